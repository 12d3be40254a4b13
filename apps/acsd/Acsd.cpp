#include "Acsd.hpp"

#include "AcsdCore.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "common/process/LoopWatchdog.hpp"
#include "common/process/TimerSet.hpp"
#include "config/LiveConfig.hpp"
#include "drivers/MqttRouter.hpp"
#include "drivers/RobotRunners.hpp"
#include "mcs/McsLink.hpp"
#include "operator/AcsdMetrics.hpp"
#include "operator/ActionRoutes.hpp"
#include "operator/AuditLog.hpp"
#include "operator/CommandRoutes.hpp"
#include "operator/DescriptionRoute.hpp"
#include "operator/HealthRoutes.hpp"
#include "operator/HttpInterfaces.hpp"
#include "operator/PageRoutes.hpp"
#include "operator/PlanLog.hpp"
#include "operator/ReadRoutes.hpp"
#include "operator/StateFeed.hpp"
#include "replay/RunTrace.hpp"
#include "store/StoreWorker.hpp"
#include "trace/TraceRoute.hpp"
#include "view/ViewCodec.hpp"
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

enum class ESampleTimer : std::uint8_t
{
    Plans
};

} // namespace

class Acsd::Impl final : private IAcsdOutput
{
    Dependencies _dependencies;
    AcsdConfig _config;
    Apps::MetricsEndpoint _metricsEndpoint;
    AcsdMetrics _metrics;
    PlanLog _planLog;
    RunTrace _runTrace;
    AcsdCore _core;
    StoreWorker _store;
    McsLink _mcs;
    MqttRouter _mqttRouter;
    std::optional<VDA5050::MosquittoLink> _mqtt; ///< Set if a robot needs the broker.
    RobotRunners _robots;
    Apps::TimerSet<AcsdTimer> _timers;
    Apps::TimerSet<ESampleTimer> _sampling;
    Apps::LoopWatchdog _watchdog;
    TraceRoute _traceRoute;
    HttpInterfaces _http;
    StateFeed _feed;
    std::size_t _openLinks = 0; ///< Of those that are being closed.
    StopHandler _stopHandler;

public:
    Impl(
        Dependencies dependencies,
        HttpAddresses& addresses,
        AcsdConfig config,
        std::unique_ptr<Planning::IPlanStore> store,
        const std::string& identity,
        std::unique_ptr<AuditLog> audit)
        : _dependencies(std::move(dependencies)),
          _config(std::move(config)),
          _metrics(_metricsEndpoint, _dependencies.clock.GetNow()),
          _planLog(_dependencies.logger.MakeFor("plan"), _metricsEndpoint),
          _runTrace(_dependencies.traceOrNull, _config, _dependencies.clock.GetNow()),
          _core(
              _runTrace.Wrap({_dependencies.clock, _dependencies.random, _dependencies.logger, *this, _mcs}),
              _config),
          _store(
              _dependencies.executor,
              std::move(store),
              [this](const Core::Result<void>& result) { _core.OnStored(result); },
              [this](const Core::Result<Planning::StoreLog>& checked) { OnStoreChecked(checked); }),
          _mcs(
              _dependencies.clock,
              _dependencies.logger.MakeFor("mcs"),
              [this](const Protocol::SessionEvent& event) { _core.OnSessionEvent(event); }),
          _mqttRouter(
              {_dependencies.logger.MakeFor("mqtt"),
               _dependencies.traceOrNull,
               [this](bool bUp) { bUp ? _core.OnMqttUp() : _core.OnMqttDown(); },
               [this] { return _core.IsClosed(); },
               _dependencies.mayCommand}),
          _robots(
              {_dependencies.executor,
               _dependencies.clock,
               _dependencies.random,
               _dependencies.logger,
               _metricsEndpoint,
               _dependencies.traceOrNull,
               &_mqttRouter,
               [this](const std::string& robotID, const RobotActionRecord& record) { OnAction(robotID, record); },
               _dependencies.mayCommand},
              _config.robots,
              [this](const std::string& robotID, const Planning::RobotEvent& event) {
                  _core.OnRobotEvent(robotID, event);
              }),
          _timers(_dependencies.executor, [this](const AcsdTimer& timer) { _core.OnTimer(timer); }),
          _sampling(_dependencies.executor, [this](ESampleTimer /*timer*/) { SampleMetrics(); }),
          _watchdog(
              _dependencies.executor,
              {_config.operations.stallLimit, _dependencies.aliveInterval},
              {[this](Core::Duration stall) { OnStall(stall); }, _dependencies.onAlive}),
          _traceRoute(_dependencies.executor, _dependencies.traceOrNull),
          _http(
              {_dependencies.executor, _dependencies.clock, _dependencies.logger, addresses},
              _config.http.control.access,
              std::move(audit)),
          _feed(
              {_dependencies.executor,
               _dependencies.clock,
               _core.GetEngine(),
               [this] { return GetProgramState(); },
               _http.GetEvents()})
    {
        _core.AddObserver(_feed.GetObserver());
        _core.AddObserver(_runTrace.GetObserver());
        _core.AddObserver(_planLog);
        _planLog.CreateSeries(_config.engine);
        AddRoutes();
        if (_config.mqtt.has_value())
        {
            _mqtt.emplace(
                _dependencies.executor,
                _dependencies.random,
                _dependencies.logger.MakeFor("mqtt"),
                MakeMqttOptions(
                    *_config.mqtt,
                    _dependencies.random,
                    {identity, _config.robots.size(), _dependencies.mayCommand}),
                _mqttRouter);
            _mqttRouter.SetLink(*_mqtt);
        }
    }

