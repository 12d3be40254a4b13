#include "judge/AckJudge.hpp"

#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <variant>

namespace ACS::AcsSim
{

using Core::QuoteForError;
using Protocol::EAckResult;

namespace
{

constexpr std::string_view REGISTRATION = "Registration";

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

SentRequest MakeSent(const std::string& command, const Protocol::DecodeOutcome& outcome, bool bPlanKnown)
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
    else if (!bPlanKnown)
    {
        sent.expected = EExpectedAnswer::Any;
    }
    return sent;
}

} // namespace

AckJudge::AckJudge(RuleBook& book, Core::Duration ackTimeout)
    : _book(book),
      _ackTimeout(ackTimeout)
{
}

bool AckJudge::IsOverdue(const std::string& transactionID) const
{
    const SentRequest* const sentOrNull = _sent.FindOrNull(transactionID);
    return sentOrNull != nullptr && sentOrNull->bOverdue;
}

std::set<std::string> AckJudge::ListOpenRequests() const
{
    std::set<std::string> open;
    for (const auto& [transactionID, sent] : _sent.GetEntries())
    {
        if (sent.bOpen && !sent.bOverdue)
        {
            open.insert(transactionID);
        }
    }
    return open;
}

bool AckJudge::IsRegistered() const noexcept
{
    return _bRegistered;
}

bool AckJudge::IsWithholdingPlans() const noexcept
{
    return _bWithheld;
}

void AckJudge::OnConnected()
{
    ++_connection;
    _bRegistered = false;
    _bWithheld = false;
}

void AckJudge::OnClosed(bool bByACS)
{
    if (_malformed.has_value() && !bByACS)
    {
        _book.Violate(ERule::MalformedText, "the connection was lost after a text that is not JSON");
    }
    _malformed.reset();
    for (auto& [transactionID, sent] : _sent.GetEntries())
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

void AckJudge::OnTick(Core::SteadyTime now)
{
    for (auto& [transactionID, sent] : _sent.GetEntries())
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

void AckJudge::Excuse(const std::string& transactionID)
{
    _sent.Add(transactionID, {}).first->expected = EExpectedAnswer::Any;
}

void AckJudge::OnMalformedSent()
{
    _malformed = ++_order;
}

void AckJudge::OnRequestSent(
    const MessageEnvelope& envelope,
    const Protocol::DecodeOutcome& outcome,
    bool bPlanKnown,
    Core::SteadyTime now)
{
    ++_order;
    if (envelope.command == REGISTRATION)
    {
        OnConnected();
    }
    SentRequest made = MakeSent(envelope.command, outcome, bPlanKnown);
    SentRequest& sent = *_sent.Add(envelope.transactionID, made).first;
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

void AckJudge::OnAck(const MessageEnvelope& envelope, Core::SteadyTime now)
{
    const std::optional<EAckResult> result = ReadResultOrNull(envelope.result);
    const std::string name =
        fmt::format("{} for {}", QuoteForError(envelope.command), QuoteForError(envelope.transactionID));
    _book.Judge(ERule::AckResult, result.has_value(), fmt::format("{}: {}", name, QuoteForError(envelope.result)));
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
    sent.bOpen = sent.acks < sent.sends && sent.bOpen;
}

/// An Ack with a foreign transactionId answers the oldest request of its command (D-4): then the other rules are not
/// violated, too.
SentRequest* AckJudge::FindSentOrNull(const MessageEnvelope& envelope)
{
    SentRequest* const sentOrNull = _sent.FindOrNull(envelope.transactionID);
    if (sentOrNull != nullptr && sentOrNull->sends > 0)
    {
        _book.Keep(ERule::AckTransaction);
        _book.Judge(
            ERule::AckCommand,
            envelope.IsExactAckOf(sentOrNull->command),
            fmt::format("{} for a {}", QuoteForError(envelope.command), QuoteForError(sentOrNull->command)));
        return sentOrNull;
    }
    _book.Violate(
        ERule::AckTransaction,
        fmt::format(
            "{} for {}: no request has it",
            QuoteForError(envelope.command),
            QuoteForError(envelope.transactionID)));
    SentRequest* oldestOrNull = nullptr;
    for (auto& [transactionID, sent] : _sent.GetEntries())
    {
        const bool bOlder = oldestOrNull == nullptr || sent.order < oldestOrNull->order;
        if (sent.bOpen && bOlder && envelope.IsAckOf(sent.command))
        {
            oldestOrNull = &sent;
        }
    }
    return oldestOrNull;
}

void AckJudge::JudgeResult(SentRequest& sent, EAckResult result, const std::string& name)
{
    const bool bSuccess = result == EAckResult::Success;
    const std::string text = fmt::format("{}: {}", name, GetText(result));
    if (sent.command == REGISTRATION)
    {
        _book.Judge(_connection > 1 ? ERule::Reconnected : ERule::RegistrationAnswered, bSuccess, text);
        _bRegistered = bSuccess;
        return;
    }
    if (sent.result.has_value())
    {
        _book.Judge(ERule::ReportRepeated, result == *sent.result, text + ", but another result before");
    }
    sent.result = sent.result.value_or(result);
    switch (sent.expected)
    {
        case EExpectedAnswer::FailPayload:
            _book.Judge(ERule::UndefinedPayload, !bSuccess, text);
            break;
        case EExpectedAnswer::FailCommand:
            _book.Judge(ERule::UnknownCommand, !bSuccess, text);
            break;
        case EExpectedAnswer::Success:
        case EExpectedAnswer::SuccessConnected:
            _book.Judge(sent.bReconnected ? ERule::ReportAfterReconnect : ERule::ReportAccepted, bSuccess, text);
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

} // namespace ACS::AcsSim
