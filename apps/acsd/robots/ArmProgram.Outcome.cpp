#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"
#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

#include <string_view>

// What became of the CONTROLs, and what the probes after a refusal show.

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;

/// After a refusal that came late, for a start to be seen.
constexpr std::chrono::milliseconds REFUSED_START_LIMIT{2'000};
/// Between two of them the counters can follow.
constexpr std::size_t PROBES_OF_HALT = 2;

constexpr std::string_view ERROR_HALTED = "ARM-programHalted";

} // namespace

void ArmProgram::OnSettled(const ArmSettlement& settlement, AdapterActions& out)
{
    if (!IsExpected(settlement.kind))
    {
        return; // of a job that has ended meanwhile
    }
    const bool bMoves = settlement.kind == EArmControl::StartProgram || settlement.kind == EArmControl::StopProgram
        || settlement.kind == EArmControl::ResumeProgram;
    _bRewindDue = _bRewindDue || (bMoves && settlement.outcome != OpenStream::EControlOutcome::NotSent);
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

bool ArmProgram::IsExpected(EArmControl kind) const
{
    switch (kind)
    {
        case EArmControl::SelectProgram:
            return Is<Selecting>();
        case EArmControl::RewindProgram:
            return Is<Rewinding>();
        case EArmControl::WriteInput:
            return Is<WritingInputs>();
        case EArmControl::StartProgram:
            return Is<Starting>();
        case EArmControl::StopProgram:
            return Is<Stopping>();
        case EArmControl::ResumeProgram:
            return Is<Resuming>();
        case EArmControl::ResetProgram:
            return Is<Resetting>();
        case EArmControl::SwitchMotorOn:
        default:
            return false;
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
            _bRewindDue = false;
            SelectUnlessCancelled(out);
            break;
        case EArmControl::WriteInput:
            OnInputWritten(out);
            break;
        case EArmControl::StartProgram:
            LeaveStarting();
            _requests.push_back(EArmRequest::VerifyCounters);
            break;
        case EArmControl::ResetProgram:
            _resetPath = std::get<Resetting>(_state).bRCode ? EResetPath::RCode : EResetPath::TaskReset;
            Fail("cancelled while it was paused", out);
            break;
        case EArmControl::StopProgram:
        case EArmControl::ResumeProgram:
        case EArmControl::SwitchMotorOn:
        default:
            _requests.push_back(EArmRequest::VerifyEffect);
            break;
    }
}

void ArmProgram::SelectUnlessCancelled(AdapterActions& out)
{
    if (_work.bCancelled)
    {
        Fail("cancelled before it was started", out);
    }
    else
    {
        Select();
    }
}

/// It was started, or may have been.
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

/// The connection is gone, or the CONTROL never left.
void ArmProgram::OnUnanswered(EArmControl kind, OpenStream::EControlOutcome outcome, AdapterActions& out)
{
    switch (kind)
    {
        case EArmControl::StartProgram:
            if (outcome == OpenStream::EControlOutcome::NotSent)
            {
                Disown(out);
                return;
            }
            // Started or not: the counters show it after the reconnect. It is never started a second time.
            LeaveStarting();
            break;
        case EArmControl::StopProgram:
        case EArmControl::ResumeProgram:
            _work.bResumeRepeated = _work.bResumeRepeated || kind == EArmControl::ResumeProgram;
            _state = Doubtful{};
            break;
        case EArmControl::ResetProgram:
            _state = Stopped{};
            break;
        case EArmControl::SelectProgram:
        case EArmControl::RewindProgram:
        case EArmControl::WriteInput:
        case EArmControl::SwitchMotorOn:
        default:
            Disown(out); // selected perhaps, but not started
            break;
    }
}

void ArmProgram::OnControlRefused(EArmControl kind, const ArmRefusal& refusal, AdapterActions& out)
{
    const bool bBeforeStart = kind == EArmControl::SelectProgram || kind == EArmControl::WriteInput;
    if (bBeforeStart && TryRewind(refusal))
    {
        return; // of the selection, however late
    }
    switch (kind)
    {
        case EArmControl::SelectProgram:
            Refuse(refusal.reason);
            break;
        case EArmControl::RewindProgram:
            SelectUnlessCancelled(out); // a controller may not know it, and the selection shows whether it is needed
            break;
        case EArmControl::WriteInput:
            Refuse(fmt::format(
                "relay {} of the arm was not written: {}",
                _work.job.inputs[std::get<WritingInputs>(_state).next].relay.name,
                refusal.reason));
            break;
        case EArmControl::StopProgram:
            _state = Running{EArmStart::Sent, true, 0};
            break;
        case EArmControl::ResumeProgram:
            // A motor that is off, or a program that runs already, is no fault of the job's.
            _state = ResumeRefused{refusal.reason, false, false};
            _requests.push_back(EArmRequest::ProbeMotor);
            break;
        case EArmControl::ResetProgram:
            OnResetRefused();
            break;
        case EArmControl::StartProgram:
            OnStartRefused(refusal, out);
            break;
        case EArmControl::SwitchMotorOn:
        default:
            break;
    }
}

/// One of the selection, that came late, says nothing of the start: whether the program begins shows it.
void ArmProgram::OnStartRefused(const ArmRefusal& refusal, AdapterActions& out)
{
    if (!IsOfSelection(refusal))
    {
        Refuse(refusal.reason);
        return;
    }
    LeaveStarting();
    if (Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state))
    {
        awaitedOrNull->refusal = refusal.reason;
        out.emplace_back(Planning::StartAdapterTimer{ArmTimers::START, REFUSED_START_LIMIT});
    }
    _requests.push_back(EArmRequest::VerifyCounters);
}

