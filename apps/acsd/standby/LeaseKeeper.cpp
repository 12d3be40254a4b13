#include "standby/LeaseKeeper.hpp"

#include <boost/asio/post.hpp>
#include <fmt/format.h>

#include <optional>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

using Planning::ELeaseWait;
using Planning::LeaseActions;

LeaseKeeper::LeaseKeeper(
    Dependencies dependencies,
    const LeaseMaker& makeLease,
    Planning::LeaseClaim claim,
    Handlers handlers)
    : _dependencies(std::move(dependencies)),
      _claim(std::move(claim)),
      _handlers(std::move(handlers)),
      _stopping(std::make_shared<std::atomic<bool>>(false)),
      _lease(_dependencies.executor, makeLease([stopping = _stopping] { return stopping->load(); })),
      _timers(
          _dependencies.executor,
          [this](Planning::ELeaseTimer timer) {
              LeaseActions actions;
              _machine.OnTimer(timer, GetNow(), actions);
              Execute(actions);
          }),
      _machine(_claim)
{
}

LeaseKeeper::~LeaseKeeper()
{
    *_stopping = true;
}

void LeaseKeeper::Start(Core::Duration pause, std::string reason)
{
    LeaseActions actions;
    _machine.Start(pause, std::move(reason), GetNow(), actions);
    Execute(actions);
}

void LeaseKeeper::ReleaseAsync(std::function<void()> handler)
{
    _onReleased = std::move(handler);
    LeaseActions actions;
    _machine.Release(actions);
    Execute(actions);
}

void LeaseKeeper::Execute(const LeaseActions& actions)
{
    for (const Planning::LeaseAction& action : actions)
    {
        std::visit([this](const auto& kind) { Execute(kind); }, action);
    }
}

void LeaseKeeper::Execute(const Planning::ReadLease& /*action*/)
{
    _lease.Do(
        [](Planning::ILease& lease) { return lease.Read(); },
        [this](const Core::Result<Planning::LeaseState>& state) {
            LeaseActions actions;
            _machine.OnRead(state, GetNow(), actions);
            Execute(actions);
        });
}

void LeaseKeeper::Execute(const Planning::TakeLease& action)
{
    _lease.Do(
        [seen = action.seen, claim = _claim](Planning::ILease& lease) { return lease.TryTakeOrNull(seen, claim); },
        [this](const Core::Result<std::optional<std::uint64_t>>& taken) {
            LeaseActions actions;
            _machine.OnTaken(taken, GetNow(), actions);
            Execute(actions);
        });
}

void LeaseKeeper::Execute(const Planning::RenewLease& action)
{
    _lease.Do(
        [epoch = action.epoch](Planning::ILease& lease) { return lease.TryRenew(epoch); },
        [this](const Core::Result<bool>& renewed) {
            LeaseActions actions;
            _machine.OnRenewed(renewed, GetNow(), actions);
            Execute(actions);
        });
}

void LeaseKeeper::Execute(const Planning::ReleaseLease& action)
{
    _lease.Do(
        [epoch = action.epoch](Planning::ILease& lease) { return lease.Release(epoch); },
        [this](const Core::Result<void>& released) {
            if (!released.has_value())
            {
                _dependencies.logger.Warning(
                    "the lease could not be released: a standby waits until it ends",
                    {{"reason", Core::Describe(released.error())}});
            }
            LeaseActions actions;
            _machine.OnReleased(actions);
            Execute(actions);
        });
}

void LeaseKeeper::Execute(const Planning::StartLeaseTimer& action)
{
    _timers.Start(action.timer, action.delay);
}

void LeaseKeeper::Execute(const Planning::LeaseExtended& action)
{
    _dependencies.guard.Extend(action.end);
}

void LeaseKeeper::Execute(const Planning::LeaseRevoked& /*action*/)
{
    _dependencies.guard.End();
    _timers.CancelAll();
}

void LeaseKeeper::Execute(const Planning::LeaseTaken& action) const
{
    _dependencies.logger.Info("this process leads", {{"epoch", std::to_string(action.epoch)}});
    _handlers.onTaken(action.epoch);
}

void LeaseKeeper::Execute(const Planning::LeaseLost& action) const
{
    _handlers.onLost(action.reason);
}

void LeaseKeeper::Execute(const Planning::LeaseFault& action) const
{
    _dependencies.logger.Warning("the lease of the store cannot be read or renewed", {{"reason", action.reason}});
}

void LeaseKeeper::Execute(const Planning::LeaseEnded& /*action*/)
{
    boost::asio::post(
        _dependencies.executor,
        [weak = std::weak_ptr(_stopping), handler = std::exchange(_onReleased, {})] {
            if (!weak.expired())
            {
                handler();
            }
        });
}

Core::SteadyTime LeaseKeeper::GetNow() const
{
    return _dependencies.clock.GetNow().steady;
}

std::string LeaseKeeper::GetWaitReason() const
{
    const auto [reason, detail] = _machine.GetWait();
    switch (reason)
    {
        case ELeaseWait::NotRead:
            return "standby: the store was not read yet";
        case ELeaseWait::StoreFailed:
            return fmt::format("standby: the store cannot be used: {}", detail);
        case ELeaseWait::OtherConfig:
            return fmt::format(
                "standby that cannot take over: its site, robots or options are not those of {}, which leads; give both the same "
                "configuration, or stop {}",
                detail,
                detail);
        case ELeaseWait::OwnName:
            return fmt::format(
                "standby: the lease has the name of this process, {}, and is taken when it ends; if it is renewed, another process "
                "has the same store.instance",
                detail);
        case ELeaseWait::TakesOver:
            return "standby that takes over: it reads the store";
        case ELeaseWait::Releases:
            return "standby: this process releases its lease";
        case ELeaseWait::OtherLeads:
        default:
            return fmt::format("standby: {} leads", detail);
    }
}

std::string LeaseKeeper::GetPublicReason() const
{
    return _machine.GetWait().reason == ELeaseWait::StoreFailed
        ? "standby: the store cannot be used; /readyz on the monitoring address has the reason"
        : GetWaitReason();
}

} // namespace ACS::Acsd
