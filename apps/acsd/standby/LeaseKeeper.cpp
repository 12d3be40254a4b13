#include "standby/LeaseKeeper.hpp"

#include <boost/asio/post.hpp>
#include <fmt/format.h>

#include <atomic>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// Readings of a standby during one lease.
constexpr int READINGS = 12;

} // namespace

LeaseKeeper::LeaseKeeper(
    Dependencies dependencies,
    const LeaseMaker& makeLease,
    Planning::LeaseClaim claim,
    Handlers handlers)
    : _dependencies(std::move(dependencies)),
      _claim(std::move(claim)),
      _handlers(std::move(handlers)),
      _watch(_claim.config),
      _stopping(std::make_shared<std::atomic<bool>>(false)),
      _lease(_dependencies.executor, makeLease([stopping = _stopping] { return stopping->load(); })),
      _timers(_dependencies.executor, [this](ETimer timer) { OnTimer(timer); })
{
}

LeaseKeeper::~LeaseKeeper()
{
    *_stopping = true;
}

void LeaseKeeper::Start()
{
    Read();
}

void LeaseKeeper::StartAfter(Core::Duration pause, std::string reason)
{
    _pauseReason = std::move(reason);
    _pauseEnd = _dependencies.clock.GetNow().steady + pause;
    Read();
}

void LeaseKeeper::OnTimer(ETimer timer)
{
    switch (timer)
    {
        case ETimer::Read:
            Read();
            return;
        case ETimer::Renew:
            Renew();
            return;
        case ETimer::End:
            Lose(fmt::format("the lease could not be renewed: {}", _fault.empty() ? "the store is slow" : _fault));
            return;
        default:
            return;
    }
}

void LeaseKeeper::Read()
{
    _lease.Do(
        [](Planning::ILease& lease) { return lease.Read(); },
        [this](const Core::Result<Planning::LeaseState>& state) { OnRead(state); });
}

void LeaseKeeper::OnRead(const Core::Result<Planning::LeaseState>& state)
{
    if (_state != EState::Watching)
    {
        return;
    }
    const Core::SteadyTime now = _dependencies.clock.GetNow().steady;
    if (state.has_value() && _watch.ShouldTake(*state, now) && now >= _pauseEnd)
    {
        Take(*state); // a former fault may be that of taking it, and is known again after that
        return;
    }
    SetFault(state.has_value() ? std::string() : Core::Describe(state.error()));
    ReadLater();
}

void LeaseKeeper::ReadLater()
{
    _timers.Start(ETimer::Read, _claim.duration / READINGS);
}

void LeaseKeeper::Take(const Planning::LeaseState& seen)
{
    _bTaking = true;
    const Core::SteadyTime askedAt = _dependencies.clock.GetNow().steady;
    _lease.Do(
        [seen, claim = _claim](Planning::ILease& lease) { return lease.TryTakeOrNull(seen, claim); },
        [this, askedAt](const Core::Result<std::optional<std::uint64_t>>& taken) { OnTaken(taken, askedAt); });
}

void LeaseKeeper::OnTaken(const Core::Result<std::optional<std::uint64_t>>& taken, Core::SteadyTime askedAt)
{
    _bTaking = false;
    SetFault(taken.has_value() ? std::string() : Core::Describe(taken.error()));
    const std::optional<std::uint64_t> epochOrNull = taken.value_or(std::nullopt);
    if (_state == EState::Ended)
    {
        epochOrNull.has_value() ? ReleaseTaken(*epochOrNull, std::move(_onReleased)) : _onReleased();
        return;
    }
    if (!epochOrNull.has_value())
    {
        ReadLater();
        return;
    }
    const Planning::LeaseTerm term(_claim.duration, askedAt);
    if (!term.IsHeld(_dependencies.clock.GetNow().steady))
    {
        SetFault("it took too long to take the lease");
        ReleaseTaken(*epochOrNull, [] {});
        ReadLater();
        return;
    }
    _state = EState::Leading;
    _epoch = *epochOrNull;
    _term = term;
    Extend();
    _timers.Start(ETimer::Renew, _term->GetRenewInterval());
    _dependencies.logger.Info("this process leads", {{"epoch", std::to_string(_epoch)}});
    _handlers.onTaken(_epoch);
}

void LeaseKeeper::Renew()
{
    if (_state != EState::Leading || HasEnded())
    {
        return;
    }
    _timers.Start(ETimer::Renew, _term->GetRenewInterval());
    if (std::exchange(_bRenewing, true))
    {
        return; // the store has not answered the last request yet
    }
    const Core::SteadyTime askedAt = _dependencies.clock.GetNow().steady;
    _lease.Do(
        [epoch = _epoch](Planning::ILease& lease) { return lease.TryRenew(epoch); },
        [this, askedAt](const Core::Result<bool>& renewed) { OnRenewed(renewed, askedAt); });
}

