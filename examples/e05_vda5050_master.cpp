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

const VDA5050::VehicleAddress& GetAddress()
{
    static const VDA5050::VehicleAddress address{"uagv", "ExampleMaker", "LR01"};
    return address;
}

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

    [[nodiscard]] Core::Result<void> Send(VDA5050::OrderMessage order, bool bUpdate)
    {
        fmt::print("master: sends {} node(s), update {}\n", order.nodes.size(), order.orderUpdateID);
        return bUpdate ? _master.SendOrderUpdate(std::move(order), _now, _fromMaster)
                       : _master.SendOrder(std::move(order), _now, _fromMaster);
    }
};

/// Four nodes in a row, two metres apart. The builder fills in sequence ids and released flags.
Core::Result<VDA5050::OrderBuilder> MakeRoute()
{
    std::vector<VDA5050::OrderNode> nodes(4);
    std::vector<VDA5050::OrderEdge> edges(nodes.size() - 1);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        nodes[i].nodeID = fmt::format("N{}", i + 1);
        nodes[i].nodePosition.emplace();
        nodes[i].nodePosition->x = 2.0 * static_cast<double>(i);
        nodes[i].nodePosition->mapID = "hall";
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
    master.address = GetAddress();
    VDA5050::VehicleOptions vehicle;
    vehicle.address = GetAddress();
    Line line(std::move(master), std::move(vehicle));
    line.Settle();

    Core::Result<VDA5050::OrderBuilder> route = MakeRoute();
    // Two nodes of base, two of horizon; then everything. Any error of the chain ends up in `sent`.
    const auto sent = route.and_then([](auto& builder) { return builder.MakeOrder(2); }).and_then([&line](auto order) {
        return line.Send(std::move(order), false);
    });
    line.Settle();
    const auto updated =
        route.and_then([](auto& builder) { return builder.MakeUpdate(4); }).and_then([&line](auto update) {
            return line.Send(std::move(update), true);
        });
    line.Settle();
    return sent.has_value() && updated.has_value() && line.bFinished ? 0 : 1;
}
