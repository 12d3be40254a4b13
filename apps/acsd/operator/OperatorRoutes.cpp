#include "operator/OperatorRoutes.hpp"

#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::HttpRequest;
using Apps::HttpResponse;
using Captures = Apps::HttpRoutes::Captures;

using Parameters = std::vector<std::string_view>;

/// The only parameter that may be given more than once.
constexpr std::string_view CARRIER = "carrier";

constexpr unsigned HTTP_ACCEPTED = 202;
constexpr unsigned HTTP_BAD_REQUEST = 400;
constexpr unsigned HTTP_NOT_FOUND = 404;
constexpr unsigned HTTP_CONFLICT = 409;
constexpr unsigned HTTP_UNAVAILABLE = 503;

HttpResponse MakeAnswer(unsigned status, std::string_view key, std::string_view sentence)
{
    HttpResponse response{status, "application/json", {}};
    Json::JsonWriter writer(response.body);
    writer.BeginObject();
    writer.Key(key);
    writer.WriteString(sentence);
    writer.EndObject();
    response.body += '\n';
    return response;
}

HttpResponse Refuse(unsigned status, std::string_view sentence)
{
    return MakeAnswer(status, "error", sentence);
}

HttpResponse RefuseFull()
{
    constexpr std::chrono::seconds WAIT{1};
    HttpResponse response =
        Refuse(HTTP_UNAVAILABLE, "Refused, because acsd has not stored earlier commands yet. Retry in 1 s.");
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
    const OperatorAccess& access,
    Planning::PlanCommand command,
    std::string message,
    EUnstored unstored = EUnstored::Refused)
{
    const std::optional<std::string> fault = access.getStoreFaultOrNull();
    if (fault.has_value() && unstored == EUnstored::Refused)
    {
        return Refuse(
            HTTP_UNAVAILABLE,
            fmt::format("Refused, because it would be lost in a crash: {}. Retry when /readyz answers ready.", *fault));
    }
    if (fault.has_value())
    {
        message += fmt::format(
            " This is not stored and would be lost in a crash: {}. After a restart, check /status and repeat the request if "
            "necessary.",
            *fault);
    }
    switch (access.submit(std::move(command)))
    {
        case Planning::EInputAdmission::Accepted:
            return MakeAnswer(HTTP_ACCEPTED, "message", message);
        case Planning::EInputAdmission::Full:
            return RefuseFull();
        case Planning::EInputAdmission::Closed:
        default:
            return Refuse(HTTP_UNAVAILABLE, "acsd is stopping and accepts no requests.");
    }
}

/// Unknown and repeated parameters and a body. They are refused rather than ignored, because the command would do something
/// else than intended.
std::optional<std::string> FindUnexpectedOrNull(const HttpRequest& request, const Parameters& parameters)
{
    std::set<std::string_view> seen;
    for (const auto& [name, value] : request.query)
    {
        if (std::ranges::find(parameters, name) == parameters.end())
        {
            return parameters.empty()
                ? fmt::format("Unknown parameter {}; this request has no parameters.", name)
                : fmt::format("Unknown parameter {}; known: {}.", name, fmt::join(parameters, ", "));
        }
        if (!Core::JsonText::IsUtf8(value))
        {
            return fmt::format("The parameter {} is not valid UTF-8, found {}.", name, Core::QuoteForError(value));
        }
        if (!seen.insert(name).second && name != CARRIER)
        {
            return fmt::format("The parameter {} is given twice.", name);
        }
    }
    if (!request.body.empty())
    {
        return fmt::format(
            "Expected no body, found {}. Give parameters in the query: ?robot=LR01&code=ACS-1004",
            Core::QuoteForError(request.body));
    }
    return std::nullopt;
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

HttpResponse RefuseRobot(const std::string& robotID)
{
    return Refuse(HTTP_NOT_FOUND, fmt::format("There is no robot {}; /status lists the robots.", robotID));
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
    const OperatorAccess& access,
    const std::string& robotID,
    bool bOn)
{
    const std::optional<Planning::RobotStatus> robot = FindRobotOrNull(engine, robotID);
    if (!robot.has_value())
    {
        return RefuseRobot(robotID);
    }
    return Submit(
        access,
        Planning::SetMaintenance{robotID, bOn, 0},
        bOn ? DescribeMaintenance(engine, *robot) : robotID + " is put back into service.",
        bOn ? EUnstored::Accepted : EUnstored::Refused);
}

/// One parameter `carrier` for each port, in the order of the ports; an empty value is an empty port.
HttpResponse SetCarriers(
    const Planning::PlanEngine& engine,
    const OperatorAccess& access,
    const std::string& robotID,
    const HttpRequest& request)
{
    const std::optional<Planning::RobotStatus> robot = FindRobotOrNull(engine, robotID);
    if (!robot.has_value())
    {
        return RefuseRobot(robotID);
    }
    Planning::SetCarriers command{robotID, {}, 0};
    for (const auto& [name, value] : request.query)
    {
        command.carrierIDs.push_back(value.empty() ? std::nullopt : std::optional(value));
    }
    if (std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        return Refuse(HTTP_BAD_REQUEST, *reason);
    }
    return Submit(access, std::move(command), fmt::format("The ports of {} are corrected.", robotID));
}

HttpResponse ClearAlarms(const Planning::PlanEngine& engine, const OperatorAccess& access, const HttpRequest& request)
{
    const std::optional<std::string> robotID = request.GetQueryOrNull("robot");
    const std::optional<std::string> errorCode = request.GetQueryOrNull("code");
    if (!robotID.has_value() || !errorCode.has_value())
    {
        return Refuse(
            HTTP_BAD_REQUEST,
            "The parameters robot and code are required: /alarms/clear?robot=LR01&code=ACS-1004");
    }
    const auto isMeant = [&robotID, &errorCode](const Planning::Alarm& alarm) {
        return alarm.robotID == *robotID && alarm.errorCode == *errorCode;
    };
    if (std::ranges::none_of(engine.GetActiveAlarms(), isMeant))
    {
        return Refuse(
            HTTP_NOT_FOUND,
            fmt::format("{} has no alarm {}; /status lists the alarms.", *robotID, *errorCode));
    }
    return Submit(
        access,
        Planning::ClearAlarms{*robotID, *errorCode, request.GetQueryOrNull("plan"), request.GetQueryOrNull("job"), 0},
        "The alarm is cleared. It is set again if its cause persists.");
}

HttpResponse ResolveJob(
    const Planning::PlanEngine& engine,
    const OperatorAccess& access,
    const Planning::ResolveJob& command)
{
    const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command);
    if (!reason.has_value())
    {
        return Submit(access, command, "The job is resolved; its alarm ACS-1008 is cleared.");
    }
    Planning::ResolveJob other = command;
    other.resolution = Planning::EJobResolution::Done;
    const bool bUnresolved = !engine.GetRejectionReasonOrNull(other).has_value();
    return bUnresolved ? Refuse(HTTP_CONFLICT, *reason)
                       : Refuse(HTTP_NOT_FOUND, *reason + " /status lists each unresolved job as an alarm ACS-1008.");
}

