// Lesson 11: a VDA5050 vehicle of your own on a real MQTT broker. The session keeps the protocol's rules; what is yours is
// the class Hardware, which here needs a second for each edge and half of one for each action.
//
//     mosquitto -p 1883
//     e11_vehicle 127.0.0.1 1883 V1        (VDA5050 2.0, uagv/v2/Example/V1/...; Ctrl-C ends it)

#include "ExampleBroker.hpp"
#include "ExampleRandom.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/VehicleSession.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

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

using namespace ACS;          // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr const char* MAP = "floor";

Core::Now ReadClock()
{
    return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
}

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

class ExampleVehicle final : public IMqttLinkListener
{
    boost::asio::io_context& _io;
    VehicleSession _session;
    VehicleActions _actions; ///< Asked for, and not yet carried out.
    std::map<EVehicleTimer, Wait> _timers;
    Wait _leg;                         ///< Runs while the vehicle drives.
    std::map<std::string, Wait> _work; ///< For each action that is performed.
    AgvPosition _position;
    MosquittoLink _link;

public:
    ExampleVehicle(
        boost::asio::io_context& io,
        Core::IRandom& random,
        const MosquittoOptions& broker,
        const VehicleOptions& vehicle)
        : _io(io),
          _session(vehicle),
          _leg(io),
          _link(io.get_executor(), random, Core::Logger(), broker, *this)
    {
        _position.bPositionInitialized = true;
        _position.mapID = MAP;
        _session.OnPosition(_position, {});
        BatteryState battery;
        battery.batteryCharge = 80.0;
        _session.OnBattery(battery, ReadClock(), _actions);
        _link.Subscribe(_session.GetSubscriptions());
        _link.SetWill(_session.MakeWill(ReadClock()));
        _link.Start();
    }

    /// OFFLINE is the last word, and the broker sends no will.
    void Stop()
    {
        _session.Leave(ReadClock(), _actions);
        Execute();
        _link.StopAsync(std::nullopt, MosquittoLink::DEFAULT_STOP_TIMEOUT, [this]() { _io.stop(); });
    }

    void OnLinkUp() override
    {
        fmt::print("connected\n");
        _link.SetWill(_session.MakeWill(ReadClock())); // for the next connection: each will has its own time
        _session.OnLinkUp(ReadClock(), _actions);
        Execute();
    }

    void OnLinkDown(std::error_code reason) override
    {
        fmt::print("no broker: {}; trying again\n", reason.message());
        _session.OnLinkDown(ReadClock(), _actions); // the vehicle drives on to the end of what is released
        Execute();
    }

    void OnMqttMessage(const MqttMessage& message) override
    {
        _session.OnMessage(message.topic, message.payload, message.bRetained, ReadClock(), _actions);
        Execute();
    }

private:
    /// Carries out a batch, which may ask for another one. A session must not be called while its batch is read: hence
    /// the swap.
    void Execute()
    {
        while (!_actions.empty())
        {
            for (const VehicleAction& action : std::exchange(_actions, {}))
            {
                std::visit([this](const auto& content) { this->Do(content); }, action);
            }
        }
    }

    template <typename TFunction>
    void Later(Wait& wait, Core::Duration delay, TFunction function)
    {
        wait.Start(delay, [this, function]() {
            function();
            Execute();
        });
    }

    // ---- what every vehicle does in the same way

    void Do(const PublishMessage& publish)
    {
        if (const Core::Result<void> done = _link.Publish(publish.message); !done)
        {
            fmt::print("not published: {}\n", Core::Describe(done.error())); // the next state contains everything
        }
    }

    void Do(const StartVehicleTimer& start)
    {
        const auto [found, bNew] = _timers.try_emplace(start.timer, _io);
        Later(found->second, start.delay, [this, timer = start.timer]() {
            _session.OnTimer(timer, ReadClock(), _actions);
        });
    }

    void Do(const CancelVehicleTimer& cancel)
    {
        _timers.erase(cancel.timer);
    }

    static void Do(const OrderTaken& taken)
    {
        fmt::print("order {} update {} taken\n", taken.orderID, taken.orderUpdateID);
    }

    static void Do(const OrderRefused& refused)
    {
        fmt::print("order {} refused: {}\n", refused.orderID, refused.reason);
    }

    static void Do(const OrderCompleted& completed)
    {
        fmt::print("order {} completed\n", completed.orderID);
    }

    static void Do(const OrderCleared& cleared)
    {
        fmt::print("order {} cancelled\n", cleared.orderID);
    }

    static void Do(const MessageIgnored& ignored)
    {
        fmt::print("{} ignored: {}\n", GetTopicName(ignored.topic), Core::Describe(ignored.error));
    }

    // ---- the hardware: put yours here

    void Do(const DriveTo& drive)
    {
        _session.OnDrivingChanged(true, ReadClock(), _actions);
        Later(_leg, 1s, [this, drive]() {
            if (drive.node.nodePosition.has_value())
            {
                _position.x = drive.node.nodePosition->x;
                _position.y = drive.node.nodePosition->y;
                _session.OnPosition(_position, {});
            }
            const NodeArrival arrival{drive.node.sequenceID, drive.bStopAtNode};
            static_cast<void>(_session.TryReachNode(arrival, ReadClock(), _actions));
        });
    }

    void Do(const StopDriving& /*stop*/)
    {
        _leg.Stop();
        _session.OnDrivingChanged(false, ReadClock(), _actions);
    }

    void Do(const StartAction& start)
    {
        fmt::print("{} begins\n", start.action.actionType);
        Tell(start.action.actionID, EActionStatus::Running);
        FinishLater(start.action.actionID);
    }

    void Do(const PauseAction& pause)
    {
        _work.erase(pause.actionID);
        Tell(pause.actionID, EActionStatus::Paused);
    }

    void Do(const ResumeAction& resume)
    {
        Tell(resume.actionID, EActionStatus::Running);
        FinishLater(resume.actionID);
    }

    void Do(const StopAction& stop)
    {
        _work.erase(stop.actionID);
        Tell(stop.actionID, EActionStatus::Failed);
    }

    void FinishLater(const std::string& actionID)
    {
        const auto [found, bNew] = _work.try_emplace(actionID, _io);
        Later(found->second, 500ms, [this, actionID]() {
            Tell(actionID, EActionStatus::Finished);
            _work.erase(actionID);
        });
    }

    void Tell(const std::string& actionID, EActionStatus status)
    {
        static_cast<void>(_session.TrySetActionStatus(actionID, status, {}, ReadClock(), _actions));
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    std::optional<MosquittoOptions> brokerOrNull =
        argc == 4 ? ReadBrokerOrNull(arguments[1], arguments[2]) : std::nullopt;
    if (!brokerOrNull.has_value())
    {
        fmt::print("Usage: e11_vehicle HOST PORT SERIALNUMBER\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // each line at once, also into a pipe
    brokerOrNull->clientID = fmt::format("example-vehicle-{}", arguments[3]);
    boost::asio::io_context io;
    ExampleRandom random;
    ExampleVehicle vehicle(io, random, *brokerOrNull, MakeVehicleOptions(arguments[3]));
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
