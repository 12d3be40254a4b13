#pragma once

#include "FindingSink.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ACS::AdapterTest
{

/// The present drive or the last one: compares its events with the route and with where the robot is.
class DriveChecker
{
public:
    enum class EEnd : std::uint8_t
    {
        Open,
        Arrived,
        Cancelled,
        Rejected,
    };

private:
    FindingSink _sink;
    std::optional<Planning::Drive> _drive;
    std::size_t _passedCount = 0; ///< Nodes of the drive for which NodePassed was raised.
    EEnd _end = EEnd::Open;
    bool _bLost = false; ///< It was commanded by an adapter that was destroyed.
    bool _bCancelAsked = false;
    std::set<std::string> _knownIDs;
    std::set<std::string> _visited; ///< Nodes on which the robot was since the drive was commanded.
    std::string _nodeID;            ///< Of the robot, as sampled last.

public:
    explicit DriveChecker(FindingSink sink);

    void OnDrive(const Planning::Drive& drive, const RobotTruth& truth);
    void OnExtend(const Planning::ExtendDrive& extend);
    void OnCancel(const Planning::CancelDrive& cancel);
    void OnRestart();

    void OnNodePassed(const Planning::NodePassed& event);
    void OnArrived(const Planning::Arrived& event, const RobotTruth& truth);
    void OnRejected(const Planning::DriveRejected& event, const RobotTruth& truth);
    void OnCancelled(const Planning::DriveCancelled& event, const RobotTruth& truth);

    /// Where the robot is now. The state is null before the first one of the adapter.
    void Sample(const RobotTruth& truth, const Planning::StateChanged* stateOrNull);

    [[nodiscard]] EEnd GetEnd() const noexcept;
    [[nodiscard]] std::size_t GetPassedCount() const noexcept;
    /// Nodes on which the robot was since the drive was commanded.
    [[nodiscard]] const std::set<std::string>& GetVisited() const noexcept;

private:
    /// Whether the event is of the open drive. Adds a finding if it is not.
    [[nodiscard]] bool IsOpen(const std::string& driveID, const Planning::RobotEvent& event) const;
    [[nodiscard]] bool IsReleased(const std::string& nodeID) const;
    void VerifyEntered(const Planning::StateChanged* stateOrNull);
};

} // namespace ACS::AdapterTest
