#include "Catch.hpp"
#include "LinkFixture.hpp"
#include "SteadySystemClock.hpp"
#include "Vda5050Sample.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050_mosquitto/MasterClient.hpp>
#include <acs/vda5050_mosquitto/VehicleClient.hpp>

#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using namespace VDA5050; // NOLINT(google-build-using-namespace): nearly every name of the test is one of it
using VDA5050::Test::MakeAction;
using VDA5050::Test::MakeEdges;
using VDA5050::Test::MakeNodes;

/// A vehicle that is at each node at once and performs each action at once, by VehicleClient alone.
class QuickVehicle final : IVehicleHandler
{
    SteadySystemClock _clock;
    SeededRandom _random;
    bool _bInCall = false;

public:
    std::size_t ups = 0;
    std::size_t downs = 0;
    std::vector<std::string> performed;
    std::unique_ptr<VehicleClient> client;

    QuickVehicle(boost::asio::io_context& io, const MosquittoOptions& broker)
    {
        VehicleOptions options;
        options.address = {"uagv", "ACS", "LR1"};
        options.initialNodeID = "N0";
        options.minimumStateInterval = 5ms;
        options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
        client = std::make_unique<VehicleClient>(
            io.get_executor(),
            _clock,
            _random,
            Core::Logger(),
            broker,
            options,
            static_cast<IVehicleHandler&>(*this)); // its base is private
        Call([](VehicleSession& session, Core::Now /*now*/, VehicleActions& /*out*/) {
            AgvPosition position;
            position.bPositionInitialized = true;
            position.mapID = "floor";
            session.OnPosition(position, {});
        });
        client->Start();
    }

private:
    void OnBrokerUp() override
    {
        ++ups;
    }

    void OnBrokerDown(std::error_code /*reason*/) override
    {
        ++downs;
    }

    void OnVehicleAction(const VehicleAction& action) override
    {
        CHECK_FALSE(_bInCall);
        std::visit(
            Core::Overloaded{
                [this](const DriveTo& drive) {
                    Call([&drive](VehicleSession& session, Core::Now now, VehicleActions& out) {
                        session.OnDrivingChanged(true, now, out);
                        CHECK(session.TryReachNode({drive.node.sequenceID, drive.bStopAtNode}, now, out));
                        session.OnDrivingChanged(false, now, out);
                    });
                },
                [this](const StartAction& start) {
                    performed.push_back(start.action.actionID);
                    Call([&start](VehicleSession& session, Core::Now now, VehicleActions& out) {
                        const std::string& actionID = start.action.actionID;
                        CHECK(session.TrySetActionStatus(actionID, EActionStatus::Running, {}, now, out));
                        CHECK(session.TrySetActionStatus(actionID, EActionStatus::Finished, {}, now, out));
                    });
                },
                [](const auto& /*other*/) {
                }},
            action);
    }

    void Call(const VehicleClient::SessionCall& call)
    {
        _bInCall = true;
        client->Run(call);
        _bInCall = false;
    }
};

struct RecordingMaster final : IMasterHandler
{
    std::size_t ups = 0;
    std::size_t downs = 0;
    std::vector<std::pair<std::size_t, MasterAction>> events;
    std::function<void(std::size_t vehicle, const MasterAction& event)> onEvent;

    void OnBrokerUp() override
    {
        ++ups;
    }

    void OnBrokerDown(std::error_code reason) override
    {
        CHECK(reason);
        ++downs;
    }

    void OnVehicleEvent(std::size_t vehicle, const MasterAction& event) override
    {
        CHECK_FALSE(std::holds_alternative<PublishMessage>(event));
        CHECK_FALSE(std::holds_alternative<StartMasterTimer>(event));
        events.emplace_back(vehicle, event);
        if (onEvent)
        {
            onEvent(vehicle, event);
        }
    }

    template <typename TEvent>
    [[nodiscard]] std::size_t Count() const
    {
        return static_cast<std::size_t>(std::ranges::count_if(events, [](const auto& event) {
            return std::holds_alternative<TEvent>(event.second);
        }));
    }
};

class ClientFixture
{
protected:
    boost::asio::io_context _io;
    MosquittoBroker _broker;
    SteadySystemClock _clock;
    SeededRandom _random;
    RecordingMaster _handler;
    std::unique_ptr<MasterClient> _master;
    std::unique_ptr<QuickVehicle> _vehicle;

