#include "Acsd.hpp"

#include "common/http/HttpRoutes.hpp"
#include "common/http/HttpServer.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "common/process/TimerSet.hpp"
#include "config/LiveConfig.hpp"
#include "mcs/McsLink.hpp"
#include "operator/AcsdMetrics.hpp"
#include "operator/AcsdStatus.hpp"
#include "operator/OperatorRoutes.hpp"
#include "operator/PlanLog.hpp"
#include "robots/RobotHost.hpp"
#include "store/StoreSummary.hpp"
#include "store/StoreWatch.hpp"
#include "store/StoreWorker.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/PlanEngineHost.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <cassert>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;

/// For the links to take leave, once nothing is left to be told.
constexpr std::chrono::milliseconds STOP_LIMIT = 5s;
/// The engine stores acknowledgements together, a little later: a stop waits for that.
constexpr std::chrono::milliseconds SETTLE_TIME = 300ms;

enum class EAcsdTimer : std::uint8_t
{
    WorkGrace,  ///< Until the MCS gets the report that no work can be accepted.
    Drain,      ///< For everything to be reported.
    Settle,     ///< Everything is reported; the acknowledgements are still to be stored.
    Stop,       ///< For the links to close.
    Status,     ///< Until the robots' statuses are repeated.
    StoreLate,  ///< For a batch to be stored.
    StoreCheck, ///< Until the store is checked again.
};

} // namespace

class Acsd::Impl final : public VDA5050::IMqttLinkListener
{
    Surroundings _surroundings;
    AcsdConfig _config;
    Apps::MetricsEndpoint _metrics;
    AcsdMetrics _figures;
    PlanLog _planLog;
    Planning::PlanEngine _engine;
    Planning::PlanEngineHost _host;
    StoreWatch _storeWatch;
    StoreWorker _store;
    McsLink _mcs;
    VDA5050::MosquittoLink _mqtt;
    std::map<std::string, std::unique_ptr<RobotHost>, std::less<>> _robots;
    /// By manufacturer and serial number: a message costs one look-up, however many robots there are.
    std::map<std::pair<std::string, std::string>, RobotHost*> _vehicles;
    std::set<std::string> _reachable; ///< Robots that are not Disconnected.
    Apps::TimerSet<EAcsdTimer> _timers;
    Apps::TimerSet<Planning::EngineTimer> _engineTimers;
    Apps::HttpRoutes _routes;
    Apps::HttpServer _http;
    Apps::Endpoint _httpEndpoint;

    bool _bMqttUp = false;
    bool _bWorks = false;    ///< Whether work can be taken at this moment.
    bool _bDraining = false; ///< No new plans; what is to be told is told, then the links are left.
    bool _bSettling = false; ///< All is told.
    bool _bStopping = false;
    std::size_t _stopsOpen = 0;
    StopHandler _stopHandler;

    void OnStored(const Core::Result<void>& result)
    {
        _timers.Cancel(EAcsdTimer::StoreLate);
        _figures.ObserveCommit(_storeWatch.OnStored(result, _surroundings.clock.GetNow().steady));
        _host.OnStored(result);
        FollowDrain();
        if (_bStopping && !_host.IsStoring() && _stopsOpen == 0)
        {
            StopLinks();
        }
    }

    void CheckStore()
    {
        if (!_host.IsStoring() && !_storeWatch.GetObstacleOrNull().has_value()) // else it is tried all the time
        {
            _store.CheckAsync();
        }
        _timers.Start(EAcsdTimer::StoreCheck, StoreWatch::CHECK_INTERVAL);
    }

    void OnStoreLost(const Core::Error& error)
    {
        if (!_host.IsStoring())
        {
            _storeWatch.OnLost(error, _surroundings.clock.GetNow().steady);
            _host.OnStoreLost(error);
        }
    }

