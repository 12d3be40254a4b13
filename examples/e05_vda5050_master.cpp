// Lesson 5: master control and a vehicle of VDA5050 in one process, without a broker: an order whose base grows.
//
// Master control releases a part of the route (the base) and shows the rest (the horizon); an update releases more. Both
// sessions are pure: their messages travel through two vectors here, and through MosquittoLink in a program.

#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <fmt/core.h>

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace): an example reads better without the prefix
namespace Core = ACS::Core;

namespace
{

/// Two sessions and the messages between them. No timer is kept: nothing gets lost here, so nothing is sent again.
class Line
{
    MasterSession _master;
    VehicleSession _vehicle;
    MasterActions _fromMaster;
    VehicleActions _fromVehicle;
    Core::Now _now;

public:
    bool bFinished = false;

    Line(MasterOptions master, VehicleOptions vehicle)
        : _master(std::move(master)),
          _vehicle(std::move(vehicle))
    {
        AgvPosition position; // A vehicle takes orders only when it knows where it is.
        position.bPositionInitialized = true;
        position.mapID = "hall";
        _vehicle.OnPosition(position, {});
        _master.OnLinkUp(_now, _fromMaster);
        _vehicle.OnLinkUp(_now, _fromVehicle);
        Settle();
    }

    /// Carries out what both sides want until neither wants anything.
    void Settle()
    {
        while (!_fromMaster.empty() || !_fromVehicle.empty())
        {
            for (const MasterAction& action : std::exchange(_fromMaster, {}))
            {
                ExecuteForMaster(action);
            }
            for (const VehicleAction& action : std::exchange(_fromVehicle, {}))
            {
                ExecuteForVehicle(action);
            }
        }
    }

    /// Whether the vehicle can be given it; what it makes of it comes as OrderAccepted or OrderRejected.
    [[nodiscard]] bool TrySend(const Core::Result<OrderMessage>& order)
    {
        const Core::Result<void> sent = order.and_then([this](const OrderMessage& message) {
            return message.orderUpdateID == 0 ? _master.SendOrder(message, _now, _fromMaster)
                                              : _master.SendOrderUpdate(message, _now, _fromMaster);
        });
        Settle();
        return sent.has_value();
    }

private:
    void ExecuteForMaster(const MasterAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const PublishMessage& publish) {
                    _vehicle.OnMessage(publish.message.topic, publish.message.payload, false, _now, _fromVehicle);
                },
                [](const OrderAccepted& accepted) {
                    fmt::print("master: update {} of {} is accepted\n", accepted.orderUpdateID, accepted.orderID);
                },
                [](const NodeReached& reached) { fmt::print("master: {} is reached\n", reached.nodeID); },
                [this](const OrderFinished& /*finished*/) { bFinished = true; },
                [](const auto& /*other*/) {
                }}, // Of no interest to this lesson.
            action);
    }

    void ExecuteForVehicle(const VehicleAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const PublishMessage& publish) {
                    _master.OnMessage(publish.message.topic, publish.message.payload, _now, _fromMaster);
                },
                [this](const DriveTo& drive) {
                    fmt::print("vehicle: drives to {}\n", drive.node.nodeID); // And is there at once.
                    _vehicle.TryReachNode({drive.node.sequenceID, drive.bStopAtNode}, _now, _fromVehicle);
                },
                [this](const StartVehicleTimer& start) {
                    if (start.timer == EVehicleTimer::MinimumStateInterval) // The next state waits for it.
                    {
                        _now.steady += start.delay;
                        _vehicle.OnTimer(start.timer, _now, _fromVehicle);
                    }
                },
                [](const auto& /*other*/) {
                }},
            action);
    }
};

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    MasterOptions master;
    master.address = {"uagv", "ExampleMaker", "LR01"};
    VehicleOptions vehicle;
    vehicle.address = master.address;
    Line line(std::move(master), std::move(vehicle));

    // Four nodes in a row, two metres apart. The builder fills in sequence ids and released flags.
    std::vector<OrderNode> nodes(4);
    std::vector<OrderEdge> edges(3);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        nodes[i].nodeID = fmt::format("N{}", i + 1);
        nodes[i].nodePosition = {2.0 * static_cast<double>(i), 0, {}, {}, {}, "hall", {}};
    }
    edges[0].edgeID = "E1";
    edges[1].edgeID = "E2";
    edges[2].edgeID = "E3";
    Core::Result<OrderBuilder> route = OrderBuilder::Create("order-1", std::move(nodes), std::move(edges));
    if (!route.has_value())
    {
        return 1;
    }
    // Two nodes of base, two of horizon: the vehicle drives to N2 and waits there. Then the rest of the route.
    const bool bOrdered = line.TrySend(route->MakeOrder(2));
    const bool bUpdated = line.TrySend(route->MakeUpdate(4));
    fmt::print("order-1 is {}finished\n", line.bFinished ? "" : "not ");
    return bOrdered && bUpdated && line.bFinished ? 0 : 1;
}