    ClientFixture()
    {
        FleetOptions options;
        options.vehicle.resendInterval = 200ms;
        auto made = MasterClient::Create(
            _io.get_executor(),
            _clock,
            _random,
            Core::Logger(),
            MakeOptions(_broker.GetPort(), "master"),
            options,
            _handler);
        REQUIRE(made.has_value());
        _master = std::move(*made);
        _master->Start();
        _vehicle = std::make_unique<QuickVehicle>(_io, MakeOptions(_broker.GetPort(), "LR1"));
    }

    [[nodiscard]] bool WasReached(const std::function<bool()>& isTrue)
    {
        return TryRunUntil(_io, isTrue);
    }

    [[nodiscard]] bool IsReady() const
    {
        const auto number = _master->GetFleet().FindOrNull({"uagv", "ACS", "LR1"});
        return number.has_value() && _master->GetFleet().GetSession(*number).CanTakeOrder()
            && _handler.Count<StateReceived>() > 0; // Events come after the session has changed.
    }

    [[nodiscard]] static OrderMessage MakeOrder(const std::string& orderID)
    {
        std::vector<OrderNode> nodes = MakeNodes(3);
        nodes[2].actions.push_back(MakeAction("action-of-" + orderID, EBlockingType::Hard, "detectObject"));
        return *OrderBuilder::Create(orderID, nodes, MakeEdges(2))->MakeOrder(3);
    }
};

} // namespace

TEST_CASE_METHOD(ClientFixture, "MasterClient and VehicleClient: a vehicle is discovered, drives an order, and leaves")
{
    REQUIRE(WasReached([this] { return IsReady(); }));
    CHECK(_master->IsConnected());
    CHECK(_vehicle->client->IsConnected());
    CHECK(_handler.ups == 1);
    CHECK(_vehicle->ups == 1);
    CHECK(std::holds_alternative<VehicleOnline>(_handler.events.front().second));
    REQUIRE(_master->SendOrder(0, MakeOrder("order-1")).has_value());
    CHECK(_handler.Count<OrderAccepted>() == 0); // No event during a call.
    REQUIRE(WasReached([this] { return _handler.Count<OrderFinished>() == 1; }));
    CHECK(_handler.Count<NodeReached>() == 3);
    CHECK(_vehicle->performed == std::vector<std::string>{"action-of-order-1"});

    const Core::Result<std::string> request = _master->SendInstantAction(0, MakeAction("", {}, "factsheetRequest"));
    REQUIRE(request.has_value());
    REQUIRE(WasReached([this] { return _handler.Count<FactsheetReceived>() >= 2; }));

    bool bStopped = false;
    _vehicle->client->StopAsync([&bStopped] { bStopped = true; });
    REQUIRE(WasReached([this] { return _handler.Count<VehicleOffline>() == 1; }));
    REQUIRE(WasReached([&bStopped] { return bStopped; }));
    _vehicle.reset();
    CHECK(_handler.Count<VehicleBroken>() == 0);
    CHECK_FALSE(_master->SendOrder(0, MakeOrder("order-2")).has_value());
    CHECK_FALSE(_master->Cancel(0).has_value());

    const std::size_t before = _handler.events.size();
    bStopped = false;
    _master->StopAsync([&bStopped] { bStopped = true; });
    REQUIRE(WasReached([&bStopped] { return bStopped; }));
    CHECK_FALSE(_master->IsConnected());
    CHECK(_handler.downs == 0);
    CHECK(_handler.events.size() == before);
}

TEST_CASE_METHOD(ClientFixture, "MasterClient: what can no longer be sent is refused")
{
    REQUIRE(WasReached([this] { return IsReady(); }));
    bool bStopped = false;
    _master->StopAsync([&bStopped] { bStopped = true; });
    CHECK_FALSE(_master->SendOrder(0, MakeOrder("order-1")).has_value());
    REQUIRE(WasReached([&bStopped] { return bStopped; }));
    CHECK(_vehicle->performed.empty());
}

TEST_CASE_METHOD(ClientFixture, "MasterClient: after a stop handler that destroys the client no other one is called")
{
    REQUIRE(WasReached([this] { return IsReady(); }));
    std::size_t calls = 0;
    _master->StopAsync([this, &calls] {
        ++calls;
        _master.reset();
    });
    _master->StopAsync([&calls] { ++calls; });
    REQUIRE(WasReached([&calls] { return calls > 0; }));
    CHECK(calls == 1);
}

