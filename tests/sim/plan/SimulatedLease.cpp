#include "SimulatedLease.hpp"

#include <acs/plan/EPlanningError.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

using namespace Planning; // NOLINT(google-build-using-namespace): what is simulated
using namespace std::chrono_literals;

SimulatedLease::SimulatedLease(Dependencies around, std::function<void(std::uint64_t epoch)> onTaken)
    : _around(around),
      _onTaken(std::move(onTaken)),
      _timers(_around.timeline),
      _machine(LeaseClaim{"acsd", {}, DURATION})
{
}

SimulatedLease::~SimulatedLease()
{
    End();
}

void SimulatedLease::Start()
{
    LeaseActions actions;
    _machine.Start({}, {}, GetNow(), actions);
    Execute(actions);
}

void SimulatedLease::SetHandlers(Handlers handlers)
{
    _handlers = std::move(handlers);
}

void SimulatedLease::Release()
{
    LeaseActions actions;
    _machine.Release(actions);
    Execute(actions);
}

void SimulatedLease::CutOff()
{
    _around.trace.Add("acsd: cut off from the store");
    _connection->bCutOff = true;
}

void SimulatedLease::End()
{
    _timers.CancelAll();
    _connection->bEnded = true;
}

bool SimulatedLease::IsHeld() const
{
    return GetNow() < _heldUntil;
}

void SimulatedLease::Execute(const LeaseActions& actions)
{
    for (const LeaseAction& action : actions)
    {
        std::visit([this](const auto& kind) { Execute(kind); }, action);
    }
}

void SimulatedLease::Execute(const ReadLease& /*action*/)
{
    Call(
        [](CrashableStore& store) { return store.ReadLease(); },
        [](LeaseMachine& machine, const Core::Result<LeaseState>& state, Core::SteadyTime now, LeaseActions& out) {
            machine.OnRead(state, now, out);
        });
}

void SimulatedLease::Execute(const TakeLease& action)
{
    Call(
        [seen = action.seen](CrashableStore& store) { return store.TryTakeOrNull(seen, DURATION); },
        [](LeaseMachine& machine,
           const Core::Result<std::optional<std::uint64_t>>& taken,
           Core::SteadyTime now,
           LeaseActions& out) { machine.OnTaken(taken, now, out); });
}

void SimulatedLease::Execute(const RenewLease& action)
{
    Call(
        [epoch = action.epoch](CrashableStore& store) { return store.TryRenew(epoch); },
        [](LeaseMachine& machine, const Core::Result<bool>& renewed, Core::SteadyTime now, LeaseActions& out) {
            machine.OnRenewed(renewed, now, out);
        });
}

void SimulatedLease::Execute(const ReleaseLease& action)
{
    Call(
        [epoch = action.epoch](CrashableStore& store) { return store.Release(epoch); },
        [](LeaseMachine& machine, const Core::Result<void>& /*released*/, Core::SteadyTime /*now*/, LeaseActions& out) {
            machine.OnReleased(out);
        });
}

void SimulatedLease::Execute(const StartLeaseTimer& action)
{
    _timers.Start(action.timer, action.delay, [this, timer = action.timer] {
        LeaseActions actions;
        _machine.OnTimer(timer, GetNow(), actions);
        Execute(actions);
    });
}

void SimulatedLease::Execute(const LeaseExtended& action)
{
    _heldUntil = action.end;
}

void SimulatedLease::Execute(const LeaseRevoked& /*action*/)
{
    _heldUntil = {};
    _timers.CancelAll();
}

void SimulatedLease::Execute(const LeaseTaken& action)
{
    const auto onTaken = std::exchange(_onTaken, {});
    onTaken(action.epoch);
}

void SimulatedLease::Execute(const LeaseLost& action) const
{
    _around.trace.Add("acsd: the lease is lost: {}", action.reason);
    _handlers.onLost();
}

void SimulatedLease::Execute(const LeaseFault& action) const
{
    _around.trace.Add("acsd: the lease: {}", action.reason);
}

void SimulatedLease::Execute(const LeaseEnded& /*action*/) const
{
    _handlers.onReleased();
}

template <typename TCall, typename TAnswer>
void SimulatedLease::Call(TCall call, TAnswer answer)
{
    using Answer = std::invoke_result_t<TCall, CrashableStore&>;
    const Core::SteadyTime calledAt = std::max(GetNow(), _answeredAt) + ChooseLatency();
    const Core::Duration back = ChooseLatency();
    _answeredAt = calledAt + back;
    _around.timeline.Post(
        calledAt - GetNow(),
        [this, connection = _connection, &store = _around.store, &timeline = _around.timeline, call, answer, back] {
            Answer result = connection->bCutOff
                ? Answer(Core::Fail(EPlanningError::StoreFailed, "acsd.db", "a connection", "none"))
                : call(store);
            timeline.Post(back, [this, connection, answer, result = std::move(result)] {
                if (!connection->bEnded)
                {
                    LeaseActions actions;
                    answer(_machine, result, GetNow(), actions);
                    Execute(actions);
                }
            });
        });
}

Core::Duration SimulatedLease::ChooseLatency()
{
    const bool bFaulty = _around.scenario.Has(EFault::Disk) && _around.timeline.GetAge() < _around.scenario.faultsEnd;
    return _around.chance.GetBetween(1ms, bFaulty && _around.chance.IsHit(10) ? 4s : 20ms);
}

Core::SteadyTime SimulatedLease::GetNow() const
{
    return _around.timeline.GetNow().steady;
}

} // namespace ACS::Simulation
