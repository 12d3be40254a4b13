#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"
#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// The step of a program that begins. Some controllers count from 0.
constexpr std::int64_t FIRST_STEP = 1;
/// Maximum time for a program to raise its first counter when it is unknown whether its start arrived.
constexpr std::chrono::milliseconds START_LIMIT{10'000};

} // namespace

ArmProgram::ArmProgram(ArmOptions options, ArmControls& controls)
    : _options(std::move(options)),
      _controls(controls)
{
}

void ArmProgram::SetWork(ArmJob job)
{
    _work = {};
    _work.jobID = std::move(job.jobID);
    _work.program = job.program;
    _work.inputs = ArmInputTransfer(std::move(job.inputs), _options.inputRetries);
}

void ArmProgram::Start(ArmJob job, AdapterActions& out)
{
    SetWork(std::move(job));
    BeginSelection(out);
}

void ArmProgram::BeginSelection(AdapterActions& out)
{
    _work.bRewound = false;
    if (_controls.IsRewindDue())
    {
        Rewind();
    }
    else
    {
        Select(out);
    }
}

void ArmProgram::Select(AdapterActions& out)
{
    if (_work.bCancelled)
    {
        Fail("cancelled before it was started", out);
        return;
    }
    _state = Selecting{};
    _controls.Select(_work.program);
}

void ArmProgram::Rewind()
{
    _state = Rewinding{};
    _controls.Rewind();
}

/// If a program was started or stopped from outside acsd, the program counter is set once, and the program is selected
/// again.
bool ArmProgram::TryRewind(const ArmRefusal& refusal)
{
    if (!ArmProgramControls::IsRewindWanted(refusal) || std::exchange(_work.bRewound, true))
    {
        return false;
    }
    Rewind();
    return true;
}

bool ArmProgram::TryCancel(const std::string& jobID, AdapterActions& out)
{
    if (jobID != _work.jobID || !HasJob())
    {
        return false;
    }
    if (ArmStates::IsBeforeStart(_state))
    {
        Fail("cancelled before it was started", out);
        return false;
    }
    const bool bRuns = Is<Starting>(_state) || Is<Awaited>(_state) || Is<Running>(_state);
    _work.bCancelled = _work.bCancelled || IsPauseWanted() || !bRuns;
    return true;
}

void ArmProgram::Recover(ArmJob job, bool bBegun, bool bCancelled, AdapterActions& out)
{
    SetWork(std::move(job));
    _work.bCancelled = bCancelled;
    _state = Awaited{bBegun ? EArmStart::Counted : EArmStart::Unknown, {}};
    if (!bBegun)
    {
        // The start may still be on its way. A program that has not raised its first counter by then was not started.
        out.emplace_back(
            Planning::StartAdapterTimer{ArmTimers::START, ArmTimers::AddPeriods(START_LIMIT, _options.period)});
    }
}

void ArmProgram::Advance(bool bFree, bool bProbing, AdapterActions& out)
{
    if (!bFree)
    {
        return;
    }
    if (Prepared* const preparedOrNull = std::get_if<Prepared>(&_state))
    {
        if (IsPauseWanted())
        {
            preparedOrNull->bPaused = true;
        }
        else if (preparedOrNull->bPaused)
        {
            BeginSelection(out);
        }
        else
        {
            _state = Starting{};
            _controls.Start();
        }
    }
    else if (const Running* const runningOrNull = std::get_if<Running>(&_state))
    {
        if (IsPauseWanted() && !runningOrNull->bStopRefused)
        {
            _state = Stopping{};
            _controls.Stop();
        }
    }
    else if (Is<Unverified>(_state))
    {
        // Not resumed: a program that has ended would run a second time.
        _state = Stopping{};
        _controls.Stop();
    }
    else if (Is<Stopped>(_state))
    {
        AdvanceStopped(bProbing, out);
    }
    else if (const ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state))
    {
        const bool bDue =
            refusedOrNull->bRetries && !refusedOrNull->bSeenStopped && (IsPauseWanted() || _work.bCancelled);
        if (bDue && !bProbing)
        {
            ProbeRefusedProgram();
        }
    }
}

