#pragma once

#include "RobotMessages.hpp"
#include <acs/plan/IRobotAdapter.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Simulation
{

/// Joins a MemoryRobot to the engine, over a link that loses messages: what the robot has not shown is sent again.
class MemoryRobotAdapter final : public Planning::IRobotAdapter
{
public:
    using Sender = std::function<void(const RobotMessage& message)>;

private:
    Sender _send;
    std::uint64_t _number; ///< Higher than that of earlier adapters, over restarts too.
    std::uint64_t _greeting = 0;
    bool _bLinkUp = false;
    bool _bOnline = false;
    std::vector<RobotMessage> _unconfirmed;
    std::optional<RobotSnapshot> _snapshot;
    std::string _driveID;
    std::vector<std::string> _route; ///< The route of the drive.
    std::size_t _reportedCount = 0;  ///< Number of its nodes that were reported.
    bool _bDriveShown = false;       ///< The robot has received it.
    std::optional<Planning::StartJob> _job;
    std::optional<Planning::RecoverJob> _recovery; ///< Requested, and not answered by the robot yet.
    bool _bJobStarted = false;
    bool _bJobShown = false; ///< The robot has received it.
    /// The last command that the robot showed when the job was sent; nullopt: the job was not sent yet.
    std::optional<std::string> _commandBeforeJob;
    std::string _foreignDriveID; ///< A drive from before a restart that is being cancelled.

public:
    /// The number is higher than that of every adapter before this one.
    MemoryRobotAdapter(std::uint64_t number, Sender send);

    void Handle(const Planning::RobotCommand& command, Core::Now now, Planning::AdapterActions& out) override;
    void OnTimer(Planning::AdapterTimerID timer, Core::Now now, Planning::AdapterActions& out) override;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override;

    void OnLinkUp(Planning::AdapterActions& out);
    void OnLinkDown(Planning::AdapterActions& out);
    void OnSnapshot(const RobotSnapshot& snapshot, Planning::AdapterActions& out);

private:
    void Send(const RobotMessage& message);
    void DropDoubtfulJob(Planning::AdapterActions& out);
    void Confirm();
    [[nodiscard]] bool IsConfirmed(const RobotMessage& message) const;
    void Recover(Planning::AdapterActions& out);
    void UpdateDrive(Planning::AdapterActions& out);
    void UpdateJob(Planning::AdapterActions& out);
    void PublishState(Planning::AdapterActions& out);
};

} // namespace ACS::Simulation