    [[nodiscard]] Core::Result<void> Open(Planning::StoredState state)
    {
        return _mcs.Open(_dependencies.executor, _dependencies.random, _config, _dependencies.traceOrNull).map([&] {
            _http.GetGate().Restore(state.receipts);
            _core.Restore(std::move(state));
            _http.Open();
        });
    }

    void Start()
    {
        _watchdog.Start();
        SampleMetrics();
        _robots.Start();
        _core.Start();
        _feed.Start();
        if (_mqtt.has_value())
        {
            _mqtt->Start();
        }
        _mcs.Start();
    }

    void StopAsync(StopHandler handler)
    {
        _stopHandler = std::move(handler);
        _core.Stop();
    }

    void Reload(const AcsdConfig& fresh)
    {
        LogChange(_config, fresh, _dependencies.logger.MakeFor("config"));
        ApplyLiveKeys(fresh, _config);
        _core.Reload(_config);
        _mcs.SetLimits(_config.mcs);
        _mcs.ReloadTLS();
        _http.ReloadTokens(fresh.http.control, _config.http.control);
        if (_dependencies.traceOrNull != nullptr)
        {
            _dependencies.traceOrNull->SetLimits(_config.operations.trace);
        }
    }

private:
    void Store(const Planning::StoreBatch& batch) override
    {
        _store.Append(batch);
    }

    void CheckStore() override
    {
        _store.CheckAsync();
    }

    void OnStoreChecked(const Core::Result<Planning::StoreLog>& checked)
    {
        if (!checked.has_value())
        {
            _core.OnStoreLost(checked.error());
            return;
        }
        _metrics.UpdateStoreLog(*checked);
        _core.OnStoreLog(*checked);
    }

    void CommandRobot(const Planning::CommandRobot& command) override
    {
        if (CanCommand())
        {
            _robots.Handle(command);
        }
    }

    void StartTimer(const AcsdTimer& timer, Core::Duration delay) override
    {
        _timers.Start(timer, delay);
    }

    void CancelTimer(const AcsdTimer& timer) override
    {
        _timers.Cancel(timer);
    }

    void CancelTimers() override
    {
        _timers.CancelAll();
    }

    /// Its sender was answered 202, so that an operator must see it; the same request with the same key is executed again.
    void OnOperatorRefused(const RefusedOffer& refused) override
    {
        const std::string text =
            fmt::format("{} was accepted but is not executed: {}", refused.command, refused.reason);
        _dependencies.logger.MakeFor("operator").Warning(text);
        if (refused.receipt.has_value())
        {
            _http.GetGate().Forget(*refused.receipt);
        }
        const ChangeEntry entry{"note", {}, {}, 0, {}, text, {}};
        _http.GetEvents().Publish("entry", EncodeEntry(entry, _dependencies.clock.GetNow().wall));
    }

