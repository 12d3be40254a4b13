#include "vda-sim/VirtualVehicle.hpp"

#include "vda-sim/OrderLimits.hpp"
#include "vda-sim/ProfileRules.hpp"
#include "vda-sim/VehicleFactsheet.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/ShortText.hpp>
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace ACS::VdaSim
{
namespace
{

using namespace std::chrono_literals;

constexpr Core::Duration STATE_WHILE_DRIVING = 1s;

/// A vehicle that reports no position shows the session nothing of its loss.
void CheckLocalized(
    const VDA5050::OrderMessage& order,
    const VDA5050::OrderContext& context,
    std::vector<VDA5050::OrderViolation>& violations)
{
    if (order.orderID != context.heldOrderID)
    {
        violations.push_back(VDA5050::MakeOrderViolation(
            order,
            VDA5050::ErrorTypes::NO_ROUTE_ERROR,
            "the vehicle does not know where it is"));
    }
}

/// The names of the site's maps; of nodes without a mapId there is none.
std::set<std::string> ListMaps(const Planning::SiteMap& site)
{
    std::set<std::string> mapIDs;
    for (const Planning::SiteNode& node : site.GetNodes())
    {
        mapIDs.insert(node.mapID);
    }
    mapIDs.erase(std::string());
    return mapIDs;
}

/// Whether the states of the vehicle have maps, which are new in 2.1.
bool HasMapStates(const VirtualVehicleOptions& options)
{
    return options.version != VDA5050::EVda5050Version::Version200
        && GetProfile(options.profile).traits.bReportsPosition;
}

VDA5050::VehicleOptions MakeSessionOptions(
    const VirtualVehicleOptions& options,
    const Planning::SiteMap& site,
    std::shared_ptr<const bool> lost,
    std::shared_ptr<const std::set<std::string>> disabledMapIDs)
{
    VDA5050::VehicleOptions session;
    session.address = options.address;
    session.version = options.version;
    session.qos = options.qos;
    session.factsheet = MakeFactsheet(options.type, options.limits, options.version, options.handling);
    const VehicleProfile& profile = GetProfile(options.profile);
    if (profile.adaptOrNull != nullptr)
    {
        profile.adaptOrNull(session.factsheet);
    }
    session.parameterCheck = options.parameterCheck;
    session.visualizationInterval = profile.traits.bReportsPosition ? 200ms : 0ms;
    session.bForgetsInManual = profile.traits.bForgetsInManual;
    session.bStopsBetweenNodes = false; // like a line-guided vehicle: a cancelled order ends on a node
    session.initialNodeID = options.startNodeID;
    session.orderCheck =
        [&site,
         traits = profile.traits,
         handling = options.handling,
         lost = std::move(lost),
         disabledMapIDs =
             std::move(disabledMapIDs)](const VDA5050::OrderMessage& order, const VDA5050::OrderContext& context) {
            std::vector<VDA5050::OrderViolation> violations = FindUndrivable(order, site);
            std::ranges::move(FindDisabledMaps(order, *disabledMapIDs), std::back_inserter(violations));
            std::ranges::move(FindRejected(order, context, traits, handling), std::back_inserter(violations));
            if (*lost)
            {
                CheckLocalized(order, context, violations);
            }
            return violations;
        };
    if (!HasMapStates(options))
    {
        const std::set<std::string> mapIDs = ListMaps(site);
        session.mapIDs.assign(mapIDs.begin(), mapIDs.end());
    }
    return session;
}

} // namespace

VirtualVehicle::VirtualVehicle(
    VirtualVehicleOptions options,
    const Planning::SiteMap& site,
    Core::IRandom& random,
    Core::Logger logger)
    : _options(std::move(options)),
      _site(&site),
      _random(&random),
      _logger(std::move(logger)),
      _session(MakeSessionOptions(_options, site, _lost, _disabledMapIDs)),
      _drive(site, _options.limits, _options.startNodeID, _options.startPosition),
      _actionRunner(
          _options.actionSeconds,
          LoadDevice(_options.address.serialNumber, _options.type, _options.handling, _options.worldOrNull)),
      _battery(_options.charge),
      _clock(_options.timeScale),
      _incoming(EFaultDirection::In, GetProfile(_options.profile).traits.acceptanceTime),
      _warnings(_logger)
{
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
    UpdateDock(now);
    _actionRunner.GetDevice().UpdateLoads();
    ReportLoads(now);
    if (!_faults.WasOnline() && HasMapStates(_options))
    {
        ReportMaps(now);
    }
    ReportPosition();
    ReportBattery(now);
    _session.OnLinkUp(now, _sessionActions);
    Pump(now, out);
    _faults.OnLinkUp(now.steady);
    Settle(now, out);
}

void VirtualVehicle::OnLinkDown(Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    _session.OnLinkDown(now, _sessionActions);
    _incoming.Clear();
    _outgoing.Clear();
    Settle(now, out);
}

void VirtualVehicle::OnMessage(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    std::vector<VDA5050::MqttMessage> passed;
    _incoming.Pass(message, _faults.GetBoard(), *_random, now.steady, passed);
    LogOverflow(_incoming.TakeOverflow(), now);
    for (const VDA5050::MqttMessage& through : passed)
    {
        Deliver(through, now, out);
    }
    Settle(now, out);
}

void VirtualVehicle::OnTimer(std::uint64_t key, Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    if (key == KEY_TICK)
    {
        _clock.OnTick();
    }
    else if (key == KEY_EVENT)
    {
        _nextEvent.reset();
        _faults.OnTime(now.steady);
        ReleaseMessages(now, out);
    }
    else
    {
        _session.OnTimer(static_cast<VDA5050::EVehicleTimer>(key), now, _sessionActions);
    }
    Settle(now, out);
}

void VirtualVehicle::Leave(Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    _session.Leave(now, _sessionActions);
    Pump(now, out);
    ReleaseMessages({Core::SteadyTime::max(), now.wall}, out);
}

void VirtualVehicle::Settle(Core::Now now, VirtualActions& out)
{
    Pump(now, out);
    ApplyFaults(now, out);
    UpdateDock(now);
    KeepTicking(out);
    ScheduleEvents(now, out);
}

VDA5050::StateMessage VirtualVehicle::GetState() const
{
    return _session.GetState();
}

const Pose& VirtualVehicle::GetPose() const noexcept
{
    return _drive.GetMotion().GetPose();
}

void VirtualVehicle::PassTime(Core::Now now, VirtualActions& out)
{
    const std::size_t slices = _clock.CountSlices(now.steady);
    if (!_clock.IsTicking())
    {
        return; // it was stationary, with nothing to do
    }
    for (std::size_t i = 0; i < slices; ++i)
    {
        AdvanceSlice(now, out);
    }
    ReportPosition();
    ReportBattery(now);
    Pump(now, out);
}

void VirtualVehicle::AdvanceSlice(Core::Now now, VirtualActions& out)
{
    const DriveStep step = _drive.Advance(SliceClock::SLICE_SECONDS);
    _battery.Discharge(step.metres);
    if (_actionRunner.IsCharging())
    {
        _battery.Charge(SliceClock::SLICE_SECONDS);
    }
    if (step.reached.has_value())
    {
        OnNodeReached(*step.reached, now, out); // first: it ends the edge's actions
    }
    std::vector<ActionOutcome> outcomes;
    if (!_faults.GetBoard().IsActive(EFaultKind::EmergencyStop))
    {
        _actionRunner.Advance(SliceClock::SLICE_SECONDS, outcomes);
    }
    if (!outcomes.empty())
    {
        EndActions(std::move(outcomes), now, out);
    }
    _drive.EndAbandoned();
    if (_bDriving && _drive.GetMotion().IsStanding())
    {
        ReportDriving(false, now);
        Pump(now, out);
    }
}

void VirtualVehicle::OnNodeReached(const VDA5050::DriveTo& leg, Core::Now now, VirtualActions& out)
{
    ReportPosition();
    UpdateDock(now);
    VDA5050::NodeArrival arrival{leg.node.sequenceID, leg.bStopAtNode};
    for (const VDA5050::Action& action : leg.edge.actions)
    {
        if (auto ended = _actionRunner.StopOrNull(action.actionID, true); ended.has_value())
        {
            arrival.edgeActions.push_back({std::move(ended->actionID), ended->status, std::move(ended->result)});
        }
    }
    if (_session.TryReachNode(std::move(arrival), now, _sessionActions))
    {
        _bDriving = _bDriving && !leg.bStopAtNode;
    }
    else
    {
        _logger.Warning("reached a node that the session does not expect", {{"node", leg.node.nodeID}});
    }
    Pump(now, out);
    _drive.EndPassing();
    _faults.OnPlace(_drive.GetNodeID(), now.steady);
    ApplyFaults(now, out);
}

void VirtualVehicle::Pump(Core::Now now, VirtualActions& out)
{
    // An action may add others, which the next round executes.
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
            [&](VDA5050::PublishMessage& publish) { Send(std::move(publish.message), now, out); },
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
                _drive.Stop();
                UpdateBrake(now);
                if (_drive.GetMotion().IsStanding())
                {
                    // Also if it was reported before: the session waits for it.
                    _session.OnDrivingChanged(false, now, _sessionActions);
                }
            },
            [&](const VDA5050::StartAction& start) { Start(start, now); },
            [&](const VDA5050::PauseAction& pause) {
                if (_actionRunner.TryPause(pause.actionID))
                {
                    SetStatus(pause.actionID, VDA5050::EActionStatus::Paused, {}, now);
                }
            },
            [&](const VDA5050::ResumeAction& resume) {
                if (_actionRunner.TryResume(resume.actionID))
                {
                    SetStatus(resume.actionID, VDA5050::EActionStatus::Running, {}, now);
                }
            },
            [&](const VDA5050::StopAction& stop) {
                if (auto ended = _actionRunner.StopOrNull(stop.actionID, stop.bEdgeEnded); ended.has_value())
                {
                    SetStatus(stop.actionID, ended->status, std::move(ended->result), now);
                }
            },
            [&](const VDA5050::OrderTaken& taken) {
                _orderErrors.clear();
                _session.OnErrors(MakeErrors(), now, _sessionActions);
                _logger.Info(taken.bUpdate ? "order update" : "order", {{"orderId", Core::ShortenText(taken.orderID)}});
            },
            [&](const VDA5050::OrderRefused& refused) { LogRefusal(refused, now); },
            [&](const VDA5050::OrderCompleted& completed) {
                _logger.Info("order completed", {{"orderId", Core::ShortenText(completed.orderID)}});
            },
            [&](const VDA5050::OrderCleared& cleared) {
                _drive.Abandon();
                _logger.Info("order cancelled", {{"orderId", Core::ShortenText(cleared.orderID)}});
            },
            [&](const VDA5050::MessageIgnored& ignored) {
                LogIgnored(ignored, now);
            }},
        action);
}

