#include "scenario/ScenarioStepReader.hpp"

#include "common/config/DurationText.hpp"
#include "plans/PlanFile.hpp"
#include "scenario/ObjectReader.hpp"
#include "wire/CommandNames.hpp"
#include "wire/PayloadText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

namespace
{

using Json::Value;
using Protocol::EAcsCommand;

constexpr std::uint32_t MAX_TIMES = 1000;
constexpr std::uint32_t MAX_REFUSALS = 1000;
constexpr std::uint32_t MIN_CLOSE_CODE = 1000;
constexpr std::uint32_t MAX_CLOSE_CODE = 4999;
/// Reserved for what ends a connection without a code (RFC 6455, 7.4.1).
constexpr std::array<std::uint16_t, 4> UNSENT_CLOSE_CODES{1004, 1005, 1006, 1015};
constexpr std::string_view EVERY_COMMAND = "*";

/// The members of a message that an expectation may name.
constexpr std::array MESSAGE_MEMBERS{"transactionId", "timestamp", "result", "message", "payload"};

/// The members of a step in which placeholders are replaced.
constexpr std::array FILLED_MEMBERS{"transactionId", "timestamp", "result", "message", "payload", "reason", "sendText"};

/// "planId={A}, status=Completed": the leaves of a pattern.
void DescribeLeavesRecursive( // NOLINT(misc-no-recursion): as deep as the parser's limit
    const Value& value,
    std::string_view name,
    std::string& out)
{
    if (value.IsObject())
    {
        for (const auto& member : value.GetObject())
        {
            DescribeLeavesRecursive(member.value, {member.name.GetString(), member.name.GetStringLength()}, out);
        }
        return;
    }
    out += out.empty() ? " " : ", ";
    out += name;
    out += '=';
    out += value.IsString() ? std::string(value.GetString(), value.GetStringLength()) : Json::WriteText(value);
}

/// The member that makes a step what it is.
struct Verb
{
    std::string_view name;
    ScenarioStep (*read)(StepsContext& context, ObjectReader& reader, const Verb& verb);
    EAcsCommand command = EAcsCommand::ExecutionPlan; ///< Of the verbs that are about a plan.
};

/// Which of a scenario's plans a member names.
std::string TakeName(const StepsContext& context, ObjectReader& reader, std::string_view member)
{
    std::string name = reader.TakeText(member);
    const auto found = context.names.find(name);
    if (found == context.names.end() || !std::holds_alternative<PlannedPlan>(found->second))
    {
        std::string expected = "the name that a send step before gave to a plan (\"as\")";
        reader.Refuse(member, std::move(expected), Core::QuoteForError(name));
    }
    return name;
}

/// The name that a step gives.
std::string TakeNewName(ObjectReader& reader, std::string_view otherwise)
{
    std::string name = reader.TakeText("as", otherwise);
    if (!IsScenarioName(name))
    {
        reader.Refuse("as", "a name of letters, digits, '_' and '-'", Core::QuoteForError(name));
    }
    return name;
}

/// What looks like a placeholder must stand for something: a misspelt one would match anything but what is meant.
void CheckPlaceholders(const StepsContext& context, const Value& step, ObjectReader& reader)
{
    if (!step.IsObject())
    {
        return;
    }
    for (const char* const name : FILLED_MEMBERS)
    {
        const auto member = step.FindMember(name);
        if (member != step.MemberEnd())
        {
            std::optional<Core::Error> mistake =
                FindBadPlaceholderOrNullRecursive(member->value, reader.GetPath(name), context.names);
            if (mistake.has_value())
            {
                reader.Refuse(std::move(*mistake));
            }
        }
    }
}

void ReadPlan(const StepsContext& context, ObjectReader& reader, PlannedPlan& plan)
{
    const std::string file = reader.TakeText("file");
    if (!file.empty())
    {
        tl::expected<PlannedPlan, std::string> read = context.readPlan(file);
        if (!read.has_value())
        {
            reader.Refuse("file", "a plan file", read.error());
            return;
        }
        plan = std::move(*read);
    }
}

void TakePlan(ObjectReader& reader, std::string_view member, Core::Result<PlannedPlan> parsed, PlannedPlan& plan)
{
    if (parsed.has_value())
    {
        plan = std::move(*parsed);
        return;
    }
    Core::Error& error = parsed.error();
    error.path = reader.GetPath(member) + (error.path.starts_with("payload") ? error.path.substr(7) : "");
    reader.Refuse(std::move(error));
}

ScenarioStep ReadSendPlan(StepsContext& context, ObjectReader& reader)
{
    SendPlanStep step;
    step.name = TakeNewName(reader, "plan");
    step.bFreshIDs = reader.IsTrue("freshIds", true);
    step.times = reader.TakeNumber("times", 1, 1, MAX_TIMES);
    if (step.times > 1 && !step.bFreshIDs)
    {
        reader.Refuse("times", "1 where the ids are not fresh", fmt::format("{}", step.times));
    }
    const Value* const payloadOrNull = reader.TakeOrNull("payload");
    if (payloadOrNull != nullptr)
    {
        TakePlan(reader, "payload", ParsePlanFile(Json::WriteText(*payloadOrNull)), step.plan);
    }
    else
    {
        ReadPlan(context, reader, step.plan);
    }
    context.names.insert_or_assign(step.name, step.plan);
    std::string title = fmt::format("send ExecutionPlan {}", step.name);
    title += step.times > 1 ? fmt::format(", {} times", step.times) : "";
    return {std::move(step), std::move(title)};
}

ScenarioStep ReadSendRequest(ObjectReader& reader, EAcsCommand command)
{
    SendRequestStep step;
    step.command = command;
    const Value* const payloadOrNull = reader.TakeOrNull("payload");
    step.payload = Core::JsonText::FromTrusted(payloadOrNull == nullptr ? "{}" : Json::WriteText(*payloadOrNull));
    const Core::Result<Protocol::AcsPayload> parsed = ParsePayload(command, step.payload);
    if (!parsed.has_value())
    {
        Core::Error error = parsed.error();
        error.path = reader.GetPath(error.path);
        reader.Refuse(std::move(error));
    }
    return {std::move(step), fmt::format("send {}", GetText(command))};
}

ScenarioStep ReadSend(StepsContext& context, ObjectReader& reader, const Verb& /*verb*/)
{
    const std::string name = reader.TakeText("send");
    const std::optional<EAcsCommand> command = FindCommandOrNull(name);
    if (!command.has_value() || !Protocol::IsSentByMCS(*command))
    {
        reader.Refuse("send", "one of " + ListCommands(Protocol::IsSentByMCS), Core::QuoteForError(name));
        return {};
    }
    return *command == EAcsCommand::ExecutionPlan ? ReadSendPlan(context, reader) : ReadSendRequest(reader, *command);
}

ScenarioStep ReadSendAgain(StepsContext& context, ObjectReader& reader, const Verb& /*verb*/)
{
    SendAgainStep step;
    step.name = TakeName(context, reader, "sendAgain");
    step.bFreshTransaction = reader.IsTrue("freshTransaction", false);
    std::string title = fmt::format(
        "send ExecutionPlan {} again{}",
        step.name,
        step.bFreshTransaction ? " under another transactionId" : "");
    return {std::move(step), std::move(title)};
}

ScenarioStep ReadSendText(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    const Value* const textOrNull = reader.TakeOrNull(verb.name);
    if (textOrNull->IsString())
    {
        return {SendTextStep{{textOrNull->GetString(), textOrNull->GetStringLength()}}, "send a text"};
    }
    return {SendTextStep{Json::WriteText(*textOrNull)}, "send a text"};
}

/// CancelPlan and its kin, of a plan that the scenario has sent.
ScenarioStep ReadControl(StepsContext& context, ObjectReader& reader, const Verb& verb)
{
    const std::string name = TakeName(context, reader, verb.name);
    std::string payload = R"({"planId":)";
    Core::JsonText::AppendString("{" + name + "}", payload);
    if (verb.command != EAcsCommand::ResumePlan)
    {
        payload += R"(,"reason":)";
        Core::JsonText::AppendString(reader.TakeText("reason", "asked for by a scenario"), payload);
    }
    payload += '}';
    return {
        SendRequestStep{verb.command, Core::JsonText::FromTrusted(std::move(payload))},
        fmt::format("{} {}", verb.name, name)};
}

MessagePattern ReadPattern(ObjectReader& reader, std::string_view member, std::string& description)
{
    MessagePattern pattern;
    pattern.command = reader.TakeText(member);
    if (!reader.HasFailed() && !CanComeFromACS(pattern.command))
    {
        reader.Refuse(
            member,
            "the Ack of a command of the MCS, a pattern with '*' that matches a message of the ACS, or one of "
                + ListCommands(IsSentByACS),
            Core::QuoteForError(pattern.command));
    }
    std::string members = "{";
    description = pattern.command;
    std::string leaves;
    for (const std::string_view name : MESSAGE_MEMBERS)
    {
        const Value* const valueOrNull = reader.TakeOrNull(name);
        if (valueOrNull != nullptr)
        {
            members += members.size() == 1 ? "" : ",";
            Core::JsonText::AppendString(name, members);
            members += ":" + Json::WriteText(*valueOrNull);
            DescribeLeavesRecursive(*valueOrNull, name, leaves);
        }
    }
    description += leaves;
    pattern.members = Core::JsonText::FromTrusted(members + "}");
    pattern.bRepeated = reader.IsTrue("repeated", false);
    description += pattern.bRepeated ? " repeated" : "";
    return pattern;
}

ScenarioStep ReadExpect(StepsContext& context, ObjectReader& reader, const Verb& verb)
{
    std::string description;
    ExpectStep step;
    step.pattern = ReadPattern(reader, verb.name, description);
    step.within = reader.TakeDuration("within", context.within);
    if (reader.HasMember("as"))
    {
        step.name = TakeNewName(reader, "");
        context.names.insert_or_assign(step.name, FoundMessage{});
    }
    return {std::move(step), "expect " + description};
}

/// One message, or several in any order: an array of objects with a "command".
ScenarioStep ReadExpectNext(StepsContext& context, ObjectReader& reader, const Verb& verb)
{
    ExpectNextStep step;
    std::string description;
    const Value* const groupOrNull = reader.TakeOrNull(verb.name);
    if (groupOrNull != nullptr && groupOrNull->IsArray() && !groupOrNull->Empty())
    {
        for (const Value& value : groupOrNull->GetArray())
        {
            ObjectReader element(value, fmt::format("{}[{}]", reader.GetPath(verb.name), step.patterns.size()));
            std::string part;
            CheckPlaceholders(context, value, element);
            step.patterns.push_back(ReadPattern(element, "command", part));
            description += (description.empty() ? "" : " and ") + part;
            if (const Core::Result<void> finished = element.Finish(); !finished.has_value())
            {
                reader.Refuse(finished.error());
            }
        }
    }
    else
    {
        step.patterns.push_back(ReadPattern(reader, verb.name, description));
    }
    step.within = reader.TakeDuration("within", context.within);
    step.besides = reader.HasMember("besides") ? reader.TakeText("besides") : std::string();
    if (!step.besides.empty() && !CanComeFromACS(step.besides))
    {
        reader.Refuse("besides", "the name of a message of the ACS", Core::QuoteForError(step.besides));
    }
    return {std::move(step), "expect next " + description};
}

ScenarioStep ReadExpectNothing(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    std::string description;
    ExpectNothingStep step;
    step.pattern = ReadPattern(reader, verb.name, description);
    step.duration = reader.TakeDuration("for");
    std::string title = fmt::format("expect no {} for {}", description, Apps::MakeDurationText(step.duration));
    return {std::move(step), std::move(title)};
}

ScenarioStep ReadWaitFor(StepsContext& context, ObjectReader& reader, const Verb& verb)
{
    using Protocol::EPlanStatus;
    WaitForPlanStep step;
    step.name = TakeName(context, reader, verb.name);
    step.within = reader.TakeDuration("within", context.within);
    const std::string word = reader.TakeText("status");
    constexpr std::array STATES{
        EPlanStatus::Pending,
        EPlanStatus::InProgress,
        EPlanStatus::Paused,
        EPlanStatus::Completed,
        EPlanStatus::Failed,
        EPlanStatus::Cancelled,
        EPlanStatus::Aborted};
    const auto* const found =
        std::find_if(STATES.begin(), STATES.end(), [&word](EPlanStatus status) { return GetText(status) == word; });
    if (found == STATES.end())
    {
        reader.Refuse(
            "status",
            "one of Pending, InProgress, Paused, Completed, Failed, Cancelled, Aborted",
            Core::QuoteForError(word));
        return {};
    }
    step.status = *found;
    return {step, fmt::format("wait until {} is {}", step.name, word)};
}

ScenarioStep ReadWait(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    const std::chrono::milliseconds duration = reader.TakeDuration(verb.name);
    return {WaitStep{duration}, "wait " + Apps::MakeDurationText(duration)};
}

ScenarioStep ReadAsk(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    AskStep step{reader.TakeText(verb.name)};
    std::string title = "ask: " + step.text;
    return {std::move(step), std::move(title)};
}

ScenarioStep ReadDrop(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    const std::string how = reader.TakeText(verb.name);
    if (how == "cut")
    {
        return {DropStep{EDrop::Cut}, "cut the connection"};
    }
    if (how != "close")
    {
        reader.Refuse(verb.name, "cut or close", Core::QuoteForError(how));
        return {};
    }
    const auto code =
        static_cast<std::uint16_t>(reader.TakeNumber("code", Protocol::CLOSE_NORMAL, MIN_CLOSE_CODE, MAX_CLOSE_CODE));
    if (std::find(UNSENT_CLOSE_CODES.begin(), UNSENT_CLOSE_CODES.end(), code) != UNSENT_CLOSE_CODES.end())
    {
        reader.Refuse("code", "a code that may be sent", fmt::format("{}", code));
    }
    return {DropStep{EDrop::Close, code}, fmt::format("close the connection with {}", code)};
}

AckHold ReadHold(ObjectReader& reader, std::string_view member)
{
    AckHold hold;
    const std::string name = reader.TakeText(member);
    hold.command = FindCommandOrNull(name);
    hold.duration = reader.TakeDuration("for");
    if (name != EVERY_COMMAND && (!hold.command.has_value() || !IsAckedByMCS(*hold.command)))
    {
        reader.Refuse(member, "\"*\" or one of " + ListCommands(IsAckedByMCS), Core::QuoteForError(name));
    }
    return hold;
}

std::string DescribeHold(std::string_view verb, const AckHold& hold)
{
    return fmt::format(
        "{} the Acks of {} for {}",
        verb,
        hold.command.has_value() ? GetText(*hold.command) : "every command",
        Apps::MakeDurationText(hold.duration));
}

ScenarioStep ReadWithhold(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    const AckHold hold = ReadHold(reader, verb.name);
    return {HoldAcksStep{hold}, DescribeHold("withhold", hold)};
}

ScenarioStep ReadDelay(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    AckHold hold = ReadHold(reader, verb.name);
    hold.delay = reader.TakeDuration("by");
    return {HoldAcksStep{hold}, DescribeHold("delay", hold)};
}

ScenarioStep ReadRefuse(StepsContext& /*context*/, ObjectReader& reader, const Verb& verb)
{
    RefuseRegistrationStep step;
    step.times = reader.TakeNumber(verb.name, 1, 1, MAX_REFUSALS);
    step.message = reader.TakeText("message", "Registration refused.");
    std::string title = fmt::format("refuse the next {} registrations", step.times);
    return {std::move(step), std::move(title)};
}

constexpr std::array<Verb, 17> VERBS{
    {{"send", ReadSend},
     {"sendAgain", ReadSendAgain},
     {"sendText", ReadSendText},
     {"cancel", ReadControl, EAcsCommand::CancelPlan},
     {"abort", ReadControl, EAcsCommand::AbortPlan},
     {"pause", ReadControl, EAcsCommand::PausePlan},
     {"resume", ReadControl, EAcsCommand::ResumePlan},
     {"expect", ReadExpect},
     {"expectNext", ReadExpectNext},
     {"expectNothing", ReadExpectNothing},
     {"waitFor", ReadWaitFor},
     {"wait", ReadWait},
     {"ask", ReadAsk},
     {"drop", ReadDrop},
     {"withholdAcks", ReadWithhold},
     {"delayAcks", ReadDelay},
     {"refuseRegistration", ReadRefuse}}};

} // namespace

Core::Result<ScenarioStep> ReadScenarioStep(StepsContext& context, const Value& value, const std::string& path)
{
    ObjectReader reader(value, path);
    const auto* const verb = std::find_if(VERBS.begin(), VERBS.end(), [&reader](const Verb& candidate) {
        return reader.HasMember(candidate.name);
    });
    if (verb == VERBS.end())
    {
        std::string names;
        for (const Verb& candidate : VERBS)
        {
            names += names.empty() ? "" : ", ";
            names += candidate.name;
        }
        reader.Refuse({Core::ECoreError::MissingField, path, "a step with one of the members " + names, "none"});
        return tl::make_unexpected(reader.Finish().error());
    }
    CheckPlaceholders(context, value, reader);
    ScenarioStep step = verb->read(context, reader, *verb);
    step.title = reader.TakeText("note", step.title);
    Core::Result<void> finished = reader.Finish();
    if (!finished.has_value())
    {
        return tl::make_unexpected(std::move(finished.error()));
    }
    return step;
}

} // namespace ACS::McsSim
