// Lesson 19: a bridge from a maker's own vehicle interface to VDA5050. VehicleSession keeps the rules of the standard; the
// bridge translates. The interface here is invented, lines of text over TCP:
//
//     goto NUMBER X Y     drive there, then answer "done NUMBER"        stop      brake, then answer "moving 0"
//     do NUMBER TYPE      answer "started NUMBER", then "done NUMBER" or "failed NUMBER"
//     pose X Y THETA CHARGE and moving 0|1 are sent by the vehicle
//
//     e19_bridge 127.0.0.1 1883 V1 127.0.0.1 5000       (the broker, the serial number, the vehicle; Ctrl-C ends it)
//
// The bridge gives each command a number of its own: the ids of an order come from outside and could contain anything, also
// a line end. After a lost connection it repeats the commands that have not ended; the vehicle executes a number once. The
// numbers grow across restarts of the bridge, because they begin with the milliseconds of the clock: each has 64 bits.
// The lesson is longer than 150 lines because a bridge has two sides.

#include "ExampleBroker.hpp"
#include "ExampleClock.hpp"
#include "ExampleRandom.hpp"
#include "MakerLink.hpp"
#include <acs/core/Now.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050_mosquitto/VehicleClient.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS;          // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)

namespace
{

constexpr std::string_view MAP = "floor";

/// The maker's vehicle drives to coordinates: a node without a position cannot be reached.
std::vector<OrderViolation> CheckPositions(const OrderMessage& order, const OrderContext& /*context*/)
{
    for (const OrderNode& node : order.nodes)
    {
        if (!node.nodePosition.has_value())
        {
            return {MakeOrderViolation(order, ErrorTypes::NO_ROUTE_ERROR, "a node has no position")};
        }
    }
    return {};
}

VehicleOptions MakeVehicleOptions(std::string serialNumber)
{
    VehicleOptions options;
    options.address = {"uagv", "Example", std::move(serialNumber)};
    options.mapIDs = {std::string(MAP)};
    options.orderCheck = CheckPositions;
    for (const char* const type : {"cancelOrder", "stateRequest"})
    {
        options.factsheet.protocolFeatures.agvActions.push_back(*FindPredefinedActionOrNull(type));
    }
    AgvAction beep; // One of the maker's own. Other types are refused.
    beep.actionType = "beep";
    beep.actionScopes = {EActionScope::Node};
    options.factsheet.protocolFeatures.agvActions.push_back(beep);
    return options;
}

class Bridge final : public IVehicleHandler
{
    struct Command
    {
        std::string verb;
        std::string rest;             ///< What follows the number.
        std::string actionID;         ///< Empty for a drive.
        std::uint32_t sequenceID = 0; ///< Of the node of a drive.
    };

    std::map<std::uint64_t, Command> _commands; ///< Those that have not ended, by number.
    bool _bStopWanted = false;                  ///< Until the vehicle shows that it does not move.
    ExampleClock _clock;
    std::uint64_t _lastNumber = CountMilliseconds(_clock.GetNow().wall); ///< Above all numbers of an earlier run.
    VehicleClient _vehicle;
    MakerLink _maker;

public:
    Bridge(
        boost::asio::io_context& io,
        Core::IRandom& random,
        const MosquittoOptions& broker,
        const VehicleOptions& vehicle,
        const boost::asio::ip::tcp::endpoint& maker)
        : _vehicle(io.get_executor(), _clock, random, Core::Logger(), broker, vehicle, *this),
          _maker(
              io,
              maker,
              [this](std::string_view line) { OnLine(line); },
              [this](bool bConnected) { OnMakerLink(bConnected); })
    {
        OnMakerLink(false);
        _vehicle.Start();
    }

    void StopAsync(VehicleClient::StopHandler handler)
    {
        _vehicle.StopAsync(std::move(handler));
    }

    void OnBrokerUp() override
    {
        fmt::print("connected\n");
    }

    void OnBrokerDown(std::error_code reason) override
    {
        fmt::print("no broker: {}; trying again\n", reason.message());
    }

    // ---- from VDA5050 to the maker

    void OnVehicleAction(const VehicleAction& action) override
    {
        std::visit(
            Core::Overloaded{
                [this](const DriveTo& drive) { Drive(drive); },
                [this](const StopDriving&) {
                    std::erase_if(_commands, [](const auto& command) { return command.second.actionID.empty(); });
                    _bStopWanted = true;
                    _maker.Send("stop");
                },
                [this](const StartAction& start) {
                    Begin({"do", start.action.actionType, start.action.actionID, 0}); // Types are listed above.
                },
                [](const OrderTaken& taken) { fmt::print("order {} taken\n", taken.orderID); },
                [](const OrderRefused& refused) {
                    fmt::print("order {} refused: {}\n", refused.orderID, refused.reason);
                },
                [](const OrderCompleted& completed) { fmt::print("order {} completed\n", completed.orderID); },
                [](const auto& /*other*/) {
                }}, // The vehicle cannot pause or abort an action: it continues.
            action);
    }

private:
    [[nodiscard]] static std::uint64_t CountMilliseconds(Core::WallTime time)
    {
        const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch());
        return static_cast<std::uint64_t>(since.count());
    }

