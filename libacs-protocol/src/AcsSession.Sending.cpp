#include "AcsSession.Impl.hpp"
#include "PendingRequests.hpp"
#include <acs/core/Uuid.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Protocol
{

namespace
{

using Detail::EConnectPhase;
using Detail::EWaitingRequests;
using Detail::StatusKey;

StatusKey MakeStatusKey(const AcsPayload& payload)
{
    const RobotStatusUpdate* robotOrNull = std::get_if<RobotStatusUpdate>(&payload);
    return {GetCommand(payload), robotOrNull == nullptr ? std::string() : robotOrNull->robotID};
}

bool IsStatus(const AcsPayload& payload)
{
    return std::holds_alternative<TscStateUpdate>(payload) || std::holds_alternative<AcsCommStateUpdate>(payload)
        || std::holds_alternative<RobotStatusUpdate>(payload);
}

/// Whether the MCS must see this status although another one has followed: section 6.16 has each change sent, section 6.7
/// demands Stopped of a pause.
bool ShouldBeSeen(const AcsPayload& waiting, const AcsPayload& next)
{
    const RobotStatusUpdate* const robotOrNull = std::get_if<RobotStatusUpdate>(&waiting);
    const RobotStatusUpdate* const nextOrNull = std::get_if<RobotStatusUpdate>(&next);
    if (robotOrNull == nullptr || nextOrNull == nullptr)
    {
        return false;
    }
    const bool bKept =
        robotOrNull->robotStatus == ERobotStatus::Arrival || robotOrNull->robotStatus == ERobotStatus::Stopped;
    const bool bRepeated = robotOrNull->robotStatus == nextOrNull->robotStatus
        && robotOrNull->position == nextOrNull->position && robotOrNull->planID == nextOrNull->planID
        && robotOrNull->stepNo == nextOrNull->stepNo;
    return bKept && !bRepeated;
}

} // namespace

bool AcsSession::Impl::TrySendDurable(const AcsRequest& request, Core::Now now, SessionActions& out)
{
    if (_state != EState::Registered)
    {
        return false;
    }
    const EAcsCommand command = GetCommand(request);
    if (Detail::FindPendingByID(_inFlight, command, request.transactionID).bFound)
    {
        return true;
    }
    if (GetRoom() == 0)
    {
        _requests = std::max(_requests, EWaitingRequests::Waiting);
        return false;
    }
    _recent.Forget(GetCommand(request), request.transactionID);
    Send(request, true, {}, now, out);
    ArmAckTimer(now, out);
    return true;
}

void AcsSession::Impl::ReplayDone(Core::Now now, SessionActions& out)
{
    if (_state != EState::Registered || _phase != EConnectPhase::Replay)
    {
        return;
    }
    _phase = EConnectPhase::Snapshot;
    UseRoom(now, out);
}

void AcsSession::Impl::SendStatus(const AcsPayload& status, Core::Now now, SessionActions& out)
{
    assert(IsStatus(status));
    if (IsStatus(status) && !IsKnownState(status))
    {
        Replace(_statuses[MakeStatusKey(status)], status, _state == EState::Registered);
        UseRoom(now, out);
    }
}

void AcsSession::Impl::Replace(Status& status, const AcsPayload& payload, bool bConnected)
{
    if (bConnected && status.bPending && !status.bEarlier && ShouldBeSeen(status.payload, payload))
    {
        status.passed.push_back(std::move(status.payload));
        if (status.passed.size() > MOST_PASSED)
        {
            status.passed.pop_front();
        }
    }
    status.payload = payload;
    status.bPending = true;
    status.bUnanswered = false;
    status.bEarlier = false;
}

void AcsSession::Impl::SendPosition(const RobotPositionUpdate& positions, Core::Now now, SessionActions& out)
{
    if (_state != EState::Registered || _phase != EConnectPhase::Positions)
    {
        return;
    }
    AcsCodec::EncodeRequest({Core::MakeUUID(_random), Detail::MakeTimestamp(now, _siteOffset), positions}, _scratch);
    ++_output.statistics.Of(EAcsCommand::RobotPositionUpdate).sent;
    out.emplace_back(SendText{0, _scratch, true});
}

std::size_t AcsSession::Impl::GetRoom() const noexcept
{
    return _state == EState::Registered && _inFlight.size() < _options.window ? _options.window - _inFlight.size() : 0;
}

bool AcsSession::Impl::IsKnownState(const AcsPayload& status) const
{
    const auto found = _statuses.find(MakeStatusKey(status));
    return !std::holds_alternative<RobotStatusUpdate>(status) && found != _statuses.end() && !found->second.bUnanswered
        && found->second.payload == status;
}

void AcsSession::Impl::Send(
    const AcsRequest& request,
    bool bDurable,
    StatusKey statusKey,
    Core::Now now,
    SessionActions& out)
{
    InFlight& entry = _inFlight.emplace_back();
    entry.command = GetCommand(request);
    entry.transactionID = request.transactionID;
    entry.deadline = now.steady + _options.ackTimeout;
    entry.bDurable = bDurable;
    entry.statusKey = std::move(statusKey);
    AcsCodec::EncodeRequest(request, entry.text);
    ++_output.statistics.Of(entry.command).sent;
    out.emplace_back(SendText{0, entry.text, false});
}

std::string AcsSession::Impl::SendPayload(AcsPayload payload, StatusKey statusKey, Core::Now now, SessionActions& out)
{
    AcsRequest request{Core::MakeUUID(_random), Detail::MakeTimestamp(now, _siteOffset), std::move(payload)};
    Send(request, false, std::move(statusKey), now, out);
    return std::move(request.transactionID);
}

void AcsSession::Impl::UseRoom(Core::Now now, SessionActions& out)
{
    const std::size_t room = GetRoom();
    const std::size_t kept = _requests == EWaitingRequests::Next ? 1 : 0;
    if (_phase != EConnectPhase::Replay)
    {
        SendStatuses(kept, now, out);
        if (TryEndSnapshot(now, out))
        {
            SendStatuses(kept, now, out);
        }
    }
    if (_requests != EWaitingRequests::None && room > 0)
    {
        OfferRoom(out);
    }
    ArmAckTimer(now, out);
}

void AcsSession::Impl::OfferRoom(SessionActions& out)
{
    if (GetRoom() == 0)
    {
        _requests = EWaitingRequests::Next;
        return;
    }
    _requests = EWaitingRequests::None;
    out.emplace_back(Deliver{WindowOpened{}});
    if (_inFlight.empty() && !_output.IsRunning(ESessionTimer::Ack))
    {
        // Statuses may wait for room that no request uses, and no Ack is due.
        _output.Start(ESessionTimer::Ack, _options.ackTimeout, out);
    }
}

bool AcsSession::Impl::TryEndSnapshot(Core::Now now, SessionActions& out)
{
    const auto isPending = [](const auto& entry) {
        return entry.second.bPending;
    };
    const bool bDue = _state == EState::Registered && _phase == EConnectPhase::Snapshot;
    if (!bDue || std::any_of(_statuses.upper_bound(_lastStatus), _statuses.end(), isPending))
    {
        return false;
    }
    _phase = EConnectPhase::Positions;
    if (_options.positionInterval.count() > 0)
    {
        _nextPosition = now.steady;
        SchedulePosition(now, out);
    }
    return true;
}

void AcsSession::Impl::Supersede(const AcsPayload& status)
{
    const StatusKey key = MakeStatusKey(status);
    for (InFlight& entry : _inFlight)
    {
        entry.bSuperseded = entry.bSuperseded || (!entry.bDurable && entry.statusKey == key);
    }
}

void AcsSession::Impl::SendStatuses(std::size_t kept, Core::Now now, SessionActions& out)
{
    auto next = _statuses.upper_bound(_lastStatus);
    std::size_t left = _statuses.size();
    while (left > 0 && GetRoom() > kept)
    {
        --left;
        if (next == _statuses.end())
        {
            if (_phase == EConnectPhase::Snapshot)
            {
                return; // what has changed since it was sent follows after the snapshot
            }
            next = _statuses.begin();
        }
        auto& [key, status] = *next;
        ++next;
        if (!status.bPending)
        {
            continue;
        }
        Supersede(status.payload);
        _lastStatus = key;
        if (!status.passed.empty())
        {
            static_cast<void>(SendPayload(std::move(status.passed.front()), key, now, out));
            status.passed.pop_front();
            left = _statuses.size(); // the next one of this robot follows in its turn
            continue;
        }
        status.bPending = false;
        static_cast<void>(SendPayload(status.payload, key, now, out));
    }
}

void AcsSession::Impl::SchedulePosition(Core::Now now, SessionActions& out)
{
    const auto late = now.steady - _nextPosition;
    _output.statistics.positionTicksMissed += static_cast<std::uint64_t>(late / _options.positionInterval);
    _nextPosition += _options.positionInterval * (late / _options.positionInterval + 1);
    const auto delay = std::chrono::ceil<std::chrono::milliseconds>(_nextPosition - now.steady);
    _output.Start(ESessionTimer::Position, delay, out);
    out.emplace_back(Deliver{PositionDue{}});
}

} // namespace ACS::Protocol
