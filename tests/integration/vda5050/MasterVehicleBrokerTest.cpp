#include "Catch.hpp"
#include "LinkedMaster.hpp"
#include "LinkedVehicle.hpp"

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using namespace VDA5050; // NOLINT(google-build-using-namespace): nearly every name of the test is one of it
using VDA5050::Test::MakeAction;
using VDA5050::Test::MakeEdges;
using VDA5050::Test::MakeNodes;

/// A master and a vehicle on a real broker.
class BrokerTest
{
protected:
    boost::asio::io_context _context;
    MosquittoBroker _broker;
    QosTable _qos;
    EMqttVersion _mqttVersion = EMqttVersion::Version311;
    EVda5050Version _version = EVda5050Version::Version200;

    [[nodiscard]] MosquittoOptions MakeLinkOptions(const std::string& clientID) const
    {
        MosquittoOptions options = MakeOptions(_broker.GetPort(), clientID);
        options.version = _mqttVersion;
        return options;
    }

    [[nodiscard]] std::unique_ptr<LinkedVehicle> MakeVehicle()
    {
        VehicleOptions options = LinkedVehicle::MakeOptions(_version);
        options.qos = _qos;
        return std::make_unique<LinkedVehicle>(_context, MakeLinkOptions("vehicle"), options);
    }

    [[nodiscard]] std::unique_ptr<LinkedMaster> MakeMaster()
    {
        MasterOptions options;
        options.address = VDA5050::Test::MakeAddress();
        options.version = _version;
        options.qos = _qos;
        options.resendInterval = 200ms;
        return std::make_unique<LinkedMaster>(_context, MakeLinkOptions("master"), options);
    }

    [[nodiscard]] bool WasReached(const std::function<bool()>& isTrue)
    {
        return TryRunUntil(_context, isTrue);
    }

    [[nodiscard]] bool WasReady(const std::unique_ptr<LinkedMaster>& master)
    {
        return WasReached([&]() { return master->session.CanTakeOrder(); });
    }

    /// N0 to N4; an action on N1 and on N3.
    [[nodiscard]] static OrderBuilder MakeRoute()
    {
        std::vector<OrderNode> nodes = MakeNodes(5);
        nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard, "detectObject"));
        nodes[3].actions.push_back(MakeAction("a3", EBlockingType::Soft, "detectObject"));
        return *OrderBuilder::Create("order-1", nodes, MakeEdges(4));
    }

    /// The vehicle has passed N0 and N1 and is held before N2.
    void DriveToFirstAction(
        const std::unique_ptr<LinkedVehicle>& vehicle,
        const std::unique_ptr<LinkedMaster>& master,
        const OrderMessage& order)
    {
        REQUIRE(WasReady(master));
        vehicle->LetReach(2);
        REQUIRE(master->SendOrder(order));
        REQUIRE(WasReached([&]() { return master->ListReached().size() == 2; }));
    }
};

} // namespace

TEST_CASE_METHOD(BrokerTest, "13 Over a broker an order and its update are driven, each node and action once")
{
    _version = GENERATE(EVda5050Version::Version200, EVda5050Version::Version210);
    const auto profile = GENERATE(EQosProfile::Project, EQosProfile::Standard);
    _qos = QosTable(profile);
    _mqttVersion = profile == EQosProfile::Project ? EMqttVersion::Version311 : EMqttVersion::Version5;
    const auto vehicle = MakeVehicle();
    const auto master = MakeMaster();
    vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    REQUIRE(WasReady(master));
    REQUIRE(WasReached([&]() { return master->session.GetFactsheetOrNull() != nullptr; }));

    OrderBuilder route = MakeRoute();
    REQUIRE(master->SendOrder(*route.MakeOrder(2)));
    REQUIRE(WasReached([&]() { return master->ListReached().size() == 2; }));
    REQUIRE(master->SendUpdate(*route.MakeUpdate(5)));
    REQUIRE(WasReached([&]() { return master->Count<OrderFinished>() == 1; }));

    CHECK(master->ListReached() == std::vector<std::uint32_t>{0, 2, 4, 6, 8});
    CHECK(master->Count<OrderAccepted>() == 2);
    CHECK(master->GetStatusOrNull("a1") == EActionStatus::Finished);
    CHECK(master->GetStatusOrNull("a3") == EActionStatus::Finished);
    CHECK(vehicle->CountStarts("a1") == 1);
    CHECK(vehicle->CountStarts("a3") == 1);
    CHECK(vehicle->Count<OrderRefused>() == 0);
    CHECK(master->Count<MessageRefused>() == 0);
}

