#include "OpenStreamRobotAdapter.hpp"

#include <acs/core/JsonText.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/json/JsonDecoder.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

/// The answer to GET motor_on_state.
struct MotorState
{
    std::int64_t value = 0;
};

} // namespace ACS::Acsd

template <>
struct ACS::Json::JsonFields<ACS::Acsd::MotorState>
{
    static constexpr auto FIELDS = std::make_tuple(Required("val", &Acsd::MotorState::value));
};

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Planning::AdapterActions;
using Planning::RaiseEvent;

/// The base's session has the numbers of its own timers, which are fewer.
constexpr Planning::AdapterTimerID MOTOR_TIMER = 100;
constexpr std::chrono::milliseconds MOTOR_PERIOD = 200ms;
constexpr std::chrono::milliseconds MOTOR_RETRY = 5s;
/// The only value on which the manuals of all versions agree.
constexpr std::int64_t MOTOR_IS_ON = 0;

constexpr std::string_view MOTOR_STATE_URL = "/project/robot/motor_on_state";
constexpr std::string_view MOTOR_ON_URL = "/project/robot/motor_on";
constexpr std::string_view SELECT_URL = "/project/context/tasks[0]/cur_prog_cnt";

template <typename T>
std::optional<T> ReadOrNull(const Core::JsonText& text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(text.GetText(), {});
    Json::DecodeContext context;
    T value{};
    if (!root || !Json::TryDecode(**root, value, Json::FieldBounds{}, context))
    {
        return std::nullopt;
    }
    return value;
}

OpenStream::MonitorRequest MakeMonitor(std::string url, std::chrono::milliseconds period)
{
    OpenStream::MonitorRequest monitor;
    monitor.url = std::move(url);
    monitor.period = period;
    return monitor;
}

} // namespace

OpenStreamRobotAdapter::OpenStreamRobotAdapter(
    VDA5050::MasterOptions base,
    ArmCounters counters,
    JobMethods methods,
    RobotOutputs& outputs)
    : _outputs(outputs),
      _base(std::move(base), methods, outputs),
      _options(std::move(counters)),
      _methods(std::move(methods))
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

void OpenStreamRobotAdapter::EndJob()
{
    _phase = EJobPhase::None;
    _program = EProgram::Runs;
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
    return state;
}

void OpenStreamRobotAdapter::OnTimer(Planning::AdapterTimerID timer, Core::Now now, AdapterActions& out)
{
    if (timer == START_TIMER)
    {
        CheckStart(out);
        return;
    }
    if (timer != MOTOR_TIMER)
    {
        _base.OnTimer(timer, now, _baseActions);
        DrainBase(out);
        return;
    }
    if (_armState == EArmState::MotorOff)
    {
        SendControl(EControl::MotorOn, MOTOR_ON_URL, "{}");
        out.emplace_back(Planning::StartAdapterTimer{MOTOR_TIMER, MOTOR_RETRY});
    }
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
            [&](const OpenStream::ClientMonitorStarted&) { _look = _look == ELook::Asked ? ELook::Due : _look; },
            [&](const OpenStream::ClientControlFault& fault) { TakeFault(fault, out); },
            [&](const OpenStream::ClientLost&) { TakeLoss(out); },
            [](const auto&) {
            }},
        event);
}

void OpenStreamRobotAdapter::TakeLoss(AdapterActions& out)
{
    out.emplace_back(Planning::CancelAdapterTimer{MOTOR_TIMER});
    out.emplace_back(Planning::CancelAdapterTimer{START_TIMER});
    SetArmState(EArmState::Lost, out);
    _look = ELook::None;
    _bGoOnRepeated = _bGoOnRepeated || _program == EProgram::GoingOn;
    if (_program == EProgram::Stopping || _program == EProgram::GoingOn)
    {
        _program = EProgram::Doubtful;
    }
    if (_phase == EJobPhase::Looking || _phase == EJobPhase::Selected)
    {
        DisownJob(out); // another one may be selected by the time it is back
    }
}

