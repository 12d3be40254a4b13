#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// A robot in memory: drives along released nodes and does jobs, each with delays of its own from the random source.
class FakeRobotAdapter final : public Planning::IRobotAdapter
{
    static constexpr Planning::AdapterTimerID MOVE_TIMER = 1;
    static constexpr Planning::AdapterTimerID JOB_TIMER = 2;

    Core::IRandom& _random;
    std::string _nodeID;
    Planning::Drive _drive;
    std::size_t _index = 0;
    bool _bDriving = false;
    bool _bAccepted = false; ///< Has told the first node of its drive.
    bool _bMoving = false;   ///< Between _index and the next node.
    bool _bStopping = false;
    std::string _jobID;
    std::string _commandID; ///< Of the job.
    std::string _shownCommandID;
    bool _bJobStarted = false;
    bool _bForeign = false;             ///< Its drive was given by an engine that is gone.
    std::map<std::string, bool> _ended; ///< By commandID: whether it was done well.
    bool _bPauseAsked = false;
    bool _bPoseKnown = false; ///< Its first drive tells it where its node is.
    double _x = 0;
    double _y = 0;
    bool _bCharging = false;

public:
    std::set<std::string> failingJobs;
    bool bRejectDrives = false;
    bool bIgnoresJobCancel = false; ///< As an arm, whose program is never broken off.
    bool bIgnoresDriveCancel = false;
    bool bStuck = false;        ///< Takes its drive and stays where it is.
    bool bDeaf = false;         ///< No drive reaches it.
    bool bMissesJobs = false;   ///< No job reaches it.
    bool bIgnoresPause = false; ///< Neither stops nor goes on, as one that does not hear.
    bool bFinishesJobs = false; ///< A job that runs is not paused: the robot stands when it is done.
    bool bIgnoresCharging = false;
    std::string mark;                                     ///< As arms have one.
    std::optional<std::vector<Planning::PortLoad>> loads; ///< What its sensors show.
    double battery = 80;
    std::size_t chargesAsked = 0;
    std::size_t resumesAsked = 0;
    std::size_t extensions = 0;
    std::size_t drives = 0;
    std::size_t ranOverBase = 0; ///< Extensions that were needed and had not come when the base ended.
    std::vector<std::string> doneJobs;
    std::vector<Planning::StartJob> commandedJobs; ///< As they came, repeated ones too.
    std::vector<Planning::StartJob> recoveredJobs; ///< Of which it was asked what became of them.
    std::string uncertainReason;                   ///< Not empty: it cannot tell what became of a job.

    [[nodiscard]] const std::string& GetDriveID() const noexcept
    {
        return _drive.driveID;
    }

    /// It was switched off and on, without a drive or a job.
    void Forget()
    {
        _shownCommandID.clear();
        _ended.clear();
    }

    FakeRobotAdapter(Core::IRandom& random, std::string nodeID)
        : _random(random),
          _nodeID(std::move(nodeID))
    {
    }

    /// The nodes that the robot is on: one, or two while it is between them.
    [[nodiscard]] std::vector<std::string> GetOccupied() const
    {
        std::vector<std::string> nodes{_nodeID};
        if (_bMoving)
        {
            nodes.push_back(_drive.route.nodes[_index + 1].nodeID);
        }
        return nodes;
    }

    /// The engine is gone, and its adapter with it; the robot goes on with what it has.
    void LoseEngine()
    {
        _bForeign = _bDriving;
        _bStopping = _bDriving;
    }

    void Connect(Planning::AdapterActions& out)
    {
        if (_bForeign && _bStopping && !_bMoving && !_bPauseAsked)
        {
            _bDriving = false;
            _bForeign = false;
        }
        Raise(Planning::LinkChanged{true}, out);
        RaiseState(out);
    }

    /// What it is like at this moment, as it tells it again and again.
    void TellState(Planning::AdapterActions& out) const
    {
        RaiseState(out);
    }

