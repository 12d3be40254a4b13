#include "AcsdCore.hpp"

#include "replay/RecordedConfig.hpp"
#include "replay/RecordedInput.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

/// More plans than the engine accepts would wait in vain.
Planning::InputLimits MakeInputLimits(const Planning::EngineOptions& options)
{
    Planning::InputLimits limits;
    limits.plans = options.maximumPlans;
    return limits;
}

Planning::EngineOptions MakeEngineOptions(const AcsdConfig& config)
{
    Planning::EngineOptions options = config.engine;
    options.mcsCodes = MakeMcsCodes(config.mcs.style.errors);
    return options;
}

} // namespace

AcsdCore::AcsdCore(Dependencies dependencies, const AcsdConfig& config)
    : _dependencies(std::move(dependencies)),
      _operations(config.operations),
      _engine(MakeEngineOptions(config), *config.site, _dependencies.random),
      _host(
          _engine,
          _dependencies.clock,
          [this](const Planning::EngineAction& action) {
              if (_dependencies.filter)
              {
                  _dependencies.filter(action, [this](const Planning::EngineAction& passed) { Execute(passed); });
              }
              else
              {
                  Execute(action);
              }
          },
          [this](const Planning::StoreBatch& batch) { Store(batch); },
          MakeInputLimits(config.engine)),
      _gateway(
          _dependencies.clock,
          _dependencies.random,
          _dependencies.logger.MakeFor("mcs"),
          config.localOffset,
          _engine,
          _dependencies.mcs,
          [this](Planning::PlanCommand command) {
              _host.Push(std::move(command));
              UpdateDrain();
          }),
      _storeWatch(_dependencies.logger.MakeFor("store")),
      _bBrokerNeeded(
          std::ranges::none_of(config.robots, [](const RobotLinkConfig& robot) { return robot.topicPrefix.empty(); }))
{
    _gateway.SetStyle(config.mcs.style);
    _gateway.SetAckObserver([this](Core::Duration wait) { _dependencies.output.ObserveAckWait(wait); });
}

void AcsdCore::AddObserver(Planning::IPlanObserver& observer)
{
    _engine.AddObserver(observer);
}

void AcsdCore::Restore(Planning::StoredState state)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&state] { return RestoreInput{state}; });
    _gateway.Restore(state.outbox);
    _host.Restore(std::move(state));
}

void AcsdCore::Start()
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [] { return StartInput{}; });
    _dependencies.output.StartTimer(EAcsdTimer::WorkGrace, _operations.workGrace);
    StartStatusTimer();
    CheckStore();
    _gateway.Begin();
}

void AcsdCore::Reload(const AcsdConfig& config)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&config] {
        return ReloadInput{MakeRecordedConfig(config)};
    });
    _operations = config.operations;
    _gateway.SetStyle(config.mcs.style);
    if (_phase == EPhase::Running)
    {
        StartStatusTimer();
    }
}

void AcsdCore::Stop()
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [] { return StopInput{}; });
    if (_phase != EPhase::Running)
    {
        return;
    }
    _phase = EPhase::Draining;
    _dependencies.output.CancelTimer(EAcsdTimer::WorkGrace);
    _dependencies.output.StartTimer(EAcsdTimer::Drain, _operations.drainTimeout);
    _gateway.BeginDraining();
    UpdateDrain();
}

void AcsdCore::Close()
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [] { return CloseInput{}; });
    DoClose();
}

void AcsdCore::DoClose()
{
    if (IsClosed())
    {
        return;
    }
    _phase = EPhase::Closing;
    _host.Close();
    _dependencies.output.CancelTimers();
    _dependencies.output.StartTimer(EAcsdTimer::Stop, STOP_LIMIT);
    if (!_host.IsStoring()) // otherwise the actions that wait for the transaction are executed first
    {
        CloseLinks();
    }
}

void AcsdCore::OnSessionEvent(const Protocol::SessionEvent& event)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&event] { return event; });
    _gateway.OnSessionEvent(event);
    UpdateDrain();
}

void AcsdCore::OnRobotEvent(const std::string& robotID, const Planning::RobotEvent& event)
{
    ICoreRecorder* const recorderOrNull = _dependencies.recorderOrNull;
    const RecordedInput recorded(recorderOrNull, [&] { return Planning::RobotInput{robotID, event}; });
    _host.Push(
        Planning::RobotInput{robotID, recorderOrNull == nullptr ? event : recorderOrNull->Watch(robotID, event)});
}

void AcsdCore::OnTimer(const AcsdTimer& timer)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&timer] { return timer; });
    std::visit(
        Core::Overloaded{
            [this](EAcsdTimer own) { OnOwnTimer(own); },
            [this](const Planning::EngineTimer& ofEngine) {
                _host.Push(ofEngine);
            }},
        timer);
}

