// Lesson 5: master control and a vehicle of VDA5050 in one process, without a broker: an order whose base grows.
//
// Master control releases a part of the route (the base) and shows the rest (the horizon); an update releases more. Both
// sessions are pure: their messages travel through two vectors here, and through MosquittoLink in a program.

#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <fmt/core.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace): an example reads better without the prefix

namespace
{

/// Two sessions and the messages between them. No timer is kept: nothing gets lost here, so nothing is sent again.
class Line
{
    VDA5050::MasterSession _master;
    VDA5050::VehicleSession _vehicle;
    VDA5050::MasterActions _fromMaster;
    VDA5050::VehicleActions _fromVehicle;
    Core::Now _now;

    void ExecuteForMaster(const VDA5050::MasterAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const VDA5050::PublishMessage& publish) {
                    const VDA5050::MqttMessage& message = publish.message;
                    _vehicle.OnMessage(message.topic, message.payload, message.bRetained, _now, _fromVehicle);
                },
                [](const VDA5050::OrderAccepted& accepted) {
                    fmt::print("master: update {} of {} is accepted\n", accepted.orderUpdateID, accepted.orderID);
                },
                [](const VDA5050::NodeReached& reached) { fmt::print("master: {} is reached\n", reached.nodeID); },
                [this](const VDA5050::OrderFinished& finished) {
                    fmt::print("master: {} is finished\n", finished.orderID);
                    bFinished = true;
                },
                [](const auto& /*other*/) {
                }}, // Of no interest to this lesson: see MasterAction.hpp.
            action);
    }

    void ExecuteForVehicle(const VDA5050::VehicleAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const VDA5050::PublishMessage& publish) {
                    _master.OnMessage(publish.message.topic, publish.message.payload, _now, _fromMaster);
                },
                [this](const VDA5050::DriveTo& drive) {
                    fmt::print("vehicle: drives to {}\n", drive.node.nodeID);
                    _now.steady += std::chrono::seconds(3);
                    _vehicle.TryReachNode(drive.node.sequenceID, _now, _fromVehicle);
                },
                [this](const VDA5050::StartVehicleTimer& start) {
                    // A state waits until it may be sent; nothing else happens meanwhile, so it is sent now.
                    if (start.timer == VDA5050::EVehicleTimer::MinimumStateInterval)
                    {
                        _now.steady += start.delay;
                        _vehicle.OnTimer(start.timer, _now, _fromVehicle);
                    }
                },
                [](const auto& /*other*/) {
                }},
            action);
    }

public:
    bool bFinished = false;

    Line(VDA5050::MasterOptions master, VDA5050::VehicleOptions vehicle)
        : _master(std::move(master)),
          _vehicle(std::move(vehicle))
    {
        VDA5050::AgvPosition position; // A vehicle takes orders only when it knows where it is.
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
            for (const VDA5050::MasterAction& action : std::exchange(_fromMaster, {}))
            {
                ExecuteForMaster(action);
            }
            for (const VDA5050::VehicleAction& action : std::exchange(_fromVehicle, {}))
            {
                ExecuteForVehicle(action);
            }
        }
    }

    /// Whether the vehicle can be given it; what it makes of it comes as OrderAccepted or OrderRejected.
    [[nodiscard]] bool TrySend(const Core::Result<VDA5050::OrderMessage>& order)
    {
        const Core::Result<void> sent = order.and_then([this](const VDA5050::OrderMessage& message) {
            return message.orderUpdateID == 0 ? _master.SendOrder(message, _now, _fromMaster)
                                              : _master.SendOrderUpdate(message, _now, _fromMaster);
        });
        Settle();
        return sent.has_value();
    }
};

/// Four nodes in a row, two metres apart. The builder fills in sequence ids and released flags.
Core::Result<VDA5050::OrderBuilder> MakeRoute()
{
    std::vector<VDA5050::OrderNode> nodes(4);
    std::vector<VDA5050::OrderEdge> edges(3);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        nodes[i].nodeID = fmt::format("N{}", i + 1);
        nodes[i].nodePosition = {2.0 * static_cast<double>(i), 0, {}, {}, {}, "hall", {}};
    }
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        edges[i].edgeID = fmt::format("E{}", i + 1);
    }
    return VDA5050::OrderBuilder::Create("order-1", std::move(nodes), std::move(edges));
}

} // namespace

int main()
{
    VDA5050::MasterOptions master;
    master.address = {"uagv", "ExampleMaker", "LR01"};
    VDA5050::VehicleOptions vehicle;
    vehicle.address = master.address;
    Line line(std::move(master), std::move(vehicle));

    Core::Result<VDA5050::OrderBuilder> route = MakeRoute();
    if (!route.has_value())
    {
        return 1;
    }
    // Two nodes of base, two of horizon: the vehicle drives to N2 and waits there. Then the rest of the route.
    const bool bOrdered = line.TrySend(route->MakeOrder(2));
    const bool bUpdated = line.TrySend(route->MakeUpdate(4));
    return bOrdered && bUpdated && line.bFinished ? 0 : 1;
}
