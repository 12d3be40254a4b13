#pragma once

#include "control/StallWatch.hpp"
#include "control/TscControl.hpp"
#include "dispatch/Dispatcher.hpp"
#include "dispatch/WaitReasons.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace ACS::Planning
{

/// Raises ACS-1015 for a robot with a plan that waits for too long although none of the robots for which it waits makes progress.
/// Owns the WaitReasons.
class WaitWatch
{
    enum class EWait : std::uint8_t
    {
        None,
        Timed,    ///< The timer is running.
        Deferred, ///< The timer has expired, but another robot made progress then. It starts again when none does.
        Reported, ///< The alarm was raised.
    };

    const EngineOptions& _options;
    const RestartHold& _hold;
    Fleet& _fleet;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;
    const WaitingRobots& _waiting;
    WaitReasons _reasons;
    std::vector<EWait> _waits; ///< By robot.

public:
    WaitWatch(
        EngineState& engine,
        const TscControl& tsc,
        const StallWatch& stalls,
        const WaitingRobots& waiting,
        const TrafficCoordinator& coordinator,
        const Dispatcher& dispatcher);

    [[nodiscard]] const WaitReasons& GetReasons() const noexcept;
    /// Starts and ends the waits of the robots whose work has changed, which may be what deferred ones waited for; called at the
    /// end of every engine call.
    void UpdateWaits();
    void UpdateWait(const Robot& robot);
    /// The timer has expired: raises the alarm, unless another robot makes progress.
    void OnWaitDue(const Robot& robot);

private:
    [[nodiscard]] bool IsWaiting(const Robot& robot) const;
    /// Why the plan of the robot makes no progress; nullopt: it may still continue without help.
    [[nodiscard]] std::optional<WaitReason> DescribeOrNull(const Robot& robot) const;
    void StartTimer(const Robot& robot);
};

} // namespace ACS::Planning
