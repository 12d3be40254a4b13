#pragma once

#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "SchemaCheck.hpp"
#include "SeededRandom.hpp"
#include "vda-sim/VirtualVehicle.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// N0 --10 m--> N1 --5 m, to the north--> N2 --1 m--> CHG01's dock, a charger that is entered without rotation, and back.
/// A01.CP01 and A01.CP02 are at N1, A02.CP01 at N2.
inline Planning::SiteMap MakeTestSite()
{
    const auto node = [](std::string nodeID, double x, double y, std::optional<double> thetaOrNull) {
        return Planning::SiteNode{std::move(nodeID), x, y, "floor", {{"any", thetaOrNull}}};
    };
    const auto edge = [](std::string from, std::string to, double speed, double orientation, bool bRotation) {
        Planning::SiteEdgeRule rule;
        rule.vehicleTypeID = "any";
        rule.maxSpeed = speed;
        rule.orientation = orientation;
        rule.orientationType = "TANGENTIAL";
        rule.bRotationAllowed = bRotation;
        std::string edgeID = from + "-" + to;
        return Planning::SiteEdge{std::move(edgeID), std::move(from), std::move(to), {std::move(rule)}};
    };
    auto site = Planning::SiteMap::Create(
        {node("N0", 0.0, 0.0, std::nullopt),
         node("N1", 10.0, 0.0, std::nullopt),
         node("N2", 10.0, 5.0, std::nullopt),
         node("DOCK", 11.0, 5.0, 0.0)},
        {edge("N0", "N1", 1.2, 0.0, true),
         edge("N1", "N2", 1.2, 0.0, true),
         edge("N2", "DOCK", 0.4, 0.0, false),
         edge("DOCK", "N2", 0.4, std::numbers::pi, false)},
        {{"CHG01", {"DOCK"}}, {"A01.CP01", {"N1"}}, {"A01.CP02", {"N1"}}, {"A02.CP01", {"N2"}}});
    if (!site.has_value())
    {
        throw std::runtime_error(Core::Describe(site.error()));
    }
    return std::move(*site);
}

/// An action parameter whose value is a text.
[[nodiscard]] inline VDA5050::ActionParameter MakeText(std::string_view key, std::string_view value)
{
    return {std::string(key), Core::JsonText::FromString(value)};
}

/// Adds the parameters that the standard makes mandatory and the action lacks.
inline void AddMandatoryParameters(VDA5050::Action& action)
{
    const VDA5050::AgvAction* const row = VDA5050::FindPredefinedActionOrNull(action.actionType);
    if (row == nullptr)
    {
        return;
    }
    for (const VDA5050::AgvActionParameter& listed : row->actionParameters)
    {
        if (!listed.bOptional.value_or(false) && VDA5050::FindParameterOrNull(action, listed.key) == nullptr)
        {
            action.actionParameters.push_back({listed.key, Core::JsonText::FromString("any")});
        }
    }
}

/// A virtual vehicle in virtual time: its timers fire when the test advances the time. Its messages are checked against
/// the official schemas.
class VehicleDriver
{
    Planning::SiteMap _site;
    ManualClock _clock;
    RecordingLogSink _log;
    SeededRandom _random;
    VDA5050::EVda5050Version _version;
    VdaSim::VirtualVehicle _vehicle;
    VdaSim::VirtualActions _actions;
    std::map<std::uint64_t, Core::SteadyTime> _timers;
    std::vector<std::pair<Core::SteadyTime, VDA5050::MqttMessage>> _published;
    VDA5050::Vda5050Codec _codec;
    std::uint32_t _headerID = 0;
    bool _bConnected = true;
    std::vector<bool> _cuts; ///< With the will or without.

public:
    explicit VehicleDriver(std::string startNodeID, double timeScale = 1.0)
        : VehicleDriver(MakeOptions(std::move(startNodeID), timeScale))
    {
    }

    explicit VehicleDriver(
        VdaSim::VirtualVehicleOptions options,
        std::uint64_t seed = 1,
        Planning::SiteMap site = MakeTestSite())
        : _site(std::move(site)),
          _random(seed),
          _version(options.version),
          _vehicle(std::move(options), _site, _random, Core::Logger(_log, "LR01"))
    {
        _vehicle.OnLinkUp(_clock.GetNow(), _actions);
        Execute();
    }

