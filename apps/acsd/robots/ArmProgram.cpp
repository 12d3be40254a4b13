#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"
#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

#include <string_view>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

constexpr std::string_view SELECT_URL = "/project/context/tasks[0]/cur_prog_cnt";
constexpr std::string_view REWIND_URL = "/project/context/tasks[0]/set_cur_pc_idx";
constexpr std::string_view START_URL = "/project/robot/start";
constexpr std::string_view STOP_URL = "/project/robot/stop";
constexpr std::string_view RCODE_URL = "/project/service/r_code/execute";
constexpr std::string_view RESET_URL = "/project/context/tasks[0]/reset";

/// Bad program counter: a selection wants set_cur_pc_idx first.
constexpr std::int64_t BAD_COUNTER = -1'245'280;

/// Of a program that begins; some count from 0.
constexpr std::int64_t FIRST_STEP = 1;
/// For a program to raise its first counter when it is not known whether its start arrived.
constexpr std::chrono::milliseconds START_LIMIT{10'000};

} // namespace

ArmProgram::ArmProgram(ArmOptions options, ArmControls& controls)
    : _options(std::move(options)),
      _controls(controls)
{
}

void ArmProgram::Start(ArmJob job)
{
    _work = {std::move(job)};
    if (_bRewindDue)
    {
        Rewind();
    }
    else
    {
        Select();
    }
}

void ArmProgram::Select()
{
    _state = Selecting{};
    // ext_sel 1: as it must be in remote mode, without which there is no start.
    _controls.Send(
        EArmControl::SelectProgram,
        SELECT_URL,
        fmt::format(R"({{"pno":{},"sno":0,"fno":0,"ext_sel":1}})", _work.job.program));
}

/// After a start or stop a controller may refuse a selection for its program counter, which is set before the next one.
void ArmProgram::Rewind()
{
    _state = Rewinding{};
    _controls.Send(EArmControl::RewindProgram, REWIND_URL, R"({"idx":1})");
}

bool ArmProgram::IsOfSelection(const ArmRefusal& refusal)
{
    return refusal.codeOrNone == BAD_COUNTER;
}

/// A program that was started or stopped by others: the counter is set, once, and it is selected again.
bool ArmProgram::TryRewind(const ArmRefusal& refusal)
{
    if (!IsOfSelection(refusal) || std::exchange(_work.bRewound, true))
    {
        return false;
    }
    Rewind();
    return true;
}

void ArmProgram::StartProgram()
{
    _state = Starting{};
    _controls.Send(EArmControl::StartProgram, START_URL, "{}");
}

void ArmProgram::StopProgram()
{
    _state = Stopping{};
    _controls.Send(EArmControl::StopProgram, STOP_URL, "{}");
}

void ArmProgram::ResumeProgram()
{
    _state = Resuming{};
    _controls.Send(EArmControl::ResumeProgram, START_URL, "{}");
}

void ArmProgram::ResetProgram(EResetPath path)
{
    const bool bRCode = path == EResetPath::RCode;
    _state = Resetting{bRCode};
    _controls.Send(EArmControl::ResetProgram, bRCode ? RCODE_URL : RESET_URL, bRCode ? R"({"code":1})" : "{}");
}

void ArmProgram::Cancel(const std::string& jobID, AdapterActions& out)
{
    if (jobID != _work.job.jobID || !HasJob())
    {
        return;
    }
    if (IsBeforeStart())
    {
        Fail("cancelled before it was started", out);
        return;
    }
    const bool bRuns = Is<Starting>() || Is<Awaited>() || Is<Running>();
    _work.bCancelled = _bPauseWanted || !bRuns;
}

void ArmProgram::SetPauseWanted(bool bWanted)
{
    _bPauseWanted = bWanted;
    _bPauseKnown = true;
    if (Running* const runningOrNull = std::get_if<Running>(&_state))
    {
        runningOrNull->bStopRefused = false;
    }
    DoubtFound();
}

void ArmProgram::OnPauseSeen() noexcept
{
    _bPauseKnown = true;
}

/// Where there were pauses, a program that was found after a restart may be stopped: only by being stopped and started again
/// it surely runs.
void ArmProgram::DoubtFound()
{
    const Running* const runningOrNull = std::get_if<Running>(&_state);
    if (runningOrNull != nullptr && runningOrNull->start == EArmStart::Counted && _bPauseKnown)
    {
        _work.bResumeRepeated = true;
        _state = Doubtful{};
    }
}