    void Execute(const Planning::EngineAction& action)
    {
        std::visit(
            Core::Overloaded{
                [](const Planning::StorePlans&) { assert(false && "carried out by the caller"); },
                [&](const Planning::ReplyCommand& reply) { _mcs.Reply(reply); },
                [&](const Planning::SendReport& report) { _mcs.Report(report.entry); },
                [&](const Planning::CommandRobot& command) { CommandRobot(command); },
                [&](const Planning::RobotStatusChanged& changed) {
                    _mcs.TellStatus(changed.status);
                    _reachable.erase(changed.status.robotID);
                    if (changed.status.status != Planning::ERobotStatus::Disconnected)
                    {
                        _reachable.insert(changed.status.robotID);
                    }
                    TellWorking();
                },
                [&](const Planning::TscStateChanged& changed) { _mcs.TellTSC(changed.state); },
                [&](const Planning::StartEngineTimer& start) { _engineTimers.Start(start.timer, start.delay); },
                [&](const Planning::CancelEngineTimer& cancel) {
                    _engineTimers.Cancel(cancel.timer);
                }},
            action);
    }

    void CommandRobot(const Planning::CommandRobot& command)
    {
        const auto found = _robots.find(command.robotID);
        assert(found != _robots.end());
        found->second->Handle(command.command);
    }

