#pragma once

#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/StateMessage.hpp>

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

    bool operator==(const ActionOutcome&) const = default;
};

/// The vehicle's hands: performs actions in simulated time, each for as long as its type takes, and knows what the
/// vehicle carries and whether it charges.
class ActionRunner
{
    struct RunningAction
    {
        VDA5050::Action action;
        double secondsLeft = 0.0;
        bool bPaused = false;
    };

    std::vector<RunningAction> _running;
    std::vector<VDA5050::Load> _loads;
    bool _bCharging = false;

public:
    /// Seconds of simulated time.
    static constexpr double HANDLING_SECONDS = 3.0; ///< pick, drop
    static constexpr double SHORT_SECONDS = 1.0;    ///< all others

    /// Begins; the empty text, or why it cannot.
    [[nodiscard]] std::string Start(const VDA5050::Action& action, bool bAtCharger);
    /// False where no such action runs.
    [[nodiscard]] bool TryPause(std::string_view actionID);
    [[nodiscard]] bool TryResume(std::string_view actionID);
    [[nodiscard]] bool TryStop(std::string_view actionID);

    /// Lets the time pass, and appends what ended.
    void Advance(double seconds, std::vector<ActionOutcome>& out);

    /// The vehicle leaves its place: contacts open.
    void Undock();

    [[nodiscard]] bool IsBusy() const noexcept;
    [[nodiscard]] bool IsCharging() const noexcept;
    [[nodiscard]] const std::vector<VDA5050::Load>& GetLoads() const noexcept;

private:
    [[nodiscard]] std::vector<RunningAction>::iterator Find(std::string_view actionID);
    [[nodiscard]] ActionOutcome Finish(const VDA5050::Action& action);
    [[nodiscard]] ActionOutcome PutDown(const VDA5050::Action& action);
};

} // namespace ACS::VdaSim