    [[nodiscard]] static VdaSim::VirtualVehicleOptions MakeOptions(std::string startNodeID, double timeScale = 1.0)
    {
        VdaSim::VirtualVehicleOptions options;
        options.address = {"uagv", "ACS", "LR01"};
        options.startNodeID = std::move(startNodeID);
        options.timeScale = timeScale;
        return options;
    }

    /// Ten metres, from N0 to N1, and on to N2.
    void SendRoute(const std::string& orderID = "order-1")
    {
        auto route = MakeRoute(orderID, {"N0", "N1", "N2"});
        Send(Take(route.MakeOrder(3)));
    }

    /// initPosition with N0 as the last node.
    void SendPositionAtN0(const std::string& actionID, double x, double theta)
    {
        SendInstantly(
            VDA5050::ActionTypes::INIT_POSITION,
            actionID,
            {{"x", Core::JsonText::FromNumber(x)},
             {"y", Core::JsonText::FromNumber(0.0)},
             {"theta", Core::JsonText::FromNumber(theta)},
             {"mapId", Core::JsonText::FromString("floor")},
             {"lastNodeId", Core::JsonText::FromString("N0")}});
    }

    /// The order of the route, its second node with this action on it.
    [[nodiscard]] VDA5050::OrderMessage MakeOrderWith(std::string_view actionType, const std::string& actionID)
    {
        auto route = MakeRoute("with-" + actionID, {"N0", "N1", "N2"});
        VDA5050::OrderMessage order = Take(route.MakeOrder(3));
        VDA5050::Action action;
        action.actionType = std::string(actionType);
        action.actionID = actionID;
        action.blockingType = VDA5050::EBlockingType::Hard;
        AddMandatoryParameters(action);
        order.nodes[1].actions.push_back(action);
        return order;
    }

    /// Whether a line of the log has this message and this fault.
    [[nodiscard]] bool HasLine(std::string_view message, std::string_view fault) const
    {
        return std::ranges::any_of(_log.GetLines(), [&](const RecordedLine& line) {
            return line.message == message && line.HasField("fault", fault);
        });
    }

    /// "stuck for=5s"
    void Inject(std::string_view fault)
    {
        if (!TryInject(fault))
        {
            throw std::runtime_error("the vehicle has too many faults");
        }
    }

    [[nodiscard]] bool TryInject(std::string_view fault)
    {
        const bool bTaken =
            _vehicle.TryInject(Take(Apps::ParseFault(VdaSim::GetFaultGrammar(), fault)), _clock.GetNow(), _actions);
        Execute();
        return bTaken;
    }

    std::size_t EndFaults(std::optional<VdaSim::EFaultKind> kindOrNull = {})
    {
        const std::size_t count = _vehicle.EndFaults(kindOrNull, _clock.GetNow(), _actions);
        Execute();
        return count;
    }

    std::size_t Trigger()
    {
        const std::size_t count = _vehicle.Trigger(_clock.GetNow(), _actions);
        Execute();
        return count;
    }

    void NoteWorldChanged()
    {
        _vehicle.OnWorldChanged(_clock.GetNow(), _actions);
        Execute();
    }

    /// Whether the vehicle requests a connection, which it then gets.
    [[nodiscard]] bool IsConnected() const noexcept
    {
        return _bConnected;
    }

    /// A builder for the route along these nodes, with the edges of the site.
    [[nodiscard]] VDA5050::OrderBuilder MakeRoute(const std::string& orderID, const std::vector<std::string>& nodeIDs)
    {
        std::vector<VDA5050::OrderNode> nodes;
        std::vector<VDA5050::OrderEdge> edges;
        for (const std::string& nodeID : nodeIDs)
        {
            const Planning::SiteNode& known = *_site.FindNodeOrNull(nodeID);
            VDA5050::OrderNode node;
            node.nodeID = nodeID;
            node.nodePosition = VDA5050::NodePosition{};
            node.nodePosition->x = known.x;
            node.nodePosition->y = known.y;
            node.nodePosition->theta = known.rules.front().theta;
            node.nodePosition->mapID = known.mapID;
            if (!nodes.empty())
            {
                edges.push_back(MakeEdge(nodes.back().nodeID + "-" + nodeID));
            }
            nodes.push_back(std::move(node));
        }
        return Take(VDA5050::OrderBuilder::Create(orderID, std::move(nodes), std::move(edges)));
    }

