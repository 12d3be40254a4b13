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

/// Raises an alarm for a drive without progress.
class StallWatch
{
    const EngineOptions& _options;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;
    std::vector<StallMonitor> _monitors; ///< By robot.

public:
    explicit StallWatch(EngineState& engine);

    /// At the end of every call.
    void UpdateStall(Robot& robot);
    void OnDriveStall(Robot& robot);
    [[nodiscard]] bool IsStalled(const Robot& robot) const;
    [[nodiscard]] std::string DescribeStall(const Robot& robot) const;

private:
    /// Whether the robot must pass another node soon: it is connected, may drive and has a base ahead.
    [[nodiscard]] bool IsProgressExpected(const Robot& robot) const;
};

} // namespace ACS::Planning
