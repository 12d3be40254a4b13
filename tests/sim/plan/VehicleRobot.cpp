#include "VehicleRobot.hpp"

#include "VehicleConnection.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/Topic.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

/// Metres from a node within which a robot is on it, also for acsd.
constexpr double NODE_RADIUS = 0.5;
/// Metres that it may move without an update of the pose.
constexpr double GRAIN = 0.02;

VDA5050::VehicleAddress MakeAddress(const std::string& robotID)
{
    return {"uagv", "ACS", robotID};
}

double GetDistance(const VdaSim::Pose& pose, const Planning::SiteNode& node)
{
    return std::hypot(pose.x - node.x, pose.y - node.y);
}

double ChooseCharge(const ChanceSeed& seed, bool bBatteries)
{
    constexpr std::uint64_t BATTERY_PARTS = 10'000; // after all others
    ChanceModel chance({seed.seed, BATTERY_PARTS + seed.part});
    return bBatteries ? static_cast<double>(chance.GetBetween(15, 26)) : 100.0;
}

VdaSim::Fault MakeFault(VdaSim::EFaultKind kind)
{
    VdaSim::Fault fault;
    fault.kind = kind;
    fault.text = VdaSim::GetFaultName(kind);
    return fault;
}

} // namespace

VehicleRobot::VehicleRobot(
    const Dependencies& around,
    const ChanceSeed& seed,
    std::string robotID,
    const std::string& nodeID,
    bool bFaulty)
    : _around(around),
      _chance(seed),
      _robotID(std::move(robotID)),
      _bFaulty(bFaulty),
      _charge(ChooseCharge(seed, around.bBatteries)),
      _trayPorts(around.workChecker.GetFloor(), _robotID),
      _timers(around.timeline)
{
    SwitchOn(nodeID);
    ShowPlace();
}

VehicleRobot::~VehicleRobot()
{
    _around.broker.Abandon(*_client);
}

void VehicleRobot::SwitchOn(const std::string& nodeID)
{
    VdaSim::VirtualVehicleOptions options;
    options.address = MakeAddress(_robotID);
    options.startNodeID = nodeID;
    options.charge = _charge;
    Equip(options);
    _vehicle = std::make_unique<VdaSim::VirtualVehicle>(std::move(options), _around.site, _chance, Core::Logger());
    _client = _around.broker.Open(*this, _vehicle->GetSubscriptions(), _vehicle->MakeWill(_around.timeline.GetNow()));
    _around.broker.SetReachable(*_client, _bReachable);
}

/// With its load handling device.
void VehicleRobot::Equip(VdaSim::VirtualVehicleOptions& options)
{
    const bool bTrays = _around.robot.type == Planning::ERobotType::CR;
    options.worldOrNull = &_around.workChecker.GetFloor();
    options.handling.ports = _around.robot.ports.size();
    if (bTrays && _around.bArms)
    {
        options.type = VdaSim::EVehicleType::Control;
        options.handling.ports = 0;
    }
    else if (bTrays)
    {
        options.worldOrNull = &_trayPorts;
        for (std::size_t number = 1; number <= _around.robot.ports.size(); ++number)
        {
            options.handling.positions.emplace(fmt::format("CP{:02}", number), fmt::format("TP{:02}", number));
        }
    }
}

template <typename TCall>
void VehicleRobot::Call(TCall call)
{
    call(_around.timeline.GetNow(), _actions);
    const bool bNews = !_actions.empty(); // everything that begins or ends is published, or starts a timer
    for (const VdaSim::VirtualAction& action : std::exchange(_actions, {}))
    {
        Execute(action);
    }
    ShowPlace();
    if (bNews)
    {
        ShowJobs();
    }
}

void VehicleRobot::OnFloorChanged()
{
    Call([this](Core::Now now, auto& out) { _vehicle->OnWorldChanged(now, out); });
}

