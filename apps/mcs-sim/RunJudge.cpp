#include "RunJudge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

namespace
{

/// An ACS that answers nothing takes no more memory than this.
constexpr std::size_t MAX_REMEMBERED = 1'024;

template <typename TTransaction>
void Remember(std::deque<TTransaction>& all, TTransaction transaction)
{
    if (all.size() == MAX_REMEMBERED)
    {
        all.pop_front();
    }
    all.push_back(std::move(transaction));
}

} // namespace

RunJudge::RunJudge(const SimulatorOptions& options, std::vector<PlannedPlan> plans, PlanTracker::Lines& lines)
    : _lines(lines),
      _tracker(std::move(plans), options.profile == EProfile::Spec)
{
    if (options.worldOrNull != nullptr)
    {
        _floor.emplace(_tracker, *options.worldOrNull, options.stocking);
    }
}

PlanTracker& RunJudge::GetTracker() noexcept
{
    return _tracker;
}

RobotBoard& RunJudge::GetBoard() noexcept
{
    return _board;
}

NoteJudge& RunJudge::GetNotes() noexcept
{
    return _notes;
}

FloorChecker* RunJudge::GetFloorOrNull() noexcept
{
    return _floor.has_value() ? &*_floor : nullptr;
}

const TimestampCounts& RunJudge::GetTimestampCounts() const noexcept
{
    return _timestamps.GetCounts();
}

const MemberJudge& RunJudge::GetMembers() const noexcept
{
    return _members;
}

void RunJudge::OnTextSent(std::string_view text)
{
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    const auto* const requestOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsRequest>(&*outcome.message) : nullptr;
    if (requestOrNull != nullptr)
    {
        _tracker.OnRequestSent(*requestOrNull);
    }
}

void RunJudge::OnTextReceived(std::string_view text)
{
    std::ranges::move(_timestamps.OnText(text), std::back_inserter(_lines));
    std::ranges::move(_members.OnText(text), std::back_inserter(_lines));
}

void RunJudge::OnTextLost(std::string_view text)
{
    _notes.Excuse();
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    const auto* const ackOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsAck>(&*outcome.message) : nullptr;
    if (ackOrNull == nullptr)
    {
        return;
    }
    _tracker.OnAckLost(ackOrNull->transactionID);
    Transaction transaction{ackOrNull->command, ackOrNull->transactionID};
    if (std::erase(_unanswered, transaction) == 0)
    {
        Remember(_lostAcks, std::move(transaction));
    }
}

void RunJudge::OnRequest(const Protocol::RequestReceived& received)
{
    if (received.bDuplicate)
    {
        return;
    }
    const Protocol::AcsPayload& payload = received.request.payload;
    if (const auto* const statusOrNull = std::get_if<Protocol::RobotStatusUpdate>(&payload))
    {
        _board.OnStatus(*statusOrNull, _lines);
        _tracker.OnRequest(payload, received.request.timestamp.time, _lines);
    }
    else if (const auto* const positionOrNull = std::get_if<Protocol::RobotPositionUpdate>(&payload))
    {
        _board.OnPosition(*positionOrNull, _lines);
    }
    else
    {
        _tracker.OnRequest(payload, received.request.timestamp.time, _lines);
    }
    if (_floor.has_value())
    {
        _floor->OnRequest(payload, _lines);
    }
}

void RunJudge::OnAck(const Protocol::AckReceived& received)
{
    if (received.bLate)
    {
        _notes.WithdrawExcuse();
    }
    std::erase(_unanswered, Transaction{received.ack.command, received.ack.transactionID});
    _tracker.OnAck(received.ack, _lines);
}

void RunJudge::OnUnanswered(const Protocol::RequestUnanswered& unanswered)
{
    // After a lost connection a plan is sent again, and may be acknowledged twice.
    const bool bPlan = unanswered.command == Protocol::EAcsCommand::ExecutionPlan;
    if (bPlan || unanswered.reason == Protocol::EUnansweredReason::Timeout)
    {
        _notes.Excuse();
    }
    // Overdue Acks of plans are the tracker's to see.
    if (bPlan)
    {
        return;
    }
    _lines.push_back(fmt::format("{} was not answered", GetText(unanswered.command)));
    Transaction transaction{unanswered.command, unanswered.transactionID};
    if (unanswered.reason == Protocol::EUnansweredReason::Timeout && std::erase(_lostAcks, transaction) == 0)
    {
        Remember(_unanswered, std::move(transaction));
    }
}

void RunJudge::OnNoted(const Protocol::ProtocolNoted& noted)
{
    std::optional<NoteJudge::Verdict> verdict = _notes.JudgeOrNull(noted);
    if (!verdict.has_value())
    {
        return;
    }
    if (verdict->bViolation)
    {
        _tracker.AddViolation(std::move(verdict->text), _lines);
    }
    else
    {
        _lines.push_back(std::move(verdict->text));
    }
}

void RunJudge::OnLinkLost()
{
    _tracker.OnLinkLost();
    // It is unknown whether the ACS has received these requests.
    _unanswered.clear();
    _lostAcks.clear();
}

void RunJudge::EndPlans()
{
    if (_floor.has_value())
    {
        _floor->EndPlans(_lines);
    }
}

void RunJudge::Finish()
{
    for (const auto& [command, transactionID] : std::exchange(_unanswered, {}))
    {
        _tracker.AddViolation(fmt::format("ACS {} was not answered", GetText(command)), _lines);
    }
    _tracker.Finish(_lines);
    if (_floor.has_value())
    {
        _floor->Finish(_lines);
    }
}

} // namespace ACS::McsSim