    void CloseLinks() override
    {
        _openLinks = _mqtt.has_value() ? 2 : 1;
        _robots.Stop();
        if (_mqtt.has_value())
        {
            _mqtt->StopAsync(std::nullopt, VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, [this] { OnLinkClosed(); });
        }
        _mcs.StopAsync([this] { OnLinkClosed(); });
    }

    [[nodiscard]] bool CanCommand() const
    {
        return !_dependencies.mayCommand || _dependencies.mayCommand();
    }

    void OnLinkClosed()
    {
        if (--_openLinks == 0)
        {
            _core.OnLinksClosed();
        }
    }

    void OnStopped() override
    {
        _feed.Stop();
        _http.Close();
        _watchdog.Stop();
        _sampling.CancelAll();
        if (_stopHandler)
        {
            std::exchange(_stopHandler, nullptr)();
        }
    }

    void OnStoreTaken(const std::string& reason) override
    {
        _dependencies.onStoreTaken(reason);
    }

    void ObserveCommit(Core::Duration duration) override
    {
        _metrics.ObserveCommit(duration);
    }

    void ObserveAckWait(Core::Duration wait) override
    {
        _metrics.ObserveAckWait(wait);
    }

    void OnStall(Core::Duration stall)
    {
        _metrics.ObserveStall(stall);
        _dependencies.logger.Warning(
            "the event loop was blocked",
            {{"seconds", fmt::format("{:.3f}", std::chrono::duration<double>(stall).count())}});
    }

    [[nodiscard]] std::string GetConnectedBroker() const
    {
        return _core.IsMqttUp() ? MakeText(_config.mqtt->urls.at(_mqtt->GetBrokerIndex())) : std::string();
    }

    [[nodiscard]] std::vector<LinkStatus> GetLinks() const
    {
        std::vector<LinkStatus> links{_mcs.GetLink()};
        if (_mqtt.has_value())
        {
            links.push_back({"mqtt", _core.IsMqttUp(), {}, GetConnectedBroker()});
        }
        return links;
    }

    [[nodiscard]] ProgramState GetProgramState() const
    {
        ProgramState program{
            GetLinks(),
            _core.GetNotReadyReasons(),
            _core.GetPublishedConnectedOrNull(),
            _core.GetRefusedReports()};
        for (const RobotLinkConfig& robot : _config.robots)
        {
            program.robots.emplace(
                robot.robotID,
                RobotLinkState{robot.driver, robot.ports, robot.topicPrefix, _robots.GetDetails(robot.robotID)});
        }
        return program;
    }

    void AddRoutes()
    {
        Apps::HttpRoutes& monitoring = _http.GetMonitoringRoutes();
        AddHealthRoutes(monitoring, [this] { return GetProgramState(); });
        monitoring.Add("GET", "/metrics", [this](const auto&, const auto&) {
            UpdateMetrics();
            return _metricsEndpoint.Respond();
        });
        Apps::HttpRoutes& commands = _http.GetGate().GetRoutes();
        AddReadRoutes(
            commands,
            _core.GetEngine(),
            {_dependencies.clock,
             [this]() -> const StateView& { return _feed.Read(); },
             [this]() -> const StateView& { return _feed.Update(); },
             [this] {
                 return _feed.GetEventID();
             }});
        commands.Add("GET", "/v1/trace", [this](const Apps::HttpRequest& request, const auto&) {
            return _traceRoute.Respond(request);
        });
        AddDescriptionRoute(commands);
        AddPageRoutes(commands);
        AddCommandRoutes(
            commands,
            _core.GetEngine(),
            {[this](Planning::PlanCommand command, std::optional<Planning::CommandReceipt> receiptOrNull) {
                 return _core.Offer(std::move(command), std::move(receiptOrNull));
             },
             [this](const Apps::HttpResponse& answer) { return _http.GetGate().MakeReceiptOrNull(answer); },
             [this] {
                 return _core.GetStoreFaultOrNull();
             }});
        AddActionRoutes(
            commands,
            {[this] { return _core.IsStopping() || !CanCommand(); },
             [this](const std::string& robotID) -> std::optional<RobotActionsView> {
                 const RobotRunner* const robotOrNull = _robots.FindOrNull(robotID);
                 return robotOrNull == nullptr
                     ? std::nullopt
                     : std::optional(RobotActionsView{robotOrNull->GetActions(), robotOrNull->ListActionOffers()});
             },
             [this](const std::string& robotID, RobotActionRequest request, std::string reason)
                 -> std::optional<ActionAccess::Requested> {
                 RobotRunner* const robotOrNull = _robots.FindOrNull(robotID);
                 return robotOrNull == nullptr
                     ? std::nullopt
                     : std::optional(robotOrNull->RequestAction(std::move(request), std::move(reason)));
             }});
    }

