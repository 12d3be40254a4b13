#include "StateChecker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace ACS::AdapterTest
{

StateChecker::StateChecker(FindingSink sink)
    : _sink(std::move(sink))
{
}

void StateChecker::OnCommand(const Planning::RobotCommand& command)
{
    if (const auto* const driveOrNull = std::get_if<Planning::Drive>(&command))
    {
        _lastSentID = driveOrNull->driveID;
        _sentIDs.insert(_lastSentID);
    }
    else if (const auto* const jobOrNull = std::get_if<Planning::StartJob>(&command))
    {
        _lastSentID = jobOrNull->commandID;
        _sentIDs.insert(_lastSentID);
    }
    _bFaultAllowed = _bFaultAllowed || std::holds_alternative<Planning::CancelJob>(command);
    _bPauseAsked = std::holds_alternative<Planning::Pause>(command)
        || (_bPauseAsked && !std::holds_alternative<Planning::Resume>(command));
}

void StateChecker::OnLink(const Planning::LinkChanged& event)
{
    if (_bOnline != event.bOnline)
    {
        _bOnline = event.bOnline;
        _state.reset();
    }
}

void StateChecker::OnState(const Planning::StateChanged& event, const RobotTruth& truth)
{
    if (!_bOnline)
    {
        return; // ignored, as by the engine
    }
    _state = event;
    const std::string shownID = event.restartEvidence.commandID.value_or(std::string());
    if (!shownID.empty() && !_sentIDs.contains(shownID))
    {
        _sink(ERule::RestartEvidenceTrue, fmt::format("the state shows '{}', which was never commanded.", shownID));
    }
    if (event.bPaused && _bPauseAsked && (truth.bDriving || truth.bWorking))
    {
        _sink(ERule::PauseObeyed, "bPaused is reported while the robot drives or works.");
    }
    if (event.bPoseKnown && !(std::isfinite(event.x) && std::isfinite(event.y) && std::isfinite(event.theta)))
    {
        _sink(ERule::StateTrue, fmt::format("the pose {} {} {} is reported.", event.x, event.y, event.theta));
    }
    if (!(event.batteryPercent >= 0 && event.batteryPercent <= 100)) // Also not a number.
    {
        _sink(ERule::StateTrue, fmt::format("the battery is reported at {} %.", event.batteryPercent));
    }
}

void StateChecker::OnCompatibility(const Planning::CompatibilityChanged& event)
{
    _incompatibility = event.incompatibility;
}

void StateChecker::OnJobFinished(const RobotTruth& truth)
{
    VerifyLoads(truth, "when JobFinished is raised");
}

void StateChecker::OnConduct(EConduct conduct)
{
    _bFaultAllowed = _bFaultAllowed || conduct == EConduct::Fails || conduct == EConduct::Refuses;
}

void StateChecker::OnRestart()
{
    _bOnline = false;
    _state.reset();
    _incompatibility.clear();
}

void StateChecker::VerifyAtRest(const RobotTruth& truth)
{
    if (!_bOnline)
    {
        _sink(ERule::LinkReported, "the link works, and the robot is reported as disconnected.");
        return;
    }
    if (!_state.has_value())
    {
        _sink(ERule::StateAfterConnection, "no state was raised since the connection.");
        return;
    }
    if (!_state->lastNodeID.empty() && _state->lastNodeID != truth.nodeID)
    {
        _sink(
            ERule::StateTrue,
            fmt::format("the robot is on node '{}', and '{}' is reported.", truth.nodeID, _state->lastNodeID));
    }
    if (_state->bDriving && !truth.bDriving)
    {
        _sink(ERule::StateTrue, "bDriving is reported, and the robot is stopped.");
    }
    if (_state->bPaused && !_bPauseAsked)
    {
        _sink(ERule::StateTrue, "bPaused is reported, and the robot was not commanded to pause.");
    }
    if (!_bFaultAllowed)
    {
        VerifyUsable();
    }
    VerifyLoads(truth, "at rest");
}

void StateChecker::VerifyUsable()
{
    if (!_state->bAutomatic)
    {
        _sink(ERule::Usable, "bAutomatic is false.");
    }
    if (_state->bOccupied)
    {
        _sink(ERule::Usable, "bOccupied is reported.");
    }
    if (!_incompatibility.empty())
    {
        _sink(ERule::Usable, fmt::format("it is reported as incompatible: '{}'.", _incompatibility));
    }
    const auto heavy = std::ranges::find(_state->errors, Planning::EAlarmLevel::Heavy, &Planning::RobotError::level);
    if (heavy != _state->errors.end())
    {
        _sink(ERule::Usable, fmt::format("the heavy error '{}' is reported.", heavy->errorCode));
    }
}

void StateChecker::VerifyLoads(const RobotTruth& truth, std::string_view when)
{
    if (!truth.loads.has_value() || !_state.has_value() || !_state->loads.has_value())
    {
        return;
    }
    for (const Planning::PortLoad& load : *_state->loads)
    {
        const auto real = std::ranges::find(*truth.loads, load.port, &Planning::PortLoad::port);
        if (real == truth.loads->end())
        {
            _sink(
                ERule::LoadsTrue,
                fmt::format("the port '{}' is reported, which the robot does not have.", load.port));
        }
        else if (real->bLoaded != load.bLoaded)
        {
            _sink(
                ERule::LoadsTrue,
                fmt::format("'{}' is reported as {} {}.", load.port, load.bLoaded ? "loaded" : "empty", when));
        }
    }
    for (const Planning::PortLoad& real : *truth.loads)
    {
        if (std::ranges::count(*_state->loads, real.port, &Planning::PortLoad::port) != 1)
        {
            _sink(ERule::LoadsTrue, fmt::format("the port '{}' is not reported once.", real.port));
        }
    }
}

void StateChecker::VerifyEvidence()
{
    if (!_state.has_value() || !_state->restartEvidence.commandID.has_value()
        || !_state->restartEvidence.progressToken.empty())
    {
        return;
    }
    if (*_state->restartEvidence.commandID != _lastSentID)
    {
        _sink(
            ERule::RestartEvidenceTrue,
            fmt::format(
                "the robot has executed '{}', and the state shows '{}'.",
                _lastSentID,
                *_state->restartEvidence.commandID));
    }
}

bool StateChecker::IsOnline() const noexcept
{
    return _bOnline;
}

const Planning::StateChanged* StateChecker::GetStateOrNull() const noexcept
{
    return _state.has_value() ? &*_state : nullptr;
}

} // namespace ACS::AdapterTest
