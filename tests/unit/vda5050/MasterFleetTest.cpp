#include "Catch.hpp"
#include "ManualClock.hpp"
#include "Vda5050Sample.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/MasterFleet.hpp>

namespace ACS::VDA5050::Test
{

namespace
{

VehicleAddress MakeVehicle(int number)
{
    return VehicleAddress{"uagv", "ACS", "LR" + std::to_string(number)};
}

class MasterFleetFixture
{
    Testing::ManualClock _clock;

public:
    MasterFleet fleet;
    FleetActions out;

    explicit MasterFleetFixture(FleetOptions options = {})
        : fleet(std::move(options))
    {
        fleet.OnLinkUp(_clock.GetNow(), out);
    }

    [[nodiscard]] Core::Now GetNow() const
    {
        return _clock.GetNow();
    }

    void Connect(const VehicleAddress& address, EVda5050Version version = EVda5050Version::Version200)
    {
        ConnectionMessage message;
        message.header = MakeHeader(address, version);
        message.connectionState = EConnectionState::Online;
        Deliver(address, ETopic::Connection, Vda5050Codec().Encode(message, version), true);
    }

    void SendState(const VehicleAddress& address, bool bRetained = false)
    {
        StateMessage message;
        message.header = MakeHeader(address, EVda5050Version::Version200);
        Deliver(address, ETopic::State, Vda5050Codec().Encode(message, EVda5050Version::Version200), bRetained);
    }

    void Deliver(const VehicleAddress& address, ETopic topic, std::string payload, bool bRetained)
    {
        fleet.OnMessage(MqttMessage{BuildTopic(address, topic), std::move(payload), 1, bRetained}, GetNow(), out);
    }

