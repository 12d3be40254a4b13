#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"
#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

#include <string_view>

// The outcomes of the CONTROLs, and the probes after a refusal.

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;

/// Maximum time for a program to begin after a refusal that arrived late.
constexpr std::chrono::milliseconds REFUSED_START_LIMIT{2'000};
/// Number of probes in a row that must find the program stopped: between two of them its last counters arrive.
constexpr std::size_t PROBES_OF_HALT = 2;

constexpr std::string_view ERROR_HALTED = "ARM-programHalted";

} // namespace

void ArmProgram::OnSettled(const ArmSettlement& settlement, AdapterActions& out)
{
    if (!ArmStates::IsAwaiting(_state, settlement.kind))
    {
        return; // of a job that has ended meanwhile
    }
    _controls.OnSettled(settlement.kind, settlement.outcome);
    switch (settlement.outcome)
    {
        case OpenStream::EControlOutcome::Accepted:
            OnAccepted(settlement.kind, out);
            break;
        case OpenStream::EControlOutcome::Refused:
            OnControlRefused(settlement.kind, settlement.refusal, out);
            break;
        case OpenStream::EControlOutcome::NotSent:
        case OpenStream::EControlOutcome::Unconfirmed: // not asked for
        case OpenStream::EControlOutcome::Unknown:
        default:
            OnUnanswered(settlement.kind, settlement.outcome, out);
            break;
    }
}

void ArmProgram::OnAccepted(EArmControl kind, AdapterActions& out)
{
    switch (kind)
    {
        case EArmControl::SelectProgram:
            if (_work.bCancelled)
            {
                Fail("cancelled before it was started", out);
                return;
            }
            _state = VerifyingSelection{};
            _requests.push_back(EArmRequest::VerifyEffect);
            break;
        case EArmControl::RewindProgram:
            Select(out);
            break;
        case EArmControl::WriteInput:
            if (_work.inputs.TryNext())
            {
                WriteInput();
                break;
            }
            ReadInputs(out);
            break;
        case EArmControl::StartProgram:
            LeaveStarting();
            _requests.push_back(EArmRequest::VerifyCounters);
            break;
        case EArmControl::ResetProgram:
            _state = Resetting{true};
            _requests.push_back(EArmRequest::VerifyEffect);
            break;
        case EArmControl::StopProgram:
        case EArmControl::ResumeProgram:
        case EArmControl::SwitchMotorOn:
        default:
            _requests.push_back(EArmRequest::VerifyEffect);
            break;
    }
}

/// The program was started, or may have been.
void ArmProgram::LeaveStarting()
{
    if (std::get<Starting>(_state).bBegun)
    {
        _state = Running{};
    }
    else
    {
        _state = Awaited{};
    }
}

/// The connection is lost, or the CONTROL was not sent.
void ArmProgram::OnUnanswered(EArmControl kind, OpenStream::EControlOutcome outcome, AdapterActions& out)
{
    switch (kind)
    {
        case EArmControl::StartProgram:
            if (outcome == OpenStream::EControlOutcome::NotSent)
            {
                ReportNotStarted(out);
                return;
            }
            // The counters show after the reconnect whether it was started. It is never started a second time.
            LeaveStarting();
            break;
        case EArmControl::StopProgram:
        case EArmControl::ResumeProgram:
            _work.bResumeRepeated = _work.bResumeRepeated || kind == EArmControl::ResumeProgram;
            _state = Unverified{};
            break;
        case EArmControl::ResetProgram:
            _state = Stopped{};
            break;
        case EArmControl::SelectProgram:
        case EArmControl::RewindProgram:
        case EArmControl::WriteInput:
        case EArmControl::SwitchMotorOn:
        default:
            ReportNotStarted(out); // it may be selected, but it was not started
            break;
    }
}