TEST_CASE_METHOD(BrokerTest, "5.4 Over a broker an order is cancelled on its way, and another one is accepted after it")
{
    const auto vehicle = MakeVehicle();
    const auto master = MakeMaster();
    DriveToFirstAction(vehicle, master, *MakeRoute().MakeOrder(5));
    REQUIRE(master->Do([](auto& session, Core::Now now, auto& out) { return session.Cancel(now, out); }));
    REQUIRE(WasReached([&]() { return master->Count<OrderCancelled>() == 1; }));
    CHECK(vehicle->CountStarts("a3") == 0);
    CHECK(vehicle->Count<OrderCleared>() == 1);
    REQUIRE(WasReached([&]() { return master->GetStatusOrNull("a3") == EActionStatus::Failed; }));

    // From its position: the temporary first node of 5.4.
    vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    std::vector<OrderNode> nodes = MakeNodes(3);
    nodes.erase(nodes.begin());
    OrderBuilder next = *OrderBuilder::Create("order-2", nodes, MakeEdges(1));
    REQUIRE(master->SendOrder(*next.MakeOrder(2)));
    REQUIRE(WasReached([&]() { return master->Count<OrderFinished>() == 1; }));
    CHECK(vehicle->Count<OrderTaken>() == 2);
}

TEST_CASE_METHOD(BrokerTest, "5.3 Over a broker a vehicle is paused and continues")
{
    const auto vehicle = MakeVehicle();
    const auto master = MakeMaster();
    DriveToFirstAction(vehicle, master, *MakeRoute().MakeOrder(5));
    REQUIRE(master->SendAction(MakeAction("pause-1", EBlockingType::None, "startPause")));
    REQUIRE(WasReached([&]() { return master->GetStatusOrNull("pause-1") == EActionStatus::Finished; }));
    CHECK(master->session.GetStateOrNull()->bPaused == true);
    vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    REQUIRE(master->SendAction(MakeAction("status-1", EBlockingType::None, "stateRequest")));
    REQUIRE(WasReached([&]() { return master->GetStatusOrNull("status-1") == EActionStatus::Finished; }));
    CHECK(master->ListReached().size() == 2);
    REQUIRE(master->SendAction(MakeAction("pause-2", EBlockingType::None, "stopPause")));
    REQUIRE(WasReached([&]() { return master->Count<OrderFinished>() == 1; }));
    CHECK(master->GetStatusOrNull("pause-2") == EActionStatus::Finished);
    CHECK(master->ListReached() == std::vector<std::uint32_t>{0, 2, 4, 6, 8});
}

TEST_CASE_METHOD(BrokerTest, "5.7 Over a broker a map is downloaded, enabled and deleted, and the state shows it")
{
    _version = EVda5050Version::Version210;
    const auto vehicle = MakeVehicle();
    const auto master = MakeMaster();
    REQUIRE(WasReady(master));
    const auto getMaps = [&]() {
        return master->session.GetStateOrNull()->maps.value_or(std::vector<MapState>{});
    };
    const auto run = [&](std::string_view type, const std::string& mapVersion, const std::string& id) {
        Action action = MakeAction(id, EBlockingType::None, std::string(type));
        action.actionParameters.push_back({"mapId", Core::JsonText::FromString("hall-2")});
        action.actionParameters.push_back({"mapVersion", Core::JsonText::FromString(mapVersion)});
        if (type == ActionTypes::DOWNLOAD_MAP)
        {
            action.actionParameters.push_back({"mapDownloadLink", Core::JsonText::FromString("https://maps.test/2")});
        }
        REQUIRE(master->SendAction(action));
        REQUIRE(WasReached([&]() { return master->GetStatusOrNull(id) == EActionStatus::Finished; }));
    };
    run(ActionTypes::DOWNLOAD_MAP, "1", "m1");
    REQUIRE(getMaps().size() == 1);
    CHECK(getMaps().front().mapStatus == EMapStatus::Disabled);
    run(ActionTypes::ENABLE_MAP, "1", "m2");
    CHECK(getMaps().front().mapStatus == EMapStatus::Enabled);
    run(ActionTypes::DOWNLOAD_MAP, "2", "m3");
    run(ActionTypes::ENABLE_MAP, "2", "m4");
    run(ActionTypes::DELETE_MAP, "1", "m5"); // which is not in use any more
    REQUIRE(getMaps().size() == 1);
    CHECK(getMaps().front().mapVersion == "2");
    CHECK(vehicle->Count<StartAction>() == 5);
}