void VirtualVehicle::Drive(const VDA5050::DriveTo& drive, Core::Now now)
{
    _drive.Begin(drive);
    _actionRunner.Undock();
    UpdateDock(now);
    // Whether an obstacle can be passed depends on the edge.
    ReportCondition(now);
    ReportBattery(now);
}

void VirtualVehicle::LogRefusal(const VDA5050::OrderRefused& refused, Core::Now now)
{
    LogWarning(
        now,
        "order refused",
        {{"orderId", Core::ShortenText(refused.orderID)},
         {"error", Core::ShortenText(refused.errorType)},
         {"reason", Core::ShortenText(refused.reason)}});
}

void VirtualVehicle::LogIgnored(const VDA5050::MessageIgnored& ignored, Core::Now now)
{
    const std::string reason = Core::Describe(ignored.error);
    LogWarning(now, "message ignored", {{"reason", Core::ShortenText(reason)}});
}

void VirtualVehicle::LogOverflow(std::size_t lost, Core::Now now)
{
    if (lost > 0)
    {
        LogWarning(now, "too many delayed messages: further ones are lost", {});
    }
}

void VirtualVehicle::LogWarning(Core::Now now, std::string_view message, std::initializer_list<Core::LogField> fields)
{
    _warnings.Write(now.steady, Core::ELogLevel::Warning, message, message, fields);
}