/// Passes on what the operator has changed for its job; not from within a call of the vehicle.
void VehicleRobot::SeeFloor()
{
    constexpr std::uint64_t FLOOR_KEY = 1'001; // not a timer of the vehicle
    _timers.Start(FLOOR_KEY, 0ms, [this] { OnFloorChanged(); });
}

void VehicleRobot::Execute(const VdaSim::VirtualAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const VDA5050::PublishMessage& publish) { _around.broker.Publish(*_client, publish.message); },
            [this](const VdaSim::StartVirtualTimer& start) {
                const std::uint64_t key = start.key;
                _timers.Start(key, start.delay, [this, key] {
                    Call([this, key](Core::Now now, auto& out) { _vehicle->OnTimer(key, now, out); });
                });
            },
            [this](const VdaSim::CancelVirtualTimer& cancel) { _timers.Cancel(cancel.key); },
            [](const VdaSim::CutLink&) { /* by its own faults, which are not used */ },
            [](const VdaSim::OpenLink&) { /* likewise */
            }},
        action);
}

void VehicleRobot::OnLinkUp()
{
    _around.broker.SetWill(*_client, _vehicle->MakeWill(_around.timeline.GetNow()));
    Call([this](Core::Now now, auto& out) { _vehicle->OnLinkUp(now, out); });
}

void VehicleRobot::OnLinkDown(std::error_code /*reason*/)
{
    Call([this](Core::Now now, auto& out) { _vehicle->OnLinkDown(now, out); });
}

void VehicleRobot::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    const Core::Result<VDA5050::ParsedTopic> topic = VDA5050::ParseTopic(message.topic);
    const bool bOrder = topic.has_value() && topic->topic == VDA5050::ETopic::Order;
    _around.trace.Add("{} receives {} {}", _robotID, message.topic, message.payload);
    if (bOrder && _bFaulty && _chance.IsHit(15))
    {
        VdaSim::Fault refusal = MakeFault(VdaSim::EFaultKind::Refuse);
        refusal.lasts = 100ms;
        Inject(std::move(refusal));
    }
    if (bOrder && _bFaulty && _chance.IsHit(15))
    {
        VdaSim::Fault failure = MakeFault(VdaSim::EFaultKind::ActionFails);
        failure.bAtStart = _chance.IsHit(300);
        failure.maxUses = 1;
        failure.actionType = _chance.IsHit(500) ? "pick" : "drop";
        Inject(std::move(failure));
    }
    Call([this, &message](Core::Now now, auto& out) { _vehicle->OnMessage(message, now, out); });
}

void VehicleRobot::Inject(VdaSim::Fault fault)
{
    Call([this, &fault](Core::Now now, auto& out) { static_cast<void>(_vehicle->TryInject(fault, now, out)); });
}

/// One node, or both ends of its edge: by its pose, not by its reports.
std::vector<std::string> VehicleRobot::FindPlace() const
{
    const VdaSim::Pose& pose = _vehicle->GetPose();
    const std::vector<Planning::SiteNode>& nodes = _around.site.GetNodes();
    const auto nearest = std::ranges::min_element(nodes, {}, [&pose](const Planning::SiteNode& node) {
        return GetDistance(pose, node);
    });
    if (GetDistance(pose, *nearest) <= NODE_RADIUS)
    {
        return {nearest->nodeID};
    }
    const auto getDetour = [this, &pose](const Planning::SiteEdge& edge) {
        const Planning::SiteNode& from = *_around.site.FindNodeOrNull(edge.startNodeID);
        const Planning::SiteNode& to = *_around.site.FindNodeOrNull(edge.endNodeID);
        return GetDistance(pose, from) + GetDistance(pose, to) - std::hypot(from.x - to.x, from.y - to.y);
    };
    const auto edge = std::ranges::min_element(_around.site.GetEdges(), {}, getDetour);
    return {edge->startNodeID, edge->endNodeID};
}

