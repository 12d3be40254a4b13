#include "vda-sim/VirtualVehicle.hpp"

#include "vda-sim/VehicleFactsheet.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

using namespace std::chrono_literals;

constexpr std::uint64_t KEY_TICK = 100;  ///< Above the keys of the session's own timers.
constexpr double SLICE_SECONDS = 0.02;   ///< Of simulated time: the grain of all motion.
constexpr double MAX_TICK_SECONDS = 5.0; ///< Of real time: a vehicle that was suspended does not leap.
constexpr double DEFAULT_SPEED = 1.0;    ///< m/s where an order states none.
constexpr double CORNER_ANGLE = 0.1;     ///< rad: a smaller change of direction is no corner.
constexpr double CHARGE_PER_METRE = 0.02;
constexpr double CHARGE_PER_SECOND = 0.5;
constexpr double MIN_CHARGE = 5.0;
constexpr double FULL_CHARGE = 100.0;
constexpr double REACH_PER_PERCENT = 50.0; ///< m
constexpr std::string_view CHARGER_PREFIX = "CHG";
constexpr Core::Duration STATE_WHILE_DRIVING = 1s;

VDA5050::VehicleOptions MakeSessionOptions(const VirtualVehicleOptions& options, const Planning::SiteMap& site)
{
    VDA5050::VehicleOptions session;
    session.address = options.address;
    session.version = options.version;
    session.factsheet = MakeFactsheet(options.type, options.limits);
    session.visualizationInterval = 200ms;
    session.bStopsBetweenNodes = false; // as a line-guided vehicle: a cancelled order ends on a node
    session.initialNodeID = options.startNodeID;
    std::set<std::string> mapIDs;
    for (const Planning::SiteNode& node : site.GetNodes())
    {
        mapIDs.insert(node.mapID);
    }
    if (!mapIDs.contains(std::string()))
    {
        session.mapIDs.assign(mapIDs.begin(), mapIDs.end());
    }
    return session;
}

/// VDA5050, orientation of an edge: against the map or against the direction of travel.
double GetHeading(double direction, std::optional<double> orientationOrNull, bool bGlobal)
{
    if (bGlobal)
    {
        return orientationOrNull.value_or(direction);
    }
    return NormaliseAngle(direction + orientationOrNull.value_or(0.0));
}

double GetDirection(const Pose& from, const Pose& to)
{
    return std::atan2(to.y - from.y, to.x - from.x);
}

double GetTurn(double from, double to)
{
    return std::abs(NormaliseAngle(to - from));
}

} // namespace

Pose GetStartPose(const Planning::SiteNode& node)
{
    const auto rule = std::ranges::find_if(node.rules, [](const Planning::SiteNodeRule& candidate) {
        return candidate.theta.has_value();
    });
    return {node.x, node.y, rule != node.rules.end() ? NormaliseAngle(rule->theta.value_or(0.0)) : 0.0};
}

VirtualVehicle::VirtualVehicle(VirtualVehicleOptions options, const Planning::SiteMap& site, Core::Logger logger)
    : _options(std::move(options)),
      _site(&site),
      _logger(std::move(logger)),
      _session(MakeSessionOptions(_options, site)),
      _motion(_options.limits, {}),
      _nodeID(_options.startNodeID)
{
    const Planning::SiteNode* const node = site.FindNodeOrNull(_nodeID);
    if (node != nullptr)
    {
        _motion = VehicleMotion(_options.limits, GetStartPose(*node));
        _mapID = node->mapID;
    }
}

std::vector<VDA5050::MqttSubscription> VirtualVehicle::GetSubscriptions() const
{
    return _session.GetSubscriptions();
}

VDA5050::MqttWill VirtualVehicle::MakeWill(Core::Now now)
{
    return _session.MakeWill(now);
}

void VirtualVehicle::OnLinkUp(Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    _session.OnLoads(_hands.GetLoads(), now, _sessionActions);
    if (!_mapID.empty())
    {
        const VDA5050::MapState map{_mapID, "1", VDA5050::EMapStatus::Enabled, {}};
        _session.OnMaps(std::vector<VDA5050::MapState>{map}, now, _sessionActions);
    }
    TellPosition();
    TellBattery(now);
    _session.OnLinkUp(now, _sessionActions);
    Pump(now, out);
}

void VirtualVehicle::OnLinkDown(Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    _session.OnLinkDown(now, _sessionActions);
    Pump(now, out);
}

void VirtualVehicle::OnMessage(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    _session.OnMessage(message.topic, message.payload, message.bRetained, now, _sessionActions);
    Pump(now, out);
    KeepTicking(out);
}

void VirtualVehicle::OnTimer(std::uint64_t key, Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    if (key == KEY_TICK)
    {
        _bTicking = false;
    }
    else
    {
        _session.OnTimer(static_cast<VDA5050::EVehicleTimer>(key), now, _sessionActions);
        Pump(now, out);
    }
    KeepTicking(out);
}