    void Drive(const DriveTo& drive)
    {
        const bool bUnderWay = std::ranges::any_of(_commands, [&drive](const auto& command) {
            return command.second.actionID.empty() && command.second.sequenceID == drive.node.sequenceID;
        });
        if (!bUnderWay) // Otherwise only bStopAtNode has changed, and this vehicle stops at each node.
        {
            const NodePosition& position = *drive.node.nodePosition; // CheckPositions has seen it.
            _bStopWanted = false;
            Begin({"goto", fmt::format("{:.3f} {:.3f}", position.x, position.y), {}, drive.node.sequenceID});
        }
    }

    void Begin(Command command)
    {
        Send(++_lastNumber, command);
        _commands.emplace(_lastNumber, std::move(command));
    }

    void Send(std::uint64_t number, const Command& command)
    {
        _maker.Send(fmt::format("{} {} {}", command.verb, number, command.rest));
    }

    // ---- from the maker to VDA5050

    void OnLine(std::string_view line)
    {
        std::istringstream words{std::string(line)};
        std::string verb;
        words >> verb;
        if (verb == "pose")
        {
            OnPose(words);
        }
        else if (verb == "moving")
        {
            const bool bDriving = words.get() == ' ' && words.get() == '1';
            _bStopWanted = _bStopWanted && bDriving;
            _vehicle.Run(
                [bDriving](auto& session, Core::Now now, auto& out) { session.OnDrivingChanged(bDriving, now, out); });
        }
        else if (verb == "started" || verb == "done" || verb == "failed")
        {
            std::uint64_t number = 0;
            words >> number;
            OnProgress(verb, number);
        }
        else
        {
            fmt::print("a line of the vehicle is ignored\n");
        }
    }

    void OnPose(std::istringstream& words)
    {
        AgvPosition position;
        BatteryState battery;
        if (words >> position.x >> position.y >> position.theta >> battery.batteryCharge)
        {
            position.bPositionInitialized = true;
            position.mapID = MAP;
            _vehicle.Run([&position, &battery](auto& session, Core::Now now, auto& out) {
                session.OnPosition(position, {});
                session.OnBattery(battery, now, out);
            });
        }
    }

    void OnProgress(std::string_view verb, std::uint64_t number)
    {
        const auto found = _commands.find(number);
        if (found == _commands.end())
        {
            return; // Of a cancelled drive, or answered twice.
        }
        const Command command = found->second;
        const bool bDone = verb == "done";
        if (verb != "started")
        {
            _commands.erase(found);
        }
        if (command.actionID.empty() && bDone)
        {
            const NodeArrival arrival{command.sequenceID, true};
            _vehicle.Run(
                [&arrival](auto& session, Core::Now now, auto& out) { session.TryReachNode(arrival, now, out); });
        }
        else if (!command.actionID.empty())
        {
            const EActionStatus status = verb == "started" ? EActionStatus::Running
                : bDone                                    ? EActionStatus::Finished
                                                           : EActionStatus::Failed;
            _vehicle.Run([&command, status](auto& session, Core::Now now, auto& out) {
                session.TrySetActionStatus(command.actionID, status, {}, now, out);
            });
        }
    }

    void OnMakerLink(bool bConnected)
    {
        std::vector<VehicleError> errors;
        if (!bConnected)
        {
            errors.emplace_back();
            errors.back().errorType = "vehicleUnreachable";
            errors.back().errorLevel = EErrorLevel::Fatal;
        }
        _vehicle.Run([&errors](auto& session, Core::Now now, auto& out) { session.OnErrors(errors, now, out); });
        if (_bStopWanted)
        {
            _maker.Send("stop");
        }
        for (const auto& [number, command] : _commands)
        {
            Send(number, command);
        }
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    std::optional<MosquittoOptions> brokerOrNull =
        argc == 6 ? ReadBrokerOrNull(arguments[1], arguments[2]) : std::nullopt;
    const std::optional<MosquittoOptions> makerOrNull =
        argc == 6 ? ReadBrokerOrNull(arguments[4], arguments[5]) : std::nullopt;
    boost::system::error_code error;
    const auto address = boost::asio::ip::make_address(argc == 6 ? arguments[4] : "", error);
    const VehicleOptions options = MakeVehicleOptions(argc == 6 ? arguments[3] : "");
    const bool bAddressed = IsValidAddress(options.address); // The serial number "a/b" would be two levels of a topic.
    if (!brokerOrNull || !makerOrNull || error || !bAddressed)
    {
        fmt::print("Usage: e19_bridge HOST PORT SERIALNUMBER VEHICLE_ADDRESS VEHICLE_PORT\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // Each line at once, also into a pipe.
    brokerOrNull->clientID = fmt::format("bridge-{}", arguments[3]);
    boost::asio::io_context io;
    ExampleRandom random;
    Bridge bridge(io, random, *brokerOrNull, options, {address, makerOrNull->port});
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&bridge, &io](const boost::system::error_code& cancelled, int /*number*/) {
        if (!cancelled)
        {
            bridge.StopAsync([&io] { io.stop(); });
        }
    });
    io.run();
    return 0;
}
