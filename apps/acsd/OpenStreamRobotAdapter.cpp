#include "OpenStreamRobotAdapter.hpp"

#include "ArmAnswers.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// Of a controller's words about its refusal.
constexpr std::size_t MOST_OF_BODY = 200;

constexpr std::string_view SELECT_URL = "/project/context/tasks[0]/cur_prog_cnt";

/// For a start behind a refusal to be seen.
constexpr std::chrono::milliseconds REFUSED_START_LIMIT{2'000};

} // namespace

OpenStreamRobotAdapter::OpenStreamRobotAdapter(
    VDA5050::MasterOptions base,
    ArmOptions arm,
    JobMethods methods,
    ArmInputResolver inputs,
    RobotOutputs& outputs)
    : _outputs(outputs),
      _base(std::move(base), methods, outputs),
      _options(std::move(arm)),
      _methods(std::move(methods)),
      _resolveInputs(std::move(inputs))
{
}

void OpenStreamRobotAdapter::Handle(const Planning::RobotCommand& command, Core::Now now, AdapterActions& out)
{
    const Planning::StartJob* jobOrNull = std::get_if<Planning::StartJob>(&command);
    const Planning::RecoverJob* recoverOrNull = std::get_if<Planning::RecoverJob>(&command);
    const Planning::CancelJob* cancelOrNull = std::get_if<Planning::CancelJob>(&command);
    if (jobOrNull != nullptr)
    {
        StartJob(*jobOrNull, out);
    }
    else if (recoverOrNull != nullptr)
    {
        _recovery = recoverOrNull->job;
        FindJob(out);
    }
    else if (cancelOrNull != nullptr)
    {
        CancelJob(cancelOrNull->jobID, out);
    }
    else
    {
        const bool bPause = std::holds_alternative<Planning::Pause>(command);
        if (bPause || std::holds_alternative<Planning::Resume>(command))
        {
            _bPauseWanted = bPause;
            _bPauseTold = true;
            _bStopRefused = false;
            DoubtFound();
            FollowPause(out);
        }
        _base.Handle(command, now, _baseActions);
        DrainBase(out);
    }
}

void OpenStreamRobotAdapter::EndJob(AdapterActions& out)
{
    _phase = EJobPhase::None;
    _program = EProgram::Runs;
    ForgetHalt(out);
    _bStopRefused = false;
    _bGoOnRepeated = false;
    _bFound = false;
    _bGivenUp = false;
}

Planning::StateChanged OpenStreamRobotAdapter::MakeState() const
{
    Planning::StateChanged state = _baseState;
    state.bPaused = _bPaused;
    state.mark = MakeMark();
    if (_trouble.has_value())
    {
        state.errors.push_back(*_trouble);
    }
    return state;
}

void OpenStreamRobotAdapter::OnTimer(Planning::AdapterTimerID timer, Core::Now now, AdapterActions& out)
{
    switch (timer)
    {
        case RETRY_TIMER:
            Retry(out);
            break;
        case START_TIMER:
            CheckStart(out);
            break;
        case GLANCE_TIMER:
            LookAround(out);
            break;
        case LOOK_TIMER:
            EndWatch();
            break;
        default:
            _base.OnTimer(timer, now, _baseActions);
            DrainBase(out);
            break;
    }
}

std::string OpenStreamRobotAdapter::DescribeRefusal(
    int status,
    const std::optional<Core::JsonText>& bodyOrNull,
    const std::string& detail)
{
    return fmt::format(
        "the arm's controller refuses, status {}: {}",
        status,
        bodyOrNull.has_value() ? bodyOrNull->GetText().substr(0, MOST_OF_BODY) : detail);
}

std::optional<std::string> OpenStreamRobotAdapter::GetRejectionReasonOrNull(std::string_view action) const
{
    const auto method = _methods.find(action);
    if (method == _methods.end() || method->second.armProgram == 0)
    {
        return fmt::format("the arm has no program for {}", action);
    }
    return std::nullopt;
}

std::vector<VDA5050::MqttSubscription> OpenStreamRobotAdapter::GetSubscriptions() const
{
    return _base.GetSubscriptions();
}

void OpenStreamRobotAdapter::OnLinkUp(Core::Now now, AdapterActions& out)
{
    _base.OnLinkUp(now, _baseActions);
    DrainBase(out);
}

void OpenStreamRobotAdapter::OnLinkDown(Core::Now now, AdapterActions& out)
{
    _base.OnLinkDown(now, _baseActions);
    DrainBase(out);
}