    template <typename TEvent>
    [[nodiscard]] std::vector<std::size_t> ListReportingVehicles() const
    {
        std::vector<std::size_t> vehicles;
        for (const FleetAction& action : out)
        {
            if (std::holds_alternative<TEvent>(action.action))
            {
                vehicles.push_back(action.vehicle);
            }
        }
        return vehicles;
    }

private:
    [[nodiscard]] Header MakeHeader(const VehicleAddress& address, EVda5050Version version) const
    {
        return Header{
            0,
            _clock.GetNow().wall,
            std::string(GetVersionText(version)),
            address.manufacturer,
            address.serialNumber};
    }
};

} // namespace

TEST_CASE("6 A fleet discovers its vehicles from retained connection messages, each with its own version and session")
{
    MasterFleetFixture bench;
    CHECK(bench.fleet.GetSubscriptions().size() == 4);
    CHECK(bench.fleet.GetSubscriptions()[2].topicFilter == "uagv/v2/+/+/connection");
    bench.Connect(MakeVehicle(1));
    bench.Connect(MakeVehicle(2), EVda5050Version::Version210);
    bench.Connect(MakeVehicle(1));
    REQUIRE(bench.fleet.GetSize() == 2);
    CHECK(bench.ListReportingVehicles<VehicleOnline>() == std::vector<std::size_t>{0, 1});
    CHECK(bench.fleet.GetSession(0).GetOptions().version == EVda5050Version::Version200);
    CHECK(bench.fleet.GetSession(1).GetOptions().version == EVda5050Version::Version210);
    CHECK(bench.fleet.FindOrNull(MakeVehicle(2)) == std::optional<std::size_t>(1));
    CHECK_FALSE(bench.fleet.FindOrNull(MakeVehicle(3)).has_value());
    bench.out.clear();
    bench.SendState(MakeVehicle(2));
    CHECK(bench.ListReportingVehicles<StateReceived>() == std::vector<std::size_t>{1});
    CHECK(bench.fleet.GetSession(1).CanTakeOrder());
    CHECK_FALSE(bench.fleet.GetSession(0).CanTakeOrder());
}

TEST_CASE("6 A live state discovers a vehicle; a retained state or another topic does not")
{
    MasterFleetFixture bench;
    bench.SendState(MakeVehicle(1), true);
    bench.Deliver(MakeVehicle(1), ETopic::Order, "{}", false);
    bench.Deliver(VehicleAddress{"other", "ACS", "LR1"}, ETopic::State, "{}", false);
    CHECK(bench.fleet.GetSize() == 0);
    bench.SendState(MakeVehicle(1));
    CHECK(bench.fleet.GetSize() == 1);
    CHECK(bench.ListReportingVehicles<VehicleOnline>() == std::vector<std::size_t>{0});
}

TEST_CASE("13 Undecodable messages, other major versions and vehicles beyond the limit are ignored and counted")
{
    FleetOptions options;
    options.maxVehicles = 2;
    MasterFleetFixture bench(options);
    bench.Deliver(MakeVehicle(1), ETopic::Connection, "ONLINE", true);
    bench.Deliver(MakeVehicle(1), ETopic::Connection, R"({"headerId":1,"version":"3.0.0"})", true);
    CHECK(bench.fleet.GetLeftOutCount() == 2);
    CHECK(bench.fleet.GetLastLeftOutOrNull()->reason.code == EVda5050Error::UnsupportedVersion);
    CHECK(bench.fleet.GetLastLeftOutOrNull()->topic == "uagv/v2/ACS/LR1/connection");
    for (int i = 1; i <= 3; ++i)
    {
        bench.Connect(MakeVehicle(i));
    }
    CHECK(bench.fleet.GetSize() == 2);
    CHECK(bench.fleet.GetLeftOutCount() == 3);
    CHECK(bench.fleet.GetLastLeftOutOrNull()->reason.code == Core::ECoreError::QueueFull);
}

TEST_CASE("3.1 A message that a known vehicle's session would reject does not discover a vehicle")
{
    MasterFleetFixture bench;
    CHECK(bench.fleet.GetLastLeftOutOrNull() == nullptr);
    ConnectionMessage message;
    message.header = Header{0, {}, "2.0.0", "ACS", "LR1"};
    message.connectionState = EConnectionState::Online;
    const std::string payload = Vda5050Codec().Encode(message, EVda5050Version::Version200);
    bench.Deliver(VehicleAddress{"uagv", "OTHER", "LR1"}, ETopic::Connection, payload, true);
    bench.Deliver(MakeVehicle(2), ETopic::Connection, payload, true);
    bench.Deliver(MakeVehicle(1), ETopic::State, payload, false); // not a state
    CHECK(bench.fleet.GetSize() == 0);
    CHECK(bench.fleet.GetLeftOutCount() == 3);
    CHECK(bench.out.empty());
    bench.Deliver(MakeVehicle(1), ETopic::Connection, payload, true);
    CHECK(bench.fleet.GetSize() == 1);
    CHECK(bench.ListReportingVehicles<VehicleOnline>() == std::vector<std::size_t>{0});
}

TEST_CASE("13 The statistics of the fleet are the sums of those of its vehicles")
{
    MasterFleetFixture bench;
    for (int i = 1; i <= 2; ++i)
    {
        bench.Connect(MakeVehicle(i));
        bench.SendState(MakeVehicle(i));
        bench.SendState(MakeVehicle(i), true);
        bench.Deliver(MakeVehicle(i), ETopic::State, "{}", false);
    }
    const MasterStatistics statistics = bench.fleet.GetStatistics();
    CHECK(statistics.statesReceived == 2);
    CHECK(statistics.retainedIgnored == 2);
    CHECK(statistics.messagesRefused == 2);
    CHECK(statistics.messagesSent == 4); // what is asked for when a vehicle comes online
}

TEST_CASE("13 Without discovery a fleet subscribes only to the vehicles that were added")
{
    FleetOptions options;
    options.bDiscovery = false;
    MasterFleetFixture bench(options);
    const auto first = bench.fleet.Add(MakeVehicle(1), bench.GetNow(), bench.out);
    REQUIRE(first.has_value());
    CHECK(bench.fleet.Add(MakeVehicle(1), bench.GetNow(), bench.out).value_or(99) == *first);
    const auto wrong = bench.fleet.Add(VehicleAddress{"uagv", "A/B", "1"}, bench.GetNow(), bench.out);
    REQUIRE_FALSE(wrong.has_value());
    CHECK(wrong.error().code == EVda5050Error::InvalidTopic);
    bench.Connect(MakeVehicle(2));
    bench.Connect(MakeVehicle(1));
    CHECK(bench.fleet.GetSize() == 1);
    CHECK(bench.ListReportingVehicles<VehicleOnline>() == std::vector<std::size_t>{0});
}

TEST_CASE("13 A removed vehicle frees its room; its number is not used again")
{
    FleetOptions options;
    options.maxVehicles = 2;
    MasterFleetFixture bench(options);
    bench.Connect(MakeVehicle(1));
    bench.Connect(MakeVehicle(2));
    bench.Connect(MakeVehicle(3));
    REQUIRE(bench.fleet.GetLeftOutCount() == 1);
    bench.out.clear();
    REQUIRE(bench.fleet.TryRemove(0, bench.out));
    CHECK(bench.ListReportingVehicles<CancelMasterTimer>() == std::vector<std::size_t>{0, 0, 0});
    CHECK_FALSE(bench.fleet.TryRemove(0, bench.out));
    CHECK_FALSE(bench.fleet.TryRemove(7, bench.out));
    CHECK_FALSE(bench.fleet.Contains(0));
    CHECK_FALSE(bench.fleet.FindOrNull(MakeVehicle(1)).has_value());
    bench.out.clear();
    Core::Now late = bench.GetNow();
    late.steady += std::chrono::hours(1);
    bench.fleet.OnTimer(0, EMasterTimer::Silence, late, bench.out);
    CHECK(bench.out.empty());
    bench.fleet.OnLinkDown(bench.GetNow(), bench.out);
    bench.fleet.OnLinkUp(bench.GetNow(), bench.out);
    bench.Connect(MakeVehicle(3));
    CHECK(bench.fleet.FindOrNull(MakeVehicle(3)) == std::optional<std::size_t>(2));
    CHECK(bench.fleet.GetStatistics().messagesSent == 4); // of those that are there
    CHECK(bench.fleet.GetSize() == 3);
}

TEST_CASE("13 Only vehicles that pass the filter are discovered; one that is added finds room in a full fleet")
{
    FleetOptions options;
    options.maxVehicles = 1;
    options.isAccepted = [](const VehicleAddress& address) {
        return address.serialNumber != "LR1";
    };
    MasterFleetFixture bench(options);
    bench.Connect(MakeVehicle(1));
    CHECK(bench.fleet.GetSize() == 0);
    REQUIRE(bench.fleet.GetLastLeftOutOrNull() != nullptr);
    CHECK(bench.fleet.GetLastLeftOutOrNull()->reason.code == EVda5050Error::InvalidTopic);
    bench.Connect(MakeVehicle(2));
    bench.Connect(MakeVehicle(3));
    CHECK(bench.fleet.GetSize() == 1);
    CHECK(bench.fleet.Add(MakeVehicle(1), bench.GetNow(), bench.out).value_or(99) == 1);
    bench.Connect(MakeVehicle(1));
    CHECK(bench.fleet.GetSession(1).GetLink() == EVehicleLink::Online);
}

TEST_CASE("2 No session and no fleet is created for an address that is invalid in a topic")
{
    const VehicleAddress wrong = GENERATE(
        VehicleAddress{"uagv", "#", "+"},
        VehicleAddress{"", "ACS", "LR1"},
        VehicleAddress{"a/b", "ACS", "LR1"});
    MasterOptions options;
    options.address = wrong;
    const auto session = MasterSession::Create(options);
    REQUIRE_FALSE(session.has_value());
    CHECK(session.error().code == EVda5050Error::InvalidTopic);
    FleetOptions fleetOptions;
    fleetOptions.vehicle = options;
    const bool bInterface = wrong.interfaceName == "uagv"; // a fleet has no vehicle yet
    const auto fleet = MasterFleet::Create(fleetOptions);
    CHECK(fleet.has_value() == bInterface);
    CHECK((bInterface || fleet.error().code == EVda5050Error::InvalidTopic));
    options.address = MakeVehicle(1);
    REQUIRE(MasterSession::Create(options).has_value());
    CHECK(MasterSession::Create(options)->GetSubscriptions()[0].topicFilter == "uagv/v2/ACS/LR1/state");
}

TEST_CASE("13 A link outage reaches every vehicle, a timer only its own")
{
    MasterFleetFixture bench;
    bench.Connect(MakeVehicle(1));
    bench.Connect(MakeVehicle(2));
    bench.SendState(MakeVehicle(1));
    bench.SendState(MakeVehicle(2));
    bench.out.clear();
    const MasterOptions& options = bench.fleet.GetSession(1).GetOptions();
    Core::Now late = bench.GetNow();
    late.steady += options.stateInterval + options.stateMargin;
    bench.fleet.OnTimer(1, EMasterTimer::Silence, late, bench.out);
    CHECK(bench.ListReportingVehicles<VehicleSilent>() == std::vector<std::size_t>{1});
    CHECK(bench.fleet.GetSession(0).IsReady());
    bench.fleet.OnLinkDown(bench.GetNow(), bench.out);
    CHECK(bench.fleet.GetSession(0).GetLink() == EVehicleLink::Unknown);
    CHECK(bench.fleet.GetSession(1).GetLink() == EVehicleLink::Unknown);
}

} // namespace ACS::VDA5050::Test
