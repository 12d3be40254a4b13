#include "commands/ActionCommand.hpp"

#include "api/ApiCodec.hpp"
#include "commands/Requests.hpp"
#include "view/ActionViews.hpp"
#include "view/DisplayText.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::chrono::milliseconds ACTION_POLL{250};
constexpr std::size_t DEEPEST_ACTION = 32;
constexpr std::size_t MOST_ACTION_VALUES = 100'000;

bool IsOfferedAsString(const ActionsAnswer& offered, const std::string& actionType, std::string_view key)
{
    const auto offer = std::ranges::find(offered.offered, actionType, &ActionOfferInfo::actionType);
    if (offer == offered.offered.end())
    {
        return false;
    }
    const auto parameter = std::ranges::find(offer->parameters, key, &ActionParameterInfo::key);
    return parameter != offer->parameters.end() && parameter->valueType == "STRING";
}

Core::JsonText MakeValue(std::string_view text, bool bString)
{
    if (!bString)
    {
        Json::JsonDocument document;
        const Core::Result<const Json::Value*> value =
            document.Parse(text, {MAX_ANSWER_BYTES, DEEPEST_ACTION, MOST_ACTION_VALUES});
        if (value.has_value())
        {
            return Core::JsonText::FromTrusted(Json::WriteText(**value));
        }
    }
    return Core::JsonText::FromString(text);
}

template <typename T>
Outcome<T> DecodeBody(const std::string& body)
{
    Core::Result<T> answer = DecodeAnswer<T>(body);
    if (!answer.has_value())
    {
        return MakeBadAnswer(answer.error());
    }
    return std::move(*answer);
}

/// The action as the API answers it, on one line; empty if the answer does not have it.
std::string FindActionText(const std::string& body, const std::string& actionID)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root =
        document.Parse(body, {MAX_ANSWER_BYTES, DEEPEST_ACTION, MOST_ACTION_VALUES});
    const Json::Value* const actionsOrNull = root.has_value() ? Json::FindFirstOrNull(**root, "actions") : nullptr;
    if (actionsOrNull == nullptr || !actionsOrNull->IsArray())
    {
        return {};
    }
    for (const Json::Value& action : actionsOrNull->GetArray())
    {
        const Json::Value* const idOrNull = Json::FindFirstOrNull(action, "actionId");
        if (idOrNull != nullptr && idOrNull->IsString()
            && std::string_view(idOrNull->GetString(), idOrNull->GetStringLength()) == actionID)
        {
            return MakeDisplayableJSON(Json::WriteText(action)) + "\n";
        }
    }
    return {};
}

/// The error of a read after the action was sent.
tl::unexpected<CommandError> FailAfterSending(const AcsctlOptions& options, const CommandError& error)
{
    return FailWith(
        error.exitCode,
        fmt::format(
            "{}; {} was sent: acsctl actions {} shows its outcome",
            error.text,
            options.arguments.word,
            options.arguments.id));
}

Outcome<Shown> AwaitOutcome(Session& session, const AcsctlOptions& options, const ActionAcceptedAnswer& accepted)
{
    const std::string& robotID = options.arguments.id;
    const auto deadline = std::chrono::steady_clock::now() + ACTION_LIMIT;
    while (true)
    {
        const Outcome<std::string> body = Get(session.GetAPI(), MakeReadTarget(options));
        if (!body.has_value())
        {
            return FailAfterSending(options, body.error());
        }
        const Outcome<ActionsAnswer> answer = DecodeBody<ActionsAnswer>(*body);
        if (!answer.has_value())
        {
            return FailAfterSending(options, answer.error());
        }
        const auto action = std::ranges::find(answer->actions, accepted.actionID, &ActionInfo::actionID);
        if (action == answer->actions.end())
        {
            return FailWith(
                EXIT_ATTENTION,
                fmt::format(
                    "acsd no longer has {} of {}, probably because it was restarted: the outcome is not known",
                    options.arguments.word,
                    robotID));
        }
        const bool bInTime = std::chrono::steady_clock::now() < deadline;
        if (action->endedAt.has_value() || !bInTime)
        {
            const int exitCode = action->status == "Finished" ? EXIT_DONE : EXIT_ATTENTION;
            return Shown{
                options.bJSON ? FindActionText(*body, accepted.actionID) : MakeOutcomeLine(robotID, *action),
                exitCode};
        }
        session.GetLoop().Pause(ACTION_POLL);
    }
}

} // namespace

Outcome<std::string> MakeActionBody(const CommandArguments& arguments, const ActionsAnswer& offered)
{
    std::string body;
    std::set<std::string_view> keys;
    Json::JsonWriter writer(body);
    writer.BeginObject();
    writer.Key("actionType");
    writer.WriteString(arguments.word);
    if (!arguments.parameters.empty())
    {
        writer.Key("parameters");
        writer.BeginObject();
        for (const std::string_view parameter : arguments.parameters)
        {
            const std::size_t equals = parameter.find('=');
            const std::string_view key = parameter.substr(0, equals);
            if (!keys.insert(key).second)
            {
                return FailWith(EXIT_BAD_INPUT, fmt::format("the parameter {} is given twice", key));
            }
            writer.Key(key);
            writer.WriteRaw(MakeValue(parameter.substr(equals + 1), IsOfferedAsString(offered, arguments.word, key)));
        }
        writer.EndObject();
    }
    if (arguments.reason.has_value())
    {
        writer.Key("reason");
        writer.WriteString(*arguments.reason);
    }
    writer.EndObject();
    return body;
}

Outcome<Shown> RunAction(Session& session, const AcsctlOptions& options, const std::string& idempotencyKey)
{
    const std::string target = MakeReadTarget(options);
    const Outcome<std::string> listed = Get(session.GetAPI(), target);
    if (!listed.has_value())
    {
        return tl::make_unexpected(listed.error());
    }
    const Outcome<ActionsAnswer> offered = DecodeBody<ActionsAnswer>(*listed);
    if (!offered.has_value())
    {
        return tl::make_unexpected(offered.error());
    }
    Outcome<std::string> request = MakeActionBody(options.arguments, *offered);
    if (!request.has_value())
    {
        return tl::make_unexpected(request.error());
    }
    const tl::expected<ApiAnswer, ApiFailure> answer =
        session.GetAPI().Send({"POST", target, std::move(*request), idempotencyKey});
    if (!answer.has_value())
    {
        return tl::make_unexpected(MakeError(answer.error(), true));
    }
    const Outcome<std::string> body = GetBody(*answer);
    if (!body.has_value())
    {
        return tl::make_unexpected(MakeChangeError(*answer, body.error()));
    }
    const Outcome<ActionAcceptedAnswer> accepted = DecodeBody<ActionAcceptedAnswer>(*body);
    if (!accepted.has_value())
    {
        return tl::make_unexpected(MakeChangeError(*answer, accepted.error()));
    }
    return options.arguments.bNotAwaited ? ShowAccepted(options.bJSON, *body)
                                         : AwaitOutcome(session, options, *accepted);
}

} // namespace ACS::Acsctl
