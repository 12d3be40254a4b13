#include "MemoryRobotAdapter.hpp"

#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

constexpr Planning::AdapterTimerID RESEND_TIMER = 1;
constexpr Core::Duration RESEND_INTERVAL = 2s;
/// The range of numbers of one adapter.
constexpr unsigned NUMBER_BITS = 32;

void Raise(Planning::RobotEvent event, Planning::AdapterActions& out)
{
    out.emplace_back(Planning::RaiseEvent{std::move(event)});
}

} // namespace

MemoryRobotAdapter::MemoryRobotAdapter(std::uint64_t number, Sender send)
    : _send(std::move(send)),
      _number(number << NUMBER_BITS)
{
}

void MemoryRobotAdapter::Handle(const Planning::RobotCommand& command, Core::Now /*now*/, Planning::AdapterActions& out)
{
    std::visit(
        Core::Overloaded{
            [this](const Planning::Drive& drive) {
                _driveID = drive.driveID;
                _reportedCount = 0;
                _bDriveShown = false;
                _route.clear();
                for (const Planning::RouteNode& node : drive.route.nodes)
                {
                    _route.push_back(node.nodeID);
                }
                Send(drive);
            },
            [this](const Planning::ExtendDrive& extension) { Send(extension); },
            [this](const Planning::CancelDrive& cancel) { Send(cancel); },
            [this](const Planning::StartJob& job) {
                _recovery.reset();
                _job = job;
                _bJobStarted = false;
                _bJobShown = false;
                _commandBeforeJob = _bOnline ? std::optional(_snapshot->lastCommandID) : std::nullopt;
                Send(job);
            },
            [this, &out](const Planning::RecoverJob& recovery) {
                _recovery = recovery;
                if (_bOnline)
                {
                    Recover(out);
                    UpdateJob(out);
                }
            },
            [this](const Planning::CancelJob& cancel) {
                if (_job.has_value() && _job->jobID == cancel.jobID)
                {
                    Send(JobCancellation{_job->commandID});
                }
            },
            [this](const Planning::Pause&) {
                Send(PauseRequest{++_number, true});
            },
            [this](const Planning::Resume&) {
                Send(PauseRequest{++_number, false});
            },
            [](const Planning::StartCharging&) {}, // its battery is always full
            [](const Planning::StopCharging&) {
            }},
        command);
}

void MemoryRobotAdapter::OnTimer(Planning::AdapterTimerID /*timer*/, Core::Now /*now*/, Planning::AdapterActions& out)
{
    if (!_bLinkUp)
    {
        return;
    }
    if (!_bOnline)
    {
        _send(Greeting{_greeting});
    }
    for (const RobotMessage& message : _unconfirmed)
    {
        _send(message);
    }
    out.emplace_back(Planning::StartAdapterTimer{RESEND_TIMER, RESEND_INTERVAL});
}

std::optional<std::string> MemoryRobotAdapter::GetRejectionReasonOrNull(std::string_view /*action*/) const
{
    return std::nullopt;
}

void MemoryRobotAdapter::OnLinkUp(Planning::AdapterActions& out)
{
    _bLinkUp = true;
    _greeting = ++_number;
    _send(Greeting{_greeting});
    out.emplace_back(Planning::StartAdapterTimer{RESEND_TIMER, RESEND_INTERVAL});
}

void MemoryRobotAdapter::OnLinkDown(Planning::AdapterActions& out)
{
    _bLinkUp = false;
    if (std::exchange(_bOnline, false))
    {
        Raise(Planning::LinkChanged{false}, out);
    }
}

void MemoryRobotAdapter::Send(const RobotMessage& message)
{
    _unconfirmed.push_back(message);
    if (_bOnline)
    {
        _send(message);
    }
}

void MemoryRobotAdapter::OnSnapshot(const RobotSnapshot& snapshot, Planning::AdapterActions& out)
{
    if (!_bLinkUp || snapshot.greeting != _greeting)
    {
        return; // sent before the robot knew this link
    }
    _snapshot = snapshot;
    Confirm();
    if (!std::exchange(_bOnline, true))
    {
        DropDoubtfulJob(out);
        for (const RobotMessage& message : _unconfirmed)
        {
            _send(message);
        }
        Raise(Planning::LinkChanged{true}, out);
    }
    UpdateDrive(out);
    Recover(out);
    UpdateJob(out);
    PublishState(out);
}

/// The robot was away since the job was sent. If it does not show the command of before, it may have done the job and forgotten it.
void MemoryRobotAdapter::DropDoubtfulJob(Planning::AdapterActions& out)
{
    const auto isJob = [](const RobotMessage& message) {
        return std::holds_alternative<Planning::StartJob>(message);
    };
    const bool bKnown = !_commandBeforeJob.has_value()
        || (!_commandBeforeJob->empty() && _snapshot->lastCommandID == *_commandBeforeJob);
    _commandBeforeJob = _snapshot->lastCommandID;
    if (bKnown || std::erase_if(_unconfirmed, isJob) == 0)
    {
        return;
    }
    Raise(Planning::JobUnresolved{std::exchange(_job, std::nullopt)->jobID, "the robot remembers nothing"}, out);
}

void MemoryRobotAdapter::Confirm()
{
    std::erase_if(_unconfirmed, [this](const RobotMessage& message) { return IsConfirmed(message); });
}

