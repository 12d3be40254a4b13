#include "VehicleBench.hpp"

#include <array>
#include <string>
#include <vector>

namespace ACS::Testing
{

namespace
{

using Planning::EActionEffect;

Acsd::VehicleParameter MakeParameter(std::string key, std::string_view text)
{
    return {std::move(key), *Acsd::ParameterTemplate::Make(text)};
}

/// With all parameters that the standard's factsheet requires.
Acsd::JobMethod MakeHandling(std::string vehicleAction, EActionEffect effect)
{
    return {
        std::move(vehicleAction),
        0,
        {MakeParameter("stationType", "rack"),
         MakeParameter("stationName", "{place}"),
         MakeParameter("loadType", "cassette"),
         MakeParameter("loadId", "{carrier}"),
         MakeParameter("lhd", "{robot_port}")},
        {},
        effect};
}

constexpr std::array<const char*, 5> NODES{"N0", "N1", "N2", "N3", "N4"};
constexpr double EDGE_LENGTH = 4.0;

} // namespace

/// A line of nodes. The first is a charging station, too.
Planning::SiteMap VehicleBench::MakeSite()
{
    std::vector<Planning::SiteNode> nodes;
    std::vector<Planning::SiteEdge> edges;
    for (std::size_t i = 0; i < NODES.size(); ++i)
    {
        nodes.push_back({NODES.at(i), EDGE_LENGTH * static_cast<double>(i), 0.0, "floor", {{"any", std::nullopt}}});
    }
    for (std::size_t i = 0; i + 1 < NODES.size(); ++i)
    {
        Planning::SiteEdgeRule rule;
        rule.vehicleTypeID = "any";
        rule.maxSpeed = 1.0;
        edges.push_back({std::string(NODES.at(i)) + NODES.at(i + 1), NODES.at(i), NODES.at(i + 1), {rule}});
    }
    auto site =
        Planning::SiteMap::Create(nodes, edges, {{"CHG01", {"N0"}}, {"A01.CP01", {"N1"}}, {"A01.CP02", {"N1"}}});
    if (!site.has_value())
    {
        throw std::runtime_error(Core::Describe(site.error()));
    }
    return std::move(*site);
}

Acsd::VehicleConfig VehicleBench::MakeVehicleConfig()
{
    Acsd::VehicleConfig config;
    config.robotID = ROBOT;
    config.address = {"uagv", "ACS", ROBOT};
    const Acsd::LoadPositions ports(*Core::ParseLocationRange("LR01.CP01-04"), {});
    config.methods = Acsd::JobMethods(ports, std::make_shared<const Acsd::StationTable>());
    config.methods.SetMethod("CassetteLoad", {}, MakeHandling("pick", EActionEffect::Load));
    config.methods.SetMethod("CassetteUnload", {}, MakeHandling("drop", EActionEffect::Unload));
    return config;
}

AdapterTest::BenchOptions VehicleBench::GetOptions() const
{
    AdapterTest::BenchOptions options;
    for (const Planning::SiteNode& node : _site.GetNodes())
    {
        options.route.nodes.push_back({node.nodeID, node.x, node.y, std::nullopt, node.mapID});
    }
    for (const Planning::SiteEdge& edge : _site.GetEdges())
    {
        options.route.edges.push_back(
            {edge.edgeID,
             edge.startNodeID,
             edge.endNodeID,
             EDGE_LENGTH,
             1.0,
             std::nullopt,
             std::nullopt,
             "",
             std::nullopt});
    }
    return options;
}

/// Each job loads a further carrier.
Planning::StartJob VehicleBench::MakeJob(std::size_t number) const
{
    Planning::StartJob job;
    job.action = "CassetteLoad";
    job.position = "A01.CP01";
    job.from = number == 0 ? "A01.CP01" : "A01.CP02";
    job.to = number == 0 ? "LR01.CP01" : "LR01.CP02";
    job.carrierID = number == 0 ? "C1" : "C2";
    return job;
}

void VehicleBench::MakeRobot(AdapterTest::IVirtualTime& time)
{
    _timeOrNull = &time;
    _bRepeats = false;
    _bLinkUp = true;
    _retained.clear();
    _actions.clear();
    _timers.clear();
    _status.clear();
    _random = std::make_unique<SeededRandom>(1);
    VdaSim::VirtualVehicleOptions options;
    options.address = {"uagv", "ACS", ROBOT};
    options.startNodeID = NODES.front();
    _vehicle = std::make_unique<VdaSim::VirtualVehicle>(std::move(options), _site, *_random, Core::Logger());
    _truth = {};
    UpdateTruth();
    ConnectVehicleSoon();
}

Planning::IRobotAdapter& VehicleBench::MakeAdapter(AdapterTest::IAdapterHost& host)
{
    _hostOrNull = &host;
    _outputs = {};
    _adapter = Acsd::MakeRobotAdapter(MakeVehicleConfig(), _outputs);
    ConnectAdapterSoon();
    return *_adapter.adapter;
}

void VehicleBench::DestroyAdapter()
{
    _adapter = {};
    _bAdapterUp = false;
}

void VehicleBench::DestroyRobot()
{
    _bVehicleUp = false;
    _vehicle.reset();
    ++_adapterConnection;
    ++_vehicleConnection;
}

void VehicleBench::OnAdapterCalled()
{
    for (const VDA5050::MqttMessage& message : std::exchange(_outputs.messages, {}))
    {
        if (_bAdapterUp)
        {
            Post(_vehicleConnection, [this, message] {
                if (_bVehicleUp)
                {
                    CallVehicle([this, &message](Core::Now now, auto& out) { _vehicle->OnMessage(message, now, out); });
                }
            });
        }
    }
}

void VehicleBench::SetLink(bool bUp)
{
    _bLinkUp = bUp;
    if (_link == ELink::OfAdapter)
    {
        ++_adapterConnection;
        ++_vehicleConnection; // orders in transit
        if (bUp)
        {
            ConnectAdapterSoon();
        }
        else if (std::exchange(_bAdapterUp, false))
        {
            _hostOrNull->Call([this](Core::Now now, auto& out) { _adapter.adapter->OnLinkDown(now, out); });
        }
        return;
    }
    ++_vehicleConnection;
    if (bUp)
    {
        ConnectVehicleSoon();
        return;
    }
    if (std::exchange(_bVehicleUp, false))
    {
        CallVehicle([this](Core::Now now, auto& out) { _vehicle->OnLinkDown(now, out); });
        _timeOrNull->Post(KEEP_ALIVE, [this, will = _vehicle->MakeWill(_timeOrNull->GetNow()).message] {
            if (!_bVehicleUp)
            {
                PublishToAdapter(will);
            }
        });
    }
}

void VehicleBench::SetConduct(AdapterTest::EConduct conduct)
{
    CallVehicle([this](Core::Now now, auto& out) { _vehicle->EndFaults(std::nullopt, now, out); });
    _bRepeats = conduct == AdapterTest::EConduct::Repeats;
    switch (conduct)
    {
        case AdapterTest::EConduct::Slow:
            Inject("delay time=4s");
            break;
        case AdapterTest::EConduct::Refuses:
            Inject("refuse");
            break;
        case AdapterTest::EConduct::Fails:
            Inject("action-fails");
            break;
        case AdapterTest::EConduct::Obeys:
        case AdapterTest::EConduct::Repeats:
        default:
            break;
    }
}

AdapterTest::RobotTruth VehicleBench::GetTruth() const
{
    return _truth;
}

void VehicleBench::Post(std::size_t& connection, std::function<void()> task)
{
    _timeOrNull->Post(LATENCY, [&connection, present = connection, task = std::move(task)] {
        if (present == connection)
        {
            task();
        }
    });
}

void VehicleBench::ConnectAdapterSoon()
{
    Post(_adapterConnection, [this] {
        if (_adapter.adapter == nullptr || (_link == ELink::OfAdapter && !_bLinkUp))
        {
            return;
        }
        _bAdapterUp = true;
        _hostOrNull->Call([this](Core::Now now, auto& out) { _adapter.adapter->OnLinkUp(now, out); });
        for (const auto& [topic, message] : _retained)
        {
            DeliverToAdapter(message);
        }
    });
}

void VehicleBench::ConnectVehicleSoon()
{
    Post(_vehicleConnection, [this] {
        _bVehicleUp = true;
        CallVehicle([this](Core::Now now, auto& out) { _vehicle->OnLinkUp(now, out); });
    });
}

void VehicleBench::PublishToAdapter(const VDA5050::MqttMessage& message)
{
    if (message.bRetained)
    {
        _retained[message.topic] = message;
    }
    DeliverToAdapter(message);
}

void VehicleBench::DeliverToAdapter(const VDA5050::MqttMessage& message)
{
    for (int copies = _bRepeats ? 2 : 1; copies > 0; --copies)
    {
        Post(_adapterConnection, [this, message] {
            if (_bAdapterUp)
            {
                _hostOrNull->Call(
                    [this, &message](Core::Now now, auto& out) { _adapter.adapter->OnMqttMessage(message, now, out); });
            }
        });
    }
}

template <typename TCall>
void VehicleBench::CallVehicle(TCall call)
{
    call(_timeOrNull->GetNow(), _actions);
    for (const VdaSim::VirtualAction& action : std::exchange(_actions, {}))
    {
        Execute(action);
    }
    UpdateTruth();
}

void VehicleBench::Execute(const VdaSim::VirtualAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const VDA5050::PublishMessage& publish) {
                if (_bVehicleUp)
                {
                    PublishToAdapter(publish.message);
                }
            },
            [this](const VdaSim::StartVirtualTimer& start) {
                const std::size_t number = ++_lastTimer;
                const std::uint64_t key = start.key;
                _timers[key] = number;
                _timeOrNull->Post(start.delay, [this, key, number] {
                    if (_vehicle != nullptr && _timers[key] == number)
                    {
                        CallVehicle([this, key](Core::Now now, auto& out) { _vehicle->OnTimer(key, now, out); });
                    }
                });
            },
            [this](const VdaSim::CancelVirtualTimer& cancel) { _timers.erase(cancel.key); },
            [](const VdaSim::CutLink&) { /* by its own faults, which are not used */ },
            [](const VdaSim::OpenLink&) { /* likewise */
            }},
        action);
}

void VehicleBench::Inject(std::string_view text)
{
    const auto fault = Apps::ParseFault(VdaSim::GetFaultGrammar(), text);
    if (!fault.has_value())
    {
        throw std::runtime_error(Core::Describe(fault.error()));
    }
    CallVehicle([this, &fault](Core::Now now, auto& out) { static_cast<void>(_vehicle->TryInject(*fault, now, out)); });
}

void VehicleBench::UpdateTruth()
{
    const VDA5050::StateMessage state = _vehicle->GetState();
    _truth.nodeID = state.lastNodeID;
    _truth.bDriving = state.bDriving;
    _truth.bWorking = false;
    for (const VDA5050::ActionState& action : state.actionStates)
    {
        const bool bJob = action.actionType == "pick" || action.actionType == "drop";
        const VDA5050::EActionStatus before = std::exchange(_status[action.actionID], action.actionStatus);
        const bool bFinished = action.actionStatus == VDA5050::EActionStatus::Finished;
        _truth.bWorking = _truth.bWorking || (bJob && action.actionStatus == VDA5050::EActionStatus::Running);
        _truth.doneJobs += bJob && bFinished && before != VDA5050::EActionStatus::Finished ? 1U : 0U;
    }
}

} // namespace ACS::Testing