void VirtualVehicle::Leave(Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    _session.Leave(now, _sessionActions);
    Pump(now, out);
}

VDA5050::StateMessage VirtualVehicle::GetState() const
{
    return _session.GetState();
}

const Pose& VirtualVehicle::GetPose() const noexcept
{
    return _motion.GetPose();
}

const std::string& VirtualVehicle::GetName() const noexcept
{
    return _options.address.serialNumber;
}

void VirtualVehicle::PassTime(Core::Now now, VirtualActions& out)
{
    const Core::SteadyTime last = _lastTime.value_or(now.steady);
    _lastTime = now.steady;
    if (!_bTicking)
    {
        return; // it stood still, with nothing to do
    }
    const double passed = std::chrono::duration<double>(now.steady - last).count();
    Live(std::clamp(passed, 0.0, MAX_TICK_SECONDS) * _options.timeScale, now, out);
    TellPosition();
    TellBattery(now);
    Pump(now, out);
}

void VirtualVehicle::Live(double seconds, Core::Now now, VirtualActions& out)
{
    double left = seconds;
    while (left > 0.0)
    {
        const double slice = std::min(left, SLICE_SECONDS);
        left -= slice;
        const double drivenBefore = _motion.GetDriven();
        const bool bArrived = _motion.TryFinishLeg(slice);
        _charge = std::max(MIN_CHARGE, _charge - (_motion.GetDriven() - drivenBefore) * CHARGE_PER_METRE);
        if (_hands.IsCharging())
        {
            _charge = std::min(FULL_CHARGE, _charge + slice * CHARGE_PER_SECOND);
        }
        _hands.Advance(slice, _outcomes);
        if (bArrived)
        {
            ReachNode(now, out);
        }
        if (!_outcomes.empty())
        {
            EndActions(now, out);
        }
        if (_bDriving && _motion.IsStanding())
        {
            TellDriving(false, now);
            Pump(now, out);
        }
    }
}

void VirtualVehicle::ReachNode(Core::Now now, VirtualActions& out)
{
    if (!_leg.has_value())
    {
        return;
    }
    const VDA5050::DriveTo leg = *std::exchange(_leg, std::nullopt);
    _nodeID = leg.node.nodeID;
    if (leg.node.nodePosition.has_value())
    {
        _mapID = leg.node.nodePosition->mapID;
    }
    TellPosition();
    if (!_session.TryReachNode(leg.node.sequenceID, now, _sessionActions))
    {
        _logger.Warning("reached a node that the session does not expect", {{"node", _nodeID}});
    }
    Pump(now, out);
    if (!_motion.HasLeg())
    {
        _motion.Abandon(); // it passed the node at speed, but the order has changed: nothing follows
    }
}

void VirtualVehicle::EndActions(Core::Now now, VirtualActions& out)
{
    TellLoads(now);
    TellBattery(now);
    for (ActionOutcome& outcome : std::exchange(_outcomes, {}))
    {
        SetStatus(outcome.actionID, outcome.status, std::move(outcome.result), now);
    }
    Pump(now, out);
}

void VirtualVehicle::Pump(Core::Now now, VirtualActions& out)
{
    // Carrying out one may ask for others, which then are the next round.
    while (!_sessionActions.empty())
    {
        for (VDA5050::VehicleAction& action : std::exchange(_sessionActions, {}))
        {
            CarryOut(action, now, out);
        }
    }
}

