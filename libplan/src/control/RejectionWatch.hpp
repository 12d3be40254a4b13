#pragma once

#include "transaction/EngineState.hpp"

#include <string>

namespace ACS::Planning
{

/// Decides when a robot that rejected a drive or a job is sent one again, and raises ACS-1012 for a robot that rejects all, and
/// ACS-1013 for one that is known to be unable to do them.
class RejectionWatch
{
    const EngineOptions& _options;
    EngineTransaction& _transaction;

public:
    explicit RejectionWatch(EngineState& engine);

    /// The robot has rejected or lost the drive to its step, or rejected its job. Not counted if the robot was not in automatic
    /// mode or is disconnected: a vehicle then clears its order as the standard demands.
    void OnRejected(Robot& robot, const std::string& reason);
    /// The timer has expired: the robot is sent its command again.
    void OnRetryDue(Robot& robot);
    /// The robot was reconnected, or its mode, its errors or its factsheet have changed: it is sent one more command.
    void OnRobotChanged(Robot& robot);
    /// The robot has passed a node or begun a job, or the operator has cleared the alarm: the row of rejections has ended.
    void EndRow(Robot& robot);

    void OnCompatibility(Robot& robot, const CompatibilityChanged& event);

private:
    [[nodiscard]] static Alarm MakeRejectionAlarm(const Robot& robot);
};

} // namespace ACS::Planning