/// The program was surely not started. The motor is probed before the job fails: one that is off is no fault of the job's.
void ArmProgram::Refuse(std::string reason)
{
    _state = Refused{std::move(reason)};
    _requests.push_back(EArmRequest::ProbeMotor);
}

/// Versions before 60.30 do not know r_code, later ones refuse the reset of a task.
void ArmProgram::OnResetRefused()
{
    if (_resetPath == EResetPath::Unknown && std::get<Resetting>(_state).bRCode)
    {
        ResetProgram(EResetPath::TaskReset);
        return;
    }
    _work.bCancelled = false;
    _state = Stopped{};
}

void ArmProgram::OnFault(const ArmRefusal& refusal, AdapterActions& out)
{
    Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state);
    if (Is<VerifyingSelection>() || IsPreparing())
    {
        if (!TryRewind(refusal))
        {
            Fail(refusal.reason, out);
        }
    }
    else if (awaitedOrNull != nullptr && awaitedOrNull->start != EArmStart::Unknown)
    {
        // Where the controller was slow it may be of the selection, and the program begins yet.
        awaitedOrNull->refusal = refusal.reason;
        out.emplace_back(Planning::StartAdapterTimer{ArmTimers::START, REFUSED_START_LIMIT});
    }
    else if (Is<Stopping>())
    {
        OnControlRefused(EArmControl::StopProgram, refusal, out);
    }
    else if (Is<Resuming>())
    {
        OnControlRefused(EArmControl::ResumeProgram, refusal, out);
    }
}

void ArmProgram::OnMotorProbed(AdapterActions& out)
{
    if (const Refused* const refusedOrNull = std::get_if<Refused>(&_state))
    {
        Fail(std::string(refusedOrNull->reason), out);
    }
    else if (Is<ResumeRefused>())
    {
        ProbeRefusedProgram();
    }
}

/// A program that could not be started comes again when the motor is on; one that could not be resumed is probed then.
void ArmProgram::OnMotorOff(AdapterActions& out)
{
    if (Is<Refused>())
    {
        Disown(out);
    }
}

/// It may have been resumed at the controller, and may have come to its end by now: only one that is seen stopped, with its
/// counters as they were, is started or reset.
void ArmProgram::ProbeRefusedProgram()
{
    std::get<ResumeRefused>(_state).bSeenStopped = false;
    _requests.push_back(EArmRequest::ProbePlayback);
}

void ArmProgram::OnPlaybackHidden(AdapterActions& out)
{
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
    Fail(fmt::format("it was paused and does not resume: {}", refusedOrNull->refusal), out);
}

void ArmProgram::OnPlaybackProbed(std::optional<bool> bPlayingOrNull, bool bWatched)
{
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
    Running* const runningOrNull = std::get_if<Running>(&_state);
    if (!bPlayingOrNull.has_value())
    {
        return;
    }
    if (*bPlayingOrNull || !bWatched || runningOrNull == nullptr)
    {
        ForgetHalt();
    }
    else
    {
        ++runningOrNull->standingProbes;
    }
}

/// A program that has come to its end is stopped, too: that it has not shows only by counters of after the probe.
void ArmProgram::OnCounted(bool bWatched, AdapterActions& out)
{
    const Running* const runningOrNull = std::get_if<Running>(&_state);
    if (runningOrNull != nullptr && bWatched && runningOrNull->standingProbes >= PROBES_OF_HALT)
    {
        Halt(fmt::format(
            "The arm's program of job {} is stopped before its end. Find out why at the controller. Resume it there, or "
            "abandon it there: the job then fails.",
            _work.job.jobID));
    }
    ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state);
    if (refusedOrNull == nullptr || !std::exchange(refusedOrNull->bSeenStopped, false))
    {
        return;
    }
    if (refusedOrNull->bRetries || _bPauseWanted || _work.bCancelled)
    {
        _state = Stopped{};
        return;
    }
    refusedOrNull->bRetries = true;
    Halt(fmt::format(
        "The arm's program of job {} was paused and does not resume: {}. Retrying in 5 s. Or resume it at the controller, or "
        "abandon it there: the job then fails.",
        _work.job.jobID,
        refusedOrNull->refusal));
    out.emplace_back(Planning::StartAdapterTimer{ArmTimers::RETRY, ArmTimers::RETRY_DELAY});
}

void ArmProgram::Retry()
{
    if (IsRetryDue())
    {
        ProbeRefusedProgram();
    }
}

void ArmProgram::Halt(std::string message)
{
    _trouble = {std::string(ERROR_HALTED), Planning::EAlarmLevel::Heavy, std::move(message)};
}

void ArmProgram::ForgetHalt()
{
    if (Running* const runningOrNull = std::get_if<Running>(&_state))
    {
        runningOrNull->standingProbes = 0;
    }
    _trouble.reset();
}

} // namespace ACS::Acsd
