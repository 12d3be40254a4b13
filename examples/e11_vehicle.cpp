// Lesson 11: a VDA5050 vehicle of your own on a real MQTT broker. The session keeps the protocol's rules, and VehicleClient has the
// connection and the timers; what is yours is the hardware, which here needs a second for each edge and half of one for each action.
//
//     mosquitto -p 1883
//     e11_vehicle 127.0.0.1 1883 V1        (VDA5050 2.0, uagv/v2/Example/V1/...; Ctrl-C ends it)

#include "ExampleBroker.hpp"
#include "ExampleClock.hpp"
#include "ExampleRandom.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050_mosquitto/VehicleClient.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/core.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

using namespace ACS;          // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr const char* MAP = "floor";

VehicleOptions MakeVehicleOptions(std::string serialNumber)
{
    VehicleOptions options;
    options.address = {"uagv", "Example", std::move(serialNumber)};
    options.mapIDs = {MAP};
    options.initialNodeID = "N1";
    // What the vehicle can do: an order that asks for anything else is refused with an error in the state.
    for (const char* const type : {"startPause", "stopPause", "cancelOrder", "stateRequest"})
    {
        options.factsheet.protocolFeatures.agvActions.push_back(*FindPredefinedActionOrNull(type));
    }
    AgvAction beep; // one of the maker's own
    beep.actionType = "beep";
    beep.actionScopes = {EActionScope::Node, EActionScope::Instant};
    options.factsheet.protocolFeatures.agvActions.push_back(beep);
    return options;
}

/// A wait that is stopped, started again or destroyed never calls back, even where its time had come already.
class Wait
{
    boost::asio::steady_timer _timer;
    std::shared_ptr<bool> _round;

public:
    explicit Wait(boost::asio::io_context& io)
        : _timer(io)
    {
    }

    template <typename TFunction>
    void Start(Core::Duration delay, TFunction function)
    {
        _round = std::make_shared<bool>();
        _timer.expires_after(delay);
        _timer.async_wait([function, round = std::weak_ptr(_round)](const boost::system::error_code& error) {
            const std::shared_ptr<bool> self = round.lock();
            if (!error && self != nullptr)
            {
                function();
            }
        });
    }

    void Stop()
    {
        _round.reset();
        _timer.cancel();
    }
};

class ExampleVehicle final : public IVehicleHandler
{
    boost::asio::io_context& _io;
    Wait _leg;                         ///< Runs while the vehicle drives.
    std::map<std::string, Wait> _work; ///< For each action that is performed.
    AgvPosition _position;
    ExampleClock _clock;
    VehicleClient _client;

public:
    ExampleVehicle(
        boost::asio::io_context& io,
        Core::IRandom& random,
        const MosquittoOptions& broker,
        const VehicleOptions& vehicle)
        : _io(io),
          _leg(io),
          _client(io.get_executor(), _clock, random, Core::Logger(), broker, vehicle, *this)
    {
        _position.bPositionInitialized = true;
        _position.mapID = MAP;
        BatteryState battery;
        battery.batteryCharge = 80.0;
        _client.Run([this, &battery](VehicleSession& session, Core::Now now, VehicleActions& out) {
            session.OnPosition(_position, {});
            session.OnBattery(battery, now, out);
        });
        _client.Start();
    }

    void Stop()
    {
        _client.StopAsync([this] { _io.stop(); });
    }

    void OnBrokerUp() override
    {
        fmt::print("connected\n");
    }

    void OnBrokerDown(std::error_code reason) override
    {
        fmt::print("no broker: {}; trying again\n", reason.message());
    }

    void OnVehicleAction(const VehicleAction& action) override
    {
        std::visit(
            Core::Overloaded{
                // ---- the hardware: put yours here
                [this](const DriveTo& drive) { Drive(drive); },
                [this](const StopDriving& /*stop*/) {
                    _leg.Stop();
                    SetDriving(false);
                },
                [this](const StartAction& start) {
                    fmt::print("{} begins\n", start.action.actionType);
                    BeginWork(start.action.actionID);
                },
                [this](const PauseAction& pause) { EndWork(pause.actionID, EActionStatus::Paused); },
                [this](const ResumeAction& resume) { BeginWork(resume.actionID); },
                [this](const StopAction& stop) { EndWork(stop.actionID, EActionStatus::Failed); },
                // ---- what has become of orders
                [](const OrderTaken& taken) {
                    fmt::print("order {} update {} taken\n", taken.orderID, taken.orderUpdateID);
                },
                [](const OrderRefused& refused) {
                    fmt::print("order {} refused: {}\n", refused.orderID, refused.reason);
                },
                [](const OrderCompleted& completed) { fmt::print("order {} completed\n", completed.orderID); },
                [](const OrderCleared& cleared) { fmt::print("order {} cancelled\n", cleared.orderID); },
                [](const MessageIgnored& ignored) {
                    fmt::print("{} ignored: {}\n", GetTopicName(ignored.topic), Core::Describe(ignored.error));
                },
                [](const auto& /*other*/) {
                }},
            action);
    }

private:
    void SetDriving(bool bDriving)
    {
        _client.Run([bDriving](VehicleSession& session, Core::Now now, VehicleActions& out) {
            session.OnDrivingChanged(bDriving, now, out);
        });
    }

    void Drive(const DriveTo& drive)
    {
        SetDriving(true);
        _leg.Start(1s, [this, drive] {
            if (drive.node.nodePosition.has_value())
            {
                _position.x = drive.node.nodePosition->x;
                _position.y = drive.node.nodePosition->y;
            }
            _client.Run([this, &drive](VehicleSession& session, Core::Now now, VehicleActions& out) {
                session.OnPosition(_position, {});
                session.TryReachNode({drive.node.sequenceID, drive.bStopAtNode}, now, out);
            });
        });
    }

    void BeginWork(const std::string& actionID)
    {
        SetStatus(actionID, EActionStatus::Running);
        _work.try_emplace(actionID, _io).first->second.Start(500ms, [this, actionID] {
            EndWork(actionID, EActionStatus::Finished);
        });
    }

    void EndWork(const std::string& actionID, EActionStatus status)
    {
        SetStatus(actionID, status);
        _work.erase(actionID);
    }

    void SetStatus(const std::string& actionID, EActionStatus status)
    {
        _client.Run([&actionID, status](VehicleSession& session, Core::Now now, VehicleActions& out) {
            session.TrySetActionStatus(actionID, status, {}, now, out);
        });
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    std::optional<MosquittoOptions> brokerOrNull =
        argc == 4 ? ReadBrokerOrNull(arguments[1], arguments[2]) : std::nullopt;
    const VehicleOptions options = MakeVehicleOptions(argc == 4 ? arguments[3] : "");
    if (!brokerOrNull.has_value() || !IsValidAddress(options.address)) // "a/b" would be two levels of a topic.
    {
        fmt::print("Usage: e11_vehicle HOST PORT SERIALNUMBER\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // each line at once, also into a pipe
    brokerOrNull->clientID = fmt::format("example-vehicle-{}", arguments[3]);
    boost::asio::io_context io;
    ExampleRandom random;
    ExampleVehicle vehicle(io, random, *brokerOrNull, options);
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&vehicle](const boost::system::error_code& error, int /*number*/) {
        if (!error)
        {
            vehicle.Stop();
        }
    });
    io.run();
    return 0;
}
