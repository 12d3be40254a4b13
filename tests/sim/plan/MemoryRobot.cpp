#include "MemoryRobot.hpp"

#include <acs/core/Overloaded.hpp>

#include <cmath>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

MemoryRobot::MemoryRobot(
    Timeline& timeline,
    Trace& trace,
    WorkChecker& workChecker,
    const ChanceSeed& seed,
    std::string robotID,
    std::string nodeID)
    : _trace(trace),
      _workChecker(workChecker),
      _chance(seed),
      _timers(timeline),
      _robotID(std::move(robotID))
{
    _nature.bStopsOnEdges = _chance.IsHit(400);
    _nature.bFinishesJobs = _chance.IsHit(300);
    _nature.bIgnoresJobCancel = _chance.IsHit(300);
    _nature.slowness = _chance.GetBetween(1, 3);
    _snapshot.state.batteryPercent = 80;
    _snapshot.state.lastNodeID = std::move(nodeID);
    ShowPlace();
}

void MemoryRobot::SetListener(Listener listener)
{
    _listener = std::move(listener);
}

void MemoryRobot::Receive(const RobotMessage& message)
{
    std::visit(
        Core::Overloaded{
            [this](const Greeting& greeting) { _snapshot.greeting = greeting.number; },
            [this](const Planning::Drive& drive) { BeginDrive(drive); },
            [this](const Planning::ExtendDrive& extension) { Extend(extension); },
            [this](const Planning::CancelDrive& cancel) { CancelDrive(cancel); },
            [this](const Planning::StartJob& job) { BeginJob(job); },
            [this](const JobCancellation& cancel) { CancelJob(cancel.commandID); },
            [this](const PauseRequest& wish) {
                SetPause(wish);
            }},
        message);
    Show();
}

void MemoryRobot::BeginDrive(const Planning::Drive& drive)
{
    const auto [view, bNew] = _snapshot.drives.try_emplace(drive.driveID);
    if (!bNew)
    {
        return; // a repetition
    }
    view->second.releasedCount = drive.releasedCount;
    view->second.nodeID = GetNodeID();
    const bool bRefused = _drive.has_value() || _job.has_value() || !CanBegin(drive.route);
    if (bRefused || _chance.IsHit(rejectChance))
    {
        _trace.Add("{} rejects a drive to {}", _robotID, drive.route.nodes.back().nodeID);
        view->second.state = EDriveState::Rejected;
        return;
    }
    _trace.Add("{} accepts a drive to {}", _robotID, drive.route.nodes.back().nodeID);
    view->second.passedCount = 1;
    _snapshot.lastCommandID = drive.driveID;
    _drive = drive;
    _index = 0;
    _bStopping = false;
    _snapshot.activeDriveID = drive.driveID;
    GoOn();
}

/// It is on the first node; or within its deviation, on the way to the second one.
bool MemoryRobot::CanBegin(const Planning::Route& route) const
{
    const Planning::RouteNode& first = route.nodes.front();
    if (first.nodeID != GetNodeID() || !_nextNodeID.has_value())
    {
        return first.nodeID == GetNodeID();
    }
    const double distance = std::hypot(first.x - _snapshot.state.x, first.y - _snapshot.state.y);
    return route.nodes[1].nodeID == *_nextNodeID && distance <= first.allowedDeviation;
}

void MemoryRobot::Extend(const Planning::ExtendDrive& extension)
{
    if (_drive.has_value() && _drive->driveID == extension.driveID && _drive->releasedCount < extension.releasedCount)
    {
        _drive->releasedCount = extension.releasedCount;
        _snapshot.drives[extension.driveID].releasedCount = extension.releasedCount;
        GoOn();
    }
}

void MemoryRobot::CancelDrive(const Planning::CancelDrive& cancel)
{
    const auto [view, bNew] = _snapshot.drives.try_emplace(cancel.driveID);
    if (bNew)
    {
        // It was never received, and will not begin any more.
        view->second.state = EDriveState::Cancelled;
        view->second.nodeID = GetNodeID();
        return;
    }
    if (_drive.has_value() && _drive->driveID == cancel.driveID)
    {
        _bStopping = true;
        if (!_bMoving)
        {
            EndDrive(EDriveState::Cancelled);
        }
    }
}

