#include "judge/McsJudge.hpp"

#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <optional>
#include <variant>

namespace ACS::AcsSim
{

using Core::QuoteForError;

namespace
{

constexpr std::string_view POSITION = "RobotPositionUpdate";

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

} // namespace

McsJudge::McsJudge(Core::Duration ackTimeout)
    : _acks(_book, ackTimeout),
      _requests(_book)
{
}

void McsJudge::OnClosed(bool bByACS)
{
    _acks.OnClosed(bByACS);
}

void McsJudge::OnSent(std::string_view text, Core::SteadyTime now)
{
    const std::optional<MessageEnvelope> envelope = ReadEnvelopeOrNull(_document, text);
    if (!envelope.has_value() || envelope->command.empty())
    {
        _acks.OnMalformedSent();
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
        _requests.OnAnswerSent(outcome);
        return;
    }
    const auto* const requestOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsRequest>(&*outcome.message) : nullptr;
    const std::string* const planOrNull = requestOrNull == nullptr ? nullptr : FindPlanOrNull(requestOrNull->payload);
    _acks.OnRequestSent(*envelope, outcome, planOrNull == nullptr || _requests.IsKnownPlan(*planOrNull), now);
}

void McsJudge::OnReceived(std::string_view text, Core::SteadyTime now)
{
    const std::optional<MessageEnvelope> envelope = ReadEnvelopeOrNull(_document, text);
    _book.Judge(ERule::JsonObject, envelope.has_value(), "not a JSON object: " + QuoteForError(text));
    if (!envelope.has_value())
    {
        return;
    }
    _book.Judge(
        ERule::Envelope,
        envelope->missing.empty(),
        fmt::format("{} without {}", QuoteForError(envelope->command), envelope->missing));
    if (envelope->command.empty())
    {
        return;
    }
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    if (envelope->missing.find("timestamp") == std::string::npos)
    {
        _book.Judge(
            ERule::Timestamp,
            outcome.notes.badTimestamps == 0,
            "unreadable in " + QuoteForError(envelope->command));
    }
    if (!envelope->IsAck())
    {
        _requests.OnRequest(*envelope, outcome, _acks);
    }
    else if (envelope->IsAckOf(POSITION))
    {
        _book.Violate(ERule::PositionUnanswered, QuoteForError(envelope->transactionID));
    }
    else
    {
        _acks.OnAck(*envelope, now);
    }
}

void McsJudge::OnTick(Core::SteadyTime now)
{
    _acks.OnTick(now);
}

void McsJudge::Excuse(const std::string& transactionID)
{
    _acks.Excuse(transactionID);
}

bool McsJudge::IsOverdue(const std::string& transactionID) const
{
    return _acks.IsOverdue(transactionID);
}

std::set<std::string> McsJudge::ListOpenRequests() const
{
    return _acks.ListOpenRequests();
}

RuleBook& McsJudge::GetBook()
{
    return _book;
}

} // namespace ACS::AcsSim