void VehicleRobot::ShowPlace()
{
    const VdaSim::Pose& pose = _vehicle->GetPose();
    if (!_place.empty() && std::hypot(pose.x - _shownPose.x, pose.y - _shownPose.y) < GRAIN)
    {
        return;
    }
    _shownPose = pose;
    std::vector<std::string> place = FindPlace();
    std::ranges::sort(place);
    if (place != _place)
    {
        _place = place;
        _around.workChecker.OnPlaced(_robotID, std::move(place));
    }
}

void VehicleRobot::ShowJobs()
{
    const VDA5050::StateMessage state = _vehicle->GetState();
    for (const VDA5050::ActionState& action : state.actionStates)
    {
        const Planning::StartJob* const jobOrNull = _around.workChecker.FindCommandOrNull(action.actionID);
        if (jobOrNull == nullptr)
        {
            continue; // an instant action
        }
        const auto [known, bNew] = _status.try_emplace(action.actionID, VDA5050::EActionStatus::Waiting);
        const VDA5050::EActionStatus before = std::exchange(known->second, action.actionStatus);
        const bool bWasBegun = before == VDA5050::EActionStatus::Running || before == VDA5050::EActionStatus::Paused;
        const bool bBegun = action.actionStatus == VDA5050::EActionStatus::Running
            || action.actionStatus == VDA5050::EActionStatus::Paused
            || action.actionStatus == VDA5050::EActionStatus::Finished;
        if (before == action.actionStatus)
        {
            continue;
        }
        if (bBegun && !bWasBegun)
        {
            _around.workChecker.OnJobBegun(_robotID, *jobOrNull);
            SeeFloor();
        }
        if (action.actionStatus == VDA5050::EActionStatus::Finished)
        {
            _around.workChecker.OnJobFinished(_robotID, *jobOrNull);
        }
        else if (
            action.actionStatus == VDA5050::EActionStatus::Failed && bWasBegun
            && state.operatingMode == VDA5050::EOperatingMode::Manual)
        {
            _around.workChecker.OnJobInterrupted(_robotID, *jobOrNull);
        }
    }
}

std::unique_ptr<IRobotConnection> VehicleRobot::MakeConnection(std::uint64_t /*number*/, EventHandler handler)
{
    return std::make_unique<VehicleConnection>(
        _around.timeline,
        _around.broker,
        _around.robot,
        std::move(handler),
        nullptr);
}

void VehicleRobot::SetReachable(bool bReachable)
{
    _bReachable = bReachable;
    _around.broker.SetReachable(*_client, bReachable);
}

bool VehicleRobot::IsReachable() const
{
    return _bReachable;
}

void VehicleRobot::Disturb()
{
    _bDisturbed = true;
    VdaSim::Fault fault;
    switch (_chance.GetBelow(3))
    {
        case 0:
            fault = MakeFault(VdaSim::EFaultKind::EmergencyStop);
            break;
        case 1:
            fault = MakeFault(VdaSim::EFaultKind::Mode);
            _bLed = true;
            break;
        default:
            fault = MakeFault(VdaSim::EFaultKind::Stuck);
            fault.errorType = "driveError";
            fault.errorLevel = VDA5050::EErrorLevel::Fatal;
            break;
    }
    _around.trace.Add("{} has a fault: {}", _robotID, fault.text);
    Inject(std::move(fault));
}

void VehicleRobot::Recover()
{
    _bDisturbed = false;
    _around.trace.Add("{} has recovered", _robotID);
    Call([this](Core::Now now, auto& out) {
        for (const VdaSim::EFaultKind kind :
             {VdaSim::EFaultKind::EmergencyStop, VdaSim::EFaultKind::Mode, VdaSim::EFaultKind::Stuck})
        {
            static_cast<void>(_vehicle->EndFaults(kind, now, out));
        }
    });
    if (std::exchange(_bLed, false) && _chance.IsHit(500))
    {
        DriveByHand(); // otherwise it continues from where it is
    }
}

