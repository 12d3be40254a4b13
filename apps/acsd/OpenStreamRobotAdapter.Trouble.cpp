#include "OpenStreamRobotAdapter.hpp"

#include "ArmAnswers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Planning::AdapterActions;
using Planning::RaiseEvent;
using Planning::RobotError;

constexpr std::chrono::milliseconds MOTOR_PERIOD = 200ms;
/// To ask again for a motor that is off, or for what MONITOR was to show.
constexpr std::chrono::milliseconds RETRY_DELAY = 5s;
constexpr std::chrono::milliseconds GLANCE_INTERVAL = 1s;
/// A glance costs two samples: a MONITOR that is slow is not kept busy by them.
constexpr int GLANCE_PERIODS = 20;

/// Between two of them the counters can follow.
constexpr std::size_t GLANCES_OF_HALT = 2;

constexpr std::string_view MOTOR_STATE_URL = "/project/robot/motor_on_state";
constexpr std::string_view MOTOR_ON_URL = "/project/robot/motor_on";

constexpr std::string_view ERROR_MOTOR = "ARM-motorOff";
constexpr std::string_view ERROR_MONITOR = "ARM-monitorRefused";
constexpr std::string_view ERROR_COUNTERS = "ARM-countersMissing";
constexpr std::string_view ERROR_HALTED = "ARM-programHalted";

RobotError MakeHeavy(std::string_view errorCode, std::string message)
{
    return {std::string(errorCode), Planning::EAlarmLevel::Heavy, std::move(message)};
}

} // namespace

std::string_view OpenStreamRobotAdapter::GetUrl(EGlance glance)
{
    return glance == EGlance::Motor ? MOTOR_STATE_URL : GENERAL_URL;
}

void OpenStreamRobotAdapter::Monitor(std::string_view url, std::chrono::milliseconds period)
{
    OpenStream::MonitorRequest monitor;
    monitor.url = url;
    monitor.period = period;
    _outputs.armRequests.emplace_back(std::move(monitor));
}

void OpenStreamRobotAdapter::WatchMotor(AdapterActions& out)
{
    _motorRefusal.clear();
    SetArmState(EArmState::MotorOff, out);
    Monitor(MOTOR_STATE_URL, MOTOR_PERIOD);
    SendControl(EControl::MotorOn, MOTOR_ON_URL, "{}");
    out.emplace_back(Planning::StartAdapterTimer{RETRY_TIMER, RETRY_DELAY});
}

void OpenStreamRobotAdapter::TakeMotor(bool bOn, AdapterActions& out)
{
    if (!bOn)
    {
        return;
    }
    SetArmState(EArmState::Counting, out);
    WatchCounters();
    out.emplace_back(Planning::StartAdapterTimer{RETRY_TIMER, RETRY_DELAY});
}

/// What should have come is not here yet: it is told, and asked for again.
void OpenStreamRobotAdapter::Retry(AdapterActions& out)
{
    const bool bRefused = std::exchange(_bMonitorRefused, false);
    if (_armState == EArmState::MotorOff)
    {
        if (bRefused)
        {
            Monitor(MOTOR_STATE_URL, MOTOR_PERIOD);
        }
        else
        {
            TellMotorOff(out);
        }
        SendControl(EControl::MotorOn, MOTOR_ON_URL, "{}");
    }
    else if (_armState == EArmState::Counting)
    {
        WatchCounters();
        if (!bRefused)
        {
            SetTrouble(
                MakeHeavy(
                    ERROR_COUNTERS,
                    fmt::format(
                        "MONITOR of {} shows no counters of the arm's programs; look whether the controller has these "
                        "relays, and at arm.monitor_url, arm.monitor_start and arm.counter_… of the configuration.",
                        _options.monitorUrl)),
                out);
        }
    }
    else if (_armState == EArmState::Ready && _program == EProgram::Retrying && _glance == EGlance::None)
    {
        LookAtRefusedProgram(out);
        FollowPause(out);
        return;
    }
    else
    {
        return;
    }
    out.emplace_back(Planning::StartAdapterTimer{RETRY_TIMER, RETRY_DELAY});
}

void OpenStreamRobotAdapter::TellMotorOff(AdapterActions& out)
{
    SetTrouble(
        MakeHeavy(
            ERROR_MOTOR,
            _motorRefusal.empty() ? std::string("The arm's motor is off, and is asked to go on.")
                                  : fmt::format("The arm's motor is off: {}", _motorRefusal)),
        out);
}

