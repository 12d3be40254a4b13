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

namespace ACS::Simulation
{

/// A LeaseMachine on the timeline, as LeaseKeeper of acsd uses it: the calls of the store follow each other and take time.
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

    /// Of the simulated acsd.
    static constexpr std::chrono::milliseconds DURATION{3'000};

private:
    enum class EConnection : std::uint8_t
    {
        Working,
        CutOff
    };

    Dependencies _around;
    std::function<void(std::uint64_t epoch)> _onTaken;
    std::function<void()> _onLost; ///< Empty before it is taken.
    TimerBank<Planning::ELeaseTimer> _timers;
    Planning::LeaseMachine _machine;
    EConnection _connection = EConnection::Working;
    Core::SteadyTime _answeredAt{}; ///< When the call under way will be answered.
    Core::SteadyTime _heldUntil{};  ///< As LeaseGuard.

public:
    SimulatedLease(Dependencies around, std::function<void(std::uint64_t epoch)> onTaken);
    SimulatedLease(const SimulatedLease&) = delete;
    SimulatedLease& operator=(const SimulatedLease&) = delete;
    ~SimulatedLease() = default;

    /// A standby from now on.
    void Start();

    /// Call it when it is taken, in onTaken.
    void SetOnLost(std::function<void()> onLost);

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
    void Execute(const Planning::LeaseTaken& action);
    void Execute(const Planning::LeaseLost& action);
    void Execute(const Planning::LeaseFault& action);
    void Execute(const Planning::LeaseEnded& action);
    /// The call reaches the store after some time, and its result comes back after some more.
    template <typename TCall, typename TAnswer>
    void Call(TCall call, TAnswer answer);
    [[nodiscard]] Core::Duration ChooseLatency();
    [[nodiscard]] Core::SteadyTime GetNow() const;
};

} // namespace ACS::Simulation
