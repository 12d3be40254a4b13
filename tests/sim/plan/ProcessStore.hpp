#pragma once

#include "ChanceModel.hpp"
#include "CrashableStore.hpp"
#include "Mutator.hpp"
#include "Scenario.hpp"
#include "SimulatedLease.hpp"
#include "Timeline.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

namespace ACS::Simulation
{

/// The process that a ProcessStore belongs to.
class IStoreOwner
{
public:
    IStoreOwner() = default;
    IStoreOwner(const IStoreOwner&) = delete;
    IStoreOwner& operator=(const IStoreOwner&) = delete;
    virtual ~IStoreOwner() = default;

    /// Whether it has crashed, perhaps at this moment.
    [[nodiscard]] virtual bool HasCrashed(std::string_view where) = 0;
    virtual void Crash(std::string_view where) = 0;
    virtual void OnStored(const Core::Result<void>& result) = 0;
};

/// The store as one acsd uses it: writes take time, and fail. A shared store is used as LeaderStore does.
class ProcessStore final
{
public:
    /// All references must outlive it.
    struct Dependencies
    {
        Timeline& timeline;
        Trace& trace;
        ChanceModel& chance;
        CrashableStore& store;
        const Scenario& scenario;
        const Mutator& mutator;
        IStoreOwner& owner;
        std::uint64_t epoch = 0;        ///< With which the process has taken the lease; 0: the store is not shared.
        std::function<void()> onCommit; ///< Called after each batch that is on the disk.
    };

private:
    enum class ETimer : std::uint8_t
    {
        Unused ///< All are posted.
    };

    Dependencies _around;
    TimerBank<ETimer> _timers;
    std::optional<Planning::StoreBatch> _writing; ///< Being written to the disk.
    std::optional<Planning::StoreBatch>
        _unsynced; ///< Its commit failed, and the next start finds it unless one succeeds.
    std::unique_ptr<SimulatedLease> _leaseOrNull; ///< Of a shared store.
    bool _bCutOff = false;                        ///< From the shared store.

public:
    /// With the lease of a shared store, which is taken.
    ProcessStore(Dependencies around, std::unique_ptr<SimulatedLease> leaseOrNull);

    /// The process has crashed: what is being written is stored or not, and in a shared store perhaps later.
    void End();

    /// The connection to the shared store is lost.
    void CutOff();

    /// The process is stopped: it crashes when the lease of the shared store is released.
    void Release();

    void Write(const Planning::StoreBatch& batch);

    /// As acsd asks before each message to a robot.
    [[nodiscard]] bool CanCommand() const;

private:
    void Commit();
    [[nodiscard]] Core::Result<void> TryCommit(const Planning::StoreBatch& batch);
    void CommitShared(Core::Duration retry);
    void LeaveOnItsWay(const Planning::StoreBatch& batch);
};

} // namespace ACS::Simulation
