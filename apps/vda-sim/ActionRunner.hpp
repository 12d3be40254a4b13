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

/// How an action ended, or why it cannot begin.
struct ActionOutcome
{
    std::string actionID;
    VDA5050::EActionStatus status = VDA5050::EActionStatus::Finished;
    std::string result;
    std::optional<VDA5050::VehicleError> error; ///< Of one that failed by a fault.

    bool operator==(const ActionOutcome&) const = default;
};

/// Performs actions in simulated time, each in the time that its type takes: those of loads by the load handling device. Knows
/// whether the vehicle charges.
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
        std::optional<VDA5050::VehicleError> failure; ///< It fails at its end with this.
        bool bPaused = false;
    };

    std::map<std::string, double, std::less<>> _seconds;
    LoadDevice _device;
    std::vector<RunningAction> _running;
    bool _bCharging = false;

public:
    /// Duration of actions of a type, where it is not as above: seconds of simulated time by actionType. That of `pick` and
    /// `drop` applies to those that mean them at this make.
    ActionRunner(std::map<std::string, double, std::less<>> seconds, LoadDevice device);

    /// Begins; the empty text, or why it cannot. With a failure it ends with that instead of doing its work.
    [[nodiscard]] std::string Start(
        const VDA5050::Action& action,
        bool bAtCharger,
        std::optional<VDA5050::VehicleError> failureOrNull = {});
    /// What every waitForTrigger waits for; how many there were.
    std::size_t Trigger();
    /// False where no such action runs.
    [[nodiscard]] bool TryPause(std::string_view actionID);
    [[nodiscard]] bool TryResume(std::string_view actionID);
    /// Ends it before its time: by a cancel, or because its edge has come to its end, up to where an object may have been
    /// looked for. Nothing where no such action runs.
    [[nodiscard]] std::optional<ActionOutcome> StopOrNull(std::string_view actionID, bool bEdgeEnded);

    /// Lets the time pass, and appends what ended.
    void Advance(double seconds, std::vector<ActionOutcome>& out);

    /// The vehicle leaves its place: contacts open.
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
