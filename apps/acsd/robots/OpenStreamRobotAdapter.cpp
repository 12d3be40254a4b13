#include "robots/OpenStreamRobotAdapter.hpp"

#include "robots/ArmTimers.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;

} // namespace

OpenStreamRobotAdapter::OpenStreamRobotAdapter(
    VDA5050::MasterOptions base,
    ArmOptions arm,
    JobMethods methods,
    ArmInputResolver inputs,
    RobotOutputs& outputs,
    std::shared_ptr<DriveCheck> drives,
    const std::vector<NeededMap>& maps)
    : _base(std::move(base), methods, outputs, Vda5050RobotAdapter::LOAD_TIMEOUT, std::move(drives), maps),
      _options(std::move(arm)),
      _methods(std::move(methods)),
      _resolveInputs(std::move(inputs)),
      _controls(outputs),
      _monitor(_options, outputs, _controls),
      _program(_options, _controls)
{
}

void OpenStreamRobotAdapter::Handle(const Planning::RobotCommand& command, Core::Now now, AdapterActions& out)
{
    const Planning::StartJob* jobOrNull = std::get_if<Planning::StartJob>(&command);
    const Planning::RecoverJob* recoverOrNull = std::get_if<Planning::RecoverJob>(&command);
    const Planning::CancelJob* cancelOrNull = std::get_if<Planning::CancelJob>(&command);
    const Planning::Drive* driveOrNull = std::get_if<Planning::Drive>(&command);
    if (jobOrNull != nullptr)
    {
        StartJob(*jobOrNull, now, out);
    }
    else if (recoverOrNull != nullptr)
    {
        _recovery = Recovery{recoverOrNull->job};
        if (_monitor.IsReady())
        {
            RecoverJob(out);
            Update(out);
        }
    }
    else if (cancelOrNull != nullptr)
    {
        CancelJob(cancelOrNull->jobID, now, out);
    }
    else if (driveOrNull != nullptr && (_recovery.has_value() || _program.HasJob()))
    {
        ReleaseJob(out);
        out.emplace_back(Planning::RaiseEvent{
            Planning::DriveRejected{driveOrNull->driveID, "the arm still runs the program of an earlier job"}});
    }
    else
    {
        const bool bPause = std::holds_alternative<Planning::Pause>(command);
        if (bPause || std::holds_alternative<Planning::Resume>(command))
        {
            _program.SetPauseWanted(bPause);
            Update(out);
        }
        _base.Handle(command, now, _baseActions);
        DrainBase(now, out);
    }
}

void OpenStreamRobotAdapter::OnTimer(Planning::AdapterTimerID timer, Core::Now now, AdapterActions& out)
{
    switch (timer)
    {
        case ArmTimers::RETRY:
            if (!_monitor.TryRetry(out) && !_monitor.IsProbing())
            {
                _program.Retry();
            }
            break;
        case ArmTimers::PROBE:
            OnProbeTimer(out);
            break;
        case ArmTimers::EFFECT:
            _monitor.OnEffectTimer();
            break;
        case ArmTimers::START:
            if (_monitor.IsReady())
            {
                _program.OnStartTimer(_evidence.IsEchoed(), _evidence.IsZero(), out);
            }
            break;
        case ArmTimers::INPUT:
            _program.OnInputTimer(out);
            break;
        default:
            _base.OnTimer(timer, now, _baseActions);
            DrainBase(now, out);
            return;
    }
    Update(out);
}

std::optional<std::string> OpenStreamRobotAdapter::GetRejectionReasonOrNull(std::string_view action) const
{
    const JobMethod* const methodOrNull = _methods.FindMethodOrNull(action);
    if (methodOrNull == nullptr || methodOrNull->armProgram == 0)
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
    DrainBase(now, out);
}

void OpenStreamRobotAdapter::OnLinkDown(Core::Now now, AdapterActions& out)
{
    _base.OnLinkDown(now, _baseActions);
    DrainBase(now, out);
}

tl::expected<std::string, RobotActionRefusal> OpenStreamRobotAdapter::RequestAction(
    const RobotActionRequest& request,
    Core::Now now,
    AdapterActions& out)
{
    tl::expected<std::string, RobotActionRefusal> sent = _base.RequestAction(request, now, _baseActions);
    DrainBase(now, out);
    return sent;
}

