#include "Catch.hpp"
#include "HeapProbe.hpp"
#include "ManualClock.hpp"
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS;          // NOLINT(google-build-using-namespace)
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)
using Testing::HeapProbe;

namespace
{

constexpr std::int64_t KIB = 1024;

VehicleOptions MakeOptions()
{
    VehicleOptions options;
    options.address = {"uagv", "ACS", "LR001"};
    options.initialNodeID = "N000";
    options.visualizationInterval = std::chrono::milliseconds(200);
    return options;
}

std::string MakeOrderText(std::size_t edgeCount)
{
    std::vector<OrderNode> nodes(edgeCount + 1);
    std::vector<OrderEdge> edges(edgeCount);
    for (std::size_t index = 0; index < nodes.size(); ++index)
    {
        nodes[index].nodeID = "N" + std::to_string(1000 + index).substr(1);
        NodePosition& position = nodes[index].nodePosition.emplace();
        position.x = 2.0 * static_cast<double>(index);
        position.mapID = "floor-1";
    }
    for (std::size_t index = 0; index < edges.size(); ++index)
    {
        edges[index].edgeID = nodes[index].nodeID + "-" + nodes[index + 1].nodeID;
        edges[index].maxSpeed = 1.2;
    }
    auto builder = OrderBuilder::Create("order-1", std::move(nodes), std::move(edges));
    REQUIRE(builder.has_value());
    auto order = builder->MakeOrder(edgeCount + 1);
    REQUIRE(order.has_value());
    order->header = Header{0, {}, "2.0.0", "ACS", "LR001"};
    return Vda5050Codec().Encode(*order, EVda5050Version::Version200);
}

/// A vehicle on a link, allocated on the heap, and the memory that it holds.
class CountedVehicle
{
    std::int64_t _before = HeapProbe::GetLiveBytes();
    Testing::ManualClock _clock;
    std::unique_ptr<VehicleSession> _session = std::make_unique<VehicleSession>(MakeOptions());

public:
    CountedVehicle()
    {
        VehicleActions out;
        _session->OnPosition({true, {}, {}, 0.0, 0.0, 0.0, "floor-1", {}}, {});
        _session->OnLinkUp(_clock.GetNow(), out);
    }

    void Drive(std::size_t edgeCount)
    {
        VehicleActions out;
        const std::string text = MakeOrderText(edgeCount);
        _session->OnMessage("uagv/v2/ACS/LR001/order", text, false, _clock.GetNow(), out);
        _session->OnDrivingChanged(true, _clock.GetNow(), out);
        REQUIRE(_session->IsOrderRunning());
        REQUIRE(_session->GetState().nodeStates.size() == edgeCount);
    }

    /// Allocations of a message that is due by time.
    [[nodiscard]] std::uint64_t CountBlocks(EVehicleTimer timer)
    {
        VehicleActions out;
        _clock.Advance(std::chrono::minutes(1));
        _session->OnTimer(timer, _clock.GetNow(), out); // the vector's own growth is the owner's
        out.clear();
        _clock.Advance(std::chrono::minutes(1));
        const std::uint64_t before = HeapProbe::GetBlockCount();
        _session->OnTimer(timer, _clock.GetNow(), out);
        const std::uint64_t taken = HeapProbe::GetBlockCount() - before;
        REQUIRE(std::holds_alternative<PublishMessage>(out.front()));
        return taken;
    }

    [[nodiscard]] std::int64_t GetBytes() const
    {
        return HeapProbe::GetLiveBytes() - _before;
    }
};

} // namespace

TEST_CASE("A codec holds no memory between calls")
{
    const std::string text = MakeOrderText(60);
    const std::int64_t before = HeapProbe::GetLiveBytes();
    Vda5050Codec codec;
    CHECK(codec.Decode<OrderMessage>(text).has_value());
    CHECK_FALSE(codec.Decode<StateMessage>(text).has_value());
    CHECK(HeapProbe::GetLiveBytes() == before);
}

TEST_CASE("A session holds a few KiB, and less than 300 bytes for each node and edge ahead")
{
    CountedVehicle vehicle;
    const std::int64_t idle = vehicle.GetBytes();
    vehicle.Drive(60);
    const std::int64_t driving = vehicle.GetBytes();
    INFO(idle << " bytes idle, " << driving << " with 60 edges");
    CHECK(idle < 6 * KIB);
    CHECK(driving - idle < 60 * 300);
    CHECK(driving > idle);
}

TEST_CASE("A state allocates five blocks, however long the order: topic, payload, time, nodes and edges")
{
    CountedVehicle near;
    near.Drive(10);
    CountedVehicle far;
    far.Drive(60);
    const std::uint64_t ofNear = near.CountBlocks(EVehicleTimer::MaximumStateInterval);
    INFO(ofNear << " blocks for 10 edges");
    CHECK(ofNear <= 5);
    CHECK(far.CountBlocks(EVehicleTimer::MaximumStateInterval) == ofNear);
}

TEST_CASE("A visualization allocates three blocks: topic, payload and time")
{
    CountedVehicle vehicle;
    vehicle.Drive(60);
    CHECK(vehicle.CountBlocks(EVehicleTimer::Visualization) <= 3);
}