void AcsdCore::OnMqttUp()
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [] { return MqttInput{true}; });
    _bMqttUp = true;
    UpdateWorking();
}

void AcsdCore::OnMqttDown()
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [] { return MqttInput{false}; });
    _bMqttUp = false;
    UpdateWorking();
}

void AcsdCore::OnStored(const Core::Result<void>& result)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&result] {
        return StoredInput{result.has_value() ? std::nullopt : std::optional(result.error())};
    });
    if (_phase == EPhase::Stopped || TryEndForTakenStore(result))
    {
        return; // the store was late
    }
    _dependencies.output.CancelTimer(EAcsdTimer::StoreLate);
    _dependencies.output.ObserveCommit(_storeWatch.OnStored(result, _dependencies.clock.GetNow().steady));
    _host.OnStored(result);
    UpdateDrain();
    if (_phase == EPhase::Closing && !_host.IsStoring())
    {
        CloseLinks();
    }
}

void AcsdCore::OnStoreLost(const Core::Error& error)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&error] { return StoreLostInput{error}; });
    if (!TryEndForTakenStore(tl::unexpected(error)) && !_host.IsStoring())
    {
        _storeWatch.OnLost(error, _dependencies.clock.GetNow().steady);
        _host.OnStoreLost(error);
    }
}

void AcsdCore::OnStoreLog(const Planning::StoreLog& log)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&log] { return log; });
    _host.Push(log);
}

void AcsdCore::OnLinksClosed()
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [] { return LinksClosedInput{}; });
    if (_phase == EPhase::Leaving)
    {
        FinishStop();
    }
}

Planning::EInputAdmission AcsdCore::Offer(
    Planning::PlanCommand command,
    std::optional<Planning::CommandReceipt> receiptOrNull)
{
    const RecordedInput recorded(_dependencies.recorderOrNull, [&] { return OfferInput{command, receiptOrNull}; });
    if (IsStopping())
    {
        return Planning::EInputAdmission::Closed; // what waits for the store when the host closes would be lost
    }
    const Planning::ReplyToken token = _offers.Add(command, receiptOrNull);
    const Planning::EInputAdmission admission = _host.Offer(std::move(command), std::move(receiptOrNull));
    if (admission != Planning::EInputAdmission::Accepted)
    {
        _offers.Remove(token);
    }
    return admission;
}

const Planning::PlanEngine& AcsdCore::GetEngine() const noexcept
{
    return _engine;
}

const RefusedReports& AcsdCore::GetRefusedReports() const noexcept
{
    return _gateway.GetRefusedReports();
}

std::optional<bool> AcsdCore::GetPublishedConnectedOrNull() const noexcept
{
    return _gateway.GetPublishedWorkingOrNull();
}

bool AcsdCore::IsMqttUp() const noexcept
{
    return _bMqttUp;
}

bool AcsdCore::IsStopping() const noexcept
{
    return _phase != EPhase::Running;
}

bool AcsdCore::IsClosed() const noexcept
{
    return _phase >= EPhase::Closing;
}

std::optional<std::string> AcsdCore::GetStoreFaultOrNull() const
{
    return _storeWatch.GetFaultOrNull();
}

std::vector<std::string> AcsdCore::GetNotReadyReasons() const
{
    std::vector<std::string> reasons;
    if (IsStopping())
    {
        reasons.emplace_back("acsd draining for shutdown");
    }
    if (std::optional<std::string> faultOrNull = _storeWatch.GetFaultOrNull())
    {
        reasons.push_back(std::move(*faultOrNull));
    }
    return reasons;
}

void AcsdCore::Store(const Planning::StoreBatch& batch)
{
    _storeWatch.OnBegun(_dependencies.clock.GetNow().steady);
    _dependencies.output.StartTimer(EAcsdTimer::StoreLate, StoreWatch::LIMIT);
    _dependencies.output.Store(batch);
}

void AcsdCore::Execute(const Planning::EngineAction& action)
{
    std::visit(
        Core::Overloaded{
            [](const Planning::StorePlans&) { assert(false && "executed by the host"); },
            [this](const Planning::ReplyCommand& reply) { OnReply(reply); },
            [this](const Planning::SendReport& report) { _gateway.Report(report); },
            [this](const Planning::CommandRobot& command) { _dependencies.output.CommandRobot(command); },
            [this](const Planning::RobotStatusChanged& changed) { OnStatusChanged(changed.status); },
            [this](const Planning::TscStateChanged& changed) { _gateway.PublishTscState(changed.state); },
            [this](const Planning::StartEngineTimer& start) {
                _dependencies.output.StartTimer(start.timer, start.delay);
            },
            [this](const Planning::CancelEngineTimer& cancel) {
                _dependencies.output.CancelTimer(cancel.timer);
            }},
        action);
}