/// In manual mode the operator drives it to one end of the edge on which its order was lost, and sets its position.
void VehicleRobot::DriveByHand()
{
    const VDA5050::StateMessage state = _vehicle->GetState();
    if (!state.nodeStates.empty())
    {
        return; // it has an order again
    }
    if (state.bDriving)
    {
        constexpr std::uint64_t HAND_KEY = 1'000; // not a timer of the vehicle
        _timers.Start(HAND_KEY, 1s, [this] { DriveByHand(); });
        return;
    }
    const Planning::SiteNode& node = *_around.site.FindNodeOrNull(_chance.Pick(_place));
    _around.trace.Add("{} is put on {}", _robotID, node.nodeID);
    const std::string text = fmt::format(
        R"({{"headerId":{},"timestamp":"2025-07-02T12:00:00.000Z","version":"2.0.0","manufacturer":"ACS",)"
        R"("serialNumber":"{}","actions":[{{"actionType":"initPosition","actionId":"hand-{}","blockingType":"HARD",)"
        R"("actionParameters":[{{"key":"x","value":{}}},{{"key":"y","value":{}}},{{"key":"theta","value":0}},)"
        R"({{"key":"mapId","value":"floor"}},{{"key":"lastNodeId","value":"{}"}}]}}]}})",
        _handCount,
        _robotID,
        _handCount,
        node.x,
        node.y,
        node.nodeID);
    ++_handCount;
    const std::string topic = VDA5050::BuildTopic(MakeAddress(_robotID), VDA5050::ETopic::InstantActions);
    Call([this, &topic, &text](Core::Now now, auto& out) { _vehicle->OnMessage({topic, text, 2, false}, now, out); });
}

bool VehicleRobot::IsDisturbed() const
{
    return _bDisturbed;
}

void VehicleRobot::Forget()
{
    if (_place.size() > 1 || _vehicle->GetState().bDriving)
    {
        return; // not between two nodes: it would have to be carried to one
    }
    _around.trace.Add("{} loses its memory", _robotID);
    _charge = _vehicle->GetState().batteryState.batteryCharge;
    _timers.CancelAll();
    _actions.clear();
    for (const auto& [actionID, status] : _status)
    {
        const Planning::StartJob* const jobOrNull = _around.workChecker.FindCommandOrNull(actionID);
        const bool bRuns = status == VDA5050::EActionStatus::Running || status == VDA5050::EActionStatus::Paused;
        if (jobOrNull != nullptr && bRuns)
        {
            _around.workChecker.OnJobInterrupted(_robotID, *jobOrNull);
        }
    }
    _status.clear();
    _around.broker.Abandon(*_client);
    SwitchOn(_place.front());
}

void VehicleRobot::Calm()
{
    _bFaulty = false;
    Call([this](Core::Now now, auto& out) { static_cast<void>(_vehicle->EndFaults(std::nullopt, now, out)); });
}

std::string VehicleRobot::GetNodeID() const
{
    return _place.size() == 1 ? _place.front() : fmt::format("{}", fmt::join(_place, "-"));
}

bool VehicleRobot::IsDriving() const
{
    return _vehicle->GetState().bDriving;
}

bool VehicleRobot::IsAtRest() const
{
    const VDA5050::StateMessage state = _vehicle->GetState();
    const bool bActs = std::ranges::any_of(state.actionStates, [](const VDA5050::ActionState& action) {
        return action.actionStatus == VDA5050::EActionStatus::Running
            || action.actionStatus == VDA5050::EActionStatus::Paused;
    });
    return !state.bDriving && !state.bPaused.value_or(false) && state.nodeStates.empty() && !bActs;
}

/// A query brings it to the present time.
bool VehicleRobot::IsWorkUnderWay() const
{
    return false;
}

} // namespace ACS::Simulation
