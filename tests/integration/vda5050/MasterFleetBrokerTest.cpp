#include "Catch.hpp"
#include "LinkedFleet.hpp"
#include "LinkedVehicle.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <set>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using namespace VDA5050; // NOLINT(google-build-using-namespace): nearly every name of the test is one of it
using VDA5050::Test::MakeAction;
using VDA5050::Test::MakeEdges;
using VDA5050::Test::MakeNodes;

/// A fleet of vehicles and their master on a real broker, and a further client that publishes anything.
class FleetTest
{
protected:
    boost::asio::io_context _context;
    MosquittoBroker _broker;
    std::unique_ptr<LinkedFleet> _fleet;
    std::map<std::string, std::unique_ptr<LinkedVehicle>> _vehicles;
    std::unique_ptr<TestLink> _stranger;

    FleetTest()
    {
        _stranger = std::make_unique<TestLink>(_context, MakeOptions(_broker.GetPort(), "stranger"));
        _stranger->link.Subscribe({{"uagv/#", 1}});
        _stranger->link.Start();
        REQUIRE(WasReached([this]() { return _stranger->listener.ups == 1; }));
    }

    [[nodiscard]] bool WasReached(const std::function<bool()>& isTrue)
    {
        return TryRunUntil(_context, isTrue);
    }

    [[nodiscard]] static VehicleAddress MakeName(const std::string& serialNumber)
    {
        return {"uagv", "ACS", serialNumber};
    }

    void AddVehicle(const std::string& serialNumber, EVda5050Version version)
    {
        VehicleOptions options = LinkedVehicle::MakeOptions(version);
        options.address = MakeName(serialNumber);
        auto vehicle = std::make_unique<LinkedVehicle>(_context, MakeOptions(_broker.GetPort(), serialNumber), options);
        vehicle->LetReach(LinkedVehicle::EVERYWHERE);
        _vehicles[serialNumber] = std::move(vehicle);
    }

    void StartFleet()
    {
        FleetOptions options;
        options.vehicle.resendInterval = 200ms;
        _fleet = std::make_unique<LinkedFleet>(_context, MakeOptions(_broker.GetPort(), "fleet"), options);
    }

    [[nodiscard]] bool IsReady(const std::string& serialNumber) const
    {
        const auto number = _fleet->fleet.FindOrNull(MakeName(serialNumber));
        return number.has_value() && _fleet->fleet.GetSession(*number).CanTakeOrder();
    }

    [[nodiscard]] std::size_t GetNumber(const std::string& serialNumber) const
    {
        const auto number = _fleet->fleet.FindOrNull(MakeName(serialNumber));
        REQUIRE(number.has_value());
        return *number;
    }

    /// When this returns the broker has retained the message.
    void Retain(const std::string& topic, const std::string& payload)
    {
        const std::size_t before = _stranger->listener.CountTopic(topic);
        REQUIRE(_stranger->link.Publish({topic, payload, 1, true}).has_value());
        REQUIRE(WasReached([&]() { return _stranger->listener.CountTopic(topic) > before; }));
    }

    void Publish(ETopic topic, const std::string& payload)
    {
        REQUIRE(_stranger->link.Publish({BuildTopic(MakeName("LR1"), topic), payload, 1, false}).has_value());
    }

