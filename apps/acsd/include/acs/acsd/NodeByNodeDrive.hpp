#pragma once

#include <acs/core/Api.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/plan/RobotCommand.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// The drive of a robot that is sent from node to node: keeps what the engine has commanded, and raises the events of the
/// drive. Pure; an adapter owns one for its robot.
class ACS_API NodeByNodeDrive final
{
public:
    /// The next movement of the robot.
    struct Step
    {
        std::string driveID; ///< Drive::driveID of the current drive.
        std::string nodeID;  ///< The node to which the robot moves next.

        bool operator==(const Step&) const = default;
    };

private:
    std::optional<Planning::Drive> _drive;
    std::size_t _passed = 0; ///< Nodes of the drive.
    bool _bCancelling = false;
    bool _bPaused = false;

public:
    /// Keeps Drive, ExtendDrive, CancelDrive, Pause and Resume; other commands have no effect. Call OnStationary next if the
    /// robot is stationary on a node.
    void Handle(const Planning::RobotCommand& command);

    /// The robot is stationary on the node. Raises NodePassed if that is the next node of the drive, and the end of the
    /// drive: Arrived, DriveCancelled, or DriveRejected if the robot is elsewhere than the drive.
    void OnStationary(const std::string& nodeID, Planning::AdapterActions& out);

    /// The step that the robot may make, after OnStationary; nullopt while it must wait. The same step until the robot is
    /// stationary on its node: sent again after a lost connection.
    [[nodiscard]] std::optional<Step> GetStepOrNull() const;

    /// Whether a drive was commanded and has not ended.
    [[nodiscard]] bool HasDrive() const noexcept;
    /// Whether Pause was commanded last, and not Resume.
    [[nodiscard]] bool IsPaused() const noexcept;
};

} // namespace ACS::Acsd
