#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <benchmark/benchmark.h>
#include <rapidjson/document.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Bench
{

namespace
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

constexpr unsigned FLAGS =
    rapidjson::kParseIterativeFlag | rapidjson::kParseValidateEncodingFlag | rapidjson::kParseFullPrecisionFlag;
constexpr std::size_t STATE_NODES = 10;
constexpr std::size_t ORDER_NODES = 50;
constexpr std::chrono::milliseconds WALL{1'763'681'832'345};

Header MakeHeader()
{
    return Header{48231, Core::WallTime(WALL), "2.0.0", "ExampleRobotics", "AMR-000123"};
}

double MakeCoordinate(std::size_t index, double step)
{
    return 12.345 + step * static_cast<double>(index);
}

OrderMessage MakeOrder()
{
    std::vector<OrderNode> nodes(ORDER_NODES);
    std::vector<OrderEdge> edges(ORDER_NODES - 1);
    for (std::size_t index = 0; index < ORDER_NODES; ++index)
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
    OrderMessage order = *builder->MakeOrder(ORDER_NODES / 2);
    order.header = MakeHeader();
    return order;
}

StateMessage MakeState()
{
    const OrderMessage order = MakeOrder();
    StateMessage state;
    state.header = MakeHeader();
    state.orderID = order.orderID;
    state.orderUpdateID = 3;
    state.lastNodeID = "WP-0116";
    state.lastNodeSequenceID = 6;
    for (std::size_t index = 0; index < STATE_NODES; ++index)
    {
        const OrderNode& node = order.nodes[index];
        state.nodeStates.push_back(NodeState{
            node.nodeID,
            node.sequenceID,
            {},
            node.bReleased,
            NodeStatePosition{node.nodePosition->x, node.nodePosition->y, 0.61, "hall-2-floor-0"}});
        if (index + 1 < STATE_NODES)
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

template <typename TMessage>
void Decode(benchmark::State& state, const TMessage& message)
{
    Vda5050Codec codec;
    const std::string text = codec.Encode(message, EVda5050Version::Version200);
    for ([[maybe_unused]] auto round : state)
    {
        benchmark::DoNotOptimize(codec.Decode<TMessage>(text));
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

template <typename TMessage>
void Encode(benchmark::State& state, const TMessage& message)
{
    const Vda5050Codec codec;
    std::string text;
    for ([[maybe_unused]] auto round : state)
    {
        codec.Encode(message, EVda5050Version::Version200, text);
        benchmark::DoNotOptimize(text.data());
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

template <typename TMessage>
void ParseBare(benchmark::State& state, const TMessage& message)
{
    const std::string text = Vda5050Codec().Encode(message, EVda5050Version::Version200);
    for ([[maybe_unused]] auto round : state)
    {
        rapidjson::Document document;
        document.Parse<FLAGS>(text.data(), text.size());
        benchmark::DoNotOptimize(document.IsObject());
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

template <typename TMessage>
void SerialiseBare(benchmark::State& state, const TMessage& message)
{
    const std::string text = Vda5050Codec().Encode(message, EVda5050Version::Version200);
    rapidjson::Document document;
    document.Parse<FLAGS>(text.data(), text.size());
    rapidjson::StringBuffer buffer;
    for ([[maybe_unused]] auto round : state)
    {
        buffer.Clear();
        rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
        document.Accept(writer);
        benchmark::DoNotOptimize(buffer.GetString());
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

BENCHMARK_CAPTURE(Decode, State, MakeState());
BENCHMARK_CAPTURE(ParseBare, State, MakeState());
BENCHMARK_CAPTURE(Encode, State, MakeState());
BENCHMARK_CAPTURE(SerialiseBare, State, MakeState());
BENCHMARK_CAPTURE(Decode, Order, MakeOrder());
BENCHMARK_CAPTURE(ParseBare, Order, MakeOrder());
BENCHMARK_CAPTURE(Encode, Order, MakeOrder());
BENCHMARK_CAPTURE(SerialiseBare, Order, MakeOrder());

} // namespace

} // namespace ACS::Bench
