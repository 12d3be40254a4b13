#pragma once

#include <acs/acsd/ILineAdapter.hpp>
#include <acs/acsd/NodeByNodeDrive.hpp>
#include <acs/acsd/RobotJob.hpp>
#include <acs/core/Result.hpp>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// NOLINTNEXTLINE(google-build-using-namespace,google-global-names-in-headers): an example reads better without the prefix
using namespace ACS::Planning;
namespace Core = ACS::Core;

/// Drives the cart from node to node and gives it jobs; the README has its lines. The cart keeps on disk which jobs it has
/// executed: after a restart of acsd or a lost connection it is asked for the job before it is commanded again.
class CartAdapter final : public ACS::Acsd::ILineAdapter
{
public:
    using Commands = std::map<std::string, std::string, std::less<>>; ///< The cart's command for each action.

private:
    const Commands _commands;
    std::vector<std::string> _lines;
    StateChanged _state; ///< As the cart reported last.
    std::string _next;   ///< The node ahead; empty: it is stationary.
    std::string _sent;   ///< The node of a "go" that the cart has not shown yet: it may drive already.
    ACS::Acsd::NodeByNodeDrive _drive;
    ACS::Acsd::RobotJob _job;

public:
    explicit CartAdapter(Commands commands)
        : _commands(std::move(commands))
    {
        _state.batteryPercent = 100;
    }

    // It does not charge, and it finishes a job that it has begun: other commands have no effect.
    void Handle(const RobotCommand& command, Core::Now /*now*/, AdapterActions& out) override
    {
        _drive.Handle(command);
        _job.Handle(command);
        if (const auto* job = std::get_if<StartJob>(&command))
        {
            const std::string places = job->from.value_or("-") + " " + job->to.value_or("-");
            _lines.push_back("job " + job->commandID + " " + _commands.at(job->action) + " " + places);
        }
        else if (std::holds_alternative<RecoverJob>(command))
        {
            AskForJob();
        }
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
        _sent.clear(); // the cart has received it and shows it, or never will
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
            _sent = _sent == word[1] || _sent == word[2] ? std::string() : _sent;
            // Without a job in its journal there is no evidence, and none is needed.
            _state.restartEvidence.commandID = word[3] == "-" ? std::nullopt : std::optional(word[3]);
            Continue(out);
        }
        else if ((word[0] == "job" || word[0] == "refused") && !word[2].empty())
        {
            OnAnswer(word[1], word[2], out);
            _sent = word[0] == "refused" ? std::string() : _sent; // a "go" is then sent again
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
        if (const StartJob* job = _job.GetJobOrNull())
        {
            _lines.push_back("ask " + job->commandID);
        }
    }

    /// Reports the state, and continues the drive when the cart is stationary on a node.
    void Continue(AdapterActions& out)
    {
        if (_state.lastNodeID.empty())
        {
            return; // not known since the connection
        }
        _state.bDriving = !_next.empty() || !_sent.empty();
        _state.bPaused = _drive.IsPaused() && !_state.bDriving;
        _state.bOccupied = _state.bDriving && !_drive.HasDrive(); // it ends an edge from before a restart
        _state.heldNodeIDs.assign(_state.bOccupied ? 1 : 0, _next);
        out.emplace_back(RaiseEvent{_state});
        if (_state.bDriving)
        {
            return;
        }
        _drive.OnStationary(_state.lastNodeID, out);
        if (const auto step = _drive.GetStepOrNull())
        {
            _sent = step->nodeID;
            _lines.push_back("go " + step->driveID + " " + _sent);
        }
    }

    void OnAnswer(const std::string& commandID, const std::string& answer, AdapterActions& out)
    {
        if (answer == "running")
        {
            _job.OnRunning(commandID, out);
        }
        else if (answer == "done")
        {
            _job.OnDone(commandID, out);
        }
        else if (answer == "unknown")
        {
            _job.OnNotExecuted(commandID, "the cart was restarted or has a full disk", out); // it has moved nothing
        }
        else if (answer == "known") // the command has come twice
        {
            AskForJob();
        }
        else
        {
            _job.OnRejected(commandID, "the cart answers " + Core::QuoteForError(answer), out);
        }
    }
};
