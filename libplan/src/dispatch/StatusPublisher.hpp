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

/// The status of each robot (section 5), published when it changes.
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

    /// Section 5: the first that holds.
    [[nodiscard]] ERobotStatus DeriveStatus(const Robot& robot) const;
    void PublishStatus(const Robot& robot, ERobotStatus status);
    void PublishStatusChanges();
    /// Its present status counts as published.
    void Reset(Robot& robot);
    [[nodiscard]] const std::vector<RobotStatus>& GetRobotStatuses() const noexcept;

private:
    /// The first edge leads out of a station, the last one into one. A robot that waits between them for others is not docking,
    /// nor is one whose Arrival is not reported because its drive is to be cancelled.
    [[nodiscard]] ERobotStatus DeriveDriveStatus(const Robot& robot, const ActiveDrive& drive) const;
    /// Who has reached a station's last node before the dock is as good as there.
    [[nodiscard]] std::string GetReportedPosition(const Robot& robot, ERobotStatus status) const;
    /// Why the robot does not do more than it does; empty where nothing keeps it.
    [[nodiscard]] std::string DescribeStatus(const Robot& robot) const;
    [[nodiscard]] RobotStatus MakeStatus(const Robot& robot, ERobotStatus status) const;
};

} // namespace ACS::Planning