void AcsdCore::OnReply(const Planning::ReplyCommand& reply)
{
    _gateway.Reply(reply);
    if (const std::optional<RefusedOffer> refused = _offers.EndOrNull(reply))
    {
        _dependencies.output.OnOperatorRefused(*refused);
    }
}

void AcsdCore::OnStatusChanged(const Planning::RobotStatus& status)
{
    _gateway.PublishStatus(status);
    if (status.status == Planning::ERobotStatus::Disconnected)
    {
        _reachable.erase(status.robotID);
    }
    else
    {
        _reachable.insert(status.robotID);
    }
    UpdateWorking();
}

void AcsdCore::OnOwnTimer(EAcsdTimer timer)
{
    switch (timer)
    {
        case EAcsdTimer::WorkGrace:
            _gateway.PublishWorking(false);
            break;
        case EAcsdTimer::Drain:
        case EAcsdTimer::Settle:
            DoClose();
            break;
        case EAcsdTimer::Stop:
            FinishStop();
            break;
        case EAcsdTimer::Status:
            RepeatStatuses();
            break;
        case EAcsdTimer::StoreLate:
            _storeWatch.OnLate();
            break;
        case EAcsdTimer::StoreCheck:
            CheckStore();
            break;
        default:
            assert(false);
            break;
    }
}

/// Two acsd must not command the same robots. The rest of a transaction is not executed.
bool AcsdCore::TryEndForTakenStore(const Core::Result<void>& result)
{
    if (result.has_value() || result.error().code != Planning::EPlanningError::StoreTaken)
    {
        return false;
    }
    if (_phase != EPhase::Stopped)
    {
        _phase = EPhase::Stopped;
        _dependencies.output.CancelTimers();
        _dependencies.output.OnStoreTaken(Core::Describe(result.error()));
    }
    return true;
}

/// Section 6.21: no work can be accepted while all robots are away, or the broker that each of them needs; reported after a grace
/// time.
void AcsdCore::UpdateWorking()
{
    const bool bWorking = (_bMqttUp || !_bBrokerNeeded) && !_reachable.empty();
    if (_phase != EPhase::Running || bWorking == std::exchange(_bWorking, bWorking))
    {
        return;
    }
    if (bWorking)
    {
        _dependencies.output.CancelTimer(EAcsdTimer::WorkGrace);
        _gateway.PublishWorking(true);
    }
    else
    {
        _dependencies.output.StartTimer(EAcsdTimer::WorkGrace, _operations.workGrace);
    }
}

void AcsdCore::StartStatusTimer()
{
    if (_operations.statusInterval.count() > 0)
    {
        _dependencies.output.StartTimer(EAcsdTimer::Status, _operations.statusInterval);
    }
    else
    {
        _dependencies.output.CancelTimer(EAcsdTimer::Status);
    }
}

/// Section 5.2 allows this besides the update of each change (`robot.status_interval`).
void AcsdCore::RepeatStatuses()
{
    for (const Planning::RobotStatus& status : _engine.GetRobotStatuses())
    {
        _gateway.PublishStatus(status);
    }
    StartStatusTimer();
}

/// While the store fails, the engine retries its writes, which is a check as well. A check does not wait for a pause between two
/// writes: the log of a store that is always written grows fastest.
void AcsdCore::CheckStore()
{
    if (!_storeWatch.GetFaultOrNull().has_value())
    {
        _dependencies.output.CheckStore();
    }
    _dependencies.output.StartTimer(EAcsdTimer::StoreCheck, StoreWatch::CHECK_INTERVAL);
}

/// Without an MCS no report can be acknowledged: there is nothing to wait for.
void AcsdCore::UpdateDrain()
{
    if (_phase != EPhase::Draining || _host.IsStoring())
    {
        return;
    }
    if (!_dependencies.mcs.IsRegistered() || _engine.GetOutboxSummary().count == 0)
    {
        _phase = EPhase::Settling;
        _dependencies.output.StartTimer(EAcsdTimer::Settle, SETTLE_TIME);
    }
}

void AcsdCore::CloseLinks()
{
    _phase = EPhase::Leaving;
    _dependencies.output.CloseLinks();
}

void AcsdCore::FinishStop()
{
    _phase = EPhase::Stopped;
    _dependencies.output.CancelTimers();
    _dependencies.output.OnStopped();
}

} // namespace ACS::Acsd