void ArmProgram::OnControlRefused(EArmControl kind, const ArmRefusal& refusal, AdapterActions& out)
{
    const bool bBeforeStart = kind == EArmControl::SelectProgram || kind == EArmControl::WriteInput;
    if (bBeforeStart && TryRewind(refusal))
    {
        return; // a late refusal of the selection
    }
    switch (kind)
    {
        case EArmControl::SelectProgram:
            Refuse(refusal.reason);
            break;
        case EArmControl::RewindProgram:
            Select(out); // a controller may not know the rewind; the selection shows whether it is needed
            break;
        case EArmControl::WriteInput:
            Refuse(fmt::format(
                "relay {} of the arm was not written: {}",
                _work.inputs.GetCurrent().relay.name,
                refusal.reason));
            break;
        case EArmControl::StopProgram:
            _state = Running{EArmStart::Sent, true};
            break;
        case EArmControl::ResumeProgram:
            // The job does not fail when the motor is off or the program runs already.
            _state = ResumeRefused{refusal.reason, false, false};
            _requests.push_back(EArmRequest::ProbeMotor);
            break;
        case EArmControl::ResetProgram:
            _state = Resetting{};
            if (!_controls.TryOtherReset())
            {
                _work.bCancelled = false;
                _state = Stopped{};
            }
            break;
        case EArmControl::StartProgram:
            OnStartRefused(refusal, out);
            break;
        case EArmControl::SwitchMotorOn:
        default:
            break;
    }
}

/// A late refusal of the selection does not refuse the start: the counters show whether the program begins. A program that has
/// begun was not refused.
void ArmProgram::OnStartRefused(const ArmRefusal& refusal, AdapterActions& out)
{
    if (!ArmProgramControls::IsRewindWanted(refusal) && !std::get<Starting>(_state).bBegun)
    {
        Refuse(refusal.reason);
        return;
    }
    LeaveStarting();
    if (Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state))
    {
        awaitedOrNull->refusal = refusal.reason;
        out.emplace_back(
            Planning::StartAdapterTimer{ArmTimers::START, ArmTimers::AddPeriods(REFUSED_START_LIMIT, _options.period)});
    }
    _requests.push_back(EArmRequest::VerifyCounters);
}

/// The program was certainly not started. The motor is probed first: the job does not fail when it is off.
void ArmProgram::Refuse(std::string reason)
{
    _state = Refused{std::move(reason)};
    _requests.push_back(EArmRequest::ProbeMotor);
}

void ArmProgram::OnFault(const ArmRefusal& refusal, AdapterActions& out)
{
    Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state);
    if (Is<VerifyingSelection>(_state) || IsPreparing())
    {
        if (!TryRewind(refusal))
        {
            Fail(refusal.reason, out);
        }
    }
    else if (awaitedOrNull != nullptr && awaitedOrNull->start != EArmStart::Unknown)
    {
        // It may be a late refusal of the selection: the program may still begin.
        awaitedOrNull->refusal = refusal.reason;
        out.emplace_back(
            Planning::StartAdapterTimer{ArmTimers::START, ArmTimers::AddPeriods(REFUSED_START_LIMIT, _options.period)});
    }
    else if (Is<Stopping>(_state))
    {
        OnControlRefused(EArmControl::StopProgram, refusal, out);
    }
    else if (Is<Resuming>(_state))
    {
        OnControlRefused(EArmControl::ResumeProgram, refusal, out);
    }
    else if (Is<Resetting>(_state))
    {
        OnControlRefused(EArmControl::ResetProgram, refusal, out);
    }
}

void ArmProgram::OnMotorProbed(AdapterActions& out)
{
    if (const Refused* const refusedOrNull = std::get_if<Refused>(&_state))
    {
        Fail(std::string(refusedOrNull->reason), out);
    }
    else if (Is<ResumeRefused>(_state))
    {
        ProbeRefusedProgram();
    }
}

/// A job whose program could not be started is commanded again when the motor is on.
void ArmProgram::OnMotorOff(AdapterActions& out)
{
    if (Is<Refused>(_state))
    {
        ReportNotStarted(out);
    }
}

/// The program may have been resumed at the controller, and may have ended by now. Only a program that is found stopped,
/// with unchanged counters, is resumed or reset.
void ArmProgram::ProbeRefusedProgram()
{
    std::get<ResumeRefused>(_state).bSeenStopped = false;
    _requests.push_back(EArmRequest::ProbePlayback);
}

