#pragma once

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

/// The vehicle's hands: performs actions in simulated time, each for as long as its type takes, and knows what the
/// vehicle carries and whether it charges.
class ActionRunner
{
    struct RunningAction
    {
        VDA5050::Action action;
        double secondsLeft = 0.0;                     ///< Infinite: until it is triggered.
        std::optional<VDA5050::VehicleError> failure; ///< It fails at its end with this.
        bool bPaused = false;
    };

    std::map<std::string, double, std::less<>> _seconds;
    std::vector<std::string> _loadPositions;

    std::vector<RunningAction> _running;
    std::vector<VDA5050::Load> _loads;
    bool _bCharging = false;

public:
    /// Seconds of simulated time.
    static constexpr double HANDLING_SECONDS = 3.0; ///< pick, drop
    static constexpr double SHORT_SECONDS = 1.0;    ///< all others

    /// How long actions of a type take, where it is not as above: seconds of simulated time by actionType. And the
    /// places that a load each can be in.
    ActionRunner(std::map<std::string, double, std::less<>> seconds, std::vector<std::string> loadPositions);

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
    [[nodiscard]] const std::vector<VDA5050::Load>& GetLoads() const noexcept;

private:
    [[nodiscard]] double GetSeconds(std::string_view actionType) const;
    [[nodiscard]] std::vector<RunningAction>::iterator Find(std::string_view actionID);
    [[nodiscard]] ActionOutcome Finish(const RunningAction& running);
    [[nodiscard]] ActionOutcome PickUp(const VDA5050::Action& action);
    [[nodiscard]] ActionOutcome PutDown(const VDA5050::Action& action);
};

} // namespace ACS::VdaSim