void OpenStreamRobotAdapter::OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, AdapterActions& out)
{
    _base.OnMqttMessage(message, now, _baseActions);
    DrainBase(out);
}

const VDA5050::MasterSession& OpenStreamRobotAdapter::GetSession() const noexcept
{
    return _base.GetSession();
}

void OpenStreamRobotAdapter::OnArmEvent(const OpenStream::ClientEvent& event, Core::Now /*now*/, AdapterActions& out)
{
    std::visit(
        Core::Overloaded{
            [&](const OpenStream::ClientReady&) { WatchMotor(out); },
            [&](const OpenStream::ClientData& data) { TakeData(data.line, out); },
            [&](const OpenStream::ClientControlSettled& settled) { TakeSettled(settled, out); },
            [&](const OpenStream::ClientMonitorStarted&) {
                _look = _look == ELook::Asked ? ELook::Due : _look;
                _bGlanceStarted = _glance != EGlance::None;
            },
            [&](const OpenStream::ClientMonitorRefused& refused) { TakeMonitorRefused(refused, out); },
            [&](const OpenStream::ClientControlFault& fault) { TakeFault(fault, out); },
            [&](const OpenStream::ClientLost&) { TakeLoss(out); },
            [](const auto&) {
            }},
        event);
}

void OpenStreamRobotAdapter::TakeLoss(AdapterActions& out)
{
    for (const Planning::AdapterTimerID timer : {RETRY_TIMER, START_TIMER, GLANCE_TIMER, LOOK_TIMER})
    {
        out.emplace_back(Planning::CancelAdapterTimer{timer});
    }
    _trouble.reset();
    SetArmState(EArmState::Lost, out);
    _look = ELook::None;
    _glance = EGlance::None;
    _bMonitorRefused = false;
    _bMotorHidden = false;
    _bPlaybackHidden = false;
    _standingGlances = 0;
    _unshownLooks = 0;
    _bGoOnRepeated = _bGoOnRepeated || _program == EProgram::GoingOn;
    if (_program == EProgram::Stopping || _program == EProgram::GoingOn)
    {
        _program = EProgram::Doubtful;
    }
    if (IsJobBefore())
    {
        DisownJob(out); // another one may be selected by the time it is back
    }
}

/// A refusal that came after the silence.
void OpenStreamRobotAdapter::TakeFault(const OpenStream::ClientControlFault& fault, AdapterActions& out)
{
    const std::string reason = DescribeRefusal(fault.status, fault.body, fault.detail);
    if (_phase == EJobPhase::Looking)
    {
        FailJob(reason, out);
    }
    else if (_phase == EJobPhase::Running && !_bJobStarted && !_bRecovered)
    {
        // Where the controller was slow it may be of the selection, and the start comes yet.
        _refusal = reason;
        out.emplace_back(Planning::StartAdapterTimer{START_TIMER, REFUSED_START_LIMIT});
    }
    else if (_armState == EArmState::MotorOff)
    {
        _motorRefusal = reason;
    }
    else if (_phase == EJobPhase::Running && (_program == EProgram::Stopping || _program == EProgram::GoingOn))
    {
        const bool bStop = _program == EProgram::Stopping;
        TakeSettledPause(
            bStop ? EControl::StopProgram : EControl::GoOn,
            OpenStream::EControlOutcome::Refused,
            reason,
            out);
    }
}

void OpenStreamRobotAdapter::StartJob(const Planning::StartJob& job, AdapterActions& out)
{
    _recovery.reset();
    _refusal.clear();
    _jobID = job.jobID;
    _bJobStarted = false;
    _bRecovered = false;
    const std::optional<std::string> rejection = GetRejectionReasonOrNull(job.action);
    if (rejection.has_value())
    {
        FailJob(*rejection, out);
        return;
    }
    if (_armState != EArmState::Ready)
    {
        // It went away while the job waited to be stored. The robot is offline as long as that, so the job comes again
        // when it is there.
        DisownJob(out);
        return;
    }
    if (!job.mark.empty() && job.mark != MakeMark())
    {
        // A program has run meanwhile: after a restart this one could not be told from it.
        out.emplace_back(RaiseEvent{MakeState()});
        DisownJob(out);
        return;
    }
    _counted = _counters;
    _phase = EJobPhase::Selecting;
    _armProgram = _methods.find(job.action)->second.armProgram;
    SendControl(
        EControl::SelectProgram,
        SELECT_URL,
        fmt::format(R"({{"pno":{},"sno":0,"fno":0,"ext_sel":0}})", _armProgram));
}

