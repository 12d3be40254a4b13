#include "VehicleOwner.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

#include <array>
#include <string>
#include <utility>

/// A vehicle between a master that sends anything at any time and an owner that obeys: the rules are in VehicleOwner.

namespace
{

using namespace ACS;          // NOLINT(google-build-using-namespace)
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)

constexpr double NODE_DISTANCE = 1.0;

Action MakeAction(Fuzz::Choices& choices)
{
    static constexpr std::array TYPES{
        ActionTypes::PICK,
        ActionTypes::START_CHARGING,
        ActionTypes::FINE_POSITIONING,
        ActionTypes::ENABLE_MAP,
        ActionTypes::CANCEL_ORDER,
        ActionTypes::START_PAUSE,
        ActionTypes::STOP_PAUSE,
        ActionTypes::STATE_REQUEST,
        ActionTypes::INIT_POSITION,
        ActionTypes::DELETE_MAP,
        std::string_view("makeCoffee")};
    Action action;
    action.actionType = TYPES.at(choices.Take(TYPES.size()));
    action.actionID = "a" + std::to_string(choices.Take(32));
    action.blockingType = static_cast<EBlockingType>(choices.Take(3));
    if (choices.Take(2) == 0)
    {
        for (const auto& [key, value] : {std::pair{"mapId", "floor"}, {"mapVersion", "1"}, {"lastNodeId", "n1"}})
        {
            action.actionParameters.push_back({key, Core::JsonText::FromString(value)});
        }
        for (const char* key : {"x", "y", "theta"})
        {
            action.actionParameters.push_back({key, Core::JsonText::FromNumber(0.0)});
        }
    }
    return action;
}

std::vector<Action> MakeActions(Fuzz::Choices& choices)
{
    std::vector<Action> actions;
    for (std::uint32_t left = choices.Take(4) == 0 ? choices.Take(4) : 0; left > 0; --left)
    {
        actions.push_back(MakeAction(choices));
    }
    return actions;
}

OrderNode MakeNode(std::uint32_t sequenceID, bool bReleased, Fuzz::Choices& choices)
{
    OrderNode node;
    node.nodeID = "n" + std::to_string(sequenceID / 2);
    node.sequenceID = sequenceID;
    node.bReleased = bReleased;
    if (choices.Take(4) == 0)
    {
        NodePosition position;
        position.x = NODE_DISTANCE * sequenceID / 2;
        position.mapID = choices.Take(8) == 0 ? "roof" : "floor";
        position.allowedDeviationXY = choices.Take(4);
        node.nodePosition = position;
    }
    node.actions = MakeActions(choices);
    return node;
}

/// The optional members of an edge, valid and invalid.
void AddGeometry(OrderEdge& edge, Fuzz::Choices& choices)
{
    switch (choices.Take(8))
    {
        case 0:
            edge.corridor = Corridor{1.0, choices.Take(8) == 0 ? -1.0 : 1.0, {}};
            break;
        case 1:
        {
            // It fits where its nodes have no positions.
            Trajectory line{1, {0.0, 0.0, 1.0, 1.0}, {ControlPoint{}, ControlPoint{NODE_DISTANCE, 0.0, {}}}};
            line.controlPoints[1].weight = choices.Take(4);
            edge.trajectory = std::move(line);
            break;
        }
        case 2:
            edge.maxSpeed = 1.0 - choices.Take(3);
            break;
        default:
            break;
    }
}

/// Usually the next one.
std::uint32_t StepSequence(std::uint32_t sequenceID, Fuzz::Choices& choices)
{
    return sequenceID + (choices.Take(16) == 1 ? choices.Take(6) : 2);
}

/// Where a valid update would begin.
std::pair<std::string, std::uint32_t> GetDecisionPoint(const StateMessage& state)
{
    std::pair<std::string, std::uint32_t> point{state.lastNodeID, state.lastNodeSequenceID};
    for (const NodeState& node : state.nodeStates)
    {
        if (node.bReleased)
        {
            point = {node.nodeID, node.sequenceID};
        }
    }
    return point;
}