/// A refusal that came after the silence.
void OpenStreamRobotAdapter::TakeFault(const OpenStream::ClientControlFault& fault, AdapterActions& out)
{
    const bool bOfStart = _phase == EJobPhase::Running && !_bJobStarted && !_bRecovered;
    if (_phase == EJobPhase::Looking || bOfStart)
    {
        FailJob(fmt::format("the arm's controller refuses, status {}: {}", fault.status, fault.detail), out);
    }
    else if (_phase == EJobPhase::Running && (_program == EProgram::Stopping || _program == EProgram::GoingOn))
    {
        const bool bStop = _program == EProgram::Stopping;
        TakeSettledPause(bStop ? EControl::StopProgram : EControl::GoOn, OpenStream::EControlOutcome::Refused, out);
    }
}

void OpenStreamRobotAdapter::WatchMotor(AdapterActions& out)
{
    SetArmState(EArmState::MotorOff, out);
    _outputs.armRequests.emplace_back(MakeMonitor(std::string(MOTOR_STATE_URL), MOTOR_PERIOD));
    SendControl(EControl::MotorOn, MOTOR_ON_URL, "{}");
    out.emplace_back(Planning::StartAdapterTimer{MOTOR_TIMER, MOTOR_RETRY});
}

void OpenStreamRobotAdapter::StartJob(const Planning::StartJob& job, AdapterActions& out)
{
    _recovery.reset();
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
    const std::uint32_t program = _methods.find(job.action)->second.armProgram;
    SendControl(
        EControl::SelectProgram,
        SELECT_URL,
        fmt::format(R"({{"pno":{},"sno":0,"fno":0,"ext_sel":0}})", program));
}

void OpenStreamRobotAdapter::FailJob(const std::string& reason, AdapterActions& out)
{
    EndJob();
    out.emplace_back(RaiseEvent{Planning::JobFailed{std::exchange(_jobID, {}), reason}});
    TellPaused(out);
}

/// Its program was surely not started: it can be commanded again.
void OpenStreamRobotAdapter::DisownJob(AdapterActions& out)
{
    EndJob();
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
        FollowPause(out); // its state shows what came of it
        return;
    }
    if (kind == EControl::StopProgram || kind == EControl::GoOn || kind == EControl::ResetProgram)
    {
        TakeSettledPause(kind, settled.outcome, out);
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
            LookAgain();
            break;
        case OpenStream::EControlOutcome::Refused:
            FailJob(fmt::format("the arm's controller refuses, status {}: {}", settled.status, settled.detail), out);
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
        TakeMotor(*line.result, out);
    }
    else if (_armState != EArmState::Lost)
    {
        TakeCounters(*line.result, out);
    }
}

void OpenStreamRobotAdapter::TakeMotor(const Core::JsonText& result, AdapterActions& out)
{
    const std::optional<MotorState> motor = ReadOrNull<MotorState>(result);
    if (!motor.has_value() || motor->value != MOTOR_IS_ON)
    {
        return;
    }
    out.emplace_back(Planning::CancelAdapterTimer{MOTOR_TIMER});
    SetArmState(EArmState::Counting, out);
    WatchCounters();
}

void OpenStreamRobotAdapter::WatchCounters()
{
    const std::size_t words = std::max({_options.startedIndex, _options.finishedIndex, _options.failedIndex}) + 1;
    OpenStream::MonitorRequest monitor = MakeMonitor(_options.monitorUrl, _options.period);
    monitor.args = Core::JsonText::FromTrusted(fmt::format(R"({{"st":{},"len":{}}})", _options.firstByte, words));
    _outputs.armRequests.emplace_back(std::move(monitor));
}

void OpenStreamRobotAdapter::TakeCounters(const Core::JsonText& result, AdapterActions& out)
{
    const std::optional<std::vector<std::int64_t>> words = ReadOrNull<std::vector<std::int64_t>>(result);
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
    SetArmState(EArmState::Ready, out);
    const bool bReset = HasFallen(before, _counters);
    const bool bBegun = _phase == EJobPhase::Starting || _phase == EJobPhase::Running;
    if (bReset && bBegun)
    {
        FailJob("the arm's controller was restarted while its program ran: its counters began again", out);
        return;
    }
    FindJob(out);
    FollowJob(out);
    if (_look == ELook::Due)
    {
        _look = ELook::None;
        TakeLook(out);
    }
    if (bFirst)
    {
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
    const bool bOnline = _bBaseOnline && _armState == EArmState::Ready;
    if (std::exchange(_bOnline, bOnline) != bOnline)
    {
        out.emplace_back(RaiseEvent{Planning::LinkChanged{bOnline}});
    }
}

} // namespace ACS::Acsd