void VirtualVehicle::ReportPosition()
{
    if (!GetProfile(_options.profile).traits.bReportsPosition)
    {
        return;
    }
    const VehicleMotion& motion = _drive.GetMotion();
    const Pose& pose = motion.GetPose();
    VDA5050::AgvPosition position;
    position.bPositionInitialized = !_faults.GetBoard().IsActive(EFaultKind::Lost);
    position.localizationScore = position.bPositionInitialized ? 1.0 : 0.0;
    position.x = pose.x;
    position.y = pose.y;
    position.theta = pose.theta;
    position.mapID = _drive.GetMapID();
    VDA5050::Velocity velocity;
    velocity.vx = motion.GetForwardSpeed();
    velocity.vy = motion.GetSidewaysSpeed();
    velocity.omega = motion.GetTurnSpeed();
    _session.OnPosition(position, velocity, motion.HasLeg() ? motion.GetDriven() : 0.0);
}

void VirtualVehicle::ReportMaps(Core::Now now)
{
    std::vector<VDA5050::MapState> maps;
    for (const std::string& mapID : ListMaps(*_site))
    {
        maps.push_back({mapID, "1", VDA5050::EMapStatus::Enabled, {}});
    }
    if (!maps.empty())
    {
        _session.OnMaps(std::move(maps), now, _sessionActions);
    }
}

