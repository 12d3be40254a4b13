// Lesson 14: a small master control on a real broker. It discovers the vehicles, sends one order to the first vehicle that
// can accept it, prints the progress, and ends with the order. MasterClient has the connection and the timers.
//
//     vda-sim --broker mqtt://127.0.0.1:1883 --site examples/site/site.lif.json --vehicle LR01
//     e14_progress 127.0.0.1 1883 order.json      (an order message of VDA5050 with its whole route)

#include "ExampleBroker.hpp"
#include "ExampleClock.hpp"
#include "ExampleRandom.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>
#include <acs/vda5050_mosquitto/MasterClient.hpp>

#include <boost/asio/io_context.hpp>
#include <fmt/core.h>

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

using namespace ACS;          // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)

namespace
{

class ProgressMaster final : public IMasterHandler
{
    std::optional<OrderMessage> _order; ///< Empty once it was sent.

public:
    std::unique_ptr<MasterClient> client;
    bool bFailed = false; ///< The order, or one of its actions.

    explicit ProgressMaster(OrderMessage order)
        : _order(std::move(order))
    {
    }

    void OnBrokerUp() override
    {
        fmt::print("connected\n");
    }

    void OnBrokerDown(std::error_code reason) override
    {
        fmt::print("no broker: {}; trying again\n", reason.message());
    }

    void OnVehicleEvent(std::size_t vehicle, const MasterAction& event) override
    {
        const std::string& name = client->GetFleet().GetSession(vehicle).GetOptions().address.serialNumber;
        std::visit(
            Core::Overloaded{
                [&](const VehicleOnline&) { fmt::print("{}: online\n", name); },
                [&](const VehicleBroken&) { fmt::print("{}: connection broken\n", name); },
                [&](const StateReceived&) { SendOrderOnce(vehicle); },
                [&](const OrderAccepted& order) { fmt::print("{}: {} accepted\n", name, order.orderID); },
                [&](const NodeReached& node) { fmt::print("{}: node {} reached\n", name, node.nodeID); },
                [&](const ActionChanged& action) { OnAction(vehicle, action); },
                [&](const OrderFinished& order) { End(name, order.orderID + " finished", bFailed); },
                [&](const OrderRejected& order) { End(name, order.orderID + " rejected: " + order.reason, true); },
                [&](const OrderLost& order) { End(name, order.orderID + " lost: " + order.reason, true); },
                [](const auto& /*other*/) {
                }},
            event);
    }

private:
    /// The state shows whether the vehicle can accept an order: its mode, and whether another master's order runs.
    void SendOrderOnce(std::size_t vehicle)
    {
        if (_order.has_value() && client->GetFleet().GetSession(vehicle).CanTakeOrder())
        {
            const Core::Result<void> sent = client->SendOrder(vehicle, *std::exchange(_order, std::nullopt));
            if (!sent.has_value())
            {
                End("the order", Core::Describe(sent.error()), true);
            }
        }
    }

    void OnAction(std::size_t vehicle, const ActionChanged& action)
    {
        const MasterOptions& options = client->GetFleet().GetSession(vehicle).GetOptions();
        if (action.actionID.starts_with(options.actionIDPrefix))
        {
            return; // A request of the session itself, for example for a factsheet.
        }
        const bool bActionFailed = action.status == EActionStatus::Failed;
        if (bActionFailed || action.status == EActionStatus::Finished)
        {
            bFailed = bFailed || bActionFailed;
            const char* const how = bActionFailed ? "failed" : "finished";
            fmt::print("{}: {} {}\n", options.address.serialNumber, action.actionType, how);
        }
    }

    void End(const std::string& name, const std::string& how, bool bWithFailure)
    {
        fmt::print("{}: {}\n", name, how);
        bFailed = bWithFailure;
        client->StopAsync([] {}); // Nothing is left to do for the io_context then.
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    const std::optional<MosquittoOptions> brokerOrNull =
        argc == 4 ? ReadBrokerOrNull(arguments[1], arguments[2]) : std::nullopt;
    if (!brokerOrNull.has_value())
    {
        fmt::print("Usage: e14_progress HOST PORT ORDER\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // Each line at once, also into a pipe.
    std::ifstream file(arguments[3], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    Core::Result<OrderMessage> order = Vda5050Codec().Decode<OrderMessage>(text);
    if (!order.has_value())
    {
        fmt::print("{}: {}\n", arguments[3], Core::Describe(order.error()));
        return 2;
    }
    boost::asio::io_context io;
    ExampleRandom random;
    const ExampleClock clock;
    ProgressMaster master(std::move(*order));
    auto client = MasterClient::Create(io.get_executor(), clock, random, Core::Logger(), *brokerOrNull, {}, master);
    master.client = std::move(*client); // The standard's interfaceName, "uagv", is valid.
    master.client->Start();
    io.run();
    return master.bFailed ? 1 : 0;
}