    void Handle(const Planning::RobotCommand& command, Core::Now /*now*/, Planning::AdapterActions& out) override
    {
        std::visit(
            Core::Overloaded{
                [this, &out](const Planning::Drive& drive) { BeginDrive(drive, out); },
                [this, &out](const Planning::ExtendDrive& extend) { Extend(extend, out); },
                [this, &out](const Planning::CancelDrive& cancel) { Cancel(cancel, out); },
                [this, &out](const Planning::StartJob& job) {
                    commandedJobs.push_back(job);
                    if (bMissesJobs)
                    {
                        return;
                    }
                    _jobID = job.jobID;
                    _commandID = job.commandID;
                    _shownCommandID = job.commandID;
                    _bJobStarted = false;
                    StartTimer(JOB_TIMER, 500, out);
                },
                [this, &out](const Planning::RecoverJob& recover) {
                    recoveredJobs.push_back(recover.job);
                    Recover(recover.job, out);
                },
                [this, &out](const Planning::CancelJob& job) {
                    if (bIgnoresJobCancel || job.jobID != _jobID)
                    {
                        return;
                    }
                    _ended[_commandID] = false;
                    Raise(Planning::JobFailed{job.jobID, "cancelled"}, out);
                    _jobID.clear();
                    ShowPause(out);
                },
                [this, &out](const Planning::Pause&) {
                    _bPauseAsked = !bIgnoresPause || _bPauseAsked;
                    ShowPause(out);
                },
                [this, &out](const Planning::Resume&) {
                    ++resumesAsked;
                    if (!bIgnoresPause && std::exchange(_bPauseAsked, false))
                    {
                        GoOnAfterPause(out);
                    }
                },
                [this, &out](const Planning::StartCharging&) {
                    ++chargesAsked;
                    _bCharging = !bIgnoresCharging;
                    RaiseState(out);
                },
                [this, &out](const Planning::StopCharging&) {
                    _bCharging = false;
                    RaiseState(out);
                }},
            command);
    }

    void OnTimer(Planning::AdapterTimerID timer, Core::Now /*now*/, Planning::AdapterActions& out) override
    {
        if (timer == MOVE_TIMER)
        {
            Move(out);
        }
        else if (!_jobID.empty())
        {
            Work(out);
        }
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }

    /// It was asked to pause, and neither drives nor works.
    [[nodiscard]] bool IsPaused() const
    {
        return _bPauseAsked && !_bMoving && (_jobID.empty() || !bFinishesJobs);
    }

private:
    static void Raise(Planning::RobotEvent event, Planning::AdapterActions& out)
    {
        out.emplace_back(Planning::RaiseEvent{std::move(event)});
    }

    void RaiseState(Planning::AdapterActions& out) const
    {
        Planning::StateChanged state;
        state.bPoseKnown = _bPoseKnown;
        state.x = _x;
        state.y = _y;
        state.batteryPercent = battery;
        state.bCharging = _bCharging;
        state.lastNodeID = _nodeID;
        state.bDriving = _bMoving;
        state.bPaused = IsPaused();
        state.shownCommandID = _shownCommandID;
        state.mark = mark;
        state.loads = loads;
        state.bOccupied = _bForeign && _bDriving;
        for (std::size_t i = _index + 1; state.bOccupied && i < _drive.releasedCount; ++i)
        {
            state.heldNodeIDs.push_back(_drive.route.nodes[i].nodeID);
        }
        Raise(std::move(state), out);
    }

    void Recover(const Planning::StartJob& job, Planning::AdapterActions& out)
    {
        const auto ended = _ended.find(job.commandID);
        if (!uncertainReason.empty())
        {
            Raise(Planning::JobUncertain{job.jobID, uncertainReason}, out);
        }
        else if (ended != _ended.end() && ended->second)
        {
            Raise(Planning::JobFinished{job.jobID}, out);
        }
        else if (ended != _ended.end())
        {
            Raise(Planning::JobFailed{job.jobID, "the gripper is empty"}, out);
        }
        else if (_commandID != job.commandID || _jobID.empty())
        {
            Raise(Planning::JobUnknown{job.jobID}, out);
        }
        else if (_bJobStarted)
        {
            Raise(Planning::JobStarted{job.jobID}, out);
        }
    }

    void SetPose(const Planning::RouteNode& node)
    {
        _bPoseKnown = true;
        _x = node.x;
        _y = node.y;
    }

    void ShowPause(Planning::AdapterActions& out) const
    {
        if (IsPaused())
        {
            out.emplace_back(Planning::CancelAdapterTimer{JOB_TIMER});
            RaiseState(out);
        }
    }

