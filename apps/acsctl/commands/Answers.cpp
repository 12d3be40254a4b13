#include "commands/Answers.hpp"

#include "api/ApiCodec.hpp"
#include "common/config/ShellCommand.hpp"
#include "view/ActionViews.hpp"
#include "view/DisplayText.hpp"
#include "view/LineViews.hpp"
#include "view/StateViews.hpp"
#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ACS::Acsctl
{

namespace
{

constexpr unsigned HTTP_UNAUTHORIZED = 401;
constexpr unsigned HTTP_FORBIDDEN = 403;
constexpr unsigned HTTP_UNAVAILABLE = 503;

bool IsSuccess(unsigned status)
{
    constexpr unsigned HUNDRED = 100;
    return status / HUNDRED == 2;
}

template <typename T, typename TPrint>
Outcome<Shown> Show(std::string_view body, TPrint print)
{
    const Core::Result<T> answer = DecodeAnswer<T>(body);
    if (!answer.has_value())
    {
        return MakeBadAnswer(answer.error());
    }
    return Shown{print(*answer)};
}

/// The lines of application/x-ndjson.
std::vector<std::string_view> SplitLines(std::string_view body)
{
    std::vector<std::string_view> lines;
    while (!body.empty())
    {
        const std::size_t end = std::min(body.find('\n'), body.size());
        if (end != 0)
        {
            lines.push_back(body.substr(0, end));
        }
        body.remove_prefix(std::min(end + 1, body.size()));
    }
    return lines;
}

template <typename T, typename TPrint>
Outcome<Shown> ShowLines(std::string_view body, TPrint print)
{
    std::vector<T> decoded;
    for (const std::string_view line : SplitLines(body))
    {
        Core::Result<T> answer = DecodeAnswer<T>(line);
        if (!answer.has_value())
        {
            return MakeBadAnswer(answer.error());
        }
        decoded.push_back(std::move(*answer));
    }
    return Shown{print(decoded)};
}

bool HasLines(ECommand command)
{
    return command == ECommand::Trace || command == ECommand::Audit;
}

/// The JSON of the answer, on one line or, of a list of lines, on one line each.
Outcome<Shown> ShowJSON(ECommand command, std::string_view body)
{
    Shown shown;
    const std::vector<std::string_view> documents =
        HasLines(command) ? SplitLines(body) : std::vector<std::string_view>{body};
    for (const std::string_view document : documents)
    {
        const Core::Result<std::string> line = MakeOneLine(document);
        if (!line.has_value())
        {
            return MakeBadAnswer(line.error());
        }
        shown.text += *line;
        shown.text += '\n';
    }
    return shown;
}

Outcome<Shown> ShowStatus(const AcsctlOptions& options, std::string_view body, const ViewContext& context)
{
    const Core::Result<StatusInfo> status = DecodeAnswer<StatusInfo>(body);
    if (!status.has_value())
    {
        return MakeBadAnswer(status.error());
    }
    const ViewContext adjusted{context.screen, GetServerTime(*status, context.now)};
    const bool bAttention = options.arguments.bCheck && !IsHealthy(*status);
    return Shown{PrintStatus(*status, adjusted), bAttention ? EXIT_ATTENTION : EXIT_DONE};
}

Outcome<Shown> ShowPlans(const CommandArguments& arguments, std::string_view body, const ViewContext& context)
{
    const bool bUnfinished = arguments.state.value_or("unfinished") == "unfinished";
    const bool bAll = bUnfinished && !arguments.robot.has_value() && !arguments.lot.has_value();
    return Show<PlansAnswer>(body, [&](const PlansAnswer& answer) {
        return answer.plans.empty() && bAll ? std::string("No unfinished plan; --state finished lists the others.\n")
                                            : PrintPlans(answer.plans, context);
    });
}

using ShowFunction = Outcome<Shown> (*)(std::string_view body, const ViewContext& context);

struct View
{
    ECommand command;
    ShowFunction show;
};

constexpr std::array<View, 10> VIEWS{{
    {ECommand::Plan,
     [](std::string_view body, const ViewContext& context) {
         return Show<PlanInfo>(body, [&](const PlanInfo& answer) { return PrintPlan(answer, context); });
     }},
    {ECommand::Robots,
     [](std::string_view body, const ViewContext& context) {
         return Show<RobotsAnswer>(body, [&](const RobotsAnswer& answer) {
             return PrintRobots(answer.robots, context);
         });
     }},
    {ECommand::Robot,
     [](std::string_view body, const ViewContext& context) {
         return Show<RobotInfo>(body, [&](const RobotInfo& answer) { return PrintRobot(answer, context); });
     }},
    {ECommand::Actions,
     [](std::string_view body, const ViewContext& context) {
         return Show<ActionsAnswer>(body, [&](const ActionsAnswer& answer) { return PrintActions(answer, context); });
     }},
    {ECommand::Alarms,
     [](std::string_view body, const ViewContext& context) {
         return Show<AlarmsAnswer>(body, [&](const AlarmsAnswer& answer) {
             return PrintAlarms(answer.alarms, context);
         });
     }},
    {ECommand::Links,
     [](std::string_view body, const ViewContext& context) {
         return Show<LinksAnswer>(body, [&](const LinksAnswer& answer) { return PrintLinks(answer.links, context); });
     }},
    {ECommand::Queue,
     [](std::string_view body, const ViewContext& context) {
         return Show<QueueAnswer>(body, [&](const QueueAnswer& answer) { return PrintQueue(answer, context); });
     }},
    {ECommand::Site,
     [](std::string_view body, const ViewContext& context) {
         return Show<SiteAnswer>(body, [&](const SiteAnswer& answer) { return PrintSite(answer, context); });
     }},
    {ECommand::Trace,
     [](std::string_view body, const ViewContext& context) {
         return ShowLines<TraceLine>(body, [&](const auto& lines) { return PrintTrace(lines, context.screen); });
     }},
    {ECommand::Audit,
     [](std::string_view body, const ViewContext& context) {
         return ShowLines<AuditLine>(body, [&](const auto& lines) { return PrintAudit(lines, context.screen); });
     }},
}};

/// Whether acsd answers the command before its outcome is known.
bool IsPlanControl(ECommand command)
{
    return command == ECommand::Cancel || command == ECommand::Abort || command == ECommand::Pause
        || command == ECommand::Resume;
}

/// An answer without the JSON of the API: its status, and the text of acsd's HTTP server or the type of the content.
std::string DescribeForeign(const ApiAnswer& answer)
{
    constexpr std::size_t LONGEST_REASON = 400; // columns
    const std::size_t end = answer.body.find_last_not_of(" \r\n") + 1;
    const std::string reason = CutToColumns(MakeDisplayable(answer.body.substr(0, end)), LONGEST_REASON);
    const bool bPlain = answer.contentType.starts_with("text/plain") && !reason.empty();
    const std::string type = answer.contentType.empty() ? "no content" : answer.contentType;
    return fmt::format("HTTP status {}{}{}", answer.status, bPlain ? ": " : " with ", bPlain ? reason : type);
}

/// A question about the address, if the answer has the status of another server or of another address of acsd.
std::string MakeAddressHint(std::string_view listenKey, const ApiAnswer& answer)
{
    constexpr unsigned HTTP_NOT_FOUND = 404;
    constexpr unsigned FIRST_CLIENT_ERROR = 400;
    const bool bOther = answer.status < FIRST_CLIENT_ERROR || answer.status == HTTP_NOT_FOUND
        || answer.contentType.starts_with("text/html");
    return bOther ? fmt::format("; is it the address of {}?", listenKey) : std::string();
}

constexpr std::string_view MAY_BE_EXECUTED = "; acsd may have executed the command: check before you repeat it";

} // namespace

tl::unexpected<CommandError> MakeBadAnswer(const Core::Error& error)
{
    return FailWith(EXIT_BAD_ANSWER, "the answer is not one of acsd's operator API: " + Core::Describe(error));
}

Core::WallTime GetServerTime(const StatusInfo& status, Core::WallTime otherwise)
{
    if (!status.startedAt.has_value())
    {
        return otherwise;
    }
    constexpr double LONGEST = 1e9; // seconds
    const Core::Result<Core::Timestamp> started = Core::ParseTimestamp(*status.startedAt);
    const auto uptime = static_cast<std::int64_t>(std::clamp(status.uptimeSeconds, 0.0, LONGEST));
    return started.has_value() ? started->time + std::chrono::seconds(uptime) : otherwise;
}

Outcome<std::string> GetBody(const ApiAnswer& answer)
{
    return GetBodyFrom("operator.listen", answer);
}

Outcome<std::string> GetBodyFrom(std::string_view listenKey, const ApiAnswer& answer)
{
    if (IsSuccess(answer.status))
    {
        return answer.body;
    }
    const bool bDenied = answer.status == HTTP_UNAUTHORIZED || answer.status == HTTP_FORBIDDEN;
    const Core::Result<ErrorAnswer> error = DecodeAnswer<ErrorAnswer>(answer.body);
    if (!error.has_value())
    {
        return bDenied ? FailWith(EXIT_NOT_AUTHORIZED, "not authorised: " + DescribeForeign(answer))
                       : FailWith(
                           EXIT_BAD_ANSWER,
                           "the answer is not one of acsd's operator API: " + DescribeForeign(answer)
                               + MakeAddressHint(listenKey, answer));
    }
    std::string text = error->error;
    if (answer.status == HTTP_UNAVAILABLE && !answer.retryAfter.empty())
    {
        text += fmt::format(" Try again in {} s.", answer.retryAfter);
    }
    if (answer.status == HTTP_UNAUTHORIZED)
    {
        text +=
            " Identify with --token-file FILE (of the Debian package: /etc/acsd/operator.token), or with --certificate and --key.";
    }
    return FailWith(bDenied ? EXIT_NOT_AUTHORIZED : EXIT_REFUSED, std::move(text));
}

Outcome<std::string> Get(IApi& api, const std::string& target)
{
    ApiRequest request;
    request.target = target;
    const tl::expected<ApiAnswer, ApiFailure> answer = api.Send(request);
    if (!answer.has_value())
    {
        return tl::make_unexpected(MakeError(answer.error(), false));
    }
    return GetBody(*answer);
}

CommandError MakeError(const ApiFailure& failure, bool bChange)
{
    const int exitCode = failure.kind == EApiFailure::BadAnswer ? EXIT_BAD_ANSWER : EXIT_NO_CONNECTION;
    const bool bUnknown = bChange && failure.bSent;
    return {exitCode, bUnknown ? failure.text + std::string(MAY_BE_EXECUTED) : failure.text};
}

CommandError MakeChangeError(const ApiAnswer& answer, CommandError error)
{
    constexpr unsigned HTTP_BAD_GATEWAY = 502;
    constexpr unsigned HTTP_GATEWAY_TIMEOUT = 504;
    constexpr unsigned HUNDRED = 100;
    constexpr unsigned CLIENT_ERRORS = 4;
    const bool bProxy = answer.status == HTTP_BAD_GATEWAY || answer.status == HTTP_GATEWAY_TIMEOUT;
    const bool bNotExecuted = answer.status / HUNDRED == CLIENT_ERRORS;
    if (bProxy || (error.exitCode == EXIT_BAD_ANSWER && !bNotExecuted))
    {
        error.text += MAY_BE_EXECUTED;
    }
    return error;
}

Outcome<Shown> ShowAnswer(const AcsctlOptions& options, std::string_view body, const ViewContext& context)
{
    if (options.command == ECommand::Status)
    {
        Outcome<Shown> shown = ShowStatus(options, body, context);
        if (shown.has_value() && options.bJSON)
        {
            Outcome<Shown> text = ShowJSON(options.command, body);
            return text.has_value() ? Outcome<Shown>(Shown{std::move(text->text), shown->exitCode}) : text;
        }
        return shown;
    }
    if (options.bJSON)
    {
        return ShowJSON(options.command, body);
    }
    if (options.command == ECommand::Plans)
    {
        return ShowPlans(options.arguments, body, context);
    }
    const auto* const view = std::ranges::find(VIEWS, options.command, &View::command);
    if (view == VIEWS.end())
    {
        return FailWith(EXIT_BAD_INPUT, "the command has no view"); // a defect of acsctl
    }
    return view->show(body, context);
}

Outcome<Shown> ShowAccepted(bool bJSON, std::string_view body)
{
    const Core::Result<MessageAnswer> answer = DecodeAnswer<MessageAnswer>(body);
    if (!answer.has_value())
    {
        return MakeBadAnswer(answer.error());
    }
    return bJSON ? ShowJSON(ECommand::Status, body) : Outcome<Shown>(Shown{MakeDisplayable(answer->message) + "\n"});
}

Outcome<Shown> ShowChange(const AcsctlOptions& options, const ApiAnswer& answer)
{
    const Outcome<std::string> body = GetBody(answer);
    Outcome<Shown> shown =
        body.has_value() ? ShowAccepted(options.bJSON, *body) : Outcome<Shown>(tl::make_unexpected(body.error()));
    if (!shown.has_value())
    {
        return tl::make_unexpected(MakeChangeError(answer, std::move(shown.error())));
    }
    if (IsPlanControl(options.command) && !options.bJSON)
    {
        const std::string command = Apps::MakeShellCommand("plan", {options.arguments.id});
        shown->text += MakeDisplayable(command + " and acsctl events show the outcome.") + "\n";
    }
    return shown;
}

} // namespace ACS::Acsctl
