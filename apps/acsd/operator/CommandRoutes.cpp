#include "operator/CommandRoutes.hpp"

#include "operator/CommandBodies.hpp"
#include "operator/OperatorAnswer.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan_json/PlanEnumNames.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::HttpRequest;
using Apps::HttpResponse;
using Captures = Apps::HttpRoutes::Captures;

HttpResponse Refuse(unsigned status, std::string_view sentence)
{
    return MakeOperatorError(status, sentence);
}

HttpResponse RefuseFull()
{
    constexpr std::chrono::seconds WAIT{1};
    HttpResponse response =
        Refuse(OperatorCode::UNAVAILABLE, "Refused, because acsd has not stored earlier commands yet. Retry in 1 s.");
    response.retryAfter = WAIT;
    return response;
}

/// How a command is handled while the store fails.
enum class EUnstored
{
    Refused, ///< It would be lost in a crash. Controls of the MCS are refused likewise.
    Accepted ///< It only stops work, which cannot wait for a disk. The answer states that it would be lost in a crash.
};

HttpResponse Submit(
    const CommandAccess& access,
    Planning::PlanCommand command,
    std::string message,
    EUnstored unstored = EUnstored::Refused)
{
    const std::optional<std::string> fault = access.getStoreFaultOrNull();
    if (fault.has_value() && unstored == EUnstored::Refused)
    {
        return Refuse(
            OperatorCode::UNAVAILABLE,
            fmt::format("Refused, because it would be lost in a crash: {}. Retry when /readyz answers ready.", *fault));
    }
    if (fault.has_value())
    {
        message += fmt::format(
            " This is not stored and would be lost in a crash: {}. It may take effect only when the store answers. Check /v1/status, "
            "also after a restart, and repeat the request if necessary.",
            *fault);
    }
    HttpResponse accepted = MakeAccepted(message);
    // What is not stored has no receipt either.
    switch (access.submit(std::move(command), fault.has_value() ? std::nullopt : access.makeReceiptOrNull(accepted)))
    {
        case Planning::EInputAdmission::Accepted:
            return accepted;
        case Planning::EInputAdmission::Full:
            return RefuseFull();
        case Planning::EInputAdmission::Closed:
        default:
            return Refuse(OperatorCode::UNAVAILABLE, "acsd is stopping and accepts no requests.");
    }
}

std::optional<Planning::RobotStatus> FindRobotOrNull(const Planning::PlanEngine& engine, const std::string& robotID)
{
    for (Planning::RobotStatus& robot : engine.GetRobotStatuses())
    {
        if (robot.robotID == robotID)
        {
            return std::move(robot);
        }
    }
    return std::nullopt;
}

/// What the robot completes before it is out of service.
std::string DescribeMaintenance(const Planning::PlanEngine& engine, const Planning::RobotStatus& robot)
{
    if (robot.planID.has_value())
    {
        return fmt::format("{} is taken out of service when plan {} has ended.", robot.robotID, *robot.planID);
    }
    const std::vector<Planning::RobotDetail> details = engine.GetRobotDetails();
    const auto found = std::ranges::find(details, robot.robotID, &Planning::RobotDetail::robotID);
    if (found != details.end() && found->bHasJob)
    {
        return fmt::format("{} is taken out of service. It completes the job of its ended plan.", robot.robotID);
    }
    if (found != details.end() && found->bHasDrive)
    {
        return fmt::format("{} is taken out of service when it has completed its drive.", robot.robotID);
    }
    return robot.robotID + " is taken out of service.";
}

HttpResponse Maintain(
    const Planning::PlanEngine& engine,
    const CommandAccess& access,
    const std::string& robotID,
    bool bOn)
{
    const std::optional<Planning::RobotStatus> robot = FindRobotOrNull(engine, robotID);
    if (!robot.has_value())
    {
        return RefuseUnknown("robot", robotID);
    }
    return Submit(
        access,
        Planning::SetMaintenance{robotID, bOn, 0},
        bOn ? DescribeMaintenance(engine, *robot) : robotID + " is put back into service.",
        bOn ? EUnstored::Accepted : EUnstored::Refused);
}

HttpResponse SetCarriers(
    const Planning::PlanEngine& engine,
    const CommandAccess& access,
    const std::string& robotID,
    CarriersBody body)
{
    if (!FindRobotOrNull(engine, robotID).has_value())
    {
        return RefuseUnknown("robot", robotID);
    }
    Planning::SetCarriers command{robotID, std::move(body.carrierIDs), 0};
    if (std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        return Refuse(OperatorCode::BAD_REQUEST, *reason);
    }
    return Submit(access, std::move(command), fmt::format("The ports of {} are corrected.", robotID));
}

