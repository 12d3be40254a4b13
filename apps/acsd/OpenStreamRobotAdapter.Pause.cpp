#include "OpenStreamRobotAdapter.hpp"

#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

constexpr std::string_view START_URL = "/project/robot/start";
constexpr std::string_view STOP_URL = "/project/robot/stop";
constexpr std::string_view RESET_URL = "/project/context/tasks[0]/reset";

} // namespace

/// A program holds material: one that runs is never broken off, its end is told as ever. One that was stopped for a pause
/// is given up where it is.
void OpenStreamRobotAdapter::CancelJob(const std::string& jobID, AdapterActions& out)
{
    if (jobID != _jobID || _phase == EJobPhase::None)
    {
        return;
    }
    if (_phase == EJobPhase::Selected)
    {
        FailJob("given up before it was begun", out);
    }
    else if (_bStopped && _controls.empty())
    {
        SendControl(EControl::ResetProgram, RESET_URL, "{}");
    }
}

/// The next step towards what is wanted, once the arm has answered the one before.
void OpenStreamRobotAdapter::FollowPause(AdapterActions& out)
{
    if (_controls.empty() && _armState == EArmState::Ready)
    {
        if (_bPauseWanted && _phase == EJobPhase::Running && !_bStopped)
        {
            SendControl(EControl::StopProgram, STOP_URL, "{}");
        }
        else if (!_bPauseWanted && _phase == EJobPhase::Running && _bStopped)
        {
            SendControl(EControl::GoOn, START_URL, "{}");
        }
        else if (!_bPauseWanted && _phase == EJobPhase::Selected)
        {
            _phase = EJobPhase::Starting;
            SendControl(EControl::StartProgram, START_URL, "{}");
        }
    }
    TellPaused(out);
}

void OpenStreamRobotAdapter::TakeSettledPause(EControl kind, OpenStream::EControlOutcome outcome, AdapterActions& out)
{
    const bool bAccepted = outcome == OpenStream::EControlOutcome::Accepted;
    const bool bRefused = outcome == OpenStream::EControlOutcome::Refused;
    if (_phase != EJobPhase::Running)
    {
        return; // it has ended meanwhile
    }
    if (kind == EControl::StopProgram)
    {
        _bStopped = bAccepted;
    }
    else if (kind == EControl::ResetProgram && bAccepted)
    {
        FailJob("given up while it was paused", out);
    }
    else if (kind == EControl::GoOn && (bAccepted || (bRefused && _bGoOnDoubtful)))
    {
        _bStopped = false;
        _bGoOnDoubtful = false;
    }
    else if (kind == EControl::GoOn && bRefused)
    {
        FailJob("the arm's controller refuses to go on with the program that was paused", out);
    }
    else if (kind == EControl::GoOn)
    {
        _bGoOnDoubtful = true; // sent again after the reconnect; a program that runs is not started twice
    }
    if (!bRefused)
    {
        FollowPause(out);
    }
    TellPaused(out);
}

bool OpenStreamRobotAdapter::IsArmStanding() const
{
    return _phase == EJobPhase::None || _phase == EJobPhase::Selected || (_phase == EJobPhase::Running && _bStopped);
}

/// When base and arm stand; no longer when both go on.
bool OpenStreamRobotAdapter::IsPaused() const
{
    const bool bStillStopped = _bStopped && !_bPauseWanted;
    return (_baseState.bPaused && IsArmStanding()) || bStillStopped;
}

void OpenStreamRobotAdapter::TellPaused(AdapterActions& out)
{
    if (_bBaseStateKnown && std::exchange(_bPaused, IsPaused()) != IsPaused())
    {
        out.emplace_back(RaiseEvent{MakeState()});
    }
}

} // namespace ACS::Acsd
