#pragma once

#include "robot/StallMonitor.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Keeps a StallMonitor per robot and raises ACS-1009 for a drive without progress, or a job that the robot does not begin.
class StallWatch
{
    const EngineOptions& _options;
    Fleet& _fleet;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;
    std::vector<StallMonitor> _monitors; ///< By robot.

public:
    explicit StallWatch(EngineState& engine);

    /// Updates the monitors of the robots whose work has changed; called at the end of every engine call.
    void UpdateStalls();
    void UpdateStall(Robot& robot);
    /// The timer has expired: raises the alarm.
    void OnDriveStall(Robot& robot);
    [[nodiscard]] bool IsStalled(const Robot& robot) const;
    /// "node N2 not reached for 60 s". Only while IsStalled.
    [[nodiscard]] std::string DescribeStall(const Robot& robot) const;

private:
    /// The robot is connected, may drive and has released nodes ahead, or has a job to begin.
    [[nodiscard]] bool IsProgressExpected(const Robot& robot) const;
    [[nodiscard]] static bool IsJobUnconfirmed(const Robot& robot);
    /// Of the next edge of its drive; 0 without one.
    [[nodiscard]] static double GetEdgeSeconds(const Robot& robot);
};

} // namespace ACS::Planning
