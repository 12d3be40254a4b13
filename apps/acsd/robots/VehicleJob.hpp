#pragma once

#include "robots/LoadCheck.hpp"
#include <acs/plan/RobotCommand.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace ACS::Acsd
{

/// The job of a VDA5050 vehicle, from its command or its recovery to the end that is reported to the engine.
class VehicleJob final
{
    /// It was commanded before a restart, and the vehicle has not reported its state yet.
    struct Recovering
    {
        Planning::RecoverJob recovery;
    };

    /// The vehicle has its order, or receives it next. Order and action have the commandID.
    struct Running
    {
        Planning::StartJob job;
        bool bStarted = false;   ///< Its action has begun.
        bool bWithdrawn = false; ///< Its order is being cancelled because the vehicle executes another one.
    };

    /// The action is finished, and the loads do not show it yet.
    struct VerifyingLoads
    {
        LoadCheck check;
    };

public:
    /// The vehicle's factsheet is awaited, or the end of a drive that repeats actions, or the return of an offline vehicle.
    struct Deferred
    {
        Planning::StartJob job;
        bool bOutdated = false; ///< The vehicle was offline since, and an operator may have resolved the job.
    };

    /// The vehicle ended the action before it was done: its mode was switched, or it was restarted. What its loads show is
    /// evaluated when it is in automatic mode again.
    struct Interrupted
    {
        Planning::StartJob job;
        std::string reason;
        bool bLoadsAwaited = false; ///< The time in which its loads must show the outcome has begun.
    };

private:
    std::variant<std::monostate, Deferred, Recovering, Running, VerifyingLoads, Interrupted> _state;

public:
    void Defer(Planning::StartJob job);
    /// The vehicle is offline. bUnsent: it cannot have received the order of the running job.
    void OnOffline(bool bUnsent);
    void Recover(Planning::RecoverJob recovery);
    void Run(Planning::StartJob job);
    void VerifyLoads(LoadCheck check);
    /// The running job. Only while GetRunningOrNull is not null.
    void Interrupt(std::string reason);
    /// The time of the loads begins. Only while GetInterruptedOrNull is not null. False: it has begun before.
    [[nodiscard]] bool TryAwaitLoads();
    /// The vehicle is not available: the time begins again when it is.
    void StopAwaitingLoads();
    void Clear();

    /// The deferred job, which is then no longer here.
    [[nodiscard]] std::optional<Deferred> TakeDeferredOrNull();
    /// Likewise the job to be recovered.
    [[nodiscard]] std::optional<Planning::RecoverJob> TakeRecoveryOrNull();
    /// Likewise the running job. Only while GetRunningOrNull is not null.
    [[nodiscard]] Planning::StartJob TakeRunning();
    /// The action of the running job was seen to run. Returns whether that is the first time.
    [[nodiscard]] bool TryStart();
    /// The order of the running job is to be cancelled because the vehicle executes another one. Only while GetRunningOrNull is
    /// not null. False: it was withdrawn before.
    [[nodiscard]] bool TryWithdraw();

    [[nodiscard]] bool IsDeferred(std::string_view jobID) const;
    [[nodiscard]] bool HasDeferred() const;
    [[nodiscard]] bool IsRecovering() const;
    [[nodiscard]] const Planning::StartJob* GetRunningOrNull() const noexcept;
    /// Whether the running job was withdrawn and has not begun.
    [[nodiscard]] bool IsWithdrawn() const noexcept;
    /// Whether the state shows the action of the running job as running, which a vehicle may show together with paused.
    [[nodiscard]] bool IsShownRunning(const VDA5050::StateMessage& state) const;
    [[nodiscard]] const LoadCheck* GetLoadCheckOrNull() const noexcept;
    [[nodiscard]] const Interrupted* GetInterruptedOrNull() const noexcept;
};

} // namespace ACS::Acsd
