#pragma once

#include <acs/acsd/ILineAdapter.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/core/Result.hpp>

#include <array>
#include <map>
#include <sstream>
#include <utility>

// NOLINTNEXTLINE(google-build-using-namespace,google-global-names-in-headers): an example reads better without the prefix
using namespace ACS::Planning;
namespace Core = ACS::Core;

/// Drives the cart from node to node and gives it jobs; the README has its lines. The cart keeps on disk which jobs it has executed:
/// after a restart of acsd or a lost connection it is asked for the job before it is commanded again.
class CartAdapter final : public ACS::Acsd::ILineAdapter
{
public:
    using Commands = std::map<std::string, std::string, std::less<>>; ///< The cart's command for each action.

private:
    const Commands _commands;
    std::vector<std::string> _lines;
    StateChanged _state; ///< As the cart reported last.
    std::string _next;   ///< The node ahead; empty: it is stationary.
    std::optional<Drive> _drive;
    std::size_t _passed = 0; ///< Nodes of the drive.
    bool _bCancelling = false;
    bool _bPaused = false;
    std::optional<StartJob> _job;
    bool _bStarted = false; ///< It was reported that the cart has begun the job.

public:
    explicit CartAdapter(Commands commands)
        : _commands(std::move(commands))
    {
        _state.batteryPercent = 100;
    }

    void Handle(const RobotCommand& command, Core::Now /*now*/, AdapterActions& out) override
    {
        std::visit(
            Core::Overloaded{
                [this](const Drive& drive) {
                    _drive = drive;
                    _passed = 0;
                    _bCancelling = false;
                },
                [this](const ExtendDrive& extend) {
                    if (_drive.has_value()) // it may just have been rejected
                    {
                        _drive->releasedCount = extend.releasedCount;
                    }
                },
                [this](const CancelDrive& /*cancel*/) { _bCancelling = true; },
                [this](const Pause& /*pause*/) { _bPaused = true; },
                [this](const Resume& /*resume*/) { _bPaused = false; },
                [this](const StartJob& job) {
                    _job = job;
                    _bStarted = false;
                    const std::string places = job.from.value_or("-") + " " + job.to.value_or("-");
                    _lines.push_back("job " + job.commandID + " " + _commands.at(job.action) + " " + places);
                },
                [this](const RecoverJob& recover) {
                    _job = recover.job;
                    AskForJob();
                },
                [](const auto& /*other*/) {
                }}, // it does not charge, and it finishes a job that it has begun
            command);
        Continue(out);
    }

    void OnLinkUp(Core::Now /*now*/, AdapterActions& out) override
    {
        out.emplace_back(RaiseEvent{LinkChanged{true}}); // the cart sends its state
        AskForJob();
    }

    void OnLinkDown(Core::Now /*now*/, AdapterActions& out) override
    {
        _state.lastNodeID.clear();
        out.emplace_back(RaiseEvent{LinkChanged{false}});
    }

    void OnLine(std::string_view line, Core::Now /*now*/, AdapterActions& out) override
    {
        std::istringstream words{std::string(line)};
        std::array<std::string, 4> word;
        words >> word[0] >> word[1] >> word[2] >> word[3];
        if (word[0] == "state" && !word[3].empty())
        {
            _state.lastNodeID = word[1];
            _next = word[2] == "-" ? std::string() : word[2];
            // Without a job in its journal there is no evidence, and none is needed.
            _state.restartEvidence.commandID = word[3] == "-" ? std::nullopt : std::optional(word[3]);
            Continue(out);
        }
        else if ((word[0] == "job" || word[0] == "refused") && !word[2].empty())
        {
            OnAnswer(word[1], word[2], out);
        }
        else
        {
            out.emplace_back(RaiseEvent{CompatibilityChanged{"The cart sent " + Core::QuoteForError(line) + "."}});
        }
    }

    std::vector<std::string> TakeLines() override
    {
        return std::exchange(_lines, {});
    }

private:
    void AskForJob()
    {
        if (_job.has_value())
        {
            _lines.push_back("ask " + _job->commandID);
        }
    }

    /// Reports the state, and the progress of the drive when the cart is stationary on a node.
    void Continue(AdapterActions& out)
    {
        if (_state.lastNodeID.empty())
        {
            return; // not known since the connection
        }
        _state.bDriving = !_next.empty();
        _state.bPaused = _bPaused && !_state.bDriving;
        _state.bOccupied = _state.bDriving && !_drive.has_value(); // it ends an edge from before a restart
        _state.heldNodeIDs.assign(_state.bOccupied ? 1 : 0, _next);
        out.emplace_back(RaiseEvent{_state});
        if (!_drive.has_value() || _state.bDriving)
        {
            return;
        }
        const std::vector<RouteNode>& nodes = _drive->route.nodes;
        if (nodes[_passed].nodeID == _state.lastNodeID)
        {
            out.emplace_back(RaiseEvent{NodePassed{_drive->driveID, nodes[_passed++].nodeID}});
        }
        if (_passed == nodes.size())
        {
            EndDrive(Arrived{_drive->driveID}, out);
        }
        else if (_passed == 0 || nodes[_passed - 1].nodeID != _state.lastNodeID)
        {
            EndDrive(DriveRejected{_drive->driveID, "the cart is at " + Core::QuoteForError(_state.lastNodeID)}, out);
        }
        else if (_bCancelling)
        {
            EndDrive(DriveCancelled{_drive->driveID, _state.lastNodeID}, out);
        }
        else if (!_bPaused && _passed < _drive->releasedCount)
        {
            _lines.push_back("go " + _drive->driveID + " " + nodes[_passed].nodeID);
        }
    }

    void EndDrive(const RobotEvent& event, AdapterActions& out)
    {
        out.emplace_back(RaiseEvent{event});
        _drive.reset();
    }

    void OnAnswer(const std::string& commandID, const std::string& answer, AdapterActions& out)
    {
        if (!_job.has_value() || _job->commandID != commandID)
        {
            return;
        }
        if (answer == "running")
        {
            _bStarted = true;
            out.emplace_back(RaiseEvent{JobStarted{_job->jobID}});
        }
        else if (answer == "known") // the command has come twice
        {
            AskForJob();
        }
        else
        {
            out.emplace_back(RaiseEvent{MakeEnd(_job->jobID, answer)});
            _job.reset();
        }
    }

    [[nodiscard]] RobotEvent MakeEnd(const std::string& jobID, const std::string& answer) const
    {
        if (answer == "done")
        {
            return JobFinished{jobID};
        }
        if (answer != "unknown")
        {
            return JobRejected{jobID, "the cart answers " + Core::QuoteForError(answer)};
        }
        // It was restarted before it had moved anything.
        return _bStarted ? RobotEvent(JobInterrupted{jobID, "the cart was restarted"}) : RobotEvent(JobUnknown{jobID});
    }
};