    /// The engine does not know of it: only operators see it.
    void OnAction(const std::string& robotID, const RobotActionRecord& record)
    {
        const std::string text = DescribeAction(robotID, record);
        const ChangeEntry entry{"action", robotID, {}, 0, {}, text, {}};
        _http.GetEvents().Publish("entry", EncodeEntry(entry, _dependencies.clock.GetNow().wall));
    }

    void SampleMetrics()
    {
        _planLog.Sample(_core.GetEngine(), _dependencies.clock.GetNow());
        _sampling.Start(ESampleTimer::Plans, PlanLog::SAMPLE_PERIOD);
    }

    void UpdateMetrics()
    {
        const Core::Now now = _dependencies.clock.GetNow();
        _metrics.UpdateProcess();
        _planLog.Sample(_core.GetEngine(), now);
        _metrics.UpdateReady(GetLinks(), _core.GetNotReadyReasons().empty());
        if (_mqtt.has_value())
        {
            _metrics.UpdateBrokers(_config.mqtt->urls, GetConnectedBroker());
        }
        _metrics.UpdateMCS(_mcs, _core.GetRefusedReports(), _core.GetPublishedConnectedOrNull().value_or(true));
        _metrics.UpdatePlans(_core.GetEngine(), _core.GetStoreFaultOrNull().has_value(), now);
        _robots.UpdateMetrics();
        _metrics.UpdateAudit(_http.GetLostAudit());
        if (_dependencies.countDroppedLines)
        {
            _metrics.UpdateLog(_dependencies.countDroppedLines());
        }
        if (_dependencies.traceOrNull != nullptr)
        {
            _metrics.UpdateTrace(_dependencies.traceOrNull->GetLost());
        }
    }
};

Acsd::Acsd(std::unique_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

Acsd::~Acsd() = default;

Core::Result<std::unique_ptr<Acsd>> Acsd::Create(
    Dependencies dependencies,
    HttpAddresses& addresses,
    AcsdConfig config,
    OpenedStore store)
{
    assert(config.errors.empty());
    dependencies.logger.MakeFor("store").Info(store.summary, {{"store", config.store.GetName()}});
    const OperatorConfig& control = config.http.control;
    Core::Result<std::unique_ptr<AuditLog>> audit = AuditLog::Create(
        control.auditDirectory,
        control.auditLimits,
        dependencies.clock,
        dependencies.logger.MakeFor("audit"));
    if (!audit)
    {
        return tl::unexpected<Core::Error>(audit.error());
    }
    auto impl = std::make_unique<Impl>(
        std::move(dependencies),
        addresses,
        std::move(config),
        std::move(store.store),
        store.identity,
        std::move(*audit));
    const Core::Result<void> opened = impl->Open(std::move(store.state));
    if (!opened)
    {
        return tl::unexpected<Core::Error>(opened.error());
    }
    return std::unique_ptr<Acsd>(new Acsd(std::move(impl)));
}

void Acsd::Start()
{
    _impl->Start();
}

void Acsd::StopAsync(StopHandler handler)
{
    _impl->StopAsync(std::move(handler));
}

void Acsd::Reload(const AcsdConfig& fresh)
{
    _impl->Reload(fresh);
}

} // namespace ACS::Acsd
