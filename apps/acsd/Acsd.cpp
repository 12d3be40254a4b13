#include "Acsd.hpp"

#include "AcsdStatus.hpp"
#include "common/HttpRoutes.hpp"
#include "common/HttpServer.hpp"
#include "common/MetricsEndpoint.hpp"
#include "common/TimerSet.hpp"
#include "EngineLoop.hpp"
#include "McsLink.hpp"
#include "OperatorRoutes.hpp"
#include "PlanLog.hpp"
#include "RobotHost.hpp"
#include "StoreWorker.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/Uuid.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
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

/// How long the broker or all robots may be away before the MCS is told that no work can be taken (`comm.grace`).
constexpr std::chrono::milliseconds WORK_GRACE = 10s;
constexpr std::chrono::milliseconds STOP_LIMIT = 5s;

constexpr std::uint64_t GRACE_TIMER = 1;
constexpr std::uint64_t STOP_TIMER = 2;
constexpr std::uint64_t FIRST_ENGINE_TIMER = 1000;

constexpr const char* LINK_UP = "acsd_link_up";
constexpr const char* PLANS_ACTIVE = "acsd_plans_active";
constexpr const char* OUTBOX_DEPTH = "acsd_outbox_depth";
constexpr const char* MESSAGES_SENT = "acsd_mcs_requests_sent_total";
constexpr const char* MCS_NOTES = "acsd_mcs_notes_total";

VDA5050::MosquittoOptions MakeMqttOptions(const AcsdConfig& config, Core::IRandom& random)
{
    VDA5050::MosquittoOptions options;
    // Unique, so that a second acsd on the broker does not push the first one out.
    options.clientID = "acsd-" + Core::MakeUuid(random);
    options.host = config.mqtt.url.peer.host;
    options.port = config.mqtt.url.peer.port;
    if (Apps::IsSecure(config.mqtt.url.scheme))
    {
        options.tls.emplace();
    }
    return options;
}

} // namespace

class Acsd::Impl final : public VDA5050::IMqttLinkListener
{
    Surroundings _surroundings;
    AcsdConfig _config;
    Apps::MetricsEndpoint _metrics;
    PlanLog _planLog;
    Planning::PlanEngine _engine;
    EngineLoop _loop;
    StoreWorker _store;
    McsLink _mcs;
    VDA5050::MosquittoLink _mqtt;
    std::map<std::string, std::unique_ptr<RobotHost>, std::less<>> _robots;
    /// By manufacturer and serial number: a message costs one look-up, however many robots there are.
    std::map<std::pair<std::string, std::string>, RobotHost*> _vehicles;
    std::set<std::string> _reachable; ///< Robots that are not Disconnected.
    Apps::TimerSet _timers;
    Apps::HttpRoutes _routes;
    Apps::HttpServer _http;
    Apps::Endpoint _httpEndpoint;

    std::map<Planning::EngineTimer, std::uint64_t> _timerKeys;
    std::map<std::uint64_t, Planning::EngineTimer> _engineTimers;
    bool _bMqttUp = false;
    bool _bWorks = false; ///< Whether work can be taken at this moment.
    bool _bStopping = false;
    std::size_t _stopsOpen = 0;
    StopHandler _stopHandler;