    /// Sends any payload on the topic order.
    void SendRaw(const std::string& payload)
    {
        Receive(VDA5050::ETopic::Order, payload);
    }

    /// With the header of a message for another vehicle.
    void SendToOther(VDA5050::OrderMessage order)
    {
        order.header = MakeHeader();
        order.header.serialNumber = "LR02";
        Receive(VDA5050::ETopic::Order, _codec.Encode(order, VDA5050::EVda5050Version::Version200));
    }

    /// As the broker sends a retained message after the subscription.
    void SendRetained(VDA5050::OrderMessage order)
    {
        order.header = MakeHeader();
        const std::string topic = VDA5050::BuildTopic({"uagv", "ACS", "LR01"}, VDA5050::ETopic::Order);
        const std::string payload = _codec.Encode(order, VDA5050::EVda5050Version::Version200);
        _vehicle.OnMessage({topic, payload, 0, true}, _clock.GetNow(), _actions);
        Execute();
    }

    void Send(VDA5050::OrderMessage order, VDA5050::EVda5050Version version = VDA5050::EVda5050Version::Version200)
    {
        order.header = MakeHeader();
        Receive(VDA5050::ETopic::Order, _codec.Encode(order, version));
    }

    void SendInstantly(
        std::string_view actionType,
        std::string actionID,
        std::vector<VDA5050::ActionParameter> parameters = {})
    {
        VDA5050::InstantActionsMessage message;
        message.header = MakeHeader();
        VDA5050::Action action;
        action.actionType = std::string(actionType);
        action.actionID = std::move(actionID);
        action.blockingType = VDA5050::EBlockingType::Hard;
        action.actionParameters = std::move(parameters);
        message.actions.push_back(std::move(action));
        Receive(VDA5050::ETopic::InstantActions, _codec.Encode(message, VDA5050::EVda5050Version::Version200));
    }

    /// Fires every timer that is due, each at its time; calls the watcher after each.
    void Pass(std::chrono::milliseconds span, const std::function<void()>& watch = {})
    {
        const Core::SteadyTime end = _clock.GetNow().steady + span;
        for (auto next = FindNext(); next != _timers.end() && next->second <= end; next = FindNext())
        {
            const std::uint64_t key = next->first;
            MoveTo(next->second);
            _timers.erase(next);
            _vehicle.OnTimer(key, _clock.GetNow(), _actions);
            Execute();
            if (watch)
            {
                watch();
            }
        }
        MoveTo(end);
    }

    /// Advances at most this time; false if the condition did not become true.
    [[nodiscard]] bool TryPassUntil(const std::function<bool()>& isTrue, std::chrono::milliseconds limit)
    {
        const Core::SteadyTime end = _clock.GetNow().steady + limit;
        while (!isTrue() && _clock.GetNow().steady < end)
        {
            Pass(std::chrono::milliseconds(10));
        }
        return isTrue();
    }

    [[nodiscard]] VDA5050::StateMessage GetState() const
    {
        return _vehicle.GetState();
    }

    [[nodiscard]] const VdaSim::Pose& GetPose() const
    {
        return _vehicle.GetPose();
    }

    [[nodiscard]] double GetSpeed() const
    {
        const VDA5050::Velocity velocity = GetState().velocity.value_or(VDA5050::Velocity{});
        return std::hypot(velocity.vx.value_or(0.0), velocity.vy.value_or(0.0));
    }

    [[nodiscard]] VDA5050::EActionStatus GetStatus(std::string_view actionID) const
    {
        const VDA5050::StateMessage state = GetState();
        const auto found = std::ranges::find(state.actionStates, actionID, &VDA5050::ActionState::actionID);
        if (found == state.actionStates.end())
        {
            throw std::runtime_error("the vehicle does not know this action");
        }
        return found->actionStatus;
    }