void LeaseKeeper::OnRenewed(const Core::Result<bool>& renewed, Core::SteadyTime askedAt)
{
    _bRenewing = false;
    if (_state != EState::Leading || HasEnded())
    {
        return;
    }
    SetFault(renewed.has_value() ? std::string() : Core::Describe(renewed.error()));
    if (renewed.has_value() && !*renewed)
    {
        Lose("another process has taken the lease, or its row was changed");
        return;
    }
    if (!renewed.has_value())
    {
        return; // the next one may succeed in time
    }
    _term->OnRenewed(askedAt);
    Extend();
}

/// Loses a lease that has ended. It is not revived by a late answer, although no other process leads yet: commands may have been
/// held back meanwhile, which would be missing.
bool LeaseKeeper::HasEnded()
{
    if (_term->IsHeld(_dependencies.clock.GetNow().steady))
    {
        return false;
    }
    Lose("this process has stalled for longer than its lease");
    return true;
}

/// To the end of a term that has not ended.
void LeaseKeeper::Extend()
{
    _dependencies.guard.Extend(_term->GetEnd());
    _timers.Start(ETimer::End, _term->GetEnd() - _dependencies.clock.GetNow().steady);
}

void LeaseKeeper::SetFault(std::string fault)
{
    if (fault != _fault && !fault.empty())
    {
        _dependencies.logger.Warning("the lease of the store cannot be read or renewed", {{"reason", fault}});
    }
    _fault = std::move(fault);
}

void LeaseKeeper::Lose(const std::string& reason)
{
    if (std::exchange(_state, EState::Ended) == EState::Ended)
    {
        return;
    }
    _dependencies.guard.End();
    _timers.CancelAll();
    _handlers.onLost(reason);
}

void LeaseKeeper::ReleaseAsync(std::function<void()> handler)
{
    const bool bHeld = std::exchange(_state, EState::Ended) == EState::Leading;
    _dependencies.guard.End();
    _timers.CancelAll();
    if (_bTaking)
    {
        _onReleased = std::move(handler); // when it is known whether it was taken
    }
    else if (bHeld)
    {
        ReleaseTaken(_epoch, std::move(handler));
    }
    else
    {
        boost::asio::post(_dependencies.executor, std::move(handler));
    }
}

void LeaseKeeper::ReleaseTaken(std::uint64_t epoch, std::function<void()> handler)
{
    _lease.Do(
        [epoch](Planning::ILease& lease) { return lease.Release(epoch); },
        [this, handler = std::move(handler)](const Core::Result<void>& released) {
            if (!released.has_value())
            {
                _dependencies.logger.Warning(
                    "the lease could not be released: a standby waits until it ends",
                    {{"reason", Core::Describe(released.error())}});
            }
            handler();
        });
}

std::string LeaseKeeper::GetWaitReason() const
{
    if (_state == EState::Leading)
    {
        return "standby that takes over: it reads the store";
    }
    if (_state == EState::Ended)
    {
        return "standby: this process releases its lease";
    }
    if (const std::string fault = GetStoreFault(); !fault.empty())
    {
        return fmt::format("standby: the store cannot be used: {}", fault);
    }
    const std::optional<Planning::LeaseState>& seen = _watch.GetSeenOrNull();
    if (!seen.has_value())
    {
        return "standby: the store was not read yet";
    }
    if (_watch.IsOtherConfig())
    {
        return fmt::format(
            "standby that cannot take over: its site, robots or options are not those of {}, which leads; give both the same "
            "configuration, or stop {}",
            seen->holder,
            seen->holder);
    }
    if (seen->holder == _claim.holder)
    {
        return fmt::format(
            "standby: the lease has the name of this process, {}, and is taken when it ends; if it is renewed, another process has "
            "the same store.instance",
            seen->holder);
    }
    return fmt::format("standby: {} leads", seen->holder);
}

/// Why this process cannot use the store; empty: it can, or another process leads.
std::string LeaseKeeper::GetStoreFault() const
{
    const std::optional<Planning::LeaseState>& seen = _watch.GetSeenOrNull();
    const bool bOtherLeads = seen.has_value() && !seen->bReleased;
    return _fault.empty() && !bOtherLeads ? _pauseReason : _fault;
}

std::string LeaseKeeper::GetPublicReason() const
{
    return _state != EState::Leading && _state != EState::Ended && !GetStoreFault().empty()
        ? "standby: the store cannot be used; /readyz on the monitoring address has the reason"
        : GetWaitReason();
}

} // namespace ACS::Acsd