/// Its state shows what came of it; why not, only the refusal does.
void OpenStreamRobotAdapter::TakeSettledMotor(const OpenStream::ClientControlSettled& settled, AdapterActions& out)
{
    const bool bRefused = settled.outcome == OpenStream::EControlOutcome::Refused;
    _motorRefusal = bRefused ? DescribeRefusal(settled.status, settled.body, settled.detail) : std::string();
    FollowPause(out);
}

void OpenStreamRobotAdapter::TakeMonitorRefused(const OpenStream::ClientMonitorRefused& refused, AdapterActions& out)
{
    if (_look == ELook::Watched && refused.url == GENERAL_URL)
    {
        _bPlaybackHidden = true;
        LookAtCounters();
        return;
    }
    if (_glance != EGlance::None && refused.url == GetUrl(_glance))
    {
        GiveUpGlance(true, out);
        return;
    }
    const std::string_view wanted = _armState == EArmState::MotorOff ? MOTOR_STATE_URL : _options.monitorUrl;
    if (_armState == EArmState::Lost || refused.url != wanted)
    {
        return; // another one has taken its place
    }
    if (_armState == EArmState::Ready)
    {
        _armState = EArmState::Counting; // told below
    }
    _bMonitorRefused = true;
    SetTrouble(
        MakeHeavy(
            ERROR_MONITOR,
            fmt::format(
                "The arm's controller does not take the MONITOR of {}: {} {}",
                refused.url,
                refused.error.codeText,
                refused.error.message)),
        out);
    out.emplace_back(Planning::StartAdapterTimer{RETRY_TIMER, RETRY_DELAY});
}

/// The robot is in reach with it, but takes no work; without, what the engine hears is that it is not in reach.
void OpenStreamRobotAdapter::SetTrouble(std::optional<RobotError> trouble, AdapterActions& out)
{
    if (_trouble == trouble)
    {
        return;
    }
    _trouble = std::move(trouble);
    const bool bWasOnline = _bOnline;
    TellOnline(out);
    if (bWasOnline && _bOnline && _bBaseStateKnown)
    {
        out.emplace_back(RaiseEvent{MakeState()});
    }
}

/// Nobody is waited for, so the counters will not stand still.
bool OpenStreamRobotAdapter::IsProgramWatched() const
{
    const bool bFree = _controls.empty() && _look == ELook::None && _armState == EArmState::Ready;
    return bFree && _phase == EJobPhase::Running && _bJobStarted && _program == EProgram::Runs;
}

/// MONITOR reads one thing at a time: now and then, between two samples of the counters, it is another one.
void OpenStreamRobotAdapter::LookAround(AdapterActions& out)
{
    StartGlanceTimer(out);
    if (_armState != EArmState::Ready)
    {
        return;
    }
    if (!IsProgramWatched() && !IsGoOnDue())
    {
        ForgetHalt(out);
    }
    if (_glance != EGlance::None)
    {
        GiveUpGlance(_bGlanceStarted, out);
    }
    else if (!_bCountersFresh || _look != ELook::None || !_controls.empty())
    {
        return; // it has enough to show
    }
    else if (_phase == EJobPhase::None && !_bMotorHidden)
    {
        Glance(EGlance::Motor, out);
    }
    else if (IsProgramWatched() && !_bPlaybackHidden)
    {
        Glance(EGlance::Playback, out);
    }
}

void OpenStreamRobotAdapter::StartGlanceTimer(AdapterActions& out) const
{
    const std::chrono::milliseconds delay = std::max(GLANCE_INTERVAL, GLANCE_PERIODS * _options.period);
    out.emplace_back(Planning::StartAdapterTimer{GLANCE_TIMER, delay});
}

/// It has the whole interval to be answered.
void OpenStreamRobotAdapter::Glance(EGlance glance, AdapterActions& out)
{
    StartGlanceTimer(out);
    _glance = glance;
    _bGlanceStarted = false;
    Monitor(GetUrl(glance), _options.period);
}

/// For good: the controller does not show it.
void OpenStreamRobotAdapter::GiveUpGlance(bool bForGood, AdapterActions& out)
{
    const EGlance glance = std::exchange(_glance, EGlance::None);
    _bMotorHidden = _bMotorHidden || (bForGood && glance == EGlance::Motor);
    _bPlaybackHidden = _bPlaybackHidden || (bForGood && glance == EGlance::Playback);
    WatchCounters();
    if (_phase == EJobPhase::Refused)
    {
        FailJob(_refusal, out);
    }
    else if (IsGoOnRefused())
    {
        LookAtRefusedProgram(out);
        FollowPause(out);
    }
}