/// It was surely not begun; why, is looked at before it is told: a motor that is off is no fault of the job's.
void OpenStreamRobotAdapter::RefuseJob(std::string reason, AdapterActions& out)
{
    if (_bMotorHidden)
    {
        FailJob(reason, out);
        return;
    }
    _phase = EJobPhase::Refused;
    _refusal = std::move(reason);
    _look = ELook::None;
    Glance(EGlance::Motor, out);
}

void OpenStreamRobotAdapter::FailJob(const std::string& reason, AdapterActions& out)
{
    EndJob(out);
    out.emplace_back(RaiseEvent{Planning::JobFailed{std::exchange(_jobID, {}), reason}});
    TellPaused(out);
}

/// Nobody can tell by what the arm shows.
void OpenStreamRobotAdapter::HoldJob(std::string reason, AdapterActions& out)
{
    EndJob(out);
    out.emplace_back(RaiseEvent{Planning::JobUncertain{std::exchange(_jobID, {}), std::move(reason)}});
    TellPaused(out);
}

/// Its program was surely not started: it can be commanded again.
void OpenStreamRobotAdapter::DisownJob(AdapterActions& out)
{
    EndJob(out);
    out.emplace_back(RaiseEvent{Planning::JobUnknown{std::exchange(_jobID, {})}});
    TellPaused(out);
}

void OpenStreamRobotAdapter::SendControl(EControl kind, std::string_view url, std::string body)
{
    OpenStream::ControlRequest request;
    request.url = url;
    request.body = Core::JsonText::FromTrusted(std::move(body));
    _controls.push_back(kind);
    _outputs.armRequests.emplace_back(std::move(request));
}

void OpenStreamRobotAdapter::TakeSettled(const OpenStream::ClientControlSettled& settled, AdapterActions& out)
{
    if (_controls.empty())
    {
        return;
    }
    const EControl kind = _controls.front();
    _controls.pop_front();
    if (kind == EControl::MotorOn)
    {
        TakeSettledMotor(settled, out);
        return;
    }
    if (kind == EControl::StopProgram || kind == EControl::GoOn || kind == EControl::ResetProgram)
    {
        TakeSettledPause(kind, settled.outcome, DescribeRefusal(settled.status, settled.body, settled.detail), out);
        return;
    }
    const bool bOfJob = (kind == EControl::SelectProgram && _phase == EJobPhase::Selecting)
        || (kind == EControl::StartProgram && _phase == EJobPhase::Starting);
    if (!bOfJob)
    {
        return; // a job that has ended meanwhile
    }
    switch (settled.outcome)
    {
        case OpenStream::EControlOutcome::Accepted:
            _phase = _phase == EJobPhase::Selecting ? EJobPhase::Looking : EJobPhase::Running;
            LookAgain(out);
            break;
        case OpenStream::EControlOutcome::Refused:
            RefuseJob(DescribeRefusal(settled.status, settled.body, settled.detail), out);
            break;
        case OpenStream::EControlOutcome::NotSent:
            DisownJob(out);
            break;
        case OpenStream::EControlOutcome::Unconfirmed: // not asked for
        case OpenStream::EControlOutcome::Unknown:
            if (_phase == EJobPhase::Selecting)
            {
                DisownJob(out); // selected perhaps, but not started
            }
            else
            {
                // Started or not: the counters will tell after the reconnect. It is never started a second time.
                _phase = EJobPhase::Running;
            }
            break;
        default:
            break;
    }
}

void OpenStreamRobotAdapter::TakeData(const OpenStream::DataLine& line, AdapterActions& out)
{
    if (!line.result.has_value())
    {
        return;
    }
    if (_armState == EArmState::MotorOff)
    {
        TakeMotor(ReadMotorOnOrNull(*line.result).value_or(false), out);
    }
    else if (_armState != EArmState::Lost && !TryTakeGlance(*line.result, out))
    {
        TakeCounters(*line.result, out);
    }
}

void OpenStreamRobotAdapter::WatchCounters()
{
    const std::size_t words = std::max({_options.startedIndex, _options.finishedIndex, _options.failedIndex}) + 1;
    OpenStream::MonitorRequest monitor;
    monitor.url = _options.monitorUrl;
    monitor.period = _options.period;
    monitor.args = Core::JsonText::FromTrusted(fmt::format(R"({{"st":{},"len":{}}})", _options.firstByte, words));
    _outputs.armRequests.emplace_back(std::move(monitor));
    _glance = EGlance::None;
    _bCountersFresh = false;
}