void OpenStreamRobotAdapter::OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, AdapterActions& out)
{
    _base.OnMqttMessage(message, now, _baseActions);
    DrainBase(now, out);
}

const VDA5050::MasterSession& OpenStreamRobotAdapter::GetSession() const noexcept
{
    return _base.GetSession();
}

void OpenStreamRobotAdapter::OnArmEvent(const OpenStream::ClientEvent& event, Core::Now /*now*/, AdapterActions& out)
{
    std::visit(
        Core::Overloaded{
            [&](const OpenStream::ClientReady&) {
                _monitor.WatchMotor(out);
                ReportArm(out);
            },
            [&](const OpenStream::ClientData& data) { OnData(data.line, out); },
            [&](const OpenStream::ClientControlSettled& settled) { OnSettled(settled, out); },
            [&](const OpenStream::ClientMonitorStarted& started) { _monitor.OnAccepted(started.requestNumber); },
            [&](const OpenStream::ClientMonitorRefused& refused) {
                OnFact(_monitor.OnRefused(refused, out), out);
                Update(out);
            },
            [&](const OpenStream::ClientControlFault& fault) { OnFault(fault, out); },
            [&](const OpenStream::ClientLost&) { OnLost(out); },
            [](const auto&) {
            }},
        event);
}

void OpenStreamRobotAdapter::OnLost(AdapterActions& out)
{
    _monitor.OnLost(out);
    _trouble.reset(); // the robot is reported offline instead
    ReportArm(out);   // before a job is returned, because the engine would command it again at once
    const bool bHadJob = _program.HasJob();
    _program.OnLost(out);
    if (bHadJob && !_program.HasJob())
    {
        ReportActivity(out);
    }
}

void OpenStreamRobotAdapter::OnFault(const OpenStream::ClientControlFault& fault, AdapterActions& out)
{
    const ArmRefusal refusal = MakeArmRefusal(fault.status, fault.body, fault.detail);
    if (!_monitor.TryHandleFault(refusal.reason))
    {
        _program.OnFault(refusal, out);
        Update(out);
    }
}

void OpenStreamRobotAdapter::OnSettled(const OpenStream::ClientControlSettled& settled, AdapterActions& out)
{
    const std::optional<ArmSettlement> settlementOrNull = _controls.SettleOrNull(settled);
    if (!settlementOrNull.has_value())
    {
        return;
    }
    if (settlementOrNull->kind == EArmControl::SwitchMotorOn)
    {
        _monitor.OnMotorSettled(*settlementOrNull);
        Update(out);
        return;
    }
    _program.OnSettled(*settlementOrNull, out);
    if (settled.outcome == OpenStream::EControlOutcome::Unknown)
    {
        ReportActivity(out); // the connection is gone: the program continues when the counters are back
    }
    else
    {
        Update(out);
    }
}

void OpenStreamRobotAdapter::OnData(const OpenStream::DataLine& line, AdapterActions& out)
{
    if (line.result.has_value())
    {
        OnFact(_monitor.OnSample(*line.result, out), out);
    }
}

void OpenStreamRobotAdapter::OnFact(const ArmFact& fact, AdapterActions& out)
{
    std::visit(
        Core::Overloaded{
            [](const std::monostate&) {},
            [&](const ArmCounted& counted) { OnCounted(counted, out); },
            [&](const ArmEffectShown& shown) {
                if (_program.IsEffectShown(shown.state))
                {
                    _monitor.EndEffect(out);
                }
            },
            [&](const ArmProbed& probed) { OnProbed(probed, out); },
            [&](const ArmRelaysRead& read) {
                _program.OnInputsRead(read.ranges, out);
                if (_program.IsReadingInputs())
                {
                    _monitor.RepeatRelays();
                }
                Update(out);
            },
            [&](const ArmRelaysRefused& refused) {
                _program.OnInputsRefused(refused.reason, out);
                Update(out);
            }},
        fact);
}