/// Whether the sample is what is being looked at in place of the counters.
bool OpenStreamRobotAdapter::TryTakeGlance(const Core::JsonText& sample, AdapterActions& out)
{
    if (_look == ELook::Watched)
    {
        return TryTakeEffect(sample, out);
    }
    const std::optional<bool> bMotorOnOrNull =
        _glance == EGlance::Motor ? ReadMotorOnOrNull(sample) : std::optional<bool>();
    const std::optional<GeneralState> stateOrNull =
        _glance == EGlance::Playback ? ReadGeneralStateOrNull(sample) : std::optional<GeneralState>();
    if (bMotorOnOrNull.has_value())
    {
        _glance = EGlance::None;
        TakeMotorGlance(*bMotorOnOrNull, out);
    }
    else if (stateOrNull.has_value())
    {
        WatchCounters();
        TakePlaybackGlance(stateOrNull->bPlaying, out);
    }
    return bMotorOnOrNull.has_value() || stateOrNull.has_value();
}

/// Between jobs, or why one was refused: one that could not begin or go on for a motor that is off does so when it is on.
void OpenStreamRobotAdapter::TakeMotorGlance(bool bOn, AdapterActions& out)
{
    const bool bRefused = _phase == EJobPhase::Refused;
    const bool bGoOnRefused = IsGoOnRefused();
    if (bOn || (!bRefused && !bGoOnRefused && _phase != EJobPhase::None))
    {
        WatchCounters();
        if (bRefused)
        {
            FailJob(_refusal, out);
        }
        else if (bGoOnRefused)
        {
            LookAtRefusedProgram(out);
            FollowPause(out);
        }
        return;
    }
    TellMotorOff(out);
    WatchMotor(out);
    if (bRefused)
    {
        DisownJob(out);
    }
}

void OpenStreamRobotAdapter::TakePlaybackGlance(bool bPlaying, AdapterActions& out)
{
    if (IsGoOnRefused())
    {
        TakeRefusedGoOn(bPlaying, out);
        return;
    }
    if (bPlaying || !IsProgramWatched())
    {
        ForgetHalt(out);
    }
    else
    {
        ++_standingGlances;
    }
}

void OpenStreamRobotAdapter::TakeRefusedGoOn(bool bPlaying, AdapterActions& out)
{
    _bSeenStanding = !bPlaying;
    if (bPlaying)
    {
        _program = EProgram::Runs;
        ForgetHalt(out);
        FollowPause(out);
    }
}

/// Behind the counters, likewise: it has surely not come to its end.
void OpenStreamRobotAdapter::TakeStanding(AdapterActions& out)
{
    if (!std::exchange(_bSeenStanding, false) || !IsGoOnRefused())
    {
        return;
    }
    if (_program == EProgram::Retrying || _bPauseWanted || _bGivenUp)
    {
        _program = EProgram::Stopped;
        FollowPause(out);
        return;
    }
    _program = EProgram::Retrying;
    SetTrouble(
        MakeHeavy(
            ERROR_HALTED,
            fmt::format(
                "The arm's program of job {} was paused and does not go on: {}. It is asked again; or have it go on at "
                "the controller, or give it up there, and the job has failed.",
                _jobID,
                _refusal)),
        out);
    out.emplace_back(Planning::StartAdapterTimer{RETRY_TIMER, RETRY_DELAY});
}

/// Behind the counters: a program that has come to its end stands, too.
void OpenStreamRobotAdapter::CheckHalt(AdapterActions& out)
{
    if (_standingGlances < GLANCES_OF_HALT || !IsProgramWatched())
    {
        return;
    }
    SetTrouble(
        MakeHeavy(
            ERROR_HALTED,
            fmt::format(
                "The arm's program of job {} stands and has not come to its end. Look why; have it go on at the "
                "controller, or give it up there, and the job has failed.",
                _jobID)),
        out);
}

void OpenStreamRobotAdapter::ForgetHalt(AdapterActions& out)
{
    _standingGlances = 0;
    if (_trouble.has_value() && _trouble->errorCode == ERROR_HALTED)
    {
        SetTrouble(std::nullopt, out);
    }
}

} // namespace ACS::Acsd