    void GoOnAfterPause(Planning::AdapterActions& out)
    {
        RaiseState(out);
        if (!_jobID.empty())
        {
            StartTimer(JOB_TIMER, 500, out);
        }
        if (_bDriving && _bStopping && !_bMoving)
        {
            Stop(out);
        }
        else if (_bDriving && _bAccepted && !_bMoving)
        {
            GoOn(out);
        }
    }

    void StartTimer(Planning::AdapterTimerID timer, std::uint64_t maximum, Planning::AdapterActions& out)
    {
        const auto delay = std::chrono::milliseconds(1 + _random.GetNext() % maximum);
        out.emplace_back(Planning::StartAdapterTimer{timer, delay});
    }

    void BeginDrive(const Planning::Drive& drive, Planning::AdapterActions& out)
    {
        if (drive.route.nodes.front().nodeID == _nodeID)
        {
            SetPose(drive.route.nodes.front());
        }
        if (bDeaf)
        {
            return;
        }
        if (bRejectDrives || _bMoving || drive.route.nodes.front().nodeID != _nodeID)
        {
            Raise(Planning::DriveRejected{drive.driveID, "the test says so"}, out);
            return;
        }
        ++drives;
        _shownCommandID = drive.driveID;
        _bForeign = false;
        _drive = drive;
        _index = 0;
        _bDriving = true;
        _bStopping = false;
        _bAccepted = false;
        StartTimer(MOVE_TIMER, 100, out);
    }

    void Extend(const Planning::ExtendDrive& extend, Planning::AdapterActions& out)
    {
        if (!_bDriving || extend.driveID != _drive.driveID)
        {
            return;
        }
        ++extensions;
        const bool bWaits = _bAccepted && !_bMoving;
        ranOverBase += bWaits && _index > 0 ? 1U : 0U;
        _drive.releasedCount = extend.releasedCount;
        if (bWaits)
        {
            GoOn(out);
        }
    }

    void Cancel(const Planning::CancelDrive& cancel, Planning::AdapterActions& out)
    {
        if (!_bDriving || cancel.driveID != _drive.driveID || bIgnoresDriveCancel)
        {
            return;
        }
        _bStopping = true;
        if (!_bMoving)
        {
            Stop(out);
        }
    }

    void Stop(Planning::AdapterActions& out)
    {
        _bDriving = false;
        _bMoving = false;
        _bForeign = false;
        Raise(Planning::DriveCancelled{_drive.driveID, _nodeID}, out);
        RaiseState(out);
    }

    void Move(Planning::AdapterActions& out)
    {
        if (!_bDriving)
        {
            return;
        }
        _bAccepted = true;
        if (_bMoving)
        {
            ++_index;
            _nodeID = _drive.route.nodes[_index].nodeID;
            SetPose(_drive.route.nodes[_index]);
            _bMoving = false;
        }
        Raise(Planning::NodePassed{_drive.driveID, _nodeID}, out);
        if (_index + 1 == _drive.route.nodes.size())
        {
            _bDriving = false;
            Raise(Planning::Arrived{_drive.driveID}, out);
            RaiseState(out);
        }
        else if (_bStopping)
        {
            Stop(out);
        }
        else
        {
            ShowPause(out);
            GoOn(out);
        }
    }

    /// To the next node, where it is released.
    void GoOn(Planning::AdapterActions& out)
    {
        if (_index + 1 < _drive.releasedCount && !_bPauseAsked && !bStuck)
        {
            _bMoving = true;
            RaiseState(out);
            StartTimer(MOVE_TIMER, 3'000, out);
        }
    }

    void Work(Planning::AdapterActions& out)
    {
        if (!_bJobStarted)
        {
            _bJobStarted = true;
            Raise(Planning::JobStarted{_jobID}, out);
            StartTimer(JOB_TIMER, 5'000, out);
            return;
        }
        const std::string jobID = std::exchange(_jobID, {});
        _ended[_commandID] = !failingJobs.contains(jobID);
        if (failingJobs.contains(jobID))
        {
            Raise(Planning::JobFailed{jobID, "the gripper is empty"}, out);
        }
        else
        {
            doneJobs.push_back(jobID);
            Raise(Planning::JobFinished{jobID}, out);
        }
        ShowPause(out);
    }
};

} // namespace ACS::Testing