void ArmProgram::Recover(ArmJob job, bool bBegun, AdapterActions& out)
{
    _work = {std::move(job)};
    _state = Awaited{bBegun ? EArmStart::Counted : EArmStart::Unknown, {}};
    if (!bBegun)
    {
        // It may be on its way still. A program that has not raised its first counter by then was not started.
        out.emplace_back(Planning::StartAdapterTimer{ArmTimers::START, START_LIMIT});
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
        if (_bPauseWanted)
        {
            preparedOrNull->bVerified = _work.job.inputs.empty(); // they may be overwritten meanwhile
        }
        else if (preparedOrNull->bVerified)
        {
            StartProgram();
        }
        else
        {
            ReadInputs(0, out);
        }
    }
    else if (const Running* const runningOrNull = std::get_if<Running>(&_state))
    {
        if (_bPauseWanted && !runningOrNull->bStopRefused)
        {
            StopProgram();
        }
    }
    else if (Is<Doubtful>())
    {
        StopProgram(); // starting it on suspicion could run it a second time, had it come to its end
    }
    else if (Is<Stopped>() && _work.bCancelled)
    {
        ResetProgram(_resetPath == EResetPath::Unknown ? EResetPath::RCode : _resetPath);
    }
    else if (Is<Stopped>() && !_bPauseWanted)
    {
        ResumeProgram();
    }
    else if (const ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state))
    {
        const bool bDue =
            refusedOrNull->bRetries && !refusedOrNull->bSeenStopped && (_bPauseWanted || _work.bCancelled);
        if (bDue && !bProbing)
        {
            ProbeRefusedProgram();
        }
    }
}

void ArmProgram::OnProof(const ArmProof& proof, const std::string& echo, AdapterActions& out)
{
    if (proof.bBegun)
    {
        Begin(out);
    }
    switch (proof.outcome)
    {
        case ArmProof::EOutcome::Finished:
            Finish(out);
            break;
        case ArmProof::EOutcome::Failed:
            Fail("the arm's program gave up", out);
            break;
        case ArmProof::EOutcome::OtherProgram:
            Hold(fmt::format("the arm's counters were raised by another program: {}", echo), out);
            break;
        case ArmProof::EOutcome::Open:
        default:
            break;
    }
}

void ArmProgram::Begin(AdapterActions& out)
{
    Starting* const startingOrNull = std::get_if<Starting>(&_state);
    if (startingOrNull != nullptr && !std::exchange(startingOrNull->bBegun, true))
    {
        out.emplace_back(RaiseEvent{Planning::JobStarted{_work.job.jobID}});
    }
    else if (const Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state))
    {
        out.emplace_back(RaiseEvent{Planning::JobStarted{_work.job.jobID}});
        _state = Running{awaitedOrNull->start};
        DoubtFound();
    }
}

void ArmProgram::OnRestarted(AdapterActions& out)
{
    Hold("the arm's controller was restarted while its program ran, or might have: its counters began again", out);
}

/// A program that ran since the selection: nothing that is seen later could tell it from this job's.
void ArmProgram::OnCountedBeforeStart(AdapterActions& out)
{
    Disown(out);
}

void ArmProgram::OnVerified(bool bUnchanged, AdapterActions& out)
{
    const bool bBeforeStart = Is<VerifyingSelection>() || Is<VerifyingCounters>();
    if (bBeforeStart && !bUnchanged)
    {
        // The selection has abandoned a program, or another one was run: no evidence could tell them apart.
        Disown(out);
    }
    else if (Is<VerifyingSelection>())
    {
        Prepare();
    }
    else if (Is<VerifyingCounters>())
    {
        _state = Prepared{true};
    }
    else if (Is<Stopping>())
    {
        _state = Stopped{};
    }
    else if (Is<Resuming>())
    {
        _state = Running{};
    }
}

bool ArmProgram::IsEffectShown(const GeneralState& state) const
{
    if (Is<VerifyingSelection>())
    {
        return state.program == std::int64_t{_work.job.program} && state.step.value_or(0) <= FIRST_STEP;
    }
    if (Is<Stopping>())
    {
        return !state.bPlaying;
    }
    if (Is<Resuming>())
    {
        return state.bPlaying;
    }
    return true; // the job has ended meanwhile
}