    [[nodiscard]] static std::string MakeConnection(const std::string& version, const std::string& serialNumber)
    {
        return R"({"headerId":1,"timestamp":"2026-01-01T00:00:00.00Z","version":")" + version
            + R"(","manufacturer":"ACS","serialNumber":")" + serialNumber + R"(","connectionState":"ONLINE"})";
    }

    [[nodiscard]] static OrderMessage MakeOrder(const std::string& actionID)
    {
        std::vector<OrderNode> nodes = MakeNodes(3);
        nodes[2].actions.push_back(MakeAction(actionID, EBlockingType::Hard, "detectObject"));
        return *OrderBuilder::Create("order-of-" + actionID, nodes, MakeEdges(2))->MakeOrder(3);
    }

    /// Sends the vehicle an order and waits for its end.
    void Drive(const std::set<std::string>& serialNumbers)
    {
        for (const std::string& serialNumber : serialNumbers)
        {
            REQUIRE(WasReached([&]() { return IsReady(serialNumber); }));
            REQUIRE(_fleet->SendOrder(GetNumber(serialNumber), MakeOrder("a-" + serialNumber)));
        }
        for (const std::string& serialNumber : serialNumbers)
        {
            CAPTURE(serialNumber);
            REQUIRE(WasReached([&]() { return _fleet->Count<OrderFinished>(GetNumber(serialNumber)) == 1; }));
            CHECK(_vehicles.at(serialNumber)->CountStarts("a-" + serialNumber) == 1);
            CHECK(_vehicles.at(serialNumber)->Count<OrderTaken>() == 1);
            CHECK(_vehicles.at(serialNumber)->Count<OrderRefused>() == 0);
        }
    }
};

} // namespace

TEST_CASE_METHOD(
    FleetTest,
    "6 Over a broker a fleet is discovered, one vehicle is lost, one comes later, and each drives its order")
{
    AddVehicle("LR1", EVda5050Version::Version200);
    AddVehicle("LR2", EVda5050Version::Version210);
    AddVehicle("LR3", EVda5050Version::Version200);
    const auto isPublished = [this](const std::string& serialNumber) {
        return _stranger->listener.Contains(BuildTopic(MakeName(serialNumber), ETopic::Connection), "ONLINE");
    };
    REQUIRE(WasReached([&]() { return isPublished("LR1") && isPublished("LR2") && isPublished("LR3"); }));
    Retain("uagv/v2/ACS/LR7/connection", MakeConnection("9.1.0", "LR7"));
    Retain("uagv/v2/OTHER/LR8/connection", MakeConnection("2.0.0", "LR8")); // its header has the manufacturer ACS
    Retain("uagv/v2/ACS/LR9/connection", "ONLINE");
    StartFleet();
    REQUIRE(WasReached([this]() { return IsReady("LR1") && IsReady("LR2") && IsReady("LR3"); }));
    REQUIRE(WasReached([this]() { return _fleet->fleet.GetLeftOutCount() == 3; }));
    CHECK(_fleet->fleet.GetSize() == 3);
    CHECK(_fleet->fleet.GetSession(GetNumber("LR1")).GetOptions().version == EVda5050Version::Version200);
    CHECK(_fleet->fleet.GetSession(GetNumber("LR2")).GetOptions().version == EVda5050Version::Version210);

    _vehicles.erase("LR3");
    REQUIRE(WasReached([this]() { return _fleet->Count<VehicleBroken>(GetNumber("LR3")) == 1; }));
    CHECK(IsReady("LR1"));
    AddVehicle("LR4", EVda5050Version::Version210);
    Drive({"LR1", "LR2", "LR4"});
    CHECK_FALSE(_fleet->SendOrder(GetNumber("LR3"), MakeOrder("a-LR3")).has_value());
    CHECK(_fleet->fleet.GetSize() == 4);
    CHECK(_fleet->Count<VehicleBroken>(GetNumber("LR1")) == 0);
    CHECK(_fleet->fleet.GetStatistics().messagesRefused == 0);
}

TEST_CASE_METHOD(FleetTest, "6 After a restart of the broker each vehicle of a fleet is found again and drives")
{
    AddVehicle("LR1", EVda5050Version::Version200);
    AddVehicle("LR2", EVda5050Version::Version210);
    StartFleet();
    REQUIRE(WasReached([this]() { return IsReady("LR1") && IsReady("LR2"); }));
    _broker.Kill();
    REQUIRE(WasReached([this]() { return !IsReady("LR1") && !IsReady("LR2"); }));
    _broker.Restart();
    Drive({"LR1", "LR2"});
    CHECK(_fleet->fleet.GetSize() == 2);
    CHECK(_fleet->Count<VehicleBroken>(GetNumber("LR1")) == 0);
}