void VirtualVehicle::CarryOut(VDA5050::VehicleAction& action, Core::Now now, VirtualActions& out)
{
    std::visit(
        Core::Overloaded{
            [&](VDA5050::PublishMessage& publish) { out.emplace_back(std::move(publish)); },
            [&](const VDA5050::StartVehicleTimer& start) {
                const bool bOften = _bDriving && start.timer == VDA5050::EVehicleTimer::MaximumStateInterval;
                const Core::Duration delay = bOften ? std::min(start.delay, STATE_WHILE_DRIVING) : start.delay;
                out.emplace_back(StartVirtualTimer{static_cast<std::uint64_t>(start.timer), delay});
            },
            [&](const VDA5050::CancelVehicleTimer& cancel) {
                out.emplace_back(CancelVirtualTimer{static_cast<std::uint64_t>(cancel.timer)});
            },
            [&](const VDA5050::DriveTo& drive) { Drive(drive, now); },
            [&](const VDA5050::StopDriving&) {
                _motion.Brake();
                if (_motion.IsStanding())
                {
                    _bDriving = false;
                    _session.OnDrivingChanged(false, now, _sessionActions);
                }
            },
            [&](const VDA5050::StartAction& start) { Start(start, now); },
            [&](const VDA5050::PauseAction& pause) {
                if (_hands.TryPause(pause.actionID))
                {
                    SetStatus(pause.actionID, VDA5050::EActionStatus::Paused, {}, now);
                }
            },
            [&](const VDA5050::ResumeAction& resume) {
                if (_hands.TryResume(resume.actionID))
                {
                    SetStatus(resume.actionID, VDA5050::EActionStatus::Running, {}, now);
                }
            },
            [&](const VDA5050::StopAction& stop) {
                if (_hands.TryStop(stop.actionID))
                {
                    SetStatus(stop.actionID, VDA5050::EActionStatus::Failed, "stopped", now);
                }
            },
            [&](const VDA5050::OrderTaken& taken) {
                _logger.Info(taken.bUpdate ? "order update" : "order", {{"orderId", taken.orderID}});
            },
            [&](const VDA5050::OrderRefused& refused) { Log(refused); },
            [&](const VDA5050::OrderCompleted& completed) {
                _logger.Info("order completed", {{"orderId", completed.orderID}});
            },
            [&](const VDA5050::OrderCleared& cleared) {
                _leg.reset();
                _motion.Abandon();
                _logger.Info("order cancelled", {{"orderId", cleared.orderID}});
            },
            [&](const VDA5050::MessageIgnored& ignored) {
                _logger.Warning("message ignored", {{"reason", Core::Describe(ignored.error)}});
            }},
        action);
}

void VirtualVehicle::Log(const VDA5050::OrderRefused& refused) const
{
    _logger.Warning(
        "order refused",
        {{"orderId", refused.orderID}, {"error", refused.errorType}, {"reason", refused.reason}});
}

void VirtualVehicle::TellPosition()
{
    const Pose& pose = _motion.GetPose();
    VDA5050::AgvPosition position;
    position.bPositionInitialized = true;
    position.localizationScore = 1.0;
    position.x = pose.x;
    position.y = pose.y;
    position.theta = pose.theta;
    position.mapID = _mapID;
    VDA5050::Velocity velocity;
    velocity.vx = _motion.GetForwardSpeed();
    velocity.vy = _motion.GetSidewaysSpeed();
    velocity.omega = _motion.GetTurnSpeed();
    _session.OnPosition(position, velocity, _motion.HasLeg() ? _motion.GetDriven() : 0.0);
}

void VirtualVehicle::TellDriving(bool bDriving, Core::Now now)
{
    if (_bDriving != bDriving)
    {
        _bDriving = bDriving;
        _session.OnDrivingChanged(bDriving, now, _sessionActions);
    }
}

void VirtualVehicle::TellBattery(Core::Now now)
{
    VDA5050::BatteryState battery;
    battery.batteryCharge = _charge;
    battery.bCharging = _hands.IsCharging();
    battery.reach = std::floor(_charge * REACH_PER_PERCENT);
    _session.OnBattery(battery, now, _sessionActions);
}

void VirtualVehicle::TellLoads(Core::Now now)
{
    if (_reportedLoads != _hands.GetLoads().size())
    {
        _reportedLoads = _hands.GetLoads().size();
        _session.OnLoads(_hands.GetLoads(), now, _sessionActions);
    }
}

void VirtualVehicle::KeepTicking(VirtualActions& out)
{
    const bool bMoving = _bDriving || (_motion.HasLeg() && !_motion.IsStanding());
    if (_bTicking || !(bMoving || _hands.IsBusy() || _hands.IsCharging()))
    {
        return;
    }
    _bTicking = true;
    // The faster the simulated time, the shorter the tick, so that a node is not noticed a second late.
    const auto tick = std::chrono::duration_cast<Core::Duration>(50ms / std::clamp(_options.timeScale, 1.0, 5.0));
    out.emplace_back(StartVirtualTimer{KEY_TICK, tick});
}

void VirtualVehicle::Drive(const VDA5050::DriveTo& drive, Core::Now now)
{
    const bool bSameLeg = _motion.HasLeg() && _leg.has_value() && _leg->node.sequenceID == drive.node.sequenceID
        && _leg->edge.edgeID == drive.edge.edgeID;
    MotionLeg leg = MakeLeg(drive);
    if (bSameLeg)
    {
        _motion.SetExitSpeed(leg.exitSpeed);
        _motion.Resume();
    }
    else
    {
        _motion.Begin(leg);
    }
    _leg = drive;
    _hands.Undock();
    TellDriving(true, now);
    TellBattery(now);
}

Pose VirtualVehicle::GetNodePose(const VDA5050::OrderNode& node) const
{
    if (node.nodePosition.has_value())
    {
        return {node.nodePosition->x, node.nodePosition->y, 0.0};
    }
    const Planning::SiteNode* const known = _site->FindNodeOrNull(node.nodeID);
    return known != nullptr ? Pose{known->x, known->y, 0.0} : _motion.GetPose();
}