bool MemoryRobotAdapter::IsConfirmed(const RobotMessage& message) const
{
    const auto findDrive = [this](const std::string& driveID) {
        const auto found = _snapshot->drives.find(driveID);
        return found == _snapshot->drives.end() ? nullptr : &found->second;
    };
    return std::visit(
        Core::Overloaded{
            [](const Greeting&) { return true; },
            [&](const Planning::Drive& drive) { return findDrive(drive.driveID) != nullptr; },
            [&](const Planning::ExtendDrive& extension) {
                const DriveView* const viewOrNull = findDrive(extension.driveID);
                return viewOrNull != nullptr
                    && (viewOrNull->state != EDriveState::Driving
                        || viewOrNull->releasedCount >= extension.releasedCount);
            },
            [&](const Planning::CancelDrive& cancel) {
                const DriveView* const viewOrNull = findDrive(cancel.driveID);
                return viewOrNull != nullptr && viewOrNull->state != EDriveState::Driving;
            },
            [&](const Planning::StartJob& job) { return _snapshot->jobs.contains(job.commandID); },
            [&](const JobCancellation& cancel) {
                const auto found = _snapshot->jobs.find(cancel.commandID);
                return found != _snapshot->jobs.end() && found->second.state != EJobState::Waiting;
            },
            [&](const PauseRequest& wish) {
                return _snapshot->pauseRequest >= wish.number;
            }},
        message);
}

void MemoryRobotAdapter::UpdateDrive(Planning::AdapterActions& out)
{
    const auto found = _snapshot->drives.find(_driveID);
    if (_driveID.empty() || found == _snapshot->drives.end())
    {
        if (!_driveID.empty() && _bDriveShown)
        {
            Raise(Planning::DriveRejected{std::exchange(_driveID, {}), "the robot has lost it"}, out);
        }
        return;
    }
    _bDriveShown = true;
    const DriveView& view = found->second;
    for (; _reportedCount < view.passedCount; ++_reportedCount)
    {
        Raise(Planning::NodePassed{_driveID, _route[_reportedCount]}, out);
    }
    switch (view.state)
    {
        case EDriveState::Arrived:
            Raise(Planning::Arrived{std::exchange(_driveID, {})}, out);
            break;
        case EDriveState::Cancelled:
            Raise(Planning::DriveCancelled{std::exchange(_driveID, {}), view.nodeID}, out);
            break;
        case EDriveState::Rejected:
            Raise(Planning::DriveRejected{std::exchange(_driveID, {}), "the robot refuses it"}, out);
            break;
        case EDriveState::Driving:
        default:
            break;
    }
}

/// The robot shows all commands from before the greeting of this adapter; one that it does not show was lost.
void MemoryRobotAdapter::Recover(Planning::AdapterActions& out)
{
    if (!_recovery.has_value())
    {
        return;
    }
    const Planning::RecoverJob recovery = *std::exchange(_recovery, std::nullopt);
    if (_snapshot->jobs.contains(recovery.job.commandID))
    {
        _job = recovery.job;
        _bJobStarted = false;
        _bJobShown = false;
    }
    else if (std::ranges::count(recovery.earlierIDs, _snapshot->lastCommandID) > 0)
    {
        Raise(Planning::JobUnknown{recovery.job.jobID}, out);
    }
    else
    {
        Raise(Planning::JobUnresolved{recovery.job.jobID, "the robot remembers nothing"}, out);
    }
}

void MemoryRobotAdapter::UpdateJob(Planning::AdapterActions& out)
{
    const auto found = _job.has_value() ? _snapshot->jobs.find(_job->commandID) : _snapshot->jobs.end();
    if (found == _snapshot->jobs.end())
    {
        if (_job.has_value() && _bJobShown)
        {
            const std::string lostID = _job->jobID;
            _job.reset();
            Raise(Planning::JobFailed{lostID, "the robot has lost it"}, out);
        }
        return;
    }
    _bJobShown = true;
    if (found->second.state == EJobState::Waiting)
    {
        return;
    }
    const std::string jobID = _job->jobID;
    switch (found->second.state)
    {
        case EJobState::Finished:
            _job.reset();
            Raise(Planning::JobFinished{jobID}, out);
            break;
        case EJobState::Failed:
            _job.reset();
            Raise(Planning::JobFailed{jobID, found->second.reason}, out);
            break;
        case EJobState::Running:
        case EJobState::Waiting:
        default:
            if (!std::exchange(_bJobStarted, true))
            {
                Raise(Planning::JobStarted{jobID}, out);
            }
            break;
    }
}

void MemoryRobotAdapter::PublishState(Planning::AdapterActions& out)
{
    Planning::StateChanged state = _snapshot->state;
    const std::string& driveID = _snapshot->activeDriveID;
    const bool bForeignDrive = !driveID.empty() && driveID != _driveID;
    const std::string commandID = _job.has_value() ? _job->commandID : std::string();
    const bool bForeignJob = !_snapshot->activeCommandID.empty() && _snapshot->activeCommandID != commandID;
    state.bOccupied = bForeignDrive || bForeignJob;
    state.restartEvidence.commandID = _snapshot->lastCommandID;
    state.heldNodeIDs = bForeignDrive ? _snapshot->aheadNodeIDs : std::vector<std::string>();
    if (bForeignDrive && std::exchange(_foreignDriveID, driveID) != driveID)
    {
        Send(Planning::CancelDrive{driveID});
    }
    Raise(std::move(state), out);
}

} // namespace ACS::Simulation