HttpResponse ClearAlarms(const Planning::PlanEngine& engine, const CommandAccess& access, ClearBody body)
{
    const auto isMeant = [&body](const Planning::Alarm& alarm) {
        return alarm.robotID == body.robotID && alarm.errorCode == body.errorCode
            && (!body.planID.has_value() || alarm.planID == body.planID)
            && (!body.jobID.has_value() || alarm.jobID == body.jobID);
    };
    if (std::ranges::none_of(engine.GetActiveAlarms(), isMeant))
    {
        return Refuse(
            OperatorCode::NOT_FOUND,
            fmt::format(
                "{} has no alarm {}{}{}; /v1/alarms lists the alarms.",
                Core::QuoteForError(body.robotID),
                Core::QuoteForError(body.errorCode),
                body.planID.has_value() ? " of plan " + Core::QuoteForError(*body.planID) : std::string(),
                body.jobID.has_value() ? " of job " + Core::QuoteForError(*body.jobID) : std::string()));
    }
    return Submit(
        access,
        Planning::ClearAlarms{
            std::move(body.robotID),
            std::move(body.errorCode),
            std::move(body.planID),
            std::move(body.jobID),
            0},
        "The alarm is cleared. It is set again if its cause persists.");
}

bool HasJob(const Planning::PlanEngine& engine, const std::string& planID, const std::string& jobID)
{
    const Planning::PlanRecord* recordOrNull = engine.GetPlanRecordOrNull(planID);
    return recordOrNull != nullptr
        && std::ranges::any_of(recordOrNull->plan.steps, [&jobID](const Planning::Step& step) {
               return std::ranges::find(step.jobs, jobID, &Planning::Job::jobID) != step.jobs.end();
           });
}

std::optional<Planning::EJobResolution> ReadOutcomeOrNull(std::string_view word)
{
    for (const auto& [text, resolution] :
         {std::pair("done", Planning::EJobResolution::Done),
          std::pair("failed", Planning::EJobResolution::Failed),
          std::pair("again", Planning::EJobResolution::Again)})
    {
        if (word == text)
        {
            return resolution;
        }
    }
    return std::nullopt;
}

HttpResponse ResolveJob(
    const Planning::PlanEngine& engine,
    const CommandAccess& access,
    const Captures& captures,
    const ResolveBody& body)
{
    const std::optional<Planning::EJobResolution> resolution = ReadOutcomeOrNull(body.outcome);
    if (!resolution.has_value())
    {
        return Refuse(
            OperatorCode::BAD_REQUEST,
            fmt::format("Expected outcome: done, failed or again; found {}.", Core::QuoteForError(body.outcome)));
    }
    Planning::ResolveJob command{captures[0], captures[1], *resolution, 0};
    const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command);
    if (!reason.has_value())
    {
        return Submit(access, std::move(command), "The job is resolved; its alarm ACS-1008 is cleared.");
    }
    command.resolution = Planning::EJobResolution::Done;
    if (!engine.GetRejectionReasonOrNull(command).has_value())
    {
        return Refuse(OperatorCode::CONFLICT, *reason);
    }
    const std::string sentence = HasJob(engine, captures[0], captures[1]) ? *reason
                                                                          : fmt::format(
                                                                              "There is no job {} of a plan {}.",
                                                                              Core::QuoteForError(captures[1]),
                                                                              Core::QuoteForError(captures[0]));
    return Refuse(OperatorCode::NOT_FOUND, sentence + " /v1/alarms lists each unresolved job as an alarm ACS-1008.");
}

/// 404 for an unknown plan, otherwise 409.
HttpResponse RefusePlan(const Planning::PlanEngine& engine, const std::string& planID, std::string_view reason)
{
    return engine.GetPlanOrNull(planID).has_value() ? Refuse(OperatorCode::CONFLICT, reason)
                                                    : RefuseUnknown("plan", planID);
}