void ArmProgram::OnProof(const ArmProof& proof, const std::string& echo, AdapterActions& out)
{
    Starting* const startingOrNull = std::get_if<Starting>(&_state);
    const Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state);
    if (proof.bBegun && startingOrNull != nullptr && !std::exchange(startingOrNull->bBegun, true))
    {
        out.emplace_back(RaiseEvent{Planning::JobStarted{_work.jobID}});
    }
    else if (proof.bBegun && awaitedOrNull != nullptr)
    {
        out.emplace_back(RaiseEvent{Planning::JobStarted{_work.jobID}});
        ForgetHalt();
        _state = Running{awaitedOrNull->start};
        VerifyRecovered();
    }
    switch (proof.outcome)
    {
        case ArmProof::EOutcome::Finished:
            out.emplace_back(RaiseEvent{Planning::JobFinished{End(out)}});
            break;
        case ArmProof::EOutcome::Failed:
            Fail("the arm's program reported a failure", out);
            break;
        case ArmProof::EOutcome::OtherProgram:
            ReportUnresolved(fmt::format("another program of the arm has run: {}", echo), out);
            break;
        case ArmProof::EOutcome::Open:
        default:
            break;
    }
}

void ArmProgram::OnRestarted(AdapterActions& out)
{
    ReportUnresolved(
        "the arm's controller was restarted while its program was running or being started: the counters have fallen",
        out);
}

void ArmProgram::OnVerified(bool bUnchanged, const std::optional<GeneralState>& stateOrNull, AdapterActions& out)
{
    const std::optional<std::int64_t> shownOrNull = stateOrNull.value_or(GeneralState{}).program;
    const bool bEffectMissing = stateOrNull.has_value() && !IsEffectShown(*stateOrNull);
    const bool bBeforeStart = Is<VerifyingSelection>(_state) || Is<VerifyingCounters>(_state);
    if (bBeforeStart && !bUnchanged)
    {
        // The selection has abandoned a program, or another one has run: the counters do not distinguish them.
        ReportNotStarted(out);
    }
    else if (Is<VerifyingSelection>(_state) && shownOrNull.has_value() && shownOrNull != std::int64_t{_work.program})
    {
        Fail(
            fmt::format(
                "the arm's controller shows program {} as selected in place of program {}, which was not started",
                *shownOrNull,
                _work.program),
            out);
    }
    else if (Is<VerifyingSelection>(_state))
    {
        if (_work.inputs.GetInputs().empty())
        {
            _state = Prepared{};
            return;
        }
        _work.inputs.Begin();
        WriteInput();
    }
    else if (Is<VerifyingCounters>(_state))
    {
        _state = Prepared{};
    }
    else if (Is<Stopping>(_state) && bEffectMissing)
    {
        const bool bStopWanted = IsPauseWanted() || _work.bCancelled;
        _state = bStopWanted ? ArmProgramState(Unverified{}) : ArmProgramState(Running{});
    }
    else if (Is<Stopping>(_state))
    {
        _work.stoppedProgramOrNull = shownOrNull;
        _work.probedProgramOrNull = shownOrNull;
        _work.stoppedProbes = 0;
        _state = Stopped{EArmHalt::Verified};
    }
    else if (const Resetting* const resettingOrNull = std::get_if<Resetting>(&_state);
             resettingOrNull != nullptr && resettingOrNull->bAccepted)
    {
        FinishReset(stateOrNull, out);
    }
    else if (Is<Resuming>(_state) && bEffectMissing)
    {
        _work.bResumeRepeated = true; // it may be executed later
        _state = ResumeRefused{"the arm's controller shows no running program after the start", false, false};
        ProbeRefusedProgram();
    }
    else if (Is<Resuming>(_state))
    {
        _state = Running{};
    }
}

bool ArmProgram::IsEffectShown(const GeneralState& state) const
{
    if (Is<VerifyingSelection>(_state))
    {
        return state.program == std::int64_t{_work.program} && state.step.value_or(0) <= FIRST_STEP;
    }
    if (Is<Stopping>(_state))
    {
        return !state.bPlaying;
    }
    if (Is<Resuming>(_state))
    {
        return state.bPlaying;
    }
    // A stopped program shows nothing of a reset: the time limit is for a late refusal. Otherwise the job has ended meanwhile.
    return !Is<Resetting>(_state);
}

/// Without this limit a start that was lost on the way would leave the job running indefinitely.
void ArmProgram::OnStartTimer(bool bEchoed, bool bZero, AdapterActions& out)
{
    const Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state);
    if (awaitedOrNull == nullptr)
    {
        return;
    }
    if (bEchoed)
    {
        ReportUnresolved("the arm's program has echoed the job's number but has not raised its started counter", out);
    }
    else if (bZero && awaitedOrNull->bReconnected)
    {
        ReportUnresolved("all of the arm's counters are 0, as after a restart of its controller", out);
    }
    else if (!awaitedOrNull->refusal.empty())
    {
        Fail(std::string(awaitedOrNull->refusal), out);
    }
    else if (awaitedOrNull->start == EArmStart::Unknown)
    {
        ReportNotStarted(out);
    }
    else
    {
        Fail("the connection to the arm broke while its program was being started, and it did not begin", out);
    }
}

