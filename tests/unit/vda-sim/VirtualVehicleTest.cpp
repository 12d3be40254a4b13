#include "Catch.hpp"
#include "VehicleDriver.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EActionStatus;
using VDA5050::ETopic;

constexpr double TOLERANCE = 1e-9;
constexpr double NORTH = std::numbers::pi / 2;

VDA5050::OrderBuilder AddAction(
    VehicleDriver& driver,
    const std::vector<std::string>& route,
    std::size_t nodeIndex,
    std::string_view actionType)
{
    const VDA5050::OrderBuilder plain = driver.MakeRoute("plain", route);
    std::vector<VDA5050::OrderNode> nodes = plain.GetNodes();
    VDA5050::Action action;
    action.actionType = std::string(actionType);
    action.actionID = "work";
    action.blockingType = VDA5050::EBlockingType::Hard;
    action.actionParameters.push_back({"loadId", Core::JsonText::FromString("CASSETTE-1")});
    action.actionParameters.push_back({"lhd", Core::JsonText::FromString("CP01")});
    AddMandatoryParameters(action);
    nodes[nodeIndex].actions.push_back(action);
    const VDA5050::OrderMessage whole = VehicleDriver::Take(driver.MakeRoute("plain", route).MakeOrder(route.size()));
    return VehicleDriver::Take(
        VDA5050::OrderBuilder::Create("with-" + std::string(actionType), std::move(nodes), whole.edges));
}

} // namespace

TEST_CASE("A vehicle that starts between two nodes continues from there")
{
    VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("N0");
    options.startPosition = VdaSim::StartPosition{4.0, 0.0};
    VehicleDriver driver(std::move(options));
    CHECK(driver.GetState().lastNodeID == "N0");
    CHECK(driver.GetState().agvPosition->x == 4.0);
    std::vector<VDA5050::OrderNode> nodes = driver.MakeRoute("order-1", {"N0", "N1"}).GetNodes();
    nodes.front().nodePosition->allowedDeviationXY = 4.1;
    const std::vector<VDA5050::OrderEdge> edges =
        VehicleDriver::Take(driver.MakeRoute("order-1", {"N0", "N1"}).MakeOrder(2)).edges;
    driver.Send(
        VehicleDriver::Take(VehicleDriver::Take(VDA5050::OrderBuilder::Create("order-1", nodes, edges)).MakeOrder(2)));
    double nearest = 4.0;
    driver.Pass(60s, [&]() { nearest = std::min(nearest, driver.GetPose().x); });
    CHECK(nearest == 4.0);
    CHECK(driver.GetState().lastNodeID == "N1");
}

TEST_CASE("6.6 A vehicle drives to the end of its base and never beyond, however long nothing follows")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    CHECK(driver.GetState().bDriving);
    double farthest = 0.0;
    driver.Pass(60s, [&]() {
        farthest = std::max(farthest, driver.GetPose().x);
        CHECK(driver.GetPose().y == 0.0);
    });
    CHECK(farthest == Approx(10.0).margin(TOLERANCE));
    const VDA5050::StateMessage state = driver.GetState();
    CHECK(state.lastNodeID == "N1");
    CHECK(state.lastNodeSequenceID == 2);
    CHECK_FALSE(state.bDriving);
    CHECK(driver.GetSpeed() == 0.0);
    CHECK(state.bNewBaseRequest == true);
    REQUIRE(state.nodeStates.size() == 1);
    CHECK(state.nodeStates[0].nodeID == "N2");
    CHECK_FALSE(state.nodeStates[0].bReleased);
}

TEST_CASE("6.6 An update that comes after the vehicle has stopped sends it on, and the order ends")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    driver.Pass(60s);
    driver.Send(VehicleDriver::Take(route.MakeUpdate(3)));
    driver.Pass(30s);
    const VDA5050::StateMessage state = driver.GetState();
    CHECK(state.orderUpdateID == 1);
    CHECK(state.lastNodeID == "N2");
    CHECK(state.nodeStates.empty());
    CHECK(state.edgeStates.empty());
    CHECK_FALSE(state.bDriving);
    CHECK(driver.GetPose().x == Approx(10.0).margin(TOLERANCE));
    CHECK(driver.GetPose().y == Approx(5.0).margin(TOLERANCE));
    CHECK(driver.GetPose().theta == Approx(NORTH).margin(TOLERANCE));
}