TEST_CASE_METHOD(
    BrokerTest,
    "13 After a restart of the broker during an order no node is missed and nothing runs twice")
{
    _qos = QosTable(GENERATE(EQosProfile::Project, EQosProfile::Standard));
    const auto vehicle = MakeVehicle();
    const auto master = MakeMaster();
    OrderBuilder route = MakeRoute();
    DriveToFirstAction(vehicle, master, *route.MakeOrder(4));
    _broker.Kill();
    REQUIRE(WasReached([&]() { return master->session.GetLink() == EVehicleLink::Unknown; }));
    // The update is asked for while there is no broker; the vehicle drives to the end of its base meanwhile.
    REQUIRE(master->SendUpdate(*route.MakeUpdate(5)));
    vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    REQUIRE(WasReached([&]() { return vehicle->GetSession().GetState().lastNodeSequenceID == 6; }));
    CHECK(master->ListReached().size() == 2);
    _broker.Restart();
    REQUIRE(WasReached([&]() { return master->Count<OrderFinished>() == 1; }));
    CHECK(master->ListReached() == std::vector<std::uint32_t>{0, 2, 4, 6, 8});
    CHECK(vehicle->Count<OrderTaken>() == 2);
    CHECK(vehicle->Count<OrderRefused>() == 0);
    CHECK(vehicle->CountStarts("a1") == 1);
    CHECK(vehicle->CountStarts("a3") == 1);
    CHECK(master->Count<OrderLost>() == 0);
    CHECK(master->Count<OrderRejected>() == 0);
}

TEST_CASE_METHOD(
    BrokerTest,
    "6 A killed vehicle is reported by its will, and one that restarts without its order has lost it")
{
    auto vehicle = MakeVehicle();
    const auto master = MakeMaster();
    DriveToFirstAction(vehicle, master, *MakeRoute().MakeOrder(5));
    vehicle.reset();
    REQUIRE(WasReached([&]() { return master->Count<VehicleBroken>() == 1; }));
    CHECK(master->session.GetLink() == EVehicleLink::Broken);
    CHECK(master->session.GetOrderPhase() == EOrderPhase::Active); // it may still be driving
    const auto reborn = MakeVehicle();
    REQUIRE(WasReached([&]() { return master->Count<OrderLost>() == 1; }));
    CHECK(master->session.CanTakeOrder());
    CHECK(reborn->Count<OrderTaken>() == 0); // no earlier message was sent again
}

TEST_CASE_METHOD(BrokerTest, "13 A master that is killed and restarted resumes its order, and nothing is done twice")
{
    const auto vehicle = MakeVehicle();
    auto master = MakeMaster();
    OrderBuilder route = MakeRoute();
    const OrderMessage order = *route.MakeOrder(3);
    DriveToFirstAction(vehicle, master, order);
    const bool bFinishedMeanwhile = GENERATE(false, true);
    master.reset();
    if (bFinishedMeanwhile)
    {
        vehicle->LetReach(LinkedVehicle::EVERYWHERE);
        REQUIRE(WasReached([&]() { return vehicle->GetSession().GetState().lastNodeSequenceID == 4; }));
    }
    master = MakeMaster();
    REQUIRE(WasReached([&]() { return master->session.IsReady(); }));
    REQUIRE(master->ResumeOrder({{order}, {}})); // as it was written down before it was sent
    REQUIRE(WasReached([&]() { return master->Count<OrderAccepted>() == 1; }));
    const OrderMessage update = *route.MakeUpdate(5);
    REQUIRE(master->SendUpdate(update));
    vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    REQUIRE(WasReached([&]() { return master->Count<OrderFinished>() == 1; }));
    CHECK(master->ListReached() == std::vector<std::uint32_t>{0, 2, 4, 6, 8});
    CHECK(vehicle->Count<OrderTaken>() == 2);
    CHECK(vehicle->Count<OrderRefused>() == 0);
    CHECK(vehicle->CountStarts("a1") == 1);
    CHECK(vehicle->CountStarts("a3") == 1);
}

} // namespace ACS::Testing