    /// When messages of this topic were published.
    [[nodiscard]] std::vector<Core::SteadyTime> GetTimes(VDA5050::ETopic topic) const
    {
        std::vector<Core::SteadyTime> times;
        for (const auto& [time, message] : _published)
        {
            if (message.topic.ends_with(VDA5050::GetTopicName(topic)))
            {
                times.push_back(time);
            }
        }
        return times;
    }

    /// Whether each cut of the connection was one with the will.
    [[nodiscard]] const std::vector<bool>& GetCuts() const
    {
        return _cuts;
    }

    [[nodiscard]] const std::vector<std::pair<Core::SteadyTime, VDA5050::MqttMessage>>& GetPublished() const
    {
        return _published;
    }

    [[nodiscard]] const VDA5050::MqttMessage& GetLast() const
    {
        return _published.back().second;
    }

    void Leave()
    {
        _vehicle.Leave(_clock.GetNow(), _actions);
        Execute();
    }

    [[nodiscard]] Core::SteadyTime GetTime() const
    {
        return _clock.GetNow().steady;
    }

    [[nodiscard]] const RecordingLogSink& GetLog() const
    {
        return _log;
    }

    /// The value, or the end of the test.
    template <typename TValue>
    [[nodiscard]] static TValue Take(Core::Result<TValue> result)
    {
        if (!result.has_value())
        {
            throw std::runtime_error(Core::Describe(result.error()));
        }
        return std::move(*result);
    }

private:
    [[nodiscard]] VDA5050::OrderEdge MakeEdge(const std::string& edgeID) const
    {
        const auto known = std::ranges::find(_site.GetEdges(), edgeID, &Planning::SiteEdge::edgeID);
        VDA5050::OrderEdge edge;
        edge.edgeID = edgeID;
        edge.maxSpeed = known->rules.front().maxSpeed;
        edge.orientation = known->rules.front().orientation;
        edge.bRotationAllowed = known->rules.front().bRotationAllowed;
        return edge;
    }

    [[nodiscard]] VDA5050::Header MakeHeader()
    {
        return {++_headerID, _clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
    }

    void Receive(VDA5050::ETopic topic, const std::string& payload)
    {
        const std::string name = VDA5050::BuildTopic({"uagv", "ACS", "LR01"}, topic);
        _vehicle.OnMessage({name, payload, 0, false}, _clock.GetNow(), _actions);
        Execute();
    }

    [[nodiscard]] std::map<std::uint64_t, Core::SteadyTime>::iterator FindNext()
    {
        return std::ranges::min_element(_timers, {}, [](const auto& timer) { return timer.second; });
    }

    void MoveTo(Core::SteadyTime time)
    {
        _clock.Advance(std::chrono::ceil<std::chrono::milliseconds>(time - _clock.GetNow().steady));
    }

    void Execute()
    {
        bool bOpens = false;
        for (const VdaSim::VirtualAction& action : std::exchange(_actions, {}))
        {
            std::visit(
                Core::Overloaded{
                    [this](const VDA5050::PublishMessage& publish) {
                        CheckValid(_version, publish.message.topic, publish.message.payload);
                        _published.emplace_back(_clock.GetNow().steady, publish.message);
                    },
                    [this](const VdaSim::StartVirtualTimer& start) {
                        _timers[start.key] = _clock.GetNow().steady + start.delay;
                    },
                    [this](const VdaSim::CancelVirtualTimer& cancel) { _timers.erase(cancel.key); },
                    [this](const VdaSim::CutLink& cut) {
                        _bConnected = false;
                        _cuts.push_back(cut.bWill);
                    },
                    [&bOpens](const VdaSim::OpenLink&) {
                        bOpens = true;
                    }},
                action);
        }
        if (bOpens)
        {
            _bConnected = true;
            _vehicle.OnLinkUp(_clock.GetNow(), _actions);
            Execute();
        }
    }
};

[[nodiscard]] inline bool HasReference(const VDA5050::VehicleError& error, std::string_view key, std::string_view value)
{
    return std::ranges::any_of(error.errorReferences, [&](const VDA5050::ErrorReference& reference) {
        return reference.referenceKey == key && reference.referenceValue == value;
    });
}

} // namespace ACS::Testing