    void OnTimer(EAcsdTimer timer)
    {
        switch (timer)
        {
            case EAcsdTimer::WorkGrace:
                _mcs.TellWorking(false);
                break;
            case EAcsdTimer::Drain:
            case EAcsdTimer::Settle:
                EndDrain();
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

    /// 5.3: no work can be taken while the broker is away, or all robots are; told after a grace.
    void TellWorking()
    {
        if (_bDraining)
        {
            return;
        }
        const bool bWorks = _bMqttUp && !_reachable.empty();
        if (bWorks == _bWorks)
        {
            return;
        }
        _bWorks = bWorks;
        if (bWorks)
        {
            _timers.Cancel(EAcsdTimer::WorkGrace);
            _mcs.TellWorking(true);
        }
        else
        {
            _timers.Start(EAcsdTimer::WorkGrace, _config.operations.workGrace);
        }
    }

    void OnLinkUp() override
    {
        _bMqttUp = true;
        if (_bStopping)
        {
            return;
        }
        TellWorking();
        for (const auto& [robotID, robot] : _robots)
        {
            robot->OnLinkUp();
        }
    }

    void OnLinkDown(std::error_code /*reason*/) override
    {
        _bMqttUp = false;
        if (_bStopping)
        {
            return;
        }
        TellWorking();
        for (const auto& [robotID, robot] : _robots)
        {
            robot->OnLinkDown();
        }
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        if (_bStopping)
        {
            return;
        }
        const Core::Result<VDA5050::ParsedTopic> topic = VDA5050::ParseTopic(message.topic);
        const auto found =
            topic ? _vehicles.find({topic->address.manufacturer, topic->address.serialNumber}) : _vehicles.end();
        if (_surroundings.traceOrNull != nullptr)
        {
            std::string_view robotID;
            if (found != _vehicles.end())
            {
                robotID = found->second->GetRobotID();
            }
            _surroundings.traceOrNull->Write(
                {"mqtt", ProtocolBeast::EWireDirection::In, robotID, message.topic, message.payload});
        }
        if (found != _vehicles.end())
        {
            found->second->OnMqttMessage(message);
        }
    }

    [[nodiscard]] std::vector<LinkStatus> GetLinks() const
    {
        return {_mcs.GetLink(), {"mqtt", _bMqttUp}};
    }

    [[nodiscard]] ProgramStatus GetProgramStatus() const
    {
        ProgramStatus program{GetLinks(), GetObstacles(), {}, _mcs.GetFigures().refusedReports};
        for (const auto& [robotID, robot] : _robots)
        {
            if (const RobotHost::Figures figures = robot->GetFigures(); figures.arm.has_value())
            {
                program.arms.emplace(robotID, figures.bArmReady);
            }
        }
        return program;
    }

    void AddRoutes()
    {
        AddStatusRoutes(_routes, _engine, [this] { return GetProgramStatus(); });
        _routes.Add("GET", "/metrics", [this](const auto&, const auto&) {
            UpdateMetrics();
            return _metrics.Respond();
        });
        AddOperatorRoutes(
            _routes,
            _engine,
            {[this](Planning::PlanCommand command) { return _host.TryPush(std::move(command)); },
             [this] {
                 return _storeWatch.GetObstacleOrNull();
             }});
    }

    void UpdateMetrics()
    {
        const Core::Now now = _surroundings.clock.GetNow();
        for (const LinkStatus& link : GetLinks())
        {
            _figures.UpdateLink(link.name, link.bUp);
        }
        _figures.UpdateMCS(_mcs);
        _figures.UpdatePlans(_engine, now);
        for (const auto& [robotID, robot] : _robots)
        {
            _figures.UpdateRobot(*robot, now);
        }
        if (_surroundings.traceOrNull != nullptr)
        {
            _figures.UpdateTrace(_surroundings.traceOrNull->GetLost());
        }
    }

    /// What besides the links keeps plans from being taken.
    [[nodiscard]] std::vector<std::string> GetObstacles() const
    {
        std::vector<std::string> obstacles;
        if (_bDraining)
        {
            obstacles.emplace_back("acsd draining for shutdown");
        }
        if (std::optional<std::string> obstacle = _storeWatch.GetObstacleOrNull())
        {
            obstacles.push_back(std::move(*obstacle));
        }
        return obstacles;
    }

    void StartStatusTimer()
    {
        if (_config.operations.statusInterval.count() > 0)
        {
            _timers.Start(EAcsdTimer::Status, _config.operations.statusInterval);
        }
        else
        {
            _timers.Cancel(EAcsdTimer::Status);
        }
    }

    /// Section 5.9 allows it besides the update of each change (`robot.status_interval`).
    void RepeatStatuses()
    {
        for (const Planning::RobotStatus& status : _engine.GetRobotStatuses())
        {
            _mcs.TellStatus(status);
        }
        StartStatusTimer();
    }

    /// Whether everything is told, or can be told to nobody.
    void FollowDrain()
    {
        if (!_bDraining || _bStopping || _host.IsStoring())
        {
            return;
        }
        const bool bTold = !_mcs.IsRegistered() || _engine.GetOutboxSummary().count == 0;
        if (bTold && !std::exchange(_bSettling, true))
        {
            _timers.Start(EAcsdTimer::Settle, SETTLE_TIME);
        }
    }

    void EndDrain()
    {
        _bStopping = true;
        _host.Close();
        _timers.CancelAll();
        _engineTimers.CancelAll();
        _timers.Start(EAcsdTimer::Stop, STOP_LIMIT);
        if (!_host.IsStoring()) // otherwise what the batch withholds is released first
        {
            StopLinks();
        }
    }

    void FinishStop()
    {
        _timers.CancelAll();
        _engineTimers.CancelAll();
        _http.Stop();
        if (_stopHandler)
        {
            std::exchange(_stopHandler, nullptr)();
        }
    }

    void StopLinks()
    {
        _stopsOpen = 2;
        for (const auto& [robotID, robot] : _robots)
        {
            robot->Stop();
        }
        _mqtt.StopAsync(std::nullopt, VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, [this] { CountStop(); });
        _mcs.StopAsync([this] { CountStop(); });
    }

    void CountStop()
    {
        if (--_stopsOpen == 0)
        {
            FinishStop();
        }
    }

public:
    Impl(Surroundings surroundings, AcsdConfig config, std::unique_ptr<Planning::IPlanStore> store)
        : _surroundings(std::move(surroundings)),
          _config(std::move(config)),
          _figures(_metrics),
          _planLog(_surroundings.logger.MakeFor("plan"), _metrics),
          _engine(_config.engine, *_config.site, _surroundings.random),
          _host(
              _engine,
              _surroundings.clock,
              [this](const Planning::EngineAction& action) { Execute(action); },
              [this](const Planning::StoreBatch& batch) {
                  _storeWatch.OnBegun(_surroundings.clock.GetNow().steady);
                  _timers.Start(EAcsdTimer::StoreLate, StoreWatch::LIMIT);
                  _store.Append(batch);
              }),
          _storeWatch(_surroundings.logger.MakeFor("store")),
          _store(
              _surroundings.executor,
              std::move(store),
              [this](const Core::Result<void>& result) { OnStored(result); },
              [this](const Core::Error& error) { OnStoreLost(error); }),
          _mcs(
              _surroundings.clock,
              _surroundings.logger.MakeFor("mcs"),
              _config.localOffset,
              _engine,
              [this](Planning::PlanCommand command) {
                  _host.Push(std::move(command));
                  FollowDrain();
              }),
          _mqtt(
              _surroundings.executor,
              _surroundings.random,
              _surroundings.logger.MakeFor("mqtt"),
              MakeMqttOptions(_config.mqtt, _surroundings.random),
              *this),
          _timers(_surroundings.executor, [this](EAcsdTimer timer) { OnTimer(timer); }),
          _engineTimers(_surroundings.executor, [this](const Planning::EngineTimer& timer) { _host.Push(timer); }),
          _http(
              _surroundings.executor,
              [this](const Apps::HttpRequest& request) { return _routes.Respond(request); },
              _surroundings.logger.MakeFor("http"),
              {},
              MakeHttpGuard(_config))
    {
        _engine.SetObserver(_planLog);
        AddRoutes();
        _mcs.SetAckObserver([this](Core::Duration wait) { _figures.ObserveAckWait(wait); });
        for (const RobotLinkConfig& robot : _config.robots)
        {
            auto host = std::make_unique<RobotHost>(
                RobotHost::Surroundings{
                    _surroundings.executor,
                    _surroundings.clock,
                    _surroundings.random,
                    _mqtt,
                    _surroundings.logger,
                    _metrics,
                    _surroundings.traceOrNull},
                _config,
                robot,
                [this](const std::string& robotID, const Planning::RobotEvent& event) {
                    _host.Push(Planning::RobotInput{robotID, event});
                });
            _vehicles[{robot.manufacturer, robot.serialNumber}] = host.get();
            _robots.emplace(robot.robotID, std::move(host));
        }
    }

    [[nodiscard]] Core::Result<void> Open(Planning::StoredState state)
    {
        Core::Result<void> opened =
            _mcs.Open(_surroundings.executor, _surroundings.random, _config, _surroundings.traceOrNull);
        if (!opened)
        {
            return opened;
        }
        const Core::Result<Apps::Endpoint> endpoint = _http.Listen(_config.httpListen);
        if (!endpoint)
        {
            return tl::unexpected<Core::Error>(endpoint.error());
        }
        _httpEndpoint = *endpoint;
        _mcs.Restore(state.lastReportSequence);
        _host.Restore(std::move(state));
        return {};
    }

    void Start()
    {
        for (const auto& [robotID, robot] : _robots)
        {
            robot->Start();
        }
        _timers.Start(EAcsdTimer::WorkGrace, _config.operations.workGrace);
        StartStatusTimer();
        CheckStore();
        _mqtt.Start();
        _mcs.Start();
    }

    void StopAsync(StopHandler handler)
    {
        _stopHandler = std::move(handler);
        _bDraining = true;
        _timers.Cancel(EAcsdTimer::WorkGrace);
        _timers.Start(EAcsdTimer::Drain, _config.operations.drainTimeout);
        _mcs.BeginDraining();
        FollowDrain();
    }

    void Reload(const AcsdConfig& fresh)
    {
        LogChange(_config, fresh, _surroundings.logger.MakeFor("config"));
        TakeLiveKeys(fresh, _config);
        _mcs.SetLimits(_config.mcs);
        if (_surroundings.traceOrNull != nullptr)
        {
            _surroundings.traceOrNull->SetLimits(_config.operations.trace);
        }
        if (!_bDraining)
        {
            StartStatusTimer();
        }
    }

    [[nodiscard]] const Apps::Endpoint& GetHttpEndpoint() const noexcept
    {
        return _httpEndpoint;
    }
};

Acsd::Acsd(std::unique_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

Acsd::~Acsd() = default;

Core::Result<std::unique_ptr<Acsd>> Acsd::Create(Surroundings surroundings, AcsdConfig config)
{
    assert(config.mistakes.empty());
    Core::Result<std::unique_ptr<Planning::SqlitePlanStore>> store = Planning::SqlitePlanStore::Open(config.storePath);
    if (!store)
    {
        return tl::unexpected<Core::Error>(store.error());
    }
    Core::Result<Planning::StoredState> state = (*store)->Load();
    if (!state)
    {
        return tl::unexpected<Core::Error>(state.error());
    }
    surroundings.logger.MakeFor("store").Info(
        MakeStoreSummary((*store)->GetOrigin(), *state),
        {{"directory", config.storePath}});
    auto impl = std::make_unique<Impl>(std::move(surroundings), std::move(config), std::move(*store));
    const Core::Result<void> opened = impl->Open(std::move(*state));
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

Apps::Endpoint Acsd::GetHttpEndpoint() const
{
    return _impl->GetHttpEndpoint();
}

} // namespace ACS::Acsd
