#include "operator/OperatorRoutes.hpp"

#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
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

/// The only parameter that may come more than once.
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

/// What becomes of a command while nothing can be stored.
enum class EUnstored
{
    Refused, ///< As the controls of the MCS are: a crash would forget it.
    Taken    ///< It takes work away, which cannot wait for a disk; the answer says that a crash would forget it.
};

HttpResponse HandOn(
    const OperatorAccess& access,
    Planning::PlanCommand command,
    std::string message,
    EUnstored unstored = EUnstored::Refused)
{
    const std::optional<std::string> obstacle = access.getStoreObstacleOrNull();
    if (obstacle.has_value() && unstored == EUnstored::Refused)
    {
        return Refuse(
            HTTP_UNAVAILABLE,
            fmt::format(
                "Nothing is done, as a crash would forget it: {}. Ask again when /readyz says ready.",
                *obstacle));
    }
    if (obstacle.has_value())
    {
        message += fmt::format(
            " It is not stored, and a crash would forget it: {}. Look at /status, and ask again after a restart.",
            *obstacle);
    }
    return access.take(std::move(command)) ? MakeAnswer(HTTP_ACCEPTED, "message", message)
                                           : Refuse(HTTP_UNAVAILABLE, "acsd is stopping: nothing is taken any more.");
}

/// What of the request nobody would read: a command that is done otherwise than it was meant is worse than one that is not.
std::optional<std::string> FindStrayOrNull(const HttpRequest& request, const Parameters& parameters)
{
    std::set<std::string_view> seen;
    for (const auto& [name, value] : request.query)
    {
        if (std::ranges::find(parameters, name) == parameters.end())
        {
            return parameters.empty()
                ? fmt::format("There is no parameter {}; this takes none.", name)
                : fmt::format("There is no parameter {}; there is {}.", name, fmt::join(parameters, ", "));
        }
        if (!Core::JsonText::IsUtf8(value))
        {
            return fmt::format("The parameter {} is no UTF-8, found {}.", name, Core::QuoteForError(value));
        }
        if (!seen.insert(name).second && name != CARRIER)
        {
            return fmt::format("The parameter {} is given twice.", name);
        }
    }
    if (!request.body.empty())
    {
        return fmt::format(
            "A body is not read, found {}; parameters stand behind the path, as in ?robot=LR01&code=ACS-1004.",
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
    return Refuse(HTTP_NOT_FOUND, fmt::format("There is no robot {}; /status has the robots.", robotID));
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
    std::string message = robotID + (bOn ? " is taken out of service" : " is put back into service");
    message += bOn && robot->planID.has_value() ? fmt::format(" as soon as plan {} is over.", *robot->planID) : ".";
    return HandOn(
        access,
        Planning::SetMaintenance{robotID, bOn, 0},
        std::move(message),
        bOn ? EUnstored::Taken : EUnstored::Refused);
}

/// One parameter `carrier` for each port, in their order; an empty one: nothing.
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
    if (std::optional<std::string> objection = engine.GetRejectionReasonOrNull(command))
    {
        return Refuse(HTTP_BAD_REQUEST, *objection);
    }
    return HandOn(access, std::move(command), fmt::format("The ports of {} are corrected.", robotID));
}

HttpResponse ClearAlarms(const Planning::PlanEngine& engine, const OperatorAccess& access, const HttpRequest& request)
{
    const std::optional<std::string> robotID = request.GetQueryOrNull("robot");
    const std::optional<std::string> errorCode = request.GetQueryOrNull("code");
    if (!robotID.has_value() || !errorCode.has_value())
    {
        return Refuse(
            HTTP_BAD_REQUEST,
            "The parameters robot and code say which alarm: /alarms/clear?robot=LR01&code=ACS-1004");
    }
    const auto isMeant = [&robotID, &errorCode](const Planning::Alarm& alarm) {
        return alarm.robotID == *robotID && alarm.errorCode == *errorCode;
    };
    if (std::ranges::none_of(engine.GetActiveAlarms(), isMeant))
    {
        return Refuse(HTTP_NOT_FOUND, fmt::format("{} has no alarm {}; /status has the alarms.", *robotID, *errorCode));
    }
    return HandOn(
        access,
        Planning::ClearAlarms{*robotID, *errorCode, request.GetQueryOrNull("plan"), request.GetQueryOrNull("job"), 0},
        "The alarm is cleared; it comes back if its cause is still there.");
}

HttpResponse ResolveJob(
    const Planning::PlanEngine& engine,
    const OperatorAccess& access,
    const Planning::ResolveJob& command)
{
    const std::optional<std::string> objection = engine.GetRejectionReasonOrNull(command);
    if (!objection.has_value())
    {
        return HandOn(access, command, "The answer is taken; the alarm ACS-1008 of the job is cleared.");
    }
    Planning::ResolveJob other = command;
    other.answer = Planning::EJobResolution::Done;
    const bool bHeld = !engine.GetRejectionReasonOrNull(other).has_value();
    return bHeld
        ? Refuse(HTTP_CONFLICT, *objection)
        : Refuse(HTTP_NOT_FOUND, *objection + " The alarms ACS-1008 in /status name the plan and the job of each.");
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
            fmt::format("A step is named by its stepNo, a number from 1, found {}.", Core::QuoteForError(stepText)));
    }
    if (const std::optional<std::string> objection = engine.GetRejectionReasonOrNull(command))
    {
        return Refuse(engine.GetPlanOrNull(planID).has_value() ? HTTP_CONFLICT : HTTP_NOT_FOUND, *objection);
    }
    return HandOn(access, std::move(command), fmt::format("Step {} of plan {} is skipped.", stepText, planID));
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
                const std::optional<std::string> stray = FindStrayOrNull(request, parameters);
                return stray.has_value() ? Refuse(HTTP_BAD_REQUEST, *stray) : handle(request, captures);
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
            return HandOn(
                access,
                Planning::ControlTSC{bPause, 0},
                fmt::format("The TSC is told to {}; /status has its state.", word),
                bPause ? EUnstored::Taken : EUnstored::Refused);
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
        const Planning::EJobResolution said = answer;
        add(std::string("/plans/{PLAN}/jobs/{JOB}/") + word,
            {},
            [&engine, access, said](const HttpRequest&, const Captures& captures) {
                return ResolveJob(engine, access, {captures[0], captures[1], said, 0});
            });
    }
}

} // namespace ACS::Acsd