TEST_CASE_METHOD(ClientFixture, "VehicleClient: the broker sends the will of a vehicle that is gone")
{
    REQUIRE(WasReached([this] { return IsReady(); }));
    _vehicle.reset();
    REQUIRE(WasReached([this] { return _handler.Count<VehicleBroken>() == 1; }));
    _vehicle = std::make_unique<QuickVehicle>(_io, MakeOptions(_broker.GetPort(), "LR1"));
    REQUIRE(WasReached([this] { return _handler.Count<VehicleOnline>() == 2; }));
}

TEST_CASE_METHOD(ClientFixture, "MasterClient and VehicleClient reconnect after an outage of the broker")
{
    REQUIRE(WasReached([this] { return IsReady(); }));
    _broker.Kill();
    REQUIRE(WasReached([this] { return _handler.downs == 1 && _vehicle->downs == 1; }));
    CHECK_FALSE(_master->SendOrder(0, MakeOrder("order-1")).has_value());
    _broker.Restart();
    REQUIRE(WasReached([this] { return _handler.ups == 2 && _vehicle->ups == 2 && IsReady(); }));
    REQUIRE(_master->SendOrder(0, MakeOrder("order-2")).has_value());
    REQUIRE(WasReached([this] { return _handler.Count<OrderFinished>() == 1; }));
    CHECK(_vehicle->performed.size() == 1);
}

TEST_CASE_METHOD(ClientFixture, "MasterClient: a handler sends the order, and destroys the client")
{
    bool bSent = false;
    bool bDestroyed = false;
    _handler.onEvent = [this, &bSent, &bDestroyed](std::size_t vehicle, const MasterAction& event) {
        CHECK_FALSE(bDestroyed);
        if (std::holds_alternative<StateReceived>(event) && IsReady() && !std::exchange(bSent, true))
        {
            CHECK(_master->SendOrder(vehicle, MakeOrder("order-1")).has_value());
        }
        else if (std::holds_alternative<OrderAccepted>(event))
        {
            bDestroyed = true;
            _master.reset();
        }
    };
    REQUIRE(WasReached([&bDestroyed] { return bDestroyed; }));
    REQUIRE(WasReached([this] { return _vehicle->performed.size() == 1; }));
}

TEST_CASE_METHOD(ClientFixture, "MasterClient: a removed vehicle has no events, and is added again by its address")
{
    REQUIRE(WasReached([this] { return IsReady(); }));
    std::optional<std::size_t> last;
    _handler.onEvent = [this, &last](std::size_t vehicle, const MasterAction& event) {
        last = vehicle;
        if (vehicle == 0 && std::holds_alternative<OrderAccepted>(event))
        {
            CHECK(_master->TryRemove(0));
            CHECK_FALSE(_master->TryRemove(0));
        }
        CHECK(_master->GetFleet().Contains(vehicle) == !std::holds_alternative<OrderAccepted>(event));
    };
    REQUIRE(_master->SendOrder(0, MakeOrder("order-1")).has_value());
    REQUIRE(WasReached([this] { return _vehicle->performed.size() == 1 && !_master->GetFleet().Contains(0); }));
    const Core::Result<std::size_t> number = _master->Add({"uagv", "ACS", "LR1"});
    REQUIRE(number.has_value());
    CHECK(*number == 1);
    _vehicle->client->Run([](VehicleSession& session, Core::Now now, VehicleActions& out) {
        BatteryState battery;
        battery.bCharging = true;
        session.OnBattery(battery, now, out); // Sends a state.
    });
    REQUIRE(WasReached([&last] { return last == 1; }));
    CHECK(_handler.Count<OrderFinished>() == 0);
    CHECK_FALSE(_master->Add({"uagv", "A/B", "LR1"}).has_value());
}

TEST_CASE("MasterClient: an interface name that no topic can have is an error")
{
    boost::asio::io_context io;
    const SteadySystemClock clock;
    SeededRandom random;
    RecordingMaster handler;
    FleetOptions options;
    options.vehicle.address.interfaceName = "a/+";
    const auto made = MasterClient::Create(io.get_executor(), clock, random, Core::Logger(), {}, options, handler);
    REQUIRE_FALSE(made.has_value());
    CHECK(made.error().code == EVda5050Error::InvalidTopic);
}

} // namespace ACS::Testing