void VirtualVehicle::UpdateDisabledMaps()
{
    _disabledMapIDs->clear();
    if (!HasMapStates(_options))
    {
        return;
    }
    const VDA5050::StateMessage state = _session.GetState();
    const bool bEnabling = std::ranges::any_of(state.actionStates, [](const VDA5050::ActionState& action) {
        return action.actionType == VDA5050::ActionTypes::ENABLE_MAP && !VDA5050::IsTerminal(action.actionStatus);
    });
    if (bEnabling || !state.maps.has_value())
    {
        return; // it may enable the map that the message needs
    }
    std::set<std::string> enabled;
    for (const VDA5050::MapState& map : *state.maps)
    {
        (map.mapStatus == VDA5050::EMapStatus::Enabled ? enabled : *_disabledMapIDs).insert(map.mapID);
    }
    std::erase_if(*_disabledMapIDs, [&enabled](const std::string& mapID) { return enabled.contains(mapID); });
}

void VirtualVehicle::ReportDriving(bool bDriving, Core::Now now)
{
    if (_bDriving != bDriving)
    {
        _bDriving = bDriving;
        _session.OnDrivingChanged(bDriving, now, _sessionActions);
    }
}

void VirtualVehicle::ReportBattery(Core::Now now)
{
    _session.OnBattery(_battery.MakeState(_actionRunner.IsCharging()), now, _sessionActions);
    if (_battery.TryUpdateLow())
    {
        _session.OnErrors(MakeErrors(), now, _sessionActions);
    }
}

void VirtualVehicle::KeepTicking(VirtualActions& out)
{
    const bool bActive = _bDriving || _drive.IsMoving() || _actionRunner.IsBusy() || _actionRunner.IsCharging()
        || !_dockNodeID.has_value();
    if (bActive && !_clock.IsTicking())
    {
        out.emplace_back(StartVirtualTimer{KEY_TICK, _clock.StartTick()});
    }
}

} // namespace ACS::VdaSim
