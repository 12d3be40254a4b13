#pragma once

#include "ChanceModel.hpp"
#include "CrashableStore.hpp"
#include "Scenario.hpp"
#include "Timeline.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/LeaseMachine.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

namespace ACS::Simulation
{

/// A LeaseMachine on the timeline, as LeaseKeeper of acsd uses it: the calls of the store follow each other and take time. A call that
/// was made reaches the store also when its process has crashed meanwhile.
class SimulatedLease final
{
public:
    /// All must outlive it.
    struct Dependencies
    {
        Timeline& timeline;
        Trace& trace;
        ChanceModel& chance;
        CrashableStore& store;
        const Scenario& scenario;
    };

    /// Of its process, once the lease is taken.
    struct Handlers
    {
        std::function<void()> onLost;
        std::function<void()> onReleased;
    };

    /// Of the simulated acsd.
    static constexpr std::chrono::milliseconds DURATION{3'000};

private:
    /// Outlives its process, for calls that are under way.
    struct Connection
    {
        bool bCutOff = false;
        bool bEnded = false; ///< No result is handled any more.
    };

    Dependencies _around;
    std::function<void(std::uint64_t epoch)> _onTaken;
    Handlers _handlers; ///< Empty before it is taken.
    TimerBank<Planning::ELeaseTimer> _timers;
    Planning::LeaseMachine _machine;
    std::shared_ptr<Connection> _connection = std::make_shared<Connection>();
    Core::SteadyTime _answeredAt{}; ///< When the last call has its result.
    Core::SteadyTime _heldUntil{};  ///< As LeaseGuard.

public:
    SimulatedLease(Dependencies around, std::function<void(std::uint64_t epoch)> onTaken);
    SimulatedLease(const SimulatedLease&) = delete;
    SimulatedLease& operator=(const SimulatedLease&) = delete;
    ~SimulatedLease();

    /// A standby from now on.
    void Start();

    /// Call it in onTaken.
    void SetHandlers(Handlers handlers);

    /// The process stops: onReleased follows.
    void Release();

    /// The store does not answer any more.
    void CutOff();

    /// Its process has crashed.
    void End();

    [[nodiscard]] bool IsHeld() const;

private:
    void Execute(const Planning::LeaseActions& actions);
    void Execute(const Planning::ReadLease& action);
    void Execute(const Planning::TakeLease& action);
    void Execute(const Planning::RenewLease& action);
    void Execute(const Planning::ReleaseLease& action);
    void Execute(const Planning::StartLeaseTimer& action);
    void Execute(const Planning::LeaseExtended& action);
    void Execute(const Planning::LeaseRevoked& action);
    void Execute(const Planning::LeaseTaken& action);
    void Execute(const Planning::LeaseLost& action) const;
    void Execute(const Planning::LeaseFault& action) const;
    void Execute(const Planning::LeaseEnded& action) const;
    /// The call reaches the store after some time, and its result comes back after some more.
    template <typename TCall, typename TAnswer>
    void Call(TCall call, TAnswer answer);
    [[nodiscard]] Core::Duration ChooseLatency();
    [[nodiscard]] Core::SteadyTime GetNow() const;
};

} // namespace ACS::Simulation
