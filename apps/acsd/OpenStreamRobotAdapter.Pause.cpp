#include "OpenStreamRobotAdapter.hpp"

#include <fmt/format.h>

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
    if (IsJobBefore())
    {
        FailJob("given up before it was begun", out);
        return;
    }
    _bGivenUp = _bPauseWanted || _program != EProgram::Runs;
    FollowPause(out);
}

/// The next step towards what is wanted, once it is known what came of the one before.
void OpenStreamRobotAdapter::FollowPause(AdapterActions& out)
{
    const bool bFree = _controls.empty() && _look == ELook::None && _armState == EArmState::Ready;
    const bool bToLook = _program == EProgram::Retrying && (_bPauseWanted || _bGivenUp) && _glance == EGlance::None;
    if (bFree && bToLook && IsGoOnRefused())
    {
        LookAtRefusedProgram(out);
    }
    if (bFree && _phase == EJobPhase::Selected && !_bPauseWanted)
    {
        _phase = EJobPhase::Starting;
        SendControl(EControl::StartProgram, START_URL, "{}");
    }
    else if (bFree && _phase == EJobPhase::Running && _bJobStarted)
    {
        const bool bToStop = _program == EProgram::Runs && _bPauseWanted && !_bStopRefused;
        if (bToStop || _program == EProgram::Doubtful)
        {
            // Starting it on suspicion could run it a second time, had it come to its end.
            _program = EProgram::Stopping;
            SendControl(EControl::StopProgram, STOP_URL, "{}");
        }
        else if (_program == EProgram::Stopped && _bGivenUp)
        {
            SendControl(EControl::ResetProgram, RESET_URL, "{}");
        }
        else if (_program == EProgram::Stopped && !_bPauseWanted)
        {
            _program = EProgram::GoingOn;
            SendControl(EControl::GoOn, START_URL, "{}");
        }
    }
    TellPaused(out);
}

void OpenStreamRobotAdapter::TakeSettledPause(
    EControl kind,
    OpenStream::EControlOutcome outcome,
    const std::string& refusal,
    AdapterActions& out)
{
    const bool bAccepted = outcome == OpenStream::EControlOutcome::Accepted;
    const bool bRefused = outcome == OpenStream::EControlOutcome::Refused;
    if (_phase != EJobPhase::Running)
    {
        return; // it has ended meanwhile
    }
    if (kind == EControl::ResetProgram && bAccepted)
    {
        FailJob("given up while it was paused", out);
        return;
    }
    if (kind == EControl::ResetProgram)
    {
        _bGivenUp = !bRefused;
    }
    else if (bAccepted)
    {
        LookAgain(out);
    }
    else if (kind == EControl::GoOn && bRefused)
    {
        RefuseGoOn(refusal, out);
    }
    else if (kind == EControl::StopProgram && bRefused)
    {
        _program = EProgram::Runs;
        _bStopRefused = true;
    }
    else
    {
        _bGoOnRepeated = _bGoOnRepeated || kind == EControl::GoOn;
        _program = EProgram::Doubtful;
    }
    if (outcome == OpenStream::EControlOutcome::Unknown)
    {
        TellPaused(out); // the connection is gone: it is followed when the counters are back
    }
    else
    {
        FollowPause(out);
    }
}

/// Where pauses were about, a program that was found after a restart may stand: only by being stopped and started again it
/// surely goes on.
void OpenStreamRobotAdapter::DoubtFound()
{
    if (_bFound && _bPauseTold && _program == EProgram::Runs)
    {
        _bFound = false;
        _program = EProgram::Doubtful;
        _bGoOnRepeated = true;
    }
}

/// What for, is looked at: a motor that is off, or a program that goes on already, is no fault of the job's.
void OpenStreamRobotAdapter::RefuseGoOn(const std::string& refusal, AdapterActions& out)
{
    _program = EProgram::Refused;
    _bSeenStanding = false;
    _refusal = refusal;
    _look = ELook::None;
    if (_bMotorHidden)
    {
        LookAtRefusedProgram(out);
        return;
    }
    Glance(EGlance::Motor, out);
}

/// Somebody may have had it go on, and it may have come to its end by now: only one that is seen to stand, with its counters
/// as they were, is started or given up. FollowPause comes behind it.
void OpenStreamRobotAdapter::LookAtRefusedProgram(AdapterActions& out)
{
    _bSeenStanding = false;
    if (!_bPlaybackHidden)
    {
        Glance(EGlance::Playback, out);
    }
    else if (_bGoOnRepeated)
    {
        _program = EProgram::Runs;
    }
    else
    {
        FailJob(fmt::format("it was paused and does not go on: {}", _refusal), out);
    }
}

bool OpenStreamRobotAdapter::IsGoOnRefused() const
{
    return _phase == EJobPhase::Running && (_program == EProgram::Refused || _program == EProgram::Retrying);
}

/// It is to go on, and is not known to.
bool OpenStreamRobotAdapter::IsGoOnDue() const
{
    const bool bStands = _program == EProgram::Stopped || _program == EProgram::GoingOn;
    return (bStands || IsGoOnRefused()) && !_bPauseWanted;
}

/// Its program was surely not started.
bool OpenStreamRobotAdapter::IsJobBefore() const
{
    return _phase == EJobPhase::Looking || _phase == EJobPhase::Selected || _phase == EJobPhase::Refused;
}

bool OpenStreamRobotAdapter::IsArmStanding() const
{
    switch (_phase)
    {
        case EJobPhase::None:
        case EJobPhase::Looking:
        case EJobPhase::Selected:
        case EJobPhase::Refused:
            return true;
        case EJobPhase::Running:
            return _program == EProgram::Stopped;
        case EJobPhase::Selecting:
        case EJobPhase::Starting:
        default:
            return false;
    }
}

/// When base and arm stand; no longer when both go on.
bool OpenStreamRobotAdapter::IsPaused() const
{
    return (_baseState.bPaused && IsArmStanding()) || IsGoOnDue();
}

void OpenStreamRobotAdapter::TellPaused(AdapterActions& out)
{
    if (_bBaseStateKnown && std::exchange(_bPaused, IsPaused()) != IsPaused())
    {
        out.emplace_back(RaiseEvent{MakeState()});
    }
}

} // namespace ACS::Acsd
