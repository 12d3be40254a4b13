#pragma once

#include "control/StallWatch.hpp"
#include "dispatch/WaitReasons.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Derives the status of each robot (section 5) and publishes it when it changes.
class StatusPublisher
{
    const EngineOptions& _options;
    const SiteMap& _site;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    const StallWatch& _stalls;
    const WaitingRobots& _waiting;
    const WaitReasons& _waits;
    std::vector<RobotStatus> _last; ///< By robot.

public:
    StatusPublisher(
        EngineState& engine,
        const StallWatch& stalls,
        const WaitingRobots& waiting,
        const WaitReasons& waits);

    /// The first status of section 5 that applies.
    [[nodiscard]] ERobotStatus DeriveStatus(const Robot& robot) const;
    /// Publishes this status at once.
    void PublishStatus(const Robot& robot, ERobotStatus status);
    /// Publishes the derived status of each robot that may have changed in this call.
    void PublishStatusChanges();
    /// Treats the present status as published.
    void Reset(Robot& robot);
    [[nodiscard]] const std::vector<RobotStatus>& GetRobotStatuses() const noexcept;

private:
    /// UnDocking on the first edge out of a station, Docking on the last edge into one, else Moving. A robot whose Arrival is
    /// not reported because its drive is being cancelled is not docking.
    [[nodiscard]] ERobotStatus DeriveDriveStatus(const Robot& robot, const ActiveDrive& drive) const;
    /// A robot on the last node before the dock counts as at the station.
    [[nodiscard]] std::string GetReportedPosition(const Robot& robot, ERobotStatus status) const;
    /// What the robot waits for; may be empty.
    [[nodiscard]] std::string DescribeStatus(const Robot& robot) const;
    [[nodiscard]] RobotStatus MakeStatus(const Robot& robot, ERobotStatus status) const;
};

} // namespace ACS::Planning