TEST_CASE("6.6 An update that comes in time is driven through without a stop, slowly round the corner")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    driver.Pass(3s);
    driver.Send(VehicleDriver::Take(route.MakeUpdate(3)));
    double speedAtNode = 9.0;
    double slowest = 9.0;
    driver.Pass(60s, [&]() {
        const VDA5050::StateMessage state = driver.GetState();
        if (state.bDriving && !state.nodeStates.empty() && driver.GetPose().y < 4.0)
        {
            slowest = std::min(slowest, driver.GetSpeed());
        }
        if (std::abs(driver.GetPose().x - 10.0) < 0.01 && driver.GetPose().y < 0.01)
        {
            speedAtNode = driver.GetSpeed();
        }
    });
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK(slowest > 0.2);
    CHECK(speedAtNode < 0.45);
}

TEST_CASE("6.6 The speed at a node is limited by the next edge and by the braking distance on it")
{
    VehicleDriver driver("N0");
    const auto getSpeedAtNode = [&driver](const std::string& orderID, double secondSpeed, double secondNodeX) {
        auto route = driver.MakeRoute(orderID, {"N0", "N1", "N2"});
        auto order = VehicleDriver::Take(route.MakeOrder(3));
        order.edges[1].maxSpeed = secondSpeed;
        order.nodes[2].nodePosition->x = secondNodeX;
        order.nodes[2].nodePosition->y = 0.0;
        driver.Send(std::move(order));
        REQUIRE(driver.TryPassUntil([&]() { return driver.GetState().lastNodeID == "N1"; }, 60s));
        const double speed = driver.GetSpeed();
        driver.Pass(120s);
        CHECK(driver.GetState().lastNodeID == "N2");
        driver.SendPositionAtN0(orderID + "-back", 0.0, 0.0);
        driver.Pass(2s);
        return speed;
    };
    CHECK(getSpeedAtNode("as-fast", 1.2, 20.0) == Approx(1.2).margin(0.02));
    CHECK(getSpeedAtNode("slow", 0.3, 20.0) == Approx(0.3).margin(0.02));
    // 0.3 m with 0.6 m/s²: 0.6 m/s.
    CHECK(getSpeedAtNode("short", 1.2, 10.3) == Approx(0.6).margin(0.02));
}

TEST_CASE("A vehicle keeps to the speed of the edge and to its own acceleration")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-1", {"N0", "N1"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    const double acceleration = VdaSim::MotionLimits{}.acceleration;
    double fastest = 0.0;
    double lastSpeed = 0.0;
    Core::SteadyTime lastTime = driver.GetTime();
    const Core::SteadyTime start = lastTime;
    Core::SteadyTime end = start;
    driver.Pass(30s, [&]() {
        const double seconds = std::chrono::duration<double>(driver.GetTime() - lastTime).count();
        CHECK(std::abs(driver.GetSpeed() - lastSpeed) <= acceleration * (seconds + 0.041));
        fastest = std::max(fastest, driver.GetSpeed());
        lastSpeed = driver.GetSpeed();
        lastTime = driver.GetTime();
        end = driver.GetState().bDriving ? lastTime : end;
    });
    CHECK(fastest == Approx(1.2));
    // 10 m: 2 s to 1.2 m/s (1.2 m), 2 s to a stop, 7.6 m at 1.2 m/s.
    CHECK(std::chrono::duration<double>(end - start).count() == Approx(10.33).margin(0.3));
}

TEST_CASE("7 Where an edge allows no rotation, the vehicle turns on the node before it enters")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2", "DOCK"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(4)));
    REQUIRE(driver.TryPassUntil([&]() { return driver.GetState().lastNodeID == "N2"; }, 60s));
    CHECK(driver.GetPose().theta == Approx(NORTH).margin(0.1));
    bool bTurnedStanding = false;
    driver.Pass(30s, [&]() {
        const VdaSim::Pose& pose = driver.GetPose();
        bTurnedStanding = bTurnedStanding || (pose.x == 10.0 && pose.theta > 0.5 && pose.theta < 1.0);
        if (pose.x > 10.0 + TOLERANCE)
        {
            CHECK(pose.theta == Approx(0.0).margin(TOLERANCE));
        }
    });
    CHECK(bTurnedStanding);
    CHECK(driver.GetState().lastNodeID == "DOCK");
}

