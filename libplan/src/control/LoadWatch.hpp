#pragma once

#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Updates the record of each robot's ports from finished jobs and reported loads, and raises ACS-1004 and ACS-1011.
class LoadWatch
{
    const EngineOptions& _options;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;

public:
    explicit LoadWatch(EngineState& engine);

    /// Compares the reported loads with the record.
    void CompareLoads(Robot& robot);
    /// Sets, updates or clears ACS-1011. The first difference is reported at once, later ones at most once per LoadAlarm
    /// interval: a robot whose loads change with each state must not flood the MCS.
    void UpdateLoadAlarm(Robot& robot);
    void OnLoadAlarmTimer(Robot& robot);
    /// Records what a finished job moved. A contradiction raises ACS-1004 but is not refused: the job was done, so the record
    /// was wrong.
    void MoveCarrier(Robot& robot, const StartJob& job);

private:
    /// Ports of the robot that the job empties, then those that it fills.
    [[nodiscard]] std::vector<PortUse> ListPortUses(const Robot& robot, const StartJob& job) const;
};

} // namespace ACS::Planning