/// Drives to the next node if it is released.
void MemoryRobot::GoOn()
{
    if (!_drive.has_value() || _bMoving || _bPauseAsked || _bStopped || _bStopping
        || _index + 1 >= _drive->releasedCount)
    {
        return;
    }
    _bMoving = true;
    _nextNodeID.reset();
    ShowPlace();
    _timers.Start(ETimer::Move, _chance.GetBetween(300ms, 1'500ms) * _nature.slowness, [this] { OnMoveTimer(); });
}

void MemoryRobot::OnMoveTimer()
{
    if (IsHalted())
    {
        _bMoveHalted = true;
        ShowBetween();
        Show();
        return;
    }
    _bMoving = false;
    ++_index;
    const Planning::RouteNode& node = _drive->route.nodes[_index];
    _snapshot.state.lastNodeID = node.nodeID;
    _snapshot.state.x = node.x;
    _snapshot.state.y = node.y;
    _snapshot.state.bPoseKnown = true; // From its first drive on, which has the pose of the node.
    _snapshot.drives[_drive->driveID].passedCount = _index + 1;
    ShowPlace();
    if (_index + 1 == _drive->route.nodes.size())
    {
        EndDrive(EDriveState::Arrived);
    }
    else if (_bStopping)
    {
        EndDrive(EDriveState::Cancelled);
    }
    GoOn();
    Show();
}

void MemoryRobot::EndDrive(EDriveState state)
{
    DriveView& view = _snapshot.drives[_drive->driveID];
    view.state = state;
    view.nodeID = GetNodeID();
    _snapshot.activeDriveID.clear();
    _drive.reset();
    _bStopping = false;
}

/// As the standard demands of a vehicle that is switched to manual mode.
void MemoryRobot::LoseDrive()
{
    if (!_drive.has_value())
    {
        return;
    }
    if (std::exchange(_bMoving, false))
    {
        _nextNodeID = _drive->route.nodes[_index + 1].nodeID;
        ShowBetween();
    }
    _timers.Cancel(ETimer::Move);
    _snapshot.drives.erase(_drive->driveID);
    _snapshot.activeDriveID.clear();
    _drive.reset();
    _bMoveHalted = _bStopping = false;
    ShowPlace();
}

/// Its pose is that in the middle between two nodes.
void MemoryRobot::ShowBetween()
{
    const Planning::RouteNode& node = _drive->route.nodes[_index];
    const Planning::RouteNode& next = _drive->route.nodes[_index + 1];
    _snapshot.state.x = (node.x + next.x) / 2;
    _snapshot.state.y = (node.y + next.y) / 2;
    _snapshot.state.bPoseKnown = true;
}

void MemoryRobot::BeginJob(const Planning::StartJob& job)
{
    const auto [view, bNew] = _snapshot.jobs.try_emplace(job.commandID);
    if (!bNew)
    {
        return; // a repetition
    }
    view->second.jobID = job.jobID;
    if (_drive.has_value() || _job.has_value())
    {
        view->second.state = EJobState::Failed;
        view->second.reason = "the robot is busy";
        return;
    }
    _snapshot.lastCommandID = job.commandID;
    _job = job;
    _snapshot.activeCommandID = job.commandID;
    _timers.Start(ETimer::Job, _chance.GetBetween(10ms, 1s), [this] { OnJobTimer(); });
}

void MemoryRobot::OnJobTimer()
{
    JobView& view = _snapshot.jobs[_job->commandID];
    const bool bRuns = view.state == EJobState::Running;
    if (_bStopped || (_bPauseAsked && !(bRuns && _nature.bFinishesJobs)))
    {
        _bJobHalted = true;
        Show();
        return;
    }
    if (!bRuns)
    {
        view.state = EJobState::Running;
        _workChecker.OnJobBegun(_robotID, *_job);
        _timers.Start(ETimer::Job, _chance.GetBetween(200ms, 4s) * _nature.slowness, [this] { OnJobTimer(); });
    }
    else if (_chance.IsHit(failChance))
    {
        EndJob(EJobState::Failed, "the gripper is empty");
    }
    else
    {
        FinishJob();
    }
    Show();
}

/// Does what was commanded, independent of the plan.
void MemoryRobot::FinishJob()
{
    const std::optional<Sim::WorldEvent> move = MakeMoveOrNull(_robotID, *_job);
    const Core::Result<void> done = move.has_value() ? _workChecker.GetFloor().Act(*move) : Core::Result<void>();
    if (!done.has_value())
    {
        EndJob(EJobState::Failed, Core::Describe(done.error()));
        return;
    }
    _workChecker.OnJobFinished(_robotID, *_job);
    EndJob(EJobState::Finished, {});
}

void MemoryRobot::EndJob(EJobState state, const std::string& reason)
{
    JobView& view = _snapshot.jobs[_job->commandID];
    view.state = state;
    view.reason = reason;
    _snapshot.activeCommandID.clear();
    _timers.Cancel(ETimer::Job);
    _bJobHalted = false;
    _job.reset();
}

void MemoryRobot::CancelJob(const std::string& commandID)
{
    const auto [view, bNew] = _snapshot.jobs.try_emplace(commandID);
    if (bNew)
    {
        // It was never received, and will not begin any more.
        view->second.state = EJobState::Failed;
        view->second.reason = "cancelled before it arrived";
        return;
    }
    const bool bEndable = view->second.state == EJobState::Waiting || !_nature.bIgnoresJobCancel;
    if (_job.has_value() && _job->commandID == commandID && bEndable)
    {
        EndJob(EJobState::Failed, "cancelled");
    }
}

void MemoryRobot::SetPause(const PauseRequest& wish)
{
    if (wish.number <= _snapshot.pauseRequest)
    {
        return;
    }
    _snapshot.pauseRequest = wish.number;
    _bPauseAsked = wish.bPause;
    if (!wish.bPause)
    {
        Unhalt();
    }
}

bool MemoryRobot::IsHalted() const noexcept
{
    return _bStopped || (_bPauseAsked && _nature.bStopsOnEdges);
}

void MemoryRobot::Unhalt()
{
    if (_bStopped)
    {
        return;
    }
    if (!IsHalted() && std::exchange(_bMoveHalted, false))
    {
        _timers.Start(ETimer::Move, _chance.GetBetween(100ms, 1s), [this] { OnMoveTimer(); });
    }
    if (!_bPauseAsked && std::exchange(_bJobHalted, false))
    {
        _timers.Start(ETimer::Job, _chance.GetBetween(100ms, 1s), [this] { OnJobTimer(); });
    }
    GoOn();
}

/// Switches it off and on: it drops its drive and job and loses its memory.
void MemoryRobot::Forget()
{
    if (_bMoving || _nextNodeID.has_value())
    {
        return; // not between two nodes: it would have to be carried to one
    }
    _trace.Add("{} loses its memory", _robotID);
    _timers.CancelAll();
    _drive.reset();
    _job.reset();
    _bJobHalted = _bStopping = _bPauseAsked = false;
    _snapshot.activeDriveID.clear();
    _snapshot.activeCommandID.clear();
    _snapshot.lastCommandID.clear();
    _snapshot.drives.clear();
    _snapshot.jobs.clear();
    ShowPlace();
    Show();
}

void MemoryRobot::Disturb()
{
    _bStopped = true;
    switch (_chance.GetBelow(3))
    {
        case 0:
            _snapshot.state.bSafetyStop = true;
            break;
        case 1:
            _snapshot.state.bAutomatic = false;
            LoseDrive();
            break;
        default:
            _snapshot.state.errors = {{"AGV-lost", Planning::EAlarmLevel::Heavy, "lost its way"}};
            break;
    }
    _trace.Add("{} has a fault", _robotID);
    Show();
}

void MemoryRobot::Recover()
{
    _bStopped = false;
    _snapshot.state.bSafetyStop = false;
    _snapshot.state.bAutomatic = true;
    _snapshot.state.errors.clear();
    _trace.Add("{} has recovered", _robotID);
    Unhalt();
    Show();
}

void MemoryRobot::ShowPlace()
{
    std::vector<std::string> nodeIDs{GetNodeID()};
    if (_bMoving)
    {
        nodeIDs.push_back(_drive->route.nodes[_index + 1].nodeID);
    }
    else if (_nextNodeID.has_value())
    {
        nodeIDs.push_back(*_nextNodeID);
    }
    const bool bOnNode = nodeIDs.size() == 1;
    _workChecker.OnPlaced(_robotID, std::move(nodeIDs));
    _workChecker.GetFloor().OnPlaced(_robotID, bOnNode ? GetNodeID() : std::string());
}

void MemoryRobot::Show()
{
    const bool bJobRuns = _job.has_value() && _snapshot.jobs[_job->commandID].state == EJobState::Running;
    _snapshot.state.bDriving = _bMoving && !_bMoveHalted;
    _snapshot.aheadNodeIDs.clear();
    for (std::size_t i = _index + 1; _drive.has_value() && i < _drive->releasedCount; ++i)
    {
        _snapshot.aheadNodeIDs.push_back(_drive->route.nodes[i].nodeID);
    }
    _snapshot.state.bPaused =
        _bPauseAsked && (!_bMoving || _bMoveHalted) && !(bJobRuns && _nature.bFinishesJobs && !_bJobHalted);
    if (_listener)
    {
        _listener(_snapshot);
    }
}

const std::string& MemoryRobot::GetNodeID() const noexcept
{
    return _snapshot.state.lastNodeID;
}

const RobotSnapshot& MemoryRobot::GetSnapshot() const noexcept
{
    return _snapshot;
}

bool MemoryRobot::IsDisturbed() const noexcept
{
    return _bStopped;
}

} // namespace ACS::Simulation