OrderMessage MakeOrder(const StateMessage& state, Fuzz::Choices& choices)
{
    OrderMessage order;
    order.header = Header{0, {}, "2.1.0", "ACS", "LR01"};
    const bool bUpdate = choices.Take(2) == 0;
    order.orderID = bUpdate ? state.orderID : "o" + std::to_string(choices.Take(4));
    order.orderUpdateID = bUpdate ? state.orderUpdateID + choices.Take(3) : choices.Take(2);
    const auto [nodeID, firstID] = GetDecisionPoint(state);
    std::uint32_t sequenceID = bUpdate ? firstID : 0;
    const std::uint32_t count = 1 + choices.Take(5);
    const std::uint32_t released = 1 + choices.Take(count);
    for (std::uint32_t index = 0; index < count; ++index)
    {
        if (index > 0)
        {
            OrderEdge edge;
            edge.edgeID = "e" + std::to_string(sequenceID);
            edge.sequenceID = sequenceID - 1;
            edge.bReleased = index < released;
            edge.startNodeID = order.nodes.back().nodeID;
            edge.actions = MakeActions(choices);
            AddGeometry(edge, choices);
            order.edges.push_back(std::move(edge));
        }
        order.nodes.push_back(MakeNode(sequenceID, index < released, choices));
        if (index == 0 && choices.Take(4) != 0)
        {
            order.nodes.back().nodeID = bUpdate ? nodeID : state.lastNodeID;
        }
        if (index > 0)
        {
            order.edges.back().endNodeID = order.nodes.back().nodeID;
        }
        sequenceID = StepSequence(sequenceID, choices);
    }
    return order;
}

/// Some texts have a wrong byte, some are retained.
void Send(Fuzz::VehicleOwner& owner, ETopic topic, std::string payload, Fuzz::Choices& choices)
{
    if (choices.Take(8) == 0 && !payload.empty())
    {
        const std::size_t high = choices.TakeByte();
        const std::size_t low = choices.TakeByte();
        payload[(high * 256 + low) % payload.size()] = static_cast<char>(choices.TakeByte());
    }
    owner.Receive(topic, payload, choices.Take(32) == 1);
}

VehicleOptions MakeOptions(Fuzz::Choices& choices)
{
    VehicleOptions options;
    options.address = VehicleAddress{"uagv", "ACS", "LR01"};
    options.version = choices.Take(2) == 0 ? EVda5050Version::Version200 : EVda5050Version::Version210;
    options.bStopsBetweenNodes = choices.Take(2) == 0;
    options.initialNodeID = "n0";
    options.visualizationInterval = std::chrono::milliseconds(200);
    if (choices.Take(4) == 0)
    {
        options.criticalActionTypes = {std::string(ActionTypes::PICK)};
    }
    if (choices.Take(2) == 0)
    {
        options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    }
    if (choices.Take(4) == 0)
    {
        MaximumArrayLengths& limits = options.factsheet.protocolLimits.maxArrayLengths;
        limits.stateNodeStates = 4;
        limits.stateActionStates = 5;
        limits.stateErrors = 3;
    }
    return options;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Fuzz::Choices choices(data, size);
    Fuzz::VehicleOwner owner(MakeOptions(choices));
    Vda5050Codec codec;
    while (!choices.IsUsedUp())
    {
        owner.PassTime(choices.Take(64));
        switch (choices.Take(6))
        {
            case 0:
            {
                const std::string payload =
                    codec.Encode(MakeOrder(owner.GetState(), choices), EVda5050Version::Version210);
                Send(owner, ETopic::Order, payload, choices);
                break;
            }
            case 1:
            {
                InstantActionsMessage message;
                message.header = Header{0, {}, "2.1.0", "ACS", "LR01"};
                message.actions.push_back(MakeAction(choices));
                const std::string payload = codec.Encode(message, EVda5050Version::Version210);
                Send(owner, ETopic::InstantActions, payload, choices);
                break;
            }
            case 2:
                owner.SetStatus(choices);
                break;
            case 3:
            case 4:
                owner.ReachNode();
                break;
            default:
                owner.Happen(choices);
                break;
        }
    }
    owner.End();
    return 0;
}