void ArmProgram::OnCountersBack(AdapterActions& out)
{
    ForgetHalt();
    if (ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state))
    {
        refusedOrNull->bRetries = true;
        ProbeRefusedProgram();
    }
    if (Is<Stopped>(_state))
    {
        _requests.push_back(EArmRequest::ProbePlayback); // it may have been resumed at the controller meanwhile
    }
    if (Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state))
    {
        awaitedOrNull->bReconnected = true;
        out.emplace_back(
            Planning::StartAdapterTimer{ArmTimers::START, ArmTimers::AddPeriods(START_LIMIT, _options.period)});
    }
}

void ArmProgram::OnLost(AdapterActions& out)
{
    _trouble.reset();
    _controls.OnLost();
    out.emplace_back(Planning::CancelAdapterTimer{ArmTimers::START});
    _work.stoppedProbes = 0;
    _work.bResumeRepeated = _work.bResumeRepeated || Is<Resuming>(_state);
    if (Is<Stopping>(_state) || Is<Resuming>(_state))
    {
        _state = Unverified{};
    }
    else if (Is<Resetting>(_state) || Is<Stopped>(_state))
    {
        _state = Stopped{};
    }
    else if (ArmStates::IsBeforeStart(_state))
    {
        ReportNotStarted(out); // another program may be selected when the connection is back
    }
}

std::string ArmProgram::End(AdapterActions& out)
{
    for (const Planning::AdapterTimerID timer : {ArmTimers::START, ArmTimers::INPUT})
    {
        out.emplace_back(Planning::CancelAdapterTimer{timer});
    }
    _state = NoJob{};
    _trouble.reset();
    return std::exchange(_work, {}).jobID;
}

void ArmProgram::Fail(std::string reason, AdapterActions& out)
{
    std::string jobID = End(out);
    out.emplace_back(RaiseEvent{Planning::JobFailed{std::move(jobID), std::move(reason)}});
}

/// The counters do not prove the outcome of the job.
void ArmProgram::ReportUnresolved(std::string reason, AdapterActions& out)
{
    std::string jobID = End(out);
    out.emplace_back(RaiseEvent{Planning::JobUnresolved{std::move(jobID), std::move(reason)}});
}

void ArmProgram::ReportNotStarted(AdapterActions& out)
{
    std::string jobID = End(out);
    out.emplace_back(RaiseEvent{Planning::JobUnknown{std::move(jobID)}});
}

std::vector<EArmRequest> ArmProgram::TakeRequests()
{
    return std::exchange(_requests, {});
}

const std::vector<ArmInput>& ArmProgram::GetInputs() const noexcept
{
    return _work.inputs.GetInputs();
}

bool ArmProgram::HasJob() const noexcept
{
    return !Is<NoJob>(_state);
}

bool ArmProgram::IsPreparing() const
{
    return ArmStates::IsPreparing(_state);
}

bool ArmProgram::IsCounted() const
{
    return HasJob() && !ArmStates::IsBeforeStart(_state) && !Is<Selecting>(_state) && !Is<Rewinding>(_state);
}

bool ArmProgram::IsReadingInputs() const
{
    return Is<ReadingInputs>(_state);
}

bool ArmProgram::IsStarted() const
{
    const Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state);
    const bool bAwaited = awaitedOrNull != nullptr && awaitedOrNull->start == EArmStart::Sent
        && awaitedOrNull->refusal.empty() && !awaitedOrNull->bReconnected;
    return Is<Running>(_state) || bAwaited;
}

bool ArmProgram::IsMotorDecisive() const
{
    return !HasJob() || Is<Refused>(_state) || Is<ResumeRefused>(_state);
}

bool ArmProgram::IsResumeDue() const
{
    const bool bStopped =
        Is<Stopped>(_state) || Is<Resetting>(_state) || Is<Resuming>(_state) || Is<ResumeRefused>(_state);
    return bStopped && !IsPauseWanted();
}

bool ArmProgram::IsArmStopped() const
{
    return !IsCounted() || Is<Stopped>(_state) || Is<Resetting>(_state);
}

const std::optional<Planning::RobotError>& ArmProgram::GetTroubleOrNull() const noexcept
{
    return _trouble;
}

} // namespace ACS::Acsd