MotionLeg VirtualVehicle::MakeLeg(const VDA5050::DriveTo& drive) const
{
    const Pose& pose = _motion.GetPose();
    const VDA5050::OrderEdge& edge = drive.edge;
    const bool bGlobal = edge.orientationType == VDA5050::EOrientationType::Global;
    MotionLeg leg;
    leg.target = GetNodePose(drive.node);
    const bool bSamePlace = leg.target.x == pose.x && leg.target.y == pose.y;
    leg.target.theta = bSamePlace ? pose.theta : GetHeading(GetDirection(pose, leg.target), edge.orientation, bGlobal);
    // An order may state any number: below zero it allows no movement, as zero does.
    leg.maxSpeed = std::max(edge.maxSpeed.value_or(DEFAULT_SPEED), 0.0);
    leg.maxTurnSpeed = std::max(edge.maxRotationSpeed.value_or(_options.limits.maxTurnSpeed), 0.0);
    leg.bTurnBefore = !edge.bRotationAllowed.value_or(true);
    if (drive.node.nodePosition.has_value())
    {
        leg.finalTheta = drive.node.nodePosition->theta;
    }
    leg.exitSpeed = GetExitSpeed(drive, leg);
    return leg;
}

double VirtualVehicle::GetExitSpeed(const VDA5050::DriveTo& drive, const MotionLeg& leg) const
{
    const bool bTurnsThere =
        leg.finalTheta.has_value() && GetTurn(leg.target.theta, *leg.finalTheta) > _options.limits.turnTolerance;
    if (drive.bStopAtNode || bTurnsThere)
    {
        return 0.0;
    }
    const VDA5050::StateMessage state = _session.GetState();
    const auto node = std::ranges::find(state.nodeStates, drive.node.sequenceID + 2, &VDA5050::NodeState::sequenceID);
    const auto edge = std::ranges::find(state.edgeStates, drive.node.sequenceID + 1, &VDA5050::EdgeState::sequenceID);
    if (node == state.nodeStates.end() || edge == state.edgeStates.end())
    {
        return 0.0;
    }
    VDA5050::OrderNode nextNode;
    nextNode.nodeID = node->nodeID;
    if (node->nodePosition.has_value())
    {
        nextNode.nodePosition = VDA5050::NodePosition{};
        nextNode.nodePosition->x = node->nodePosition->x;
        nextNode.nodePosition->y = node->nodePosition->y;
    }
    const double direction = GetDirection(leg.target, GetNodePose(nextNode));
    const bool bCorner = GetTurn(GetDirection(_motion.GetPose(), leg.target), direction) > CORNER_ANGLE;
    const double speed = bCorner ? std::min(leg.maxSpeed, _options.limits.cornerSpeed) : leg.maxSpeed;
    const auto known = std::ranges::find(_site->GetEdges(), edge->edgeID, &Planning::SiteEdge::edgeID);
    if (known == _site->GetEdges().end() || known->rules.empty())
    {
        return speed;
    }
    const Planning::SiteEdgeRule& rule = known->rules.front();
    const double heading = GetHeading(direction, rule.orientation, rule.orientationType == "GLOBAL");
    const bool bMustTurn = GetTurn(leg.target.theta, heading) > _options.limits.turnTolerance;
    if (bMustTurn && !rule.bRotationAllowed.value_or(true))
    {
        return 0.0;
    }
    return std::min(speed, rule.maxSpeed.value_or(speed));
}

void VirtualVehicle::Start(const VDA5050::StartAction& start, Core::Now now)
{
    std::string refusal = _hands.Start(start.action, IsAtCharger());
    const bool bRuns = refusal.empty();
    SetStatus(start.action.actionID, VDA5050::EActionStatus::Running, {}, now);
    if (!bRuns)
    {
        SetStatus(start.action.actionID, VDA5050::EActionStatus::Failed, std::move(refusal), now);
    }
}

void VirtualVehicle::SetStatus(
    std::string_view actionID,
    VDA5050::EActionStatus status,
    std::string result,
    Core::Now now)
{
    _logger.Debug("action", {{"actionId", actionID}, {"status", VDA5050::GetStatusText(status)}});
    if (!_session.TrySetActionStatus(actionID, status, std::move(result), now, _sessionActions))
    {
        _logger.Warning("the session does not take a status", {{"actionId", actionID}});
    }
}

bool VirtualVehicle::IsAtCharger() const
{
    const Planning::SiteStation* const station = _site->FindStationAtOrNull(_nodeID);
    return station != nullptr && station->stationID.starts_with(CHARGER_PREFIX) && !_motion.HasLeg();
}

} // namespace ACS::VdaSim
