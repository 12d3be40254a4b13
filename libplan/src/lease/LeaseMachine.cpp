#include <acs/plan/LeaseMachine.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Planning
{

namespace
{

/// Readings of a standby during one lease.
constexpr int READINGS = 12;

} // namespace

LeaseMachine::LeaseMachine(LeaseClaim claim)
    : _claim(std::move(claim)),
      _watch(_claim.config)
{
}

void LeaseMachine::Start(Core::Duration pause, std::string reason, Core::SteadyTime now, LeaseActions& out)
{
    _pauseReason = std::move(reason);
    _pauseEnd = now + pause;
    out.emplace_back(ReadLease{});
}

void LeaseMachine::OnTimer(ELeaseTimer timer, Core::SteadyTime now, LeaseActions& out)
{
    if (timer == ELeaseTimer::Read && _state == EState::Watching)
    {
        out.emplace_back(ReadLease{});
    }
    else if (timer == ELeaseTimer::Renew && _state == EState::Leading && !HasEnded(now, out))
    {
        Renew(now, out);
    }
    else if (timer == ELeaseTimer::End && _state == EState::Leading)
    {
        Lose(fmt::format("the lease could not be renewed: {}", _fault.empty() ? "the store is slow" : _fault), out);
    }
}

void LeaseMachine::OnRead(const Core::Result<LeaseState>& state, Core::SteadyTime now, LeaseActions& out)
{
    if (_state != EState::Watching)
    {
        return;
    }
    if (state.has_value() && _watch.ShouldTake(*state, now) && now >= _pauseEnd)
    {
        _call = ECall::Take; // a former fault may be that of taking it, and is known again after that
        _askedAt = now;
        out.emplace_back(TakeLease{*state});
        return;
    }
    SetFault(state.has_value() ? std::string() : Core::Describe(state.error()), out);
    ReadLater(out);
}

void LeaseMachine::OnTaken(
    const Core::Result<std::optional<std::uint64_t>>& taken,
    Core::SteadyTime now,
    LeaseActions& out)
{
    _call = ECall::None;
    SetFault(taken.has_value() ? std::string() : Core::Describe(taken.error()), out);
    const std::optional<std::uint64_t> epochOrNull = taken.value_or(std::nullopt);
    const LeaseTerm term(_claim.duration, _askedAt);
    if (epochOrNull.has_value() && _state == EState::Watching && term.IsHeld(now))
    {
        Lead(*epochOrNull, term, now, out);
        return;
    }
    if (epochOrNull.has_value())
    {
        _call = ECall::Release;
        out.emplace_back(ReleaseLease{*epochOrNull});
    }
    if (_state == EState::Watching)
    {
        SetFault(epochOrNull.has_value() ? "it took too long to take the lease" : _fault, out);
        ReadLater(out);
    }
    else if (!epochOrNull.has_value())
    {
        End(out);
    }
}

void LeaseMachine::Lead(std::uint64_t epoch, const LeaseTerm& term, Core::SteadyTime now, LeaseActions& out)
{
    _state = EState::Leading;
    _epoch = epoch;
    _term = term;
    Extend(now, out);
    out.emplace_back(StartLeaseTimer{ELeaseTimer::Renew, _term->GetRenewInterval()});
    out.emplace_back(LeaseTaken{_epoch});
}

void LeaseMachine::Renew(Core::SteadyTime now, LeaseActions& out)
{
    out.emplace_back(StartLeaseTimer{ELeaseTimer::Renew, _term->GetRenewInterval()});
    if (std::exchange(_call, ECall::Renew) == ECall::None) // otherwise the store has not answered the last request yet
    {
        _askedAt = now;
        out.emplace_back(RenewLease{_epoch});
    }
}

void LeaseMachine::OnRenewed(const Core::Result<bool>& renewed, Core::SteadyTime now, LeaseActions& out)
{
    if (_state != EState::Leading)
    {
        return;
    }
    _call = ECall::None;
    if (HasEnded(now, out))
    {
        return;
    }
    SetFault(renewed.has_value() ? std::string() : Core::Describe(renewed.error()), out);
    if (renewed.has_value() && !*renewed)
    {
        Lose("another process has taken the lease, or its row was changed", out);
    }
    else if (renewed.has_value()) // otherwise the next one may succeed in time
    {
        _term->OnRenewed(_askedAt);
        Extend(now, out);
    }
}

/// It is not revived by a late answer, although no other process leads yet: commands may have been held back meanwhile, which would
/// be missing.
bool LeaseMachine::HasEnded(Core::SteadyTime now, LeaseActions& out)
{
    if (_term->IsHeld(now))
    {
        return false;
    }
    Lose("this process has stalled for longer than its lease", out);
    return true;
}

/// To the end of a term that has not ended.
void LeaseMachine::Extend(Core::SteadyTime now, LeaseActions& out) const
{
    out.emplace_back(LeaseExtended{_term->GetEnd()});
    out.emplace_back(StartLeaseTimer{ELeaseTimer::End, _term->GetEnd() - now});
}

void LeaseMachine::Lose(std::string reason, LeaseActions& out)
{
    _state = EState::Ended;
    out.emplace_back(LeaseRevoked{});
    out.emplace_back(LeaseLost{std::move(reason)});
}

void LeaseMachine::Release(LeaseActions& out)
{
    if (_state == EState::Releasing)
    {
        return;
    }
    const EState before = std::exchange(_state, EState::Releasing);
    out.emplace_back(LeaseRevoked{});
    if (before == EState::Leading)
    {
        _call = ECall::Release;
        out.emplace_back(ReleaseLease{_epoch});
    }
    else if (
        before == EState::Ended || _call == ECall::None) // otherwise the result of the call decides what is left to do
    {
        End(out);
    }
}

void LeaseMachine::OnReleased(LeaseActions& out)
{
    _call = ECall::None;
    if (_state == EState::Releasing)
    {
        End(out);
    }
}

void LeaseMachine::End(LeaseActions& out)
{
    _state = EState::Ended;
    out.emplace_back(LeaseEnded{});
}

void LeaseMachine::ReadLater(LeaseActions& out) const
{
    out.emplace_back(StartLeaseTimer{ELeaseTimer::Read, _claim.duration / READINGS});
}

void LeaseMachine::SetFault(std::string fault, LeaseActions& out)
{
    if (fault != _fault && !fault.empty())
    {
        out.emplace_back(LeaseFault{fault});
    }
    _fault = std::move(fault);
}

LeaseWait LeaseMachine::GetWait() const
{
    if (_state == EState::Leading)
    {
        return {ELeaseWait::TakesOver, {}};
    }
    if (_state != EState::Watching)
    {
        return {ELeaseWait::Releases, {}};
    }
    if (std::string fault = GetStoreFault(); !fault.empty())
    {
        return {ELeaseWait::StoreFailed, std::move(fault)};
    }
    const std::optional<LeaseState>& seen = _watch.GetSeenOrNull();
    if (!seen.has_value())
    {
        return {ELeaseWait::NotRead, {}};
    }
    if (_watch.IsOtherConfig())
    {
        return {ELeaseWait::OtherConfig, seen->holder};
    }
    return {seen->holder == _claim.holder ? ELeaseWait::OwnName : ELeaseWait::OtherLeads, seen->holder};
}

std::string LeaseMachine::GetStoreFault() const
{
    const std::optional<LeaseState>& seen = _watch.GetSeenOrNull();
    const bool bOtherLeads = seen.has_value() && !seen->bReleased;
    return _fault.empty() && !bOtherLeads ? _pauseReason : _fault;
}

} // namespace ACS::Planning