/// A start that got lost on the way would leave the job running indefinitely.
void ArmProgram::OnStartTimer(bool bEchoed, AdapterActions& out)
{
    const Awaited* const awaitedOrNull = std::get_if<Awaited>(&_state);
    if (awaitedOrNull == nullptr)
    {
        return;
    }
    if (bEchoed)
    {
        Hold("the arm's program has echoed the job's number and does not raise its started counter", out);
    }
    else if (!awaitedOrNull->refusal.empty())
    {
        Fail(std::string(awaitedOrNull->refusal), out);
    }
    else if (awaitedOrNull->start == EArmStart::Unknown)
    {
        Disown(out);
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
    if (Is<Awaited>())
    {
        out.emplace_back(Planning::StartAdapterTimer{ArmTimers::START, START_LIMIT});
    }
}

void ArmProgram::OnLost(AdapterActions& out)
{
    _trouble.reset();
    _resetPath = EResetPath::Unknown;
    out.emplace_back(Planning::CancelAdapterTimer{ArmTimers::START});
    if (Running* const runningOrNull = std::get_if<Running>(&_state))
    {
        runningOrNull->standingProbes = 0;
    }
    _work.bResumeRepeated = _work.bResumeRepeated || Is<Resuming>();
    if (Is<Stopping>() || Is<Resuming>())
    {
        _state = Doubtful{};
    }
    else if (Is<Resetting>())
    {
        _state = Stopped{};
    }
    else if (IsBeforeStart())
    {
        Disown(out); // another one may be selected by the time the connection is back
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
    return std::exchange(_work, {}).job.jobID;
}

void ArmProgram::Finish(AdapterActions& out)
{
    std::string jobID = End(out);
    out.emplace_back(RaiseEvent{Planning::JobFinished{std::move(jobID)}});
}

void ArmProgram::Fail(std::string reason, AdapterActions& out)
{
    std::string jobID = End(out);
    out.emplace_back(RaiseEvent{Planning::JobFailed{std::move(jobID), std::move(reason)}});
}

/// What the arm shows proves nothing.
void ArmProgram::Hold(std::string reason, AdapterActions& out)
{
    std::string jobID = End(out);
    out.emplace_back(RaiseEvent{Planning::JobUncertain{std::move(jobID), std::move(reason)}});
}

/// The program was surely not started: the job can be commanded again.
void ArmProgram::Disown(AdapterActions& out)
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
    return _work.job.inputs;
}

bool ArmProgram::HasJob() const noexcept
{
    return !Is<NoJob>();
}

bool ArmProgram::IsBeforeStart() const
{
    return Is<VerifyingSelection>() || IsPreparing() || Is<Refused>();
}

bool ArmProgram::IsPreparing() const
{
    return Is<WritingInputs>() || Is<ReadingInputs>() || Is<VerifyingCounters>() || Is<Prepared>();
}

bool ArmProgram::IsCounted() const
{
    return HasJob() && !IsBeforeStart() && !Is<Selecting>() && !Is<Rewinding>();
}

bool ArmProgram::IsReadingInputs() const
{
    return Is<ReadingInputs>();
}

bool ArmProgram::IsRunning() const
{
    return Is<Running>();
}

bool ArmProgram::IsMotorDecisive() const
{
    return !HasJob() || Is<Refused>() || Is<ResumeRefused>();
}

bool ArmProgram::IsResumeDue() const
{
    const bool bStopped = Is<Stopped>() || Is<Resetting>() || Is<Resuming>() || Is<ResumeRefused>();
    return bStopped && !_bPauseWanted;
}

bool ArmProgram::IsRetryDue() const
{
    const ResumeRefused* const refusedOrNull = std::get_if<ResumeRefused>(&_state);
    return refusedOrNull != nullptr && refusedOrNull->bRetries;
}

bool ArmProgram::IsArmStopped() const
{
    return !IsCounted() || Is<Stopped>() || Is<Resetting>();
}

const std::optional<Planning::RobotError>& ArmProgram::GetTroubleOrNull() const noexcept
{
    return _trouble;
}

} // namespace ACS::Acsd
