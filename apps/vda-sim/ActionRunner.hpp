#pragma once

#include "vda-sim/LoadDevice.hpp"
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VdaSim
{

/// Result of an action.
struct ActionOutcome
{
    std::string actionID;
    VDA5050::EActionStatus status = VDA5050::EActionStatus::Finished;
    std::string result;
    std::optional<VDA5050::VehicleError> error; ///< If it failed because of a fault.

    bool operator==(const ActionOutcome&) const = default;
};

/// Performs actions, each for the duration of its type in simulated time; pick and drop use the load handling device.
class ActionRunner
{
public:
    /// Seconds of simulated time.
    static constexpr double HANDLING_SECONDS = 3.0; ///< pick, drop
    static constexpr double SHORT_SECONDS = 1.0;    ///< all others

private:
    struct RunningAction
    {
        VDA5050::Action action;
        double secondsLeft = 0.0;                     ///< Infinite: until it is triggered.
        std::optional<VDA5050::VehicleError> failure; ///< Its result instead of success.
        bool bPaused = false;
        bool bUndocked = false; ///< The vehicle has left the place where the action began.
    };

    std::map<std::string, double, std::less<>> _seconds;
    LoadDevice _device;
    std::vector<RunningAction> _running;
    bool _bCharging = false;

public:
    /// Durations that differ from those above: seconds of simulated time by actionType. Those of `pick` and `drop` apply to
    /// the vehicle's own actionTypes for pick and drop.
    ActionRunner(std::map<std::string, double, std::less<>> seconds, LoadDevice device);

    /// Why the action cannot begin; empty if it can.
    [[nodiscard]] std::string FindRefusal(const VDA5050::Action& action, bool bAtCharger) const;
    /// Begins an action that is not refused. With a failure the action ends with that failure.
    void Start(const VDA5050::Action& action, std::optional<VDA5050::VehicleError> failureOrNull = {});
    /// Ends every waitForTrigger. Returns the number of them.
    std::size_t Trigger();
    /// False if no such action runs.
    [[nodiscard]] bool TryPause(std::string_view actionID);
    [[nodiscard]] bool TryResume(std::string_view actionID);
    /// Ends the action early: on a cancel, or at the end of its edge, where detectObject finishes and others fail. Nullopt if
    /// no such action runs.
    [[nodiscard]] std::optional<ActionOutcome> StopOrNull(std::string_view actionID, bool bEdgeEnded);

    /// Advances the simulated time and appends the actions that ended.
    void Advance(double seconds, std::vector<ActionOutcome>& out);

    /// The vehicle leaves its place: charging ends, and a startCharging that runs will fail.
    void Undock();

    [[nodiscard]] bool IsBusy() const noexcept;
    [[nodiscard]] bool IsCharging() const noexcept;
    [[nodiscard]] LoadDevice& GetDevice() noexcept;

private:
    [[nodiscard]] double GetSeconds(std::string_view actionType) const;
    [[nodiscard]] std::vector<RunningAction>::iterator Find(std::string_view actionID);
    [[nodiscard]] ActionOutcome Finish(const RunningAction& running);
};

} // namespace ACS::VdaSim
