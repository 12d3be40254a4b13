#pragma once

#include "ReferenceMessage.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

/// An adapter that breaks no rule, for the reference robot. Those of PlantedAdapters.hpp derive from it.
class ReferenceAdapter : public Planning::IRobotAdapter
{
protected:
    using EKind = ReferenceMessage::EKind;
    using Out = Planning::AdapterActions;

    bool _bOnline = false;
    std::optional<ReferenceMessage> _state; ///< Since the connection.
    std::optional<Planning::Drive> _drive;
    std::size_t _passedCount = 0; ///< Nodes of the drive.
    std::string _goID;            ///< The last Go of this connection: until the robot shows it, its state is outdated.
    bool _bCancelsDrive = false;
    bool _bPauseAsked = false;
    std::optional<Planning::StartJob> _job;
    bool _bCancelsJob = false;
    std::vector<ReferenceMessage> _messages; ///< To the robot.

public:
    void Handle(const Planning::RobotCommand& command, Core::Now /*now*/, Out& out) override
    {
        std::visit(
            Core::Overloaded{
                [this, &out](const Planning::Drive& typed) { OnDrive(typed, out); },
                [this, &out](const Planning::ExtendDrive& typed) { OnExtendDrive(typed, out); },
                [this, &out](const Planning::CancelDrive& typed) { OnCancelDrive(typed, out); },
                [this, &out](const Planning::StartJob& typed) { OnStartJob(typed, out); },
                [this, &out](const Planning::RecoverJob& typed) { OnRecoverJob(typed, out); },
                [this, &out](const Planning::CancelJob& typed) { OnCancelJob(typed, out); },
                [this, &out](const Planning::Pause& typed) { OnPause(typed, out); },
                [this, &out](const Planning::Resume& typed) { OnResume(typed, out); },
                [this, &out](const Planning::StartCharging& typed) { OnStartCharging(typed, out); },
                [this, &out](const Planning::StopCharging& typed) {
                    OnStopCharging(typed, out);
                }},
            command);
    }

    void OnTimer(Planning::AdapterTimerID /*timer*/, Core::Now /*now*/, Out& /*out*/) override
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }

    /// Messages of both directions may have been lost with the connection before.
    virtual void OnLinkUp(Out& out)
    {
        _bOnline = true;
        _goID.clear();
        Raise(Planning::LinkChanged{true}, out); // the robot sends its state
        if (_bPauseAsked)
        {
            Send({EKind::Pause});
        }
        if (_job.has_value())
        {
            Send({EKind::Ask, _job->commandID});
        }
    }

    virtual void OnLinkDown(Out& out)
    {
        _bOnline = false;
        _state.reset();
        Raise(Planning::LinkChanged{false}, out);
    }

    virtual void OnMessage(const ReferenceMessage& message, Out& out)
    {
        if (message.kind == EKind::State)
        {
            _state = message;
            RaiseState(out);
            ContinueDrive(out);
        }
        else if (message.kind == EKind::GoRefused && _drive.has_value() && message.id == _goID)
        {
            EndDrive(Planning::DriveRejected{_drive->driveID, "the robot refuses to drive"}, out);
        }
        else if (message.kind == EKind::JobState && _job.has_value() && message.id == _job->commandID)
        {
            OnJobState(message.text, out);
        }
    }

    /// Dropped if there is no connection.
    [[nodiscard]] std::vector<ReferenceMessage> TakeMessages()
    {
        return std::exchange(_messages, {});
    }