void OpenStreamRobotAdapter::OnCounted(const ArmCounted& counted, AdapterActions& out)
{
    const ArmJobEvidence::EChange change = _evidence.Update(counted.sample);
    if (change != ArmJobEvidence::EChange::None)
    {
        ReportState(out); // with the new progress token, before the next job begins
    }
    if (counted.bFirst)
    {
        _program.ForgetHalt();
    }
    ReportArm(out);
    if (change == ArmJobEvidence::EChange::Fallen && _program.IsCounted())
    {
        _program.OnRestarted(out);
        Update(out);
        return;
    }
    if (_recovery.has_value())
    {
        RecoverJob(out);
    }
    if (_program.IsCounted())
    {
        const ArmProof proof = _evidence.Evaluate();
        _program.OnProof(proof, _evidence.DescribeEcho(), out);
    }
    else if (_program.IsPreparing() && !_evidence.IsUnchanged())
    {
        _program.ReportNotStarted(out);
    }
    if (!counted.bFirst)
    {
        _program.OnCounted(IsProgramWatched(), out);
    }
    if (counted.bVerifies)
    {
        _program.OnVerified(_evidence.IsUnchanged(), counted.stateOrNull, out);
    }
    if (counted.bFirst)
    {
        _program.OnCountersBack(out);
    }
    Update(out);
}

void OpenStreamRobotAdapter::OnProbed(const ArmProbed& probed, AdapterActions& out)
{
    const bool bMotor = probed.probe == EArmProbe::Motor;
    if (bMotor && probed.bOnOrNull == false && _program.IsMotorDecisive())
    {
        _monitor.WatchMotor(out); // forgets why the motor could not be switched on earlier
        _monitor.ReportMotorOff();
        ReportArm(out); // before a job is returned, because the engine would command it again at once
        _program.OnMotorOff(out);
    }
    else if (bMotor)
    {
        _monitor.WatchCounters();
        _program.OnMotorProbed(out);
    }
    else
    {
        _monitor.WatchCounters();
        _program.OnPlaybackProbed(probed, IsProgramWatched());
    }
    Update(out);
}

/// MONITOR shows one thing at a time: a probe replaces the counters for one sample.
void OpenStreamRobotAdapter::OnProbeTimer(AdapterActions& out)
{
    const bool bWatched = IsProgramWatched();
    if (_monitor.IsReady() && !bWatched && !_program.IsResumeDue())
    {
        _program.ForgetHalt();
    }
    std::optional<EArmProbe> wanted;
    if (!_program.HasJob())
    {
        wanted = EArmProbe::Motor;
    }
    else if (bWatched)
    {
        wanted = EArmProbe::Playback;
    }
    OnFact(_monitor.OnProbeTimer(wanted, out), out);
}

void OpenStreamRobotAdapter::ServeProgram(AdapterActions& out)
{
    for (std::vector<EArmRequest> requests = _program.TakeRequests(); !requests.empty();
         requests = _program.TakeRequests())
    {
        for (const EArmRequest request : requests)
        {
            Serve(request, out);
        }
    }
}

void OpenStreamRobotAdapter::Serve(EArmRequest request, AdapterActions& out)
{
    switch (request)
    {
        case EArmRequest::VerifyEffect:
            _monitor.VerifyEffect(out);
            break;
        case EArmRequest::VerifyCounters:
            _monitor.VerifyCounters();
            break;
        case EArmRequest::ReadInputs:
        {
            std::vector<ArmRelay> relays;
            for (const ArmInput& input : _program.GetInputs())
            {
                relays.push_back(input.relay);
            }
            _monitor.ReadRelays(MakeRelayRanges(relays));
            break;
        }
        case EArmRequest::ProbeMotor:
            if (_monitor.IsHidden(EArmProbe::Motor))
            {
                _program.OnMotorProbed(out);
                break;
            }
            _monitor.BeginProbe(EArmProbe::Motor, out);
            break;
        case EArmRequest::ProbePlayback:
            if (_monitor.IsHidden(EArmProbe::Playback))
            {
                _program.OnPlaybackHidden(out);
                break;
            }
            _monitor.BeginProbe(EArmProbe::Playback, out);
            break;
        default:
            break;
    }
}

void OpenStreamRobotAdapter::Update(AdapterActions& out)
{
    ServeProgram(out);
    if (_monitor.IsReadingRelays() && !_program.IsReadingInputs())
    {
        _monitor.WatchCounters();
    }
    _program.Advance(IsFree(), _monitor.IsProbing(), out);
    ServeProgram(out);
    ReportArm(out);
    ReportActivity(out);
}

bool OpenStreamRobotAdapter::IsFree() const
{
    return _controls.IsIdle() && _monitor.IsIdle();
}

bool OpenStreamRobotAdapter::IsProgramWatched() const
{
    return IsFree() && _program.IsStarted();
}

} // namespace ACS::Acsd