HttpResponse SkipStep(
    const Planning::PlanEngine& engine,
    const OperatorAccess& access,
    const std::string& planID,
    const std::string& stepText)
{
    Planning::SkipStep command{planID, 0, 0};
    const char* end = stepText.data() + stepText.size();
    const auto [parsed, error] = std::from_chars(stepText.data(), end, command.stepNo);
    if (error != std::errc() || parsed != end)
    {
        return Refuse(
            HTTP_BAD_REQUEST,
            fmt::format("Expected a stepNo (a number from 1), found {}.", Core::QuoteForError(stepText)));
    }
    if (const std::optional<std::string> reason = engine.GetRejectionReasonOrNull(command))
    {
        return Refuse(engine.GetPlanOrNull(planID).has_value() ? HTTP_CONFLICT : HTTP_NOT_FOUND, *reason);
    }
    return Submit(access, std::move(command), fmt::format("Step {} of plan {} is skipped.", stepText, planID));
}

} // namespace

void AddOperatorRoutes(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const OperatorAccess& access)
{
    const auto add = [&routes](const std::string& pattern, Parameters parameters, Apps::HttpRoutes::Handler handle) {
        routes.Add(
            "POST",
            pattern,
            [parameters = std::move(parameters),
             handle = std::move(handle)](const HttpRequest& request, const Captures& captures) {
                const std::optional<std::string> reason = FindUnexpectedOrNull(request, parameters);
                return reason.has_value() ? Refuse(HTTP_BAD_REQUEST, *reason) : handle(request, captures);
            });
    };
    for (const bool bOn : {true, false})
    {
        add(bOn ? "/robots/{ROBOT}/maintenance/on" : "/robots/{ROBOT}/maintenance/off",
            {},
            [&engine, access, bOn](const HttpRequest&, const Captures& captures) {
                return Maintain(engine, access, captures[0], bOn);
            });
    }
    add("/robots/{ROBOT}/carriers", {CARRIER}, [&engine, access](const HttpRequest& request, const Captures& captures) {
        return SetCarriers(engine, access, captures[0], request);
    });
    add("/alarms/clear",
        {"robot", "code", "plan", "job"},
        [&engine, access](const HttpRequest& request, const Captures&) {
            return ClearAlarms(engine, access, request);
        });
    for (const bool bPause : {true, false})
    {
        const std::string_view word = bPause ? "pause" : "resume";
        add(fmt::format("/tsc/{}", word), {}, [access, bPause, word](const HttpRequest&, const Captures&) {
            return Submit(
                access,
                Planning::ControlTSC{bPause, 0},
                fmt::format("The TSC was commanded to {}; /status shows its state.", word),
                bPause ? EUnstored::Accepted : EUnstored::Refused);
        });
    }
    add("/plans/{PLAN}/steps/{STEP}/skip", {}, [&engine, access](const HttpRequest&, const Captures& captures) {
        return SkipStep(engine, access, captures[0], captures[1]);
    });
    for (const auto& [word, answer] :
         {std::pair("done", Planning::EJobResolution::Done),
          std::pair("failed", Planning::EJobResolution::Failed),
          std::pair("again", Planning::EJobResolution::Again)})
    {
        const Planning::EJobResolution resolution = answer;
        add(std::string("/plans/{PLAN}/jobs/{JOB}/") + word,
            {},
            [&engine, access, resolution](const HttpRequest&, const Captures& captures) {
                return ResolveJob(engine, access, {captures[0], captures[1], resolution, 0});
            });
    }
}

} // namespace ACS::Acsd
