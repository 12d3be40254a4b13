#include "McsSession.Impl.hpp"
#include "PendingRequests.hpp"
#include <acs/core/Uuid.hpp>

#include <utility>
#include <variant>

namespace ACS::Protocol
{

AcsRequest McsSession::Impl::MakeRequest(AcsPayload payload, Core::Now now)
{
    return {Core::MakeUUID(_random), Detail::MakeTimestamp(now, _siteOffset), std::move(payload)};
}

bool McsSession::Impl::TrySend(const AcsRequest& request, Core::Now now, SessionActions& out)
{
    const EAcsCommand command = GetCommand(request);
    if (Detail::FindPendingByID(_pending, command, request.transactionID).bFound)
    {
        return true;
    }
    const bool bRefused = !IsSentByMCS(command) || IsWithheld(command);
    if (!_registered.has_value() || _pending.size() >= _options.maximumPending || bRefused)
    {
        return false;
    }
    AcsCodec::EncodeRequest(request, _scratch);
    ++_output.statistics.Of(command).sent;
    out.emplace_back(SendText{*_registered, _scratch, false});
    _recent.Forget(command, request.transactionID);
    _pending.push_back(
        {command,
         request.transactionID,
         Detail::GetPlanID(request.payload),
         now.steady + _options.ackTimeout,
         1,
         _options.ackRetries == 0 ? std::string() : _scratch});
    ArmAckTimer(now, out);
    return true;
}

bool McsSession::Impl::IsTakingPlans() const noexcept
{
    return _registered.has_value() && _bAcsConnected;
}

std::size_t McsSession::Impl::GetPendingCount() const noexcept
{
    return _pending.size();
}

bool McsSession::Impl::IsWithheld(EAcsCommand command) const noexcept
{
    return command == EAcsCommand::ExecutionPlan && _options.bPlansWithheld && !_bAcsConnected;
}

void McsSession::Impl::HandleAck(AcsAck& ack, SessionActions& out)
{
    Detail::PendingMatch match = Detail::FindPendingByID(_pending, ack.command, ack.transactionID);
    if (!match.bFound)
    {
        const Detail::ELateAck late = _recent.TakeAck(ack.command, ack.transactionID);
        if (late == Detail::ELateAck::Late)
        {
            ++_output.statistics.Of(ack.command).answered;
            out.emplace_back(Deliver{AckReceived{std::move(ack), true}});
            return;
        }
        if (late != Detail::ELateAck::Repeated)
        {
            const auto* planOrNull = std::get_if<PlanAck>(&ack.payload);
            match = Detail::FindPendingByCommand(_pending, ack.command, [planOrNull](const PendingRequest& request) {
                return planOrNull == nullptr || planOrNull->planID.empty() || planOrNull->planID == request.planID;
            });
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
    ++_output.statistics.Of(ack.command).answered;
    ack.transactionID = std::move(_pending[match.index].transactionID);
    _recent.Remember(ack.command, ack.transactionID, false);
    _pending.erase(_pending.begin() + static_cast<std::ptrdiff_t>(match.index));
    out.emplace_back(Deliver{AckReceived{std::move(ack), false}});
}

void McsSession::Impl::Abandon(const PendingRequest& request, EUnansweredReason reason, SessionActions& out)
{
    _recent.Remember(request.command, request.transactionID, true);
    out.emplace_back(Deliver{RequestUnanswered{request.command, request.transactionID, reason, request.attempts}});
}

void McsSession::Impl::ResendOverdue(Core::Now now, SessionActions& out)
{
    for (PendingRequest& request : _pending)
    {
        if (request.deadline > now.steady)
        {
            continue;
        }
        // What is withheld is not sent again. Its last attempt may still be acknowledged.
        if (request.attempts <= _options.ackRetries && !IsWithheld(request.command))
        {
            ++request.attempts;
            request.deadline = now.steady + _options.ackTimeout;
            ++_output.statistics.Of(request.command).sent;
            out.emplace_back(SendText{*_registered, request.text, false});
            continue;
        }
        Abandon(request, EUnansweredReason::Timeout, out);
    }
    std::erase_if(_pending, [now](const PendingRequest& request) { return request.deadline <= now.steady; });
    ArmAckTimer(now, out);
}

void McsSession::Impl::ArmAckTimer(Core::Now now, SessionActions& out)
{
    if (!_pending.empty() && !_output.IsRunning(ESessionTimer::Ack))
    {
        _output.Start(ESessionTimer::Ack, Detail::GetNextDelay(_pending, now), out);
    }
}

} // namespace ACS::Protocol
