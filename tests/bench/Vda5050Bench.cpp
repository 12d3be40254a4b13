#include "CodecTable.hpp"
#include "Vda5050NlohmannCodec.hpp"
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Bench
{

namespace
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

constexpr std::chrono::milliseconds WALL{1'763'681'832'345};

Header MakeHeader()
{
    return Header{48231, Core::WallTime(WALL), "2.0.0", "ExampleRobotics", "AMR-000123"};
}

double MakeCoordinate(std::size_t index, double step)
{
    return 12.345 + step * static_cast<double>(index);
}

OrderMessage MakeOrder(std::size_t nodeCount)
{
    std::vector<OrderNode> nodes(nodeCount);
    std::vector<OrderEdge> edges(nodeCount - 1);
    for (std::size_t index = 0; index < nodeCount; ++index)
    {
        OrderNode& node = nodes[index];
        node.nodeID = "WP-" + std::to_string(1000 + index);
        NodePosition position;
        position.x = MakeCoordinate(index, 3.17);
        position.y = MakeCoordinate(index, -1.294);
        position.theta = 0.61;
        position.allowedDeviationXY = 0.5;
        position.mapID = "hall-2-floor-0";
        node.nodePosition = position;
        Action action;
        action.actionType = "pick";
        action.actionID = "3f2c1a77-88aa-4c3d-9a10-" + std::to_string(100'000'000'000 + index);
        action.blockingType = EBlockingType::Hard;
        action.actionParameters.push_back(
            ActionParameter{"stationName", Core::JsonText::FromString("A01.CP" + std::to_string(index))});
        action.actionParameters.push_back(ActionParameter{"height", Core::JsonText::FromNumber(1.25)});
        node.actions.push_back(std::move(action));
        if (index < edges.size())
        {
            edges[index].edgeID = "E-" + std::to_string(1000 + index);
            edges[index].maxSpeed = 1.5;
            edges[index].orientation = 0.25;
        }
    }
    Core::Result<OrderBuilder> builder =
        OrderBuilder::Create("order-5f3e2c1a-7788-4c3d-9a10-2b3c4d5e6f70", std::move(nodes), std::move(edges));
    OrderMessage order = *builder->MakeOrder(nodeCount / 2);
    order.header = MakeHeader();
    return order;
}

StateMessage MakeState(std::size_t nodeCount)
{
    const OrderMessage order = MakeOrder(nodeCount);
    StateMessage state;
    state.header = MakeHeader();
    state.orderID = order.orderID;
    state.orderUpdateID = 3;
    state.lastNodeID = "WP-0116";
    state.lastNodeSequenceID = 6;
    for (std::size_t index = 0; index < nodeCount; ++index)
    {
        const OrderNode& node = order.nodes[index];
        state.nodeStates.push_back(NodeState{
            node.nodeID,
            node.sequenceID,
            {},
            node.bReleased,
            NodeStatePosition{node.nodePosition->x, node.nodePosition->y, 0.61, "hall-2-floor-0"}});
        if (index + 1 < nodeCount)
        {
            const OrderEdge& edge = order.edges[index];
            state.edgeStates.push_back(EdgeState{edge.edgeID, edge.sequenceID, {}, edge.bReleased, {}});
        }
        if (index < 6)
        {
            state.actionStates.push_back(ActionState{
                node.actions[0].actionID,
                "pick",
                "take the load from the station",
                EActionStatus::Running,
                "half of it is done"});
        }
    }
    AgvPosition position;
    position.bPositionInitialized = true;
    position.localizationScore = 0.94;
    position.x = 17.125;
    position.y = -4.75;
    position.theta = 1.5;
    position.mapID = "hall-2-floor-0";
    state.agvPosition = position;
    state.velocity = Velocity{1.2, 0.0, 0.05};
    state.loads = {Load{"PALLET-000815", "EPAL", "fork", BoundingBoxReference{}, LoadDimensions{1.2, 0.8, 1.0}, 412.5}};
    state.bDriving = true;
    state.bPaused = false;
    state.bNewBaseRequest = false;
    state.distanceSinceLastNode = 2.125;
    state.batteryState = BatteryState{78.5, 48.2, 97.0, false, 5400.0};
    for (int i = 0; i < 2; ++i)
    {
        VehicleError error;
        error.errorType = "orderUpdateError";
        error.errorDescription = "the order update does not begin at the decision point of the running order";
        error.errorReferences = {{"topic", "order"}, {"orderId", order.orderID}, {"orderUpdateId", "2"}};
        state.errors.push_back(std::move(error));
    }
    return state;
}

/// A row whose message all codecs decode alike.
template <typename TMessage>
CodecRow MakeRow(std::string name, const TMessage& message)
{
    constexpr EVda5050Version VERSION = EVda5050Version::Version200;
    std::string text = Vda5050Codec().Encode(message, VERSION);
    const std::string other = Vda5050NlohmannCodec::Encode(message);
    if (!(Vda5050Codec().Decode<TMessage>(text) == message) || !(Vda5050Codec().Decode<TMessage>(other) == message)
        || !(Vda5050NlohmannCodec::Decode<TMessage>(text) == message))
    {
        throw std::runtime_error("the codecs do not agree about " + name);
    }
    return CodecRow{
        std::move(name),
        text,
        [text](benchmark::State& state) {
            Vda5050Codec codec;
            for ([[maybe_unused]] auto round : state)
            {
                benchmark::DoNotOptimize(codec.Decode<TMessage>(text));
            }
        },
        [message](benchmark::State& state) {
            const Vda5050Codec codec;
            std::string out;
            for ([[maybe_unused]] auto round : state)
            {
                codec.Encode(message, VERSION, out);
                benchmark::DoNotOptimize(out.data());
                benchmark::ClobberMemory();
            }
        },
        [text](benchmark::State& state) {
            for ([[maybe_unused]] auto round : state)
            {
                benchmark::DoNotOptimize(Vda5050NlohmannCodec::Decode<TMessage>(text));
            }
        },
        [message](benchmark::State& state) {
            for ([[maybe_unused]] auto round : state)
            {
                benchmark::DoNotOptimize(Vda5050NlohmannCodec::Encode(message));
            }
        }};
}

} // namespace

} // namespace ACS::Bench

int main(int argumentCount, char** arguments)
{
    using namespace ACS::Bench; // NOLINT(google-build-using-namespace)
    return RunCodecTable(
        argumentCount,
        arguments,
        {MakeRow("state, 10 nodes", MakeState(10)),
         MakeRow("order, 50 nodes", MakeOrder(50)),
         MakeRow("state, 100 nodes", MakeState(100)),
         MakeRow("order, 100 nodes", MakeOrder(100))});
}