HttpResponse SkipStep(
    const Planning::PlanEngine& engine,
    const CommandAccess& access,
    const std::string& planID,
    const std::string& stepText)
{
    Planning::SkipStep command{planID, Core::ParseNumberOrNull<std::int32_t>(stepText).value_or(0), 0};
    if (command.stepNo < 1)
    {
        return Refuse(
            OperatorCode::BAD_REQUEST,
            fmt::format("Expected a stepNo (a number from 1), found {}.", Core::QuoteForError(stepText)));
    }
    if (const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        const Planning::PlanRecord* recordOrNull = engine.GetPlanRecordOrNull(planID);
        if (recordOrNull == nullptr)
        {
            return RefuseUnknown("plan", planID);
        }
        const bool bExists = std::ranges::count(recordOrNull->plan.steps, command.stepNo, &Planning::Step::stepNo) > 0;
        return bExists
            ? Refuse(OperatorCode::CONFLICT, *reason)
            : Refuse(OperatorCode::NOT_FOUND, fmt::format("Plan {} has no step {}.", planID, command.stepNo));
    }
    return Submit(access, std::move(command), fmt::format("Step {} of plan {} is skipped.", stepText, planID));
}

HttpResponse ControlPlan(
    const Planning::PlanEngine& engine,
    const CommandAccess& access,
    Planning::EPlanControl control,
    const std::string& planID,
    ReasonBody body)
{
    Planning::ControlPlan command{control, planID, std::move(body.reason), 0, {}, Planning::EControlOrigin::Operator};
    if (const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        return RefusePlan(engine, planID, *reason);
    }
    return Submit(
        access,
        std::move(command),
        fmt::format("{} of plan {} is accepted; /v1/plans shows its effect.", GetText(control), planID));
}

HttpResponse SetPriority(
    const Planning::PlanEngine& engine,
    const CommandAccess& access,
    const std::string& planID,
    const PriorityBody& body)
{
    Planning::SetPlanPriority command{planID, body.priority, 0};
    if (const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        return RefusePlan(engine, planID, *reason);
    }
    return Submit(access, std::move(command), fmt::format("The priority of plan {} is {}.", planID, body.priority));
}

std::optional<Planning::EBlockKind> ReadBlockKindOrNull(std::string_view word)
{
    Planning::EBlockKind kind{};
    bool bExact = false;
    return Json::TryReadWord(word, kind, bExact) && bExact ? std::optional(kind) : std::nullopt;
}

HttpResponse RefuseKind(std::string_view kind)
{
    return Refuse(
        OperatorCode::BAD_REQUEST,
        fmt::format("Expected kind: node, edge or station; found {}.", Core::QuoteForError(kind)));
}

bool IsOnMap(const Planning::SiteMap& site, Planning::EBlockKind kind, const std::string& placeID)
{
    switch (kind)
    {
        case Planning::EBlockKind::Node:
            return site.FindNodeOrNull(placeID) != nullptr;
        case Planning::EBlockKind::Edge:
            return std::ranges::find(site.GetEdges(), placeID, &Planning::SiteEdge::edgeID) != site.GetEdges().end();
        case Planning::EBlockKind::Station:
        default:
            return site.FindStationOrNull(placeID) != nullptr;
    }
}

/// 404 for a place that is not on the map, otherwise 409.
template <typename TCommand>
HttpResponse RefusePlace(const Planning::PlanEngine& engine, const TCommand& command, std::string_view reason)
{
    return IsOnMap(engine.GetSite(), command.kind, command.id) ? Refuse(OperatorCode::CONFLICT, reason)
                                                               : Refuse(
                                                                   OperatorCode::NOT_FOUND,
                                                                   fmt::format(
                                                                       "There is no {} {}; /v1/site lists them.",
                                                                       GetText(command.kind),
                                                                       Core::QuoteForError(command.id)));
}

HttpResponse Block(const Planning::PlanEngine& engine, const CommandAccess& access, BlockBody body)
{
    const std::optional<Planning::EBlockKind> kind = ReadBlockKindOrNull(body.kind);
    if (!kind.has_value())
    {
        return RefuseKind(body.kind);
    }
    Planning::BlockPlace command{*kind, std::move(body.placeID), std::move(body.reason), 0};
    if (const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        return RefusePlace(engine, command, *reason);
    }
    std::string message = fmt::format("The {} {} is blocked.", body.kind, command.id);
    return Submit(access, std::move(command), std::move(message), EUnstored::Accepted);
}

HttpResponse Unblock(const Planning::PlanEngine& engine, const CommandAccess& access, UnblockBody body)
{
    const std::optional<Planning::EBlockKind> kind = ReadBlockKindOrNull(body.kind);
    if (!kind.has_value())
    {
        return RefuseKind(body.kind);
    }
    Planning::UnblockPlace command{*kind, std::move(body.placeID), 0};
    if (const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        return RefusePlace(engine, command, *reason);
    }
    std::string message = fmt::format("The {} {} is open again.", body.kind, command.id);
    return Submit(access, std::move(command), std::move(message));
}