TEST_CASE("7 An orientation of pi on a tangential edge is driven backwards")
{
    VehicleDriver driver("DOCK");
    CHECK(driver.GetPose() == VdaSim::Pose{11.0, 5.0, 0.0});
    auto route = driver.MakeRoute("order-1", {"DOCK", "N2"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    driver.Pass(1s);
    CHECK(driver.GetState().velocity->vx.value_or(0.0) < -0.3);
    driver.Pass(20s);
    CHECK(driver.GetPose().x == Approx(10.0).margin(TOLERANCE));
    CHECK(driver.GetPose().theta == Approx(0.0).margin(TOLERANCE));
}

TEST_CASE("6.8 A pick runs at its node, standing, for its time; the load is in the state then, and gone after a drop")
{
    VehicleDriver driver("N0");
    auto pick = AddAction(driver, {"N0", "N1", "N2"}, 1, VDA5050::ActionTypes::PICK);
    driver.Send(VehicleDriver::Take(pick.MakeOrder(3)));
    CHECK(driver.GetStatus("work") == EActionStatus::Waiting);
    REQUIRE(driver.TryPassUntil([&]() { return driver.GetStatus("work") == EActionStatus::Running; }, 60s));
    CHECK(driver.GetPose().x == Approx(10.0).margin(TOLERANCE));
    CHECK(driver.GetState().lastNodeID == "N1");
    CHECK_FALSE(driver.GetState().bDriving);
    driver.Pass(2900ms);
    CHECK(driver.GetStatus("work") == EActionStatus::Running);
    CHECK(driver.GetPose().y == 0.0);
    CHECK(driver.GetState().loads->empty());
    driver.Pass(200ms);
    CHECK(driver.GetStatus("work") == EActionStatus::Finished);
    const VDA5050::StateMessage loaded = driver.GetState();
    REQUIRE(loaded.loads->size() == 1);
    CHECK(loaded.loads->front().loadID == "CASSETTE-1");
    CHECK(loaded.loads->front().loadPosition == "CP01");
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");

    auto drop = AddAction(driver, {"N2", "DOCK"}, 1, VDA5050::ActionTypes::DROP);
    driver.Send(VehicleDriver::Take(drop.MakeOrder(2)));
    driver.Pass(60s);
    CHECK(driver.GetStatus("work") == EActionStatus::Finished);
    CHECK(driver.GetState().loads->empty());
}

TEST_CASE("6.8 A drop without a load fails, and the order continues")
{
    VehicleDriver driver("N0");
    auto drop = AddAction(driver, {"N0", "N1", "N2"}, 1, VDA5050::ActionTypes::DROP);
    driver.Send(VehicleDriver::Take(drop.MakeOrder(3)));
    driver.Pass(60s);
    CHECK(driver.GetStatus("work") == EActionStatus::Failed);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("6.6 An action that the factsheet does not name refuses the order")
{
    VehicleDriver driver("N0");
    auto dance = AddAction(driver, {"N0", "N1"}, 1, "dance");
    driver.Send(VehicleDriver::Take(dance.MakeOrder(2)));
    driver.Pass(10s);
    CHECK(driver.GetPose().x == 0.0);
    REQUIRE(driver.GetState().errors.size() == 1);
    CHECK(driver.GetState().errors[0].errorType == VDA5050::ErrorTypes::ORDER_ERROR);
}

TEST_CASE("An order that deviates from the standard is accepted, with a warning that counts the deviations")
{
    static constexpr std::string_view WARNING = "a message deviates from the standard and is accepted";
    VehicleDriver driver("N0");
    driver.SendRoute();
    CHECK_FALSE(driver.GetLog().Contains(Core::ELogLevel::Warning, WARNING));
    driver.Pass(60s);
    auto route = driver.MakeRoute("order-2", {"N2", "DOCK"});
    auto order = VehicleDriver::Take(route.MakeOrder(2));
    order.header = {7, {}, "2.0.0", "ACS", "LR01"};
    order.nodes[1].actions.emplace_back();
    order.nodes[1].actions[0].actionType = "detectObject";
    order.nodes[1].actions[0].actionID = "detect";
    order.nodes[1].actions[0].blockingType = VDA5050::EBlockingType::Hard;
    std::string payload = VDA5050::Vda5050Codec().Encode(order, VDA5050::EVda5050Version::Version200);
    for (const auto& [from, to] : {std::pair("\"HARD\"", "\"hard\""), std::pair("\"maxSpeed\"", "\"maxspeed\"")})
    {
        const std::size_t place = payload.find(from);
        REQUIRE(place != std::string::npos);
        payload.replace(place, std::string_view(from).size(), to);
    }
    driver.SendRaw(payload);
    CHECK(driver.GetState().orderID == "order-2");
    CHECK(std::ranges::any_of(driver.GetLog().GetLines(), [](const RecordedLine& line) {
        return line.level == Core::ELogLevel::Warning && line.message == WARNING && line.HasField("topic", "order")
            && line.HasField("unknownMembers", "1") && line.HasField("nullMembers", "0")
            && line.HasField("enumsInWrongCase", "1");
    }));
}

TEST_CASE("6.6.3 A cancelled vehicle ends on the next node, and is ready for another order")
{
    VehicleDriver driver("N0");
    auto route = AddAction(driver, {"N0", "N1", "N2"}, 2, VDA5050::ActionTypes::PICK);
    driver.Send(VehicleDriver::Take(route.MakeOrder(3)));
    driver.Pass(4s);
    driver.SendInstantly(VDA5050::ActionTypes::CANCEL_ORDER, "cancel");
    CHECK(driver.GetStatus("cancel") == EActionStatus::Running);
    CHECK(driver.GetStatus("work") == EActionStatus::Failed);
    driver.Pass(60s);
    const VDA5050::StateMessage state = driver.GetState();
    CHECK(driver.GetStatus("cancel") == EActionStatus::Finished);
    CHECK(state.lastNodeID == "N1");
    CHECK(state.nodeStates.empty());
    CHECK_FALSE(state.bDriving);
    CHECK(driver.GetPose().x == Approx(10.0).margin(TOLERANCE));
    auto next = driver.MakeRoute("order-2", {"N1", "N2"});
    driver.Send(VehicleDriver::Take(next.MakeOrder(2)));
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("6.8 A pause stops the vehicle smoothly on its path, and stopPause lets it continue")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-1", {"N0", "N1"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    driver.Pass(4s);
    const double before = driver.GetPose().x;
    driver.SendInstantly(VDA5050::ActionTypes::START_PAUSE, "pause");
    driver.Pass(30s);
    CHECK(driver.GetStatus("pause") == EActionStatus::Finished);
    CHECK(driver.GetState().bPaused == true);
    CHECK_FALSE(driver.GetState().bDriving);
    CHECK(driver.GetPose().x - before == Approx(1.2).margin(0.1)); // 1.2 m/s at 0.6 m/s²
    driver.SendInstantly(VDA5050::ActionTypes::STOP_PAUSE, "go");
    driver.Pass(30s);
    CHECK(driver.GetState().lastNodeID == "N1");
}

TEST_CASE("Charging needs a charger, and driving drains the battery and ends the charging")
{
    VehicleDriver driver("N0");
    driver.SendInstantly(VDA5050::ActionTypes::START_CHARGING, "nowhere");
    CHECK(driver.GetStatus("nowhere") == EActionStatus::Failed);
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2", "DOCK"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(4)));
    driver.Pass(90s);
    REQUIRE(driver.GetState().lastNodeID == "DOCK");
    const double drained = driver.GetState().batteryState.batteryCharge;
    CHECK(drained == Approx(100.0 - 16.0 * 0.02).margin(0.001));
    driver.SendInstantly(VDA5050::ActionTypes::START_CHARGING, "here");
    driver.Pass(30s);
    CHECK(driver.GetStatus("here") == EActionStatus::Finished);
    CHECK(driver.GetState().batteryState.bCharging);
    CHECK(driver.GetState().batteryState.batteryCharge == Approx(100.0));
    auto back = driver.MakeRoute("order-2", {"DOCK", "N2"});
    driver.Send(VehicleDriver::Take(back.MakeOrder(2)));
    CHECK_FALSE(driver.GetState().batteryState.bCharging);
}

TEST_CASE("A vehicle that stops beside its charger's node is not at the charger")
{
    VehicleDriver driver("DOCK");
    auto route = driver.MakeRoute("order-1", {"DOCK", "N2"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    driver.Pass(2s);
    driver.Inject("mode for=1s");
    driver.Pass(5s);
    REQUIRE(driver.GetState().lastNodeID == "DOCK");
    driver.SendInstantly(VDA5050::ActionTypes::START_CHARGING, "charge");
    driver.Pass(1s);
    CHECK(driver.GetStatus("charge") == EActionStatus::Failed);
}

TEST_CASE("startCharging fails when the vehicle leaves the charger before it has ended")
{
    VehicleDriver driver("DOCK");
    driver.SendInstantly(VDA5050::ActionTypes::START_CHARGING, "charge");
    driver.Pass(500ms);
    REQUIRE(driver.GetStatus("charge") == EActionStatus::Running);
    auto route = driver.MakeRoute("order-1", {"DOCK", "N2"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    bool bCharged = false;
    driver.Pass(20s, [&]() { bCharged = bCharged || driver.GetState().batteryState.bCharging; });
    CHECK_FALSE(bCharged);
    CHECK(driver.GetStatus("charge") == EActionStatus::Failed);
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK_FALSE(driver.GetState().batteryState.bCharging);
}

TEST_CASE("6.10 A driving vehicle sends a state at least each second, and its position each 200 ms")
{
    for (const double timeScale : {0.1, 1.0})
    {
        VehicleDriver driver("N0", timeScale);
        auto route = driver.MakeRoute("order-1", {"N0", "N1"});
        driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
        driver.Pass(8s);
        REQUIRE(driver.GetState().bDriving);
        for (const auto& [topic, longest] : {std::pair{ETopic::State, 1000ms}, {ETopic::Visualization, 200ms}})
        {
            const std::vector<Core::SteadyTime> times = driver.GetTimes(topic);
            REQUIRE(times.size() >= 8);
            CHECK(driver.GetTime() - times.back() <= longest);
            for (std::size_t i = 1; i < times.size(); ++i)
            {
                CHECK(times[i] - times[i - 1] <= longest);
            }
        }
    }
}

TEST_CASE("The time scale makes driving and handling quicker, and changes no speed in the messages")
{
    VehicleDriver driver("N0", 10.0);
    auto pick = AddAction(driver, {"N0", "N1"}, 1, VDA5050::ActionTypes::PICK);
    driver.Send(VehicleDriver::Take(pick.MakeOrder(2)));
    double fastest = 0.0;
    driver.Pass(1100ms, [&]() { fastest = std::max(fastest, driver.GetSpeed()); });
    CHECK(driver.GetState().lastNodeID == "N1");
    CHECK(fastest == Approx(1.2));
    CHECK(driver.GetStatus("work") == EActionStatus::Running);
    driver.Pass(350ms);
    CHECK(driver.GetStatus("work") == EActionStatus::Finished);
}

TEST_CASE("6.14 A vehicle that leaves publishes OFFLINE as the last message, retained, with QoS 1")
{
    VehicleDriver driver("N0");
    driver.Leave();
    const VDA5050::MqttMessage& last = driver.GetLast();
    CHECK(last.topic == "uagv/v2/ACS/LR01/connection");
    CHECK(last.bRetained);
    CHECK(last.qos == 1);
    CHECK_THAT(last.payload, Catch::Contains("\"OFFLINE\""));
}

TEST_CASE("A stationary vehicle with nothing to do requests no tick")
{
    VehicleDriver driver("N0");
    driver.Pass(10s);
    const std::size_t before = driver.GetTimes(ETopic::State).size();
    driver.Pass(25s);
    CHECK(driver.GetTimes(ETopic::State).size() - before == 1);
    CHECK(driver.GetPose() == VdaSim::Pose{0.0, 0.0, 0.0});
}

TEST_CASE("7 A vehicle drives along the trajectory of its edge")
{
    VehicleDriver driver("N0");
    VDA5050::OrderMessage order = VehicleDriver::Take(driver.MakeRoute("curve", {"N0", "N1"}).MakeOrder(2));
    VDA5050::Trajectory curve;
    curve.degree = 2;
    curve.knotVector = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
    curve.controlPoints = {{0.0, 0.0, {}}, {5.0, 6.0, {}}, {10.0, 0.0, {}}};
    order.edges[0].trajectory = curve;
    driver.Send(order);
    CHECK(driver.GetState().edgeStates.front().trajectory == curve);
    double highest = 0.0;
    driver.Pass(60s, [&]() { highest = std::max(highest, driver.GetPose().y); });
    CHECK(highest == Approx(3.0).margin(0.01));
    CHECK(driver.GetState().lastNodeID == "N1");
    CHECK(driver.GetPose().x == 10.0);
    CHECK(driver.GetPose().y == 0.0);
}

} // namespace ACS::Testing
