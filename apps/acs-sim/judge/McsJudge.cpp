#include "judge/McsJudge.hpp"

#include "judge/PlanChecks.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <variant>

namespace ACS::AcsSim
{

using Core::QuoteForError;
using Protocol::EAckResult;
using Protocol::EAcsCommand;

namespace
{

constexpr std::string_view REGISTRATION = "Registration";
constexpr std::string_view POSITION = "RobotPositionUpdate";

bool IsUUID(std::string_view text)
{
    constexpr std::size_t LENGTH = 36;
    constexpr std::array<std::size_t, 4> DASHES{8, 13, 18, 23};
    if (text.size() != LENGTH)
    {
        return false;
    }
    for (std::size_t i = 0; i < LENGTH; ++i)
    {
        const bool bDash = std::ranges::find(DASHES, i) != DASHES.end();
        if (bDash ? text[i] != '-' : std::isxdigit(static_cast<unsigned char>(text[i])) == 0)
        {
            return false;
        }
    }
    return true;
}

/// D-2: any case, as the examples of the specification have it.
std::optional<EAckResult> ReadResultOrNull(std::string_view text)
{
    const auto isWord = [text](std::string_view word) {
        return std::ranges::equal(text, word, [](char left, char right) {
            return std::tolower(static_cast<unsigned char>(left)) == right;
        });
    };
    if (isWord("success"))
    {
        return EAckResult::Success;
    }
    return isWord("fail") ? std::optional(EAckResult::Fail) : std::nullopt;
}

bool IsLocationPath(std::string_view path)
{
    return path.ends_with(".from") || path.ends_with(".to") || path.ends_with(".position");
}

/// Of a report or control; nullptr for others.
const std::string* FindPlanOrNull(const Protocol::AcsPayload& payload)
{
    return std::visit(
        [](const auto& typed) -> const std::string* {
            if constexpr (requires { typed.status; typed.planID.size(); typed.message; } || requires { typed.result; typed.planID.size(); })
            {
                return &typed.planID;
            }
            else
            {
                return nullptr;
            }
        },
        payload);
}

/// Forgets the oldest beyond the limit.
template <typename TMap>
void Remember(std::deque<std::string>& order, const std::string& key, TMap& map)
{
    order.push_back(key);
    if (order.size() > McsJudge::MOST_REMEMBERED)
    {
        map.erase(order.front());
        order.pop_front();
    }
}

} // namespace

McsJudge::McsJudge(Core::Duration ackTimeout)
    : _ackTimeout(ackTimeout)
{
}

RuleBook& McsJudge::GetBook()
{
    return _book;
}

bool McsJudge::HasOpenRequests() const
{
    return std::ranges::any_of(_sent, [](const auto& entry) { return entry.second.bOpen && !entry.second.bOverdue; });
}

void McsJudge::Judge(ERule rule, bool bKept, const std::string& text)
{
    if (bKept)
    {
        _book.Keep(rule);
    }
    else
    {
        _book.Violate(rule, text);
    }
}

void McsJudge::OnConnected()
{
    ++_connection;
    _bRegistered = false;
    _bWithheld = false;
}

void McsJudge::OnClosed(bool bByACS)
{
    if (_malformed.has_value() && !bByACS)
    {
        _book.Violate(ERule::MalformedText, "the connection was lost after a text that is not JSON");
    }
    _malformed.reset();
    for (auto& [transactionID, sent] : _sent)
    {
        if (sent.bOpen && !sent.bOverdue && !bByACS && sent.command == REGISTRATION)
        {
            _book.Violate(
                _connection > 1 ? ERule::Reconnected : ERule::RegistrationAnswered,
                "the connection was closed without a RegistrationAck");
        }
        sent.bOpen = false;
    }
    _bRegistered = false;
}

void McsJudge::OnTick(Core::SteadyTime now)
{
    for (auto& [transactionID, sent] : _sent)
    {
        if (!sent.bOpen || sent.bOverdue || now <= sent.deadline)
        {
            continue;
        }
        sent.bOverdue = true;
        const std::string text = fmt::format("no {}Ack for {} in time", sent.command, QuoteForError(transactionID));
        if (sent.command == REGISTRATION)
        {
            _book.Violate(_connection > 1 ? ERule::Reconnected : ERule::RegistrationAnswered, text);
        }
        else if (sent.expected == EExpectedAnswer::FailCommand)
        {
            _book.Violate(ERule::UnknownCommand, text);
        }
        else if (sent.expected == EExpectedAnswer::FailPayload)
        {
            _book.Violate(ERule::UndefinedPayload, text);
        }
        else if (_malformed.has_value() && sent.order > *_malformed)
        {
            _book.Violate(ERule::MalformedText, text);
        }
        else if (sent.bReconnected)
        {
            _book.Violate(ERule::ReportAfterReconnect, text);
        }
        else
        {
            _book.Violate(ERule::Acknowledged, text);
        }
    }
}

void McsJudge::Excuse(const std::string& transactionID)
{
    _sent[transactionID].expected = EExpectedAnswer::Any;
}

// ---- what the ACS sends

void McsJudge::OnSent(std::string_view text, Core::SteadyTime now)
{
    ++_order;
    const std::optional<MessageEnvelope> envelope = ReadEnvelopeOrNull(_document, text);
    if (!envelope.has_value() || envelope->command.empty())
    {
        _malformed = _order;
        return;
    }
    if (envelope->command == POSITION)
    {
        _book.Keep(ERule::PositionUnanswered);
        return;
    }
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    if (envelope->IsAck())
    {
        OnAnswerSent(outcome);
        return;
    }
    if (envelope->command == REGISTRATION)
    {
        OnConnected();
    }
    SentRequest made = MakeSent(envelope->command, outcome);
    const auto [entry, bNew] = _sent.try_emplace(envelope->transactionID, made);
    SentRequest& sent = entry->second;
    if (sent.sends == 0 && sent.expected == EExpectedAnswer::Any)
    {
        made.expected = EExpectedAnswer::Any;
        sent = made;
    }
    if (sent.sends > 0 && sent.connection != _connection)
    {
        // What was sent on a lost connection gets no Ack.
        sent.bReconnected = true;
        sent.sends = 0;
        sent.acks = 0;
    }
    ++sent.sends;
    sent.order = _order;
    sent.connection = _connection;
    sent.deadline = now + _ackTimeout;
    sent.bOpen = true;
    sent.bOverdue = false;
    if (made.expected != EExpectedAnswer::SuccessConnected)
    {
        return;
    }
    _lastCommState = _order;
    if (made.bConnected && std::exchange(_bWithheld, false))
    {
        _book.Keep(ERule::PlansWithheld);
    }
}

SentRequest McsJudge::MakeSent(const std::string& command, const Protocol::DecodeOutcome& outcome) const
{
    SentRequest sent;
    sent.command = command;
    if (!outcome.message.has_value())
    {
        sent.expected =
            outcome.message.error().command.has_value() ? EExpectedAnswer::FailPayload : EExpectedAnswer::FailCommand;
        return sent;
    }
    const Protocol::AcsPayload& payload = std::get<Protocol::AcsRequest>(*outcome.message).payload;
    if (const auto* const stateOrNull = std::get_if<Protocol::AcsCommStateUpdate>(&payload); stateOrNull != nullptr)
    {
        sent.expected = EExpectedAnswer::SuccessConnected;
        sent.bConnected = stateOrNull->bConnected;
    }
    else if (!IsKnownReport(payload))
    {
        sent.expected = EExpectedAnswer::Any;
    }
    return sent;
}

bool McsJudge::IsKnownReport(const Protocol::AcsPayload& payload) const
{
    const std::string* const planOrNull = FindPlanOrNull(payload);
    return planOrNull == nullptr || _plans.contains(*planOrNull);
}

void McsJudge::OnAnswerSent(const Protocol::DecodeOutcome& outcome)
{
    const auto* const ackOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsAck>(&*outcome.message) : nullptr;
    if (ackOrNull == nullptr || ackOrNull->command != EAcsCommand::ExecutionPlan)
    {
        return;
    }
    for (auto& [planID, plan] : _plans)
    {
        if (plan.transactionID == ackOrNull->transactionID)
        {
            plan.answer = ackOrNull->result;
        }
    }
}

// ---- what the MCS sends

void McsJudge::OnReceived(std::string_view text, Core::SteadyTime now)
{
    const std::optional<MessageEnvelope> envelope = ReadEnvelopeOrNull(_document, text);
    Judge(ERule::JsonObject, envelope.has_value(), "not a JSON object: " + QuoteForError(text));
    if (!envelope.has_value())
    {
        return;
    }
    Judge(
        ERule::Envelope,
        envelope->missing.empty(),
        fmt::format("{} without {}", QuoteForError(envelope->command), envelope->missing));
    if (envelope->command.empty())
    {
        return;
    }
    Protocol::DecodeOutcome outcome = _codec.Decode(text);
    if (envelope->missing.find("timestamp") == std::string::npos)
    {
        Judge(ERule::Timestamp, outcome.notes.badTimestamps == 0, "unreadable in " + QuoteForError(envelope->command));
    }
    if (envelope->IsAck())
    {
        OnAck(*envelope, now);
    }
    else
    {
        OnRequest(*envelope, std::move(outcome));
    }
}

void McsJudge::OnAck(const MessageEnvelope& envelope, Core::SteadyTime now)
{
    const std::optional<EAckResult> result = ReadResultOrNull(envelope.result);
    const std::string name =
        fmt::format("{} for {}", QuoteForError(envelope.command), QuoteForError(envelope.transactionID));
    Judge(ERule::AckResult, result.has_value(), fmt::format("{}: {}", name, QuoteForError(envelope.result)));
    if (envelope.GetRequestCommand() == POSITION)
    {
        _book.Violate(ERule::PositionUnanswered, name);
        return;
    }
    SentRequest* const sentOrNull = FindSentOrNull(envelope);
    if (sentOrNull == nullptr)
    {
        return;
    }
    SentRequest& sent = *sentOrNull;
    if (++sent.acks > sent.sends)
    {
        _book.Violate(ERule::AcknowledgedOnce, fmt::format("{}: {} Acks for {} requests", name, sent.acks, sent.sends));
        return;
    }
    _book.Keep(ERule::AcknowledgedOnce);
    if (_malformed.has_value() && sent.order > *_malformed)
    {
        _malformed.reset();
        _book.Keep(ERule::MalformedText);
    }
    if (sent.bOpen && !sent.bOverdue && now > sent.deadline)
    {
        sent.bOverdue = true;
        _book.Violate(ERule::Acknowledged, name + " came late");
    }
    else if (sent.bOpen && !sent.bOverdue)
    {
        _book.Keep(ERule::Acknowledged);
    }
    if (result.has_value())
    {
        JudgeResult(sent, *result, name);
    }
    Close(sent, envelope.transactionID);
}

/// An Ack with a foreign transactionId answers the oldest request of its command (D-4): then the other rules are not
/// violated, too.
SentRequest* McsJudge::FindSentOrNull(const MessageEnvelope& envelope)
{
    const std::string command = envelope.GetRequestCommand();
    const auto found = _sent.find(envelope.transactionID);
    if (found != _sent.end() && found->second.sends > 0)
    {
        _book.Keep(ERule::AckTransaction);
        Judge(
            ERule::AckCommand,
            found->second.command == command,
            fmt::format("{} for a {}", QuoteForError(envelope.command), QuoteForError(found->second.command)));
        return &found->second;
    }
    _book.Violate(
        ERule::AckTransaction,
        fmt::format(
            "{} for {}: no request has it",
            QuoteForError(envelope.command),
            QuoteForError(envelope.transactionID)));
    SentRequest* oldestOrNull = nullptr;
    for (auto& [transactionID, sent] : _sent)
    {
        if (sent.bOpen && sent.command == command && (oldestOrNull == nullptr || sent.order < oldestOrNull->order))
        {
            oldestOrNull = &sent;
        }
    }
    return oldestOrNull;
}

void McsJudge::JudgeResult(SentRequest& sent, EAckResult result, const std::string& name)
{
    const bool bSuccess = result == EAckResult::Success;
    const std::string text = fmt::format("{}: {}", name, GetText(result));
    if (sent.command == REGISTRATION)
    {
        Judge(_connection > 1 ? ERule::Reconnected : ERule::RegistrationAnswered, bSuccess, text);
        _bRegistered = bSuccess;
        return;
    }
    if (sent.result.has_value())
    {
        Judge(ERule::ReportRepeated, result == *sent.result, text + ", but another result before");
    }
    sent.result = sent.result.value_or(result);
    switch (sent.expected)
    {
        case EExpectedAnswer::FailPayload:
            Judge(ERule::UndefinedPayload, !bSuccess, text);
            break;
        case EExpectedAnswer::FailCommand:
            Judge(ERule::UnknownCommand, !bSuccess, text);
            break;
        case EExpectedAnswer::Success:
        case EExpectedAnswer::SuccessConnected:
            Judge(sent.bReconnected ? ERule::ReportAfterReconnect : ERule::ReportAccepted, bSuccess, text);
            break;
        case EExpectedAnswer::Any:
        default:
            break;
    }
    if (sent.expected == EExpectedAnswer::SuccessConnected && !sent.bConnected && bSuccess)
    {
        _bWithheld = sent.order == _lastCommState; // Otherwise it is true again.
    }
}

void McsJudge::Close(SentRequest& sent, const std::string& transactionID)
{
    sent.bOpen = sent.acks < sent.sends && sent.bOpen;
    if (!std::exchange(sent.bRemembered, true))
    {
        Remember(_answered, transactionID, _sent);
    }
}

void McsJudge::OnRequest(const MessageEnvelope& envelope, Protocol::DecodeOutcome outcome)
{
    Judge(
        ERule::NothingBeforeRegistration,
        _bRegistered,
        fmt::format("{} before the RegistrationAck", QuoteForError(envelope.command)));
    if (!outcome.message.has_value())
    {
        OnRequestFailure(outcome.message.error());
        return;
    }
    const auto& request = std::get<Protocol::AcsRequest>(*outcome.message);
    const EAcsCommand command = GetCommand(request);
    Judge(ERule::KnownCommand, IsSentByMCS(command), QuoteForError(envelope.command));
    if (!IsSentByMCS(command) || !IsNewRequest(request))
    {
        return;
    }
    std::visit(
        Core::Overloaded{
            [&](const Protocol::ExecutionPlan& plan) { OnPlan(plan, request.transactionID); },
            [&](const auto& other) {
                _book.Keep(ERule::RequestPayload);
                if constexpr (requires {
                                  other.planID.size();
                                  other.reason;
                              })
                {
                    OnControl(envelope.command, other.planID);
                }
            }},
        request.payload);
}

void McsJudge::OnRequestFailure(const Protocol::DecodeFailure& failure)
{
    const std::string text = fmt::format("{}: {}", QuoteForError(failure.commandName), Describe(failure.error));
    if (!failure.command.has_value() || !IsSentByMCS(*failure.command))
    {
        _book.Violate(ERule::KnownCommand, text);
        return;
    }
    _book.Keep(ERule::KnownCommand);
    if (!failure.error.path.starts_with("payload"))
    {
        _book.Violate(ERule::Envelope, text);
        return;
    }
    const bool bPlan = failure.command == EAcsCommand::ExecutionPlan;
    if (bPlan && !failure.planID.empty())
    {
        _plans.try_emplace(failure.planID, ReceivedPlan{failure.transactionID, {}});
    }
    if (bPlan && IsLocationPath(failure.error.path))
    {
        _book.Violate(ERule::PlanLocation, text);
    }
    else
    {
        _book.Violate(bPlan ? ERule::PlanPayload : ERule::RequestPayload, text);
    }
}

bool McsJudge::IsNewRequest(const Protocol::AcsRequest& request)
{
    const std::string quoted = QuoteForError(request.transactionID);
    const auto found = _received.find(request.transactionID);
    if (found != _received.end())
    {
        const bool bSame = found->second == request.payload;
        Judge(ERule::TransactionID, bSame, "two requests have " + quoted);
        return !bSame;
    }
    Judge(ERule::TransactionID, IsUUID(request.transactionID), quoted + " is not a UUID");
    _received.emplace(request.transactionID, request.payload);
    Remember(_requests, request.transactionID, _received);
    return true;
}

void McsJudge::OnPlan(const Protocol::ExecutionPlan& plan, const std::string& transactionID)
{
    _book.Keep(ERule::PlanPayload);
    std::vector<PlanFinding> findings = CheckPlan(plan);
    for (const ERule rule : {ERule::PlanLocation, ERule::PlanSteps, ERule::PlanAction, ERule::PlanCarriers})
    {
        if (std::ranges::find(findings, rule, &PlanFinding::rule) == findings.end())
        {
            _book.Keep(rule);
        }
    }
    for (PlanFinding& finding : findings)
    {
        _book.Violate(finding.rule, std::move(finding.text));
    }
    if (_bWithheld)
    {
        _book.Violate(ERule::PlansWithheld, "plan " + QuoteForError(plan.planID));
    }
    const auto [entry, bNew] = _plans.try_emplace(plan.planID);
    Judge(
        ERule::PlanID,
        bNew || entry->second.answer == EAckResult::Fail,
        fmt::format("plan {} is sent again with another transactionId", QuoteForError(plan.planID)));
    // The ACS refuses a second plan: the answer to the first one stays in effect.
    if (bNew || entry->second.answer == EAckResult::Fail)
    {
        entry->second = ReceivedPlan{transactionID, {}};
    }
}

void McsJudge::OnControl(std::string_view command, const std::string& planID)
{
    const auto found = _plans.find(planID);
    const bool bKnown = found != _plans.end() && found->second.answer != EAckResult::Fail;
    Judge(
        ERule::ControlOfKnownPlan,
        bKnown,
        fmt::format("{} of plan {}", QuoteForError(command), QuoteForError(planID)));
}

} // namespace ACS::AcsSim
