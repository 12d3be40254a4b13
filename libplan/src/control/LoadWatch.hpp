#pragma once

#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Keeps the record of a robot's ports: by the jobs that it finished, and by the loads that it reports.
class LoadWatch
{
    const EngineOptions& _options;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;

public:
    explicit LoadWatch(EngineState& engine);

    void CompareLoads(Robot& robot);
    /// Set until each port shows again what was expected there, a job has moved its carrier, or an operator has checked it. A robot
    /// whose loads change with each state must not flood the MCS: the first difference is reported at once, then the latest one
    /// when the timer LoadAlarm has expired.
    void UpdateLoadAlarm(Robot& robot);
    void OnLoadAlarmTimer(Robot& robot);
    /// What a finished job does to the robot's ports. What does not fit is reported, not refused: the robot has done it, so the
    /// ports were not what the engine believed.
    void MoveCarrier(Robot& robot, const StartJob& job);

private:
    /// The ports of its robot that a job empties and fills, in this order.
    [[nodiscard]] std::vector<PortUse> ListPortUses(const Robot& robot, const StartJob& job) const;
};

} // namespace ACS::Planning