void OpenStreamRobotAdapter::TakeCounters(const Core::JsonText& result, AdapterActions& out)
{
    const std::optional<std::vector<std::int64_t>> words = ReadRelayWordsOrNull(result);
    const std::size_t needed = std::max({_options.startedIndex, _options.finishedIndex, _options.failedIndex}) + 1;
    if (!words.has_value() || words->size() < needed)
    {
        return; // a late sample of the MONITOR before, or a controller that lacks these relays
    }
    const Counters before = std::exchange(
        _counters,
        {(*words)[_options.startedIndex], (*words)[_options.finishedIndex], (*words)[_options.failedIndex]});
    const bool bFirst = _armState != EArmState::Ready;
    const bool bNews = !std::exchange(_bCounted, true) || before != _counters;
    if (bNews && _bBaseStateKnown)
    {
        out.emplace_back(RaiseEvent{MakeState()}); // with the new mark, before anybody begins a job on it
    }
    _bCountersFresh = true;
    SetArmState(EArmState::Ready, out);
    if (bFirst)
    {
        SetTrouble(std::nullopt, out);
        out.emplace_back(Planning::CancelAdapterTimer{RETRY_TIMER});
        StartGlanceTimer(out);
    }
    const bool bReset = HasFallen(before, _counters);
    const bool bBegun = _phase == EJobPhase::Starting || _phase == EJobPhase::Running;
    if (bReset && bBegun)
    {
        HoldJob(
            "the arm's controller was restarted while its program ran, or might have: its counters began again",
            out);
        return;
    }
    FindJob(out);
    FollowJob(out);
    CheckHalt(out);
    if (!bFirst)
    {
        TakeStanding(out);
    }
    if (_look == ELook::Due)
    {
        _look = ELook::None;
        TakeLook(out);
    }
    if (bFirst)
    {
        if (IsGoOnRefused())
        {
            _program = EProgram::Retrying;
            LookAtRefusedProgram(out);
        }
        FollowPause(out);
    }
    if (bFirst && !_bJobStarted && _phase == EJobPhase::Running)
    {
        out.emplace_back(Planning::StartAdapterTimer{START_TIMER, START_LIMIT});
    }
}

void OpenStreamRobotAdapter::SetArmState(EArmState state, AdapterActions& out)
{
    _armState = state;
    TellOnline(out);
}

void OpenStreamRobotAdapter::DrainBase(AdapterActions& out)
{
    for (Planning::AdapterAction& action : _baseActions)
    {
        const RaiseEvent* raiseOrNull = std::get_if<RaiseEvent>(&action);
        const Planning::LinkChanged* linkOrNull =
            raiseOrNull == nullptr ? nullptr : std::get_if<Planning::LinkChanged>(&raiseOrNull->event);
        const Planning::StateChanged* stateOrNull =
            raiseOrNull == nullptr ? nullptr : std::get_if<Planning::StateChanged>(&raiseOrNull->event);
        if (stateOrNull != nullptr)
        {
            _baseState = *stateOrNull;
            _bPauseTold = _bPauseTold || stateOrNull->bPaused;
            _bBaseStateKnown = true;
            _bPaused = IsPaused();
            out.emplace_back(RaiseEvent{MakeState()});
        }
        else if (linkOrNull != nullptr)
        {
            _bBaseOnline = linkOrNull->bOnline;
            _bBaseStateKnown = _bBaseStateKnown && _bBaseOnline;
            TellOnline(out);
        }
        else
        {
            out.push_back(std::move(action));
        }
    }
    _baseActions.clear();
}

void OpenStreamRobotAdapter::TellOnline(AdapterActions& out)
{
    const bool bArmInReach = _armState == EArmState::Ready || (_armState != EArmState::Lost && _trouble.has_value());
    const bool bOnline = _bBaseOnline && bArmInReach;
    if (std::exchange(_bOnline, bOnline) == bOnline)
    {
        return;
    }
    out.emplace_back(RaiseEvent{Planning::LinkChanged{bOnline}});
    if (bOnline && _bBaseStateKnown)
    {
        out.emplace_back(RaiseEvent{MakeState()}); // the base may tell its next one much later
    }
}

} // namespace ACS::Acsd