void ArmProgram::OnPlaybackHidden(AdapterActions& out)
{
    if (Stopped* const stoppedOrNull = std::get_if<Stopped>(&_state))
    {
        stoppedOrNull->halt = EArmHalt::Verified; // by the counters alone
        return;
    }
    const ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state);
    if (refusedOrNull == nullptr)
    {
        return;
    }
    if (_work.bResumeRepeated)
    {
        _state = Running{};
        return;
    }
    Fail(fmt::format("it was paused and cannot be resumed: {}", refusedOrNull->refusal), out);
}

void ArmProgram::OnPlaybackProbed(const ArmProbed& probed, bool bWatched)
{
    const std::optional<bool> bPlayingOrNull = probed.bOnOrNull;
    _work.probedProgramOrNull = probed.programOrNull;
    if (ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state))
    {
        if (!bPlayingOrNull.has_value())
        {
            ProbeRefusedProgram();
        }
        else if (*bPlayingOrNull)
        {
            _state = Running{};
            ForgetHalt();
        }
        else
        {
            refusedOrNull->bSeenStopped = true;
        }
        return;
    }
    if (!bPlayingOrNull.has_value())
    {
        return;
    }
    if (Stopped* const stoppedOrNull = std::get_if<Stopped>(&_state))
    {
        if (*bPlayingOrNull)
        {
            _state = Running{};
        }
        else
        {
            stoppedOrNull->halt = EArmHalt::Shown;
        }
        return;
    }
    if (*bPlayingOrNull || !bWatched || !IsStarted())
    {
        ForgetHalt();
    }
    else
    {
        ++_work.stoppedProbes;
    }
}

/// A program that has ended is stopped, too. Only counters that are newer than the probe show that it has not ended.
void ArmProgram::OnCounted(bool bWatched, AdapterActions& out)
{
    if (bWatched && _work.stoppedProbes >= PROBES_OF_HALT)
    {
        RaiseHalt(fmt::format(
            "The arm's program of job {} {}. Find the cause at the controller. {} the program there, or abandon it there: the "
            "job then fails.",
            _work.jobID,
            Is<Awaited>(_state) ? "was started, and does not run" : "is stopped before its end",
            Is<Awaited>(_state) ? "Start" : "Resume"));
    }
    if (Stopped* const stoppedOrNull = std::get_if<Stopped>(&_state);
        stoppedOrNull != nullptr && stoppedOrNull->halt == EArmHalt::Shown)
    {
        stoppedOrNull->halt = EArmHalt::Verified;
        return;
    }
    ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state);
    if (refusedOrNull == nullptr || !std::exchange(refusedOrNull->bSeenStopped, false))
    {
        return;
    }
    if (refusedOrNull->bRetries || IsPauseWanted() || _work.bCancelled)
    {
        _state = Stopped{EArmHalt::Verified};
        return;
    }
    refusedOrNull->bRetries = true;
    RaiseHalt(fmt::format(
        "The arm's program of job {} was paused and cannot be resumed: {}. Retrying in 5 s. Resume it at the controller, or "
        "abandon it there: the job then fails.",
        _work.jobID,
        refusedOrNull->refusal));
    out.emplace_back(Planning::StartAdapterTimer{ArmTimers::RETRY, ArmTimers::RETRY_DELAY});
}

void ArmProgram::Retry()
{
    if (Stopped* const stoppedOrNull = std::get_if<Stopped>(&_state);
        stoppedOrNull != nullptr && stoppedOrNull->halt == EArmHalt::Replaced)
    {
        stoppedOrNull->halt = EArmHalt::Unchecked;
    }
    if (const ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state);
        refusedOrNull != nullptr && refusedOrNull->bRetries)
    {
        ProbeRefusedProgram();
    }
}

void ArmProgram::RaiseHalt(std::string message)
{
    _trouble = {std::string(ERROR_HALTED), Planning::EAlarmLevel::Heavy, std::move(message)};
}

void ArmProgram::ForgetHalt()
{
    _work.stoppedProbes = 0;
    _trouble.reset();
}

} // namespace ACS::Acsd