    void OnStored(const Core::Result<void>& result)
    {
        if (!result)
        {
            _surroundings.logger.Error("the store fails", {{"reason", Core::Describe(result.error())}});
        }
        _loop.OnStored(result);
        if (_bStopping && !_loop.IsStoring() && _stopsOpen == 0)
        {
            StopLinks();
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
                    NoteReachable(changed.status);
                    TellWorking();
                },
                [&](const Planning::TscStateChanged& changed) { _mcs.TellTsc(changed.state); },
                [&](const Planning::StartEngineTimer& start) { _timers.Start(GetTimerKey(start.timer), start.delay); },
                [&](const Planning::CancelEngineTimer& cancel) {
                    _timers.Cancel(GetTimerKey(cancel.timer));
                }},
            action);
    }

    void CommandRobot(const Planning::CommandRobot& command)
    {
        const auto found = _robots.find(command.robotID);
        assert(found != _robots.end());
        found->second->Handle(command.command);
    }

    std::uint64_t GetTimerKey(const Planning::EngineTimer& timer)
    {
        const auto [entry, bNew] = _timerKeys.try_emplace(timer, FIRST_ENGINE_TIMER + _timerKeys.size());
        if (bNew)
        {
            _engineTimers.emplace(entry->second, timer);
        }
        return entry->second;
    }

    void OnTimer(std::uint64_t key)
    {
        if (key == GRACE_TIMER)
        {
            _mcs.TellWorking(false);
        }
        else if (key == STOP_TIMER)
        {
            FinishStop();
        }
        else
        {
            _loop.Push(_engineTimers.at(key));
        }
    }

    void NoteReachable(const Planning::RobotStatus& status)
    {
        if (status.status == Planning::ERobotStatus::Disconnected)
        {
            _reachable.erase(status.robotID);
        }
        else
        {
            _reachable.insert(status.robotID);
        }
    }

    /// 5.3: no work can be taken while the broker is away, or all robots are; told after a grace.
    void TellWorking()
    {
        if (_bStopping)
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
            _timers.Cancel(GRACE_TIMER);
            _mcs.TellWorking(true);
        }
        else
        {
            _timers.Start(GRACE_TIMER, WORK_GRACE);
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
            const std::string_view robotID = found == _vehicles.end() ? "" : found->second->GetRobotID();
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
        return {{"mcs", _mcs.IsRegistered()}, {"mqtt", _bMqttUp}};
    }

    void AddRoutes()
    {
        _routes.Add("GET", "/livez", [](const auto&, const auto&) { return MakeLiveResponse(); });
        _routes.Add("GET", "/readyz", [this](const auto&, const auto&) { return MakeReadyResponse(GetLinks()); });
        _routes.Add("GET", "/status", [this](const auto&, const auto&) {
            return MakeStatusResponse(GetLinks(), _engine);
        });
        _routes.Add("GET", "/metrics", [this](const auto&, const auto&) {
            UpdateMetrics();
            return _metrics.Respond();
        });
        AddOperatorRoutes(_routes, [this](Planning::PlanCommand command) { _loop.Push(std::move(command)); });
    }

    void UpdateMetrics()
    {
        for (const LinkStatus& link : GetLinks())
        {
            _metrics.SetGauge(LINK_UP, {{"link", link.name}}, link.bUp ? 1.0 : 0.0);
        }
        _metrics.SetGauge(PLANS_ACTIVE, {}, static_cast<double>(_engine.GetActivePlans().size()));
        _metrics.SetGauge(OUTBOX_DEPTH, {}, static_cast<double>(_engine.GetUnacknowledged().size()));
        const Protocol::SessionStatistics& statistics = _mcs.GetStatistics();
        for (std::size_t index = 0; index < Protocol::COMMAND_COUNT; ++index)
        {
            const auto command = static_cast<Protocol::EAcsCommand>(index);
            _metrics.SetTotal(
                MESSAGES_SENT,
                {{"command", std::string(GetText(command))}},
                static_cast<double>(statistics.Of(command).sent));
        }
        for (std::size_t index = 0; index < Protocol::NOTE_COUNT; ++index)
        {
            const auto what = static_cast<Protocol::EProtocolNote>(index);
            _metrics.SetTotal(
                MCS_NOTES,
                {{"what", std::string(GetText(what))}},
                static_cast<double>(statistics.CountOf(what)));
        }
    }

    void FinishStop()
    {
        _timers.CancelAll();
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
          _planLog(_surroundings.logger.MakeFor("plan"), _metrics),
          _engine(_config.engine, *_config.site, _surroundings.random),
          _loop(
              _engine,
              _surroundings.clock,
              [this](const Planning::EngineAction& action) { Execute(action); },
              [this](const Planning::StoreBatch& batch) { _store.Append(batch); }),
          _store(
              _surroundings.executor,
              std::move(store),
              [this](const Core::Result<void>& result) { OnStored(result); }),
          _mcs(
              _surroundings.clock,
              _surroundings.logger.MakeFor("mcs"),
              _config.localOffset,
              _engine,
              [this](Planning::PlanCommand command) { _loop.Push(std::move(command)); }),
          _mqtt(
              _surroundings.executor,
              _surroundings.random,
              _surroundings.logger.MakeFor("mqtt"),
              MakeMqttOptions(_config, _surroundings.random),
              *this),
          _timers(_surroundings.executor, [this](std::uint64_t key) { OnTimer(key); }),
          _http(
              _surroundings.executor,
              [this](const Apps::HttpRequest& request) { return _routes.Respond(request); },
              _surroundings.logger.MakeFor("http"))
    {
        _engine.SetObserver(_planLog);
        AddRoutes();
        _metrics.AddGauge(LINK_UP, "Whether the link is up");
        _metrics.AddGauge(PLANS_ACTIVE, "Plans that are not finished");
        _metrics.AddGauge(OUTBOX_DEPTH, "Reports that the MCS has not acknowledged");
        _metrics.AddCounter(MESSAGES_SENT, "Requests sent to the MCS, resends included");
        _metrics.AddCounter(MCS_NOTES, "What the MCS did that the protocol does not provide for, by kind");
        for (const RobotLinkConfig& robot : _config.robots)
        {
            auto host = std::make_unique<RobotHost>(
                RobotHost::Surroundings{
                    _surroundings.executor,
                    _surroundings.clock,
                    _surroundings.random,
                    _mqtt,
                    _surroundings.logger,
                    _surroundings.traceOrNull},
                _config,
                robot,
                [this](const std::string& robotID, const Planning::RobotEvent& event) {
                    _loop.Push(RobotTask{robotID, event});
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
        _loop.Restore(std::move(state));
        return {};
    }

    void Start()
    {
        for (const auto& [robotID, robot] : _robots)
        {
            robot->Start();
        }
        _timers.Start(GRACE_TIMER, WORK_GRACE);
        _mqtt.Start();
        _mcs.Start();
    }

    void StopAsync(StopHandler handler)
    {
        _bStopping = true;
        _stopHandler = std::move(handler);
        _loop.Close();
        _timers.CancelAll();
        _timers.Start(STOP_TIMER, STOP_LIMIT);
        if (!_loop.IsStoring()) // else what stands behind the batch is told first
        {
            StopLinks();
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
    Core::Result<std::unique_ptr<Planning::SqlitePlanStore>> store = Planning::SqlitePlanStore::Open(config.storeFile);
    if (!store)
    {
        return tl::unexpected<Core::Error>(store.error());
    }
    Core::Result<Planning::StoredState> state = (*store)->Load();
    if (!state)
    {
        return tl::unexpected<Core::Error>(state.error());
    }
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

Apps::Endpoint Acsd::GetHttpEndpoint() const
{
    return _impl->GetHttpEndpoint();
}

} // namespace ACS::Acsd