protected:
    virtual void Raise(Planning::RobotEvent event, Out& out)
    {
        out.emplace_back(Planning::RaiseEvent{std::move(event)});
    }

    virtual void Send(ReferenceMessage message)
    {
        _messages.push_back(std::move(message));
    }

    virtual void OnDrive(const Planning::Drive& command, Out& out)
    {
        _drive = command;
        _passedCount = 0;
        _bCancelsDrive = false;
        ContinueDrive(out);
    }

    virtual void OnExtendDrive(const Planning::ExtendDrive& command, Out& out)
    {
        if (_drive.has_value() && _drive->driveID == command.driveID)
        {
            _drive->releasedCount = command.releasedCount;
            ContinueDrive(out);
        }
    }

    virtual void OnCancelDrive(const Planning::CancelDrive& command, Out& out)
    {
        if (_drive.has_value() && _drive->driveID == command.driveID)
        {
            _bCancelsDrive = true;
            ContinueDrive(out);
        }
    }

    virtual void OnStartJob(const Planning::StartJob& command, Out& /*out*/)
    {
        _job = command;
        _bCancelsJob = false;
        Send({EKind::Do, _job->commandID});
    }

    virtual void OnRecoverJob(const Planning::RecoverJob& command, Out& /*out*/)
    {
        _job = command.job;
        _bCancelsJob = false;
        Send({EKind::Ask, _job->commandID});
    }

    virtual void OnCancelJob(const Planning::CancelJob& command, Out& /*out*/)
    {
        if (_job.has_value() && _job->jobID == command.jobID)
        {
            _bCancelsJob = true;
            Send({EKind::Cancel, _job->commandID});
        }
    }

    virtual void OnPause(const Planning::Pause& /*command*/, Out& /*out*/)
    {
        _bPauseAsked = true;
        Send({EKind::Pause});
    }

    virtual void OnResume(const Planning::Resume& /*command*/, Out& /*out*/)
    {
        _bPauseAsked = false;
        Send({EKind::Resume});
    }

    virtual void OnStartCharging(const Planning::StartCharging& /*command*/, Out& /*out*/)
    {
        Send({EKind::Charge});
    }

    virtual void OnStopCharging(const Planning::StopCharging& /*command*/, Out& /*out*/)
    {
        Send({EKind::StopCharging});
    }

    virtual void OnJobState(const std::string& text, Out& out)
    {
        if (text == "running")
        {
            Raise(Planning::JobStarted{_job->jobID}, out);
            if (_bCancelsJob)
            {
                Send({EKind::Cancel, _job->commandID});
            }
            return;
        }
        const std::string jobID = std::exchange(_job, std::nullopt)->jobID;
        if (text == "done")
        {
            Raise(Planning::JobFinished{jobID}, out);
        }
        else if (text == "refused" && !_bCancelsJob)
        {
            Raise(Planning::JobRejected{jobID, "the robot refuses the job"}, out);
        }
        else if (text == "unknown" && !_bCancelsJob)
        {
            Raise(Planning::JobUnknown{jobID}, out);
        }
        else
        {
            Raise(Planning::JobFailed{jobID, "the job is " + text}, out);
        }
    }

    void RaiseState(Out& out)
    {
        Planning::StateChanged report;
        report.lastNodeID = _state->nodeID;
        report.batteryPercent = 80;
        report.bDriving = !_state->nextID.empty() && !_state->bPaused;
        report.bPaused = _state->bPaused;
        report.bCharging = _state->bCharging;
        report.bOccupied = !_state->nextID.empty() && !_drive.has_value(); // it ends an edge from before a restart
        report.heldNodeIDs.assign(report.bOccupied ? 1 : 0, _state->nextID);
        report.restartEvidence.commandID = _state->id;
        report.loads = std::vector<Planning::PortLoad>{{"CP01", _state->bLoaded, ""}};
        Raise(std::move(report), out);
    }

    /// Reports the progress of the drive, and sends the next Go when the robot is stationary on a node.
    virtual void ContinueDrive(Out& out)
    {
        const bool bOutdated = !_state.has_value() || (!_goID.empty() && _state->goID != _goID);
        if (!_drive.has_value() || bOutdated || !_state->nextID.empty())
        {
            return;
        }
        const std::vector<Planning::RouteNode>& nodes = _drive->route.nodes;
        if (_passedCount < nodes.size() && nodes[_passedCount].nodeID == _state->nodeID)
        {
            Raise(Planning::NodePassed{_drive->driveID, nodes[_passedCount++].nodeID}, out);
        }
        if (_passedCount == nodes.size())
        {
            EndDrive(Planning::Arrived{_drive->driveID}, out);
        }
        else if (_passedCount == 0)
        {
            EndDrive(Planning::DriveRejected{_drive->driveID, "the robot is at another node"}, out);
        }
        else if (_bCancelsDrive)
        {
            EndDrive(Planning::DriveCancelled{_drive->driveID, _state->nodeID}, out);
        }
        else if (!_bPauseAsked && _passedCount < _drive->releasedCount)
        {
            _goID = _drive->driveID + "/" + std::to_string(_passedCount);
            Send({EKind::Go, _goID, nodes[_passedCount].nodeID});
        }
    }

    void EndDrive(Planning::RobotEvent event, Out& out)
    {
        _drive.reset();
        Raise(std::move(event), out);
    }
};

} // namespace ACS::Testing