TEST_CASE_METHOD(FleetTest, "13 Over a broker each bad message is counted and reported, and its vehicle still drives")
{
    AddVehicle("LR1", EVda5050Version::Version200);
    StartFleet();
    REQUIRE(WasReached([this]() { return IsReady("LR1"); }));
    const std::string good = MakeConnection("2.0.0", "LR1");
    const auto with = [&good](const std::string& part, const std::string& other) {
        const std::size_t begin = good.find(part);
        REQUIRE(begin != std::string::npos);
        return std::string(good).replace(begin, part.size(), other);
    };
    const std::string withoutID = with(R"("headerId":1)", R"("headerId":null)");
    const std::vector<std::string> bad{
        "",
        "ONLINE",
        "null",
        "[]",
        "{}",
        good.substr(0, good.size() - 1),
        good + "}",
        std::string("\xFF\xFE\0", 3),
        std::string(100'000, '['),
        with(R"("headerId":1)", R"("headerId":-1)"),
        with(R"("headerId":1)", R"("headerId":4294967296)"),
        with(R"("headerId":1)", R"("headerId":1e300)"),
        with(R"("headerId":1)", R"("headerId":NaN)"),
        with(R"("headerId":1)", R"("headerId":"1")"),
        withoutID,
        with(R"("2.0.0")", R"("9.0.0")"),
        with(R"("2.0.0")", "2.0"),
        with(R"("ACS")", R"("OTHER")"),
        with(R"("LR1")", R"("LR/1")"),
        with(R"("LR1")", R"({"serial":"LR1"})")};
    std::size_t refused = 0;
    for (const ETopic topic : {ETopic::State, ETopic::Connection, ETopic::Visualization, ETopic::Factsheet})
    {
        for (const std::string& payload : bad)
        {
            Publish(topic, payload);
            // 3.5: the schemas of visualization demand no member, not even the header's.
            const bool bEnough = topic == ETopic::Visualization && (payload == "{}" || payload == withoutID);
            refused += bEnough ? 0U : 1U;
        }
    }
    Publish(ETopic::State, good); // a valid message of another topic
    Publish(ETopic::Connection, with(R"("ONLINE")", R"("ASLEEP")"));
    Publish(ETopic::Connection, with(R"("ONLINE")", "null"));
    refused += 3;
    REQUIRE(WasReached([&]() { return _fleet->fleet.GetStatistics().messagesRefused >= refused; }));
    CHECK(_fleet->fleet.GetStatistics().messagesRefused == refused);
    CHECK(_fleet->Count<MessageRefused>(GetNumber("LR1")) == refused);
    CHECK(IsReady("LR1"));
    Drive({"LR1"});
}

TEST_CASE_METHOD(FleetTest, "12 (20) Retained messages on order topics are ignored by vehicles and disturb no master")
{
    OrderMessage old = MakeOrder("ghost");
    old.header.version = "2.0.0";
    Retain("uagv/v2/ACS/LR1/order", Vda5050Codec().Encode(old, EVda5050Version::Version200));
    Retain("uagv/v2/ACS/LR2/order", "garbage");
    Retain("uagv/v2/ACS/LR1/instantActions", R"({"actions":[{"actionType":"cancelOrder"}]})");
    Retain("uagv/v2/ACS/LR1/state", "garbage");
    AddVehicle("LR1", EVda5050Version::Version200);
    AddVehicle("LR2", EVda5050Version::Version210);
    StartFleet();
    Drive({"LR1", "LR2"});
    CHECK(_vehicles.at("LR1")->CountStarts("ghost") == 0);
    CHECK(_fleet->fleet.GetStatistics().messagesRefused == 0);
}

} // namespace ACS::Testing
