#include "AcsSession.Impl.hpp"
#include "PendingRequests.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Protocol
{

void AcsSession::Impl::ArmAckTimer(Core::Now now, SessionActions& out)
{
    if (IsUp() && !_inFlight.empty() && !_output.IsRunning(ESessionTimer::Ack))
    {
        _output.Start(ESessionTimer::Ack, Detail::GetNextDelay(_inFlight, now), out);
    }
}

void AcsSession::Impl::ResendLate(Core::Now now, SessionActions& out)
{
    std::vector<InFlight> entries = std::exchange(_inFlight, {});
    for (InFlight& entry : entries)
    {
        if (entry.deadline > now.steady)
        {
            _inFlight.push_back(std::move(entry));
        }
        else if (entry.bSuperseded)
        {
            _recent.Remember(entry.command, entry.transactionID, entry.bDurable);
        }
        else if (entry.resends < _options.ackRetries)
        {
            ++entry.resends;
            entry.deadline = now.steady + _options.ackTimeout;
            ++_output.statistics.Of(entry.command).sent;
            out.emplace_back(SendText{0, entry.text, false});
            _inFlight.push_back(std::move(entry));
        }
        else
        {
            Abandon(entry, out);
        }
    }
    if (_unansweredInRow >= _options.ackDeadAfter && _state == EState::Registered)
    {
        Leave(EState::Closing, CLOSE_NORMAL, "no acknowledgements", out);
    }
}

void AcsSession::Impl::Abandon(const InFlight& entry, SessionActions& out)
{
    ++_unansweredInRow;
    _recent.Remember(entry.command, entry.transactionID, entry.bDurable);
    if (entry.bDurable)
    {
        out.emplace_back(Deliver{
            RequestUnanswered{entry.command, entry.transactionID, EUnansweredReason::Timeout, entry.resends + 1}});
    }
    else if (const auto status = _statuses.find(entry.statusKey); status != _statuses.end())
    {
        status->second.bUnanswered = true;
    }
}

void AcsSession::Impl::HandleAck(const AcsAck& ack, SessionActions& out)
{
    if (_state == EState::Registering && ack.command == EAcsCommand::Registration)
    {
        HandleRegistrationAck(ack, out);
        return;
    }
    Detail::PendingMatch match = Detail::FindPendingByID(_inFlight, ack.command, ack.transactionID);
    if (!match.bFound)
    {
        if (IsLateAck(ack, out))
        {
            return;
        }
        if (_options.bAcksMatchedByCommand)
        {
            match = Detail::FindPendingByCommand(_inFlight, ack.command);
        }
    }
    if (!match.bFound)
    {
        _output.Note(EProtocolNote::AckUnexpected, std::string(GetText(ack.command)), out);
        return;
    }
    if (match.bByCommand)
    {
        _output.Note(EProtocolNote::AckMismatched, std::string(GetText(ack.command)), out);
    }
    const InFlight entry = std::move(_inFlight[match.index]);
    _inFlight.erase(_inFlight.begin() + static_cast<std::ptrdiff_t>(match.index));
    _recent.Remember(entry.command, entry.transactionID, false);
    _unansweredInRow = 0;
    ++_output.statistics.Of(ack.command).answered;
    if (entry.bDurable)
    {
        out.emplace_back(Deliver{Acked{ack.command, entry.transactionID, ack.result, ack.message}});
    }
    else if (ack.result == EAckResult::Fail)
    {
        _output.Note(EProtocolNote::AckFailed, ack.message, out);
    }
    if (_state == EState::Farewell && entry.transactionID == _farewellID)
    {
        Leave(EState::Stopping, CLOSE_NORMAL, "shutting down", out);
    }
}

bool AcsSession::Impl::IsLateAck(const AcsAck& ack, SessionActions& out)
{
    const Detail::ELateAck late = _recent.TakeAck(ack.command, ack.transactionID);
    if (late == Detail::ELateAck::Unknown)
    {
        return false;
    }
    if (late == Detail::ELateAck::Late)
    {
        _unansweredInRow = 0;
        ++_output.statistics.Of(ack.command).answered;
        out.emplace_back(Deliver{Acked{ack.command, ack.transactionID, ack.result, ack.message}});
    }
    else
    {
        _output.Note(EProtocolNote::AckUnexpected, std::string(GetText(ack.command)), out);
    }
    return true;
}

} // namespace ACS::Protocol