/// Adds a POST whose body is TBody.
template <typename TBody, typename THandle>
void AddCommand(Apps::HttpRoutes& routes, std::string_view pattern, THandle handle)
{
    routes.Add(
        "POST",
        pattern,
        [handle = std::move(handle)](const HttpRequest& request, const Captures& captures) -> HttpResponse {
            if (const std::optional<std::string> reason = FindUnexpectedParameterOrNull(request, {}))
            {
                return Refuse(OperatorCode::BAD_REQUEST, *reason);
            }
            Core::Result<TBody> body = ReadBody<TBody>(request.body);
            if (!body.has_value())
            {
                return Refuse(OperatorCode::BAD_REQUEST, "Invalid body: " + Core::Describe(body.error()));
            }
            return handle(captures, std::move(*body));
        });
}

void AddPlanCommands(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const CommandAccess& access)
{
    AddCommand<EmptyBody>(
        routes,
        "/v1/plans/{planId}/steps/{stepNo}/skip",
        [&engine, access](const Captures& captures, const EmptyBody&) {
            return SkipStep(engine, access, captures[0], captures[1]);
        });
    for (const auto& [word, control] :
         {std::pair("cancel", Planning::EPlanControl::Cancel),
          std::pair("abort", Planning::EPlanControl::Abort),
          std::pair("pause", Planning::EPlanControl::Pause),
          std::pair("resume", Planning::EPlanControl::Resume)})
    {
        AddCommand<ReasonBody>(
            routes,
            fmt::format("/v1/plans/{{planId}}/{}", word),
            [&engine, access, kind = control](const Captures& captures, ReasonBody body) {
                return ControlPlan(engine, access, kind, captures[0], std::move(body));
            });
    }
    AddCommand<PriorityBody>(
        routes,
        "/v1/plans/{planId}/priority",
        [&engine, access](const Captures& captures, const PriorityBody& body) {
            return SetPriority(engine, access, captures[0], body);
        });
    AddCommand<ResolveBody>(
        routes,
        "/v1/plans/{planId}/jobs/{jobId}/resolve",
        [&engine, access](const Captures& captures, const ResolveBody& body) {
            return ResolveJob(engine, access, captures, body);
        });
}

void AddRobotCommands(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const CommandAccess& access)
{
    AddCommand<MaintenanceBody>(
        routes,
        "/v1/robots/{robotId}/maintenance",
        [&engine, access](const Captures& captures, const MaintenanceBody& body) {
            return Maintain(engine, access, captures[0], body.bOn);
        });
    AddCommand<CarriersBody>(
        routes,
        "/v1/robots/{robotId}/carriers",
        [&engine, access](const Captures& captures, CarriersBody body) {
            return SetCarriers(engine, access, captures[0], std::move(body));
        });
    AddCommand<ClearBody>(routes, "/v1/alarms/clear", [&engine, access](const Captures&, ClearBody body) {
        return ClearAlarms(engine, access, std::move(body));
    });
}

void AddSiteCommands(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const CommandAccess& access)
{
    AddCommand<BlockBody>(routes, "/v1/site/block", [&engine, access](const Captures&, BlockBody body) {
        return Block(engine, access, std::move(body));
    });
    AddCommand<UnblockBody>(routes, "/v1/site/unblock", [&engine, access](const Captures&, UnblockBody body) {
        return Unblock(engine, access, std::move(body));
    });
    for (const bool bPause : {true, false})
    {
        const std::string_view word = bPause ? "pause" : "resume";
        AddCommand<EmptyBody>(
            routes,
            fmt::format("/v1/tsc/{}", word),
            [access, bPause, word](const Captures&, const EmptyBody&) {
                return Submit(
                    access,
                    Planning::ControlTSC{bPause, 0},
                    fmt::format("The TSC was commanded to {}; /v1/status shows its state.", word),
                    bPause ? EUnstored::Accepted : EUnstored::Refused);
            });
    }
}

} // namespace

void AddCommandRoutes(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const CommandAccess& access)
{
    AddPlanCommands(routes, engine, access);
    AddRobotCommands(routes, engine, access);
    AddSiteCommands(routes, engine, access);
}

} // namespace ACS::Acsd
