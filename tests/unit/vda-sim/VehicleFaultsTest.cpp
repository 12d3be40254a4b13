#include "Catch.hpp"
#include "VehicleDriver.hpp"
#include <acs/core/ShortText.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EActionStatus;
using VDA5050::EErrorLevel;
using VDA5050::EOperatingMode;
using VdaSim::EFaultKind;

const VDA5050::VehicleError* FindErrorOrNull(const VDA5050::StateMessage& state, std::string_view type)
{
    const auto found = std::ranges::find(state.errors, type, &VDA5050::VehicleError::errorType);
    return found != state.errors.end() ? &*found : nullptr;
}

} // namespace

TEST_CASE("refuse: an order for another vehicle or a retained one does not use up the fault")
{
    VehicleDriver driver("N0");
    driver.Inject("refuse");
    auto route = driver.MakeRoute("order-1", {"N0", "N1"});
    const VDA5050::OrderMessage order = VehicleDriver::Take(route.MakeOrder(2));
    driver.SendToOther(order);
    driver.SendRetained(order);
    driver.Pass(1s);
    CHECK(driver.GetState().errors.empty());
    driver.Send(order);
    driver.Pass(1s);
    CHECK(FindErrorOrNull(driver.GetState(), VDA5050::ErrorTypes::ORDER_ERROR) != nullptr);
    CHECK(driver.GetState().orderID.empty());
}

TEST_CASE("A vehicle takes a thousand faults, those to come among them, and no more until some have ended")
{
    VehicleDriver driver("N0");
    for (std::size_t i = 0; i < VdaSim::FaultBoard::MAX_FAULTS; ++i)
    {
        driver.Inject("stuck at=1h");
    }
    CHECK_FALSE(driver.TryInject("lost"));
    CHECK(driver.GetState().agvPosition->bPositionInitialized);
    CHECK(driver.EndFaults(EFaultKind::Stuck) == VdaSim::FaultBoard::MAX_FAULTS);
    CHECK(driver.TryInject("lost"));
}

TEST_CASE("Of many bad messages the first ones are logged, each in a short line")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-" + std::string(900, 'x'), {"N1", "N2"});
    const VDA5050::OrderMessage order = VehicleDriver::Take(route.MakeOrder(2));
    for (int i = 0; i < 100; ++i)
    {
        driver.Send(order); // N1 is not where the vehicle is
        driver.SendRaw("{" + std::string(900, '"'));
    }
    driver.Inject("delay time=1h direction=in");
    for (int i = 0; i < 40; ++i)
    {
        driver.SendRaw(std::string(1'000'000, ' '));
    }
    const auto count = [&driver](std::string_view message) {
        return std::ranges::count(driver.GetLog().GetLines(), message, &RecordedLine::message);
    };
    CHECK(count("order refused") == Apps::LogRateLimiter::BURST);
    CHECK(count("too many delayed messages: further ones are lost") == Apps::LogRateLimiter::BURST);
    for (const RecordedLine& line : driver.GetLog().GetLines())
    {
        for (const auto& [key, value] : line.fields)
        {
            CAPTURE(line.message, key);
            CHECK(value.size() <= Core::MOST_SHOWN + 3);
        }
    }
}

TEST_CASE("stuck: the vehicle stops at once without an error and continues when the fault ends")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(4s);
    const double place = driver.GetPose().x;
    driver.Inject("stuck");
    CHECK(driver.GetPose().x == place);
    CHECK_FALSE(driver.GetState().bDriving);
    CHECK(driver.GetState().errors.empty());
    driver.Pass(60s);
    CHECK(driver.GetPose().x == place);
    CHECK(driver.EndFaults(EFaultKind::Stuck) == 1);
    CHECK(driver.GetState().bDriving);
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("stuck error=: the vehicle reports the error; an order that comes meanwhile is accepted and waits")
{
    VehicleDriver driver("N0");
    driver.Inject("stuck error=driveFault level=FATAL");
    driver.SendRoute();
    driver.Pass(10s);
    const VDA5050::StateMessage state = driver.GetState();
    REQUIRE(FindErrorOrNull(state, "driveFault") != nullptr);
    CHECK(FindErrorOrNull(state, "driveFault")->errorLevel == EErrorLevel::Fatal);
    CHECK(state.orderID == "order-1");
    CHECK_FALSE(state.bDriving);
    CHECK(driver.GetPose().x == 0.0);
    driver.EndFaults();
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK(driver.GetState().errors.empty());
}

TEST_CASE("blocked: the vehicle brakes, reports fieldViolation, and continues when the fault ends")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(4s);
    const double place = driver.GetPose().x;
    driver.Inject("blocked for=10s");
    CHECK(driver.GetState().safetyState.bFieldViolation);
    driver.Pass(9s);
    CHECK(driver.GetPose().x - place == Approx(1.2).margin(0.1));
    const VDA5050::StateMessage state = driver.GetState();
    CHECK_FALSE(state.bDriving);
    REQUIRE(FindErrorOrNull(state, "blockedByObstacle") != nullptr);
    CHECK(*VDA5050::FindReferenceOrNull(*FindErrorOrNull(state, "blockedByObstacle"), "edgeId") == "N0-N1");
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK_FALSE(driver.GetState().safetyState.bFieldViolation);
    CHECK(driver.GetState().errors.empty());
}

TEST_CASE("6.10.4 blocked swerve=: the obstacle is passed within a corridor that is wide enough, on its side, else not")
{
    struct Row
    {
        std::optional<VDA5050::Corridor> corridor;
        double side;
    };
    using VDA5050::Corridor;
    const auto contour = VDA5050::ECorridorReferencePoint::Contour;
    for (const auto& [corridor, side] : std::vector<Row>{
             {std::nullopt, 0.0},
             {Corridor{0.4, 0.4, {}}, 0.0},
             {Corridor{0.6, 2.0, {}}, 0.5},
             {Corridor{0.4, 0.6, {}}, -0.5},
             {Corridor{0.6, 0.6, contour}, 0.0},
             {Corridor{0.0, 0.9, contour}, -0.5}})
    {
        VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("N0");
        options.version = VDA5050::EVda5050Version::Version210;
        VehicleDriver driver(std::move(options));
        VDA5050::OrderMessage order = VehicleDriver::Take(driver.MakeRoute("o", {"N0", "N1"}).MakeOrder(2));
        order.edges[0].corridor = corridor;
        driver.Inject("blocked swerve=0.5");
        driver.Send(order, VDA5050::EVda5050Version::Version210);
        double left = 0.0;
        double right = 0.0;
        driver.Pass(60s, [&]() {
            left = std::max(left, driver.GetPose().y);
            right = std::min(right, driver.GetPose().y);
        });
        CHECK(left + right == Approx(side).margin(0.001));
        CHECK((driver.GetState().lastNodeID == "N1") == (side != 0.0));
        CHECK(driver.GetState().safetyState.bFieldViolation == (side == 0.0));
    }
}

TEST_CASE("lost: the vehicle is not localized and refuses orders until initPosition")
{
    VehicleDriver driver("N0");
    driver.Inject("lost");
    const VDA5050::StateMessage lost = driver.GetState();
    CHECK_FALSE(lost.agvPosition->bPositionInitialized);
    CHECK(FindErrorOrNull(lost, "localizationError") != nullptr);
    driver.SendRoute();
    CHECK(driver.GetState().orderID.empty());
    CHECK(FindErrorOrNull(driver.GetState(), VDA5050::ErrorTypes::NO_ROUTE_ERROR) != nullptr);
    driver.SendInstantly("initPosition", "half", {{"x", Core::JsonText::FromNumber(0.25)}});
    CHECK(driver.GetStatus("half") == EActionStatus::Failed);
    driver.SendPositionAtN0("whole", 0.25, 1.0);
    CHECK(driver.GetState().agvPosition->bPositionInitialized);
    CHECK(driver.GetState().agvPosition->x == 0.25);
    driver.Pass(2s);
    CHECK(driver.GetStatus("whole") == EActionStatus::Finished);
    CHECK(FindErrorOrNull(driver.GetState(), "localizationError") == nullptr);
    driver.SendRoute();
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("lost while driving: a cancel ends where the vehicle stopped, and initPosition makes it ready for an order")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(4s);
    const bool bLostFirst = GENERATE(true, false);
    std::string cancelID = "cancel";
    if (!bLostFirst)
    {
        driver.SendInstantly(VDA5050::ActionTypes::CANCEL_ORDER, "cancel");
        cancelID = "again";
    }
    driver.Inject("lost");
    driver.Pass(9s);
    CHECK((bLostFirst || driver.GetStatus("cancel") == EActionStatus::Running));
    driver.SendInstantly(VDA5050::ActionTypes::CANCEL_ORDER, cancelID);
    driver.Pass(5s);
    CHECK(driver.GetStatus("cancel") == EActionStatus::Finished);
    CHECK(driver.GetStatus(cancelID) == EActionStatus::Finished);
    CHECK(driver.GetState().nodeStates.empty());
    CHECK(driver.GetState().lastNodeID == "N0");
    driver.SendPositionAtN0("init", 0.0, 0.0);
    driver.Pass(2s);
    CHECK(driver.GetStatus("init") == EActionStatus::Finished);
    driver.SendRoute("order-2");
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("lost: a line-guided vehicle, whose state has no position, refuses new orders too")
{
    VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("N0");
    options.profile = VdaSim::EVehicleProfile::LineGuided;
    VehicleDriver driver(std::move(options));
    const auto makeOrder = [&driver](const std::string& orderID) {
        VDA5050::OrderMessage order = VehicleDriver::Take(driver.MakeRoute(orderID, {"N0", "N1"}).MakeOrder(2));
        for (VDA5050::OrderNode& node : order.nodes)
        {
            node.nodePosition.reset();
        }
        return order;
    };
    driver.Inject("lost");
    driver.Send(makeOrder("order-1"));
    CHECK(driver.GetState().orderID.empty());
    CHECK(FindErrorOrNull(driver.GetState(), VDA5050::ErrorTypes::NO_ROUTE_ERROR) != nullptr);
    driver.EndFaults();
    driver.Send(makeOrder("order-2"));
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N1");
    CHECK(driver.GetState().errors.empty());
}

TEST_CASE("action-fails: an action that cannot begin for another reason does not use up the fault")
{
    VehicleDriver driver("N0");
    driver.Inject("action-fails error=jammed");
    driver.SendInstantly(VDA5050::ActionTypes::START_CHARGING, "charge"); // there is no charger
    CHECK(driver.GetStatus("charge") == EActionStatus::Failed);
    CHECK(FindErrorOrNull(driver.GetState(), "jammed") == nullptr);
    driver.Send(driver.MakeOrderWith(VDA5050::ActionTypes::FINE_POSITIONING, "fine"));
    driver.Pass(60s);
    CHECK(driver.GetStatus("fine") == EActionStatus::Failed);
}

TEST_CASE("lost while driving: the vehicle brakes, and continues when it is localized again")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(4s);
    driver.Inject("lost for=10s");
    driver.Pass(9s);
    CHECK_FALSE(driver.GetState().bDriving);
    CHECK(driver.GetState().lastNodeID == "N0");
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE(
    "action-fails: the next action that fits fails, at its end or at its start, with the error; the one after it not")
{
    for (const bool bAtStart : {false, true})
    {
        VehicleDriver driver("N0");
        driver.Inject(
            bAtStart ? "action-fails type=pick error=jammed when=start" : "action-fails type=pick error=jammed");
        driver.Send(driver.MakeOrderWith(VDA5050::ActionTypes::FINE_POSITIONING, "fine"));
        driver.Pass(60s);
        CHECK(driver.GetStatus("fine") == EActionStatus::Finished);
        auto back = driver.MakeRoute("pick", {"N2", "DOCK"});
        VDA5050::OrderMessage order = VehicleDriver::Take(back.MakeOrder(2));
        VDA5050::Action pick;
        pick.actionType = VDA5050::ActionTypes::PICK;
        pick.blockingType = VDA5050::EBlockingType::Hard;
        AddMandatoryParameters(pick);
        pick.actionID = "first";
        order.nodes[0].actions.push_back(pick);
        pick.actionID = "second";
        order.nodes[0].actions.push_back(pick);
        driver.Send(order);
        driver.Pass(100ms);
        CHECK(driver.GetStatus("first") == (bAtStart ? EActionStatus::Failed : EActionStatus::Running));
        driver.Pass(10s);
        CHECK(driver.GetStatus("first") == EActionStatus::Failed);
        CHECK(driver.GetStatus("second") == EActionStatus::Finished);
        CHECK(driver.GetState().loads->size() == 1);
        const VDA5050::StateMessage state = driver.GetState();
        REQUIRE(FindErrorOrNull(state, "jammed") != nullptr);
        CHECK(*VDA5050::FindReferenceOrNull(*FindErrorOrNull(state, "jammed"), "actionId") == "first");
        driver.Pass(30s);
        CHECK(driver.GetState().lastNodeID == "DOCK");
        auto next = driver.MakeRoute("next", {"DOCK", "N2"});
        driver.Send(VehicleDriver::Take(next.MakeOrder(2)));
        CHECK(driver.GetState().errors.empty());
    }
}

TEST_CASE("estop: the vehicle brakes hard, its actions wait, and everything continues after it")
{
    VehicleDriver driver("N0");
    driver.Send(driver.MakeOrderWith(VDA5050::ActionTypes::PICK, "pick"));
    driver.Pass(4s);
    const double place = driver.GetPose().x;
    driver.Inject("estop ack=REMOTE for=5s");
    driver.Pass(4s);
    const VDA5050::StateMessage state = driver.GetState();
    CHECK(driver.GetPose().x - place == Approx(0.24).margin(0.05)); // 1.2 m/s at 3 m/s²
    CHECK(state.safetyState.emergencyStop == VDA5050::EEmergencyStop::Remote);
    REQUIRE(FindErrorOrNull(state, "emergencyStop") != nullptr);
    CHECK(FindErrorOrNull(state, "emergencyStop")->errorLevel == EErrorLevel::Fatal);
    REQUIRE(driver.TryPassUntil([&]() { return driver.GetStatus("pick") == EActionStatus::Running; }, 60s));
    CHECK(driver.GetState().safetyState.emergencyStop == VDA5050::EEmergencyStop::None);
    driver.Inject("estop for=10s");
    driver.Pass(9s);
    CHECK(driver.GetStatus("pick") == EActionStatus::Running);
    driver.Pass(5s);
    CHECK(driver.GetStatus("pick") == EActionStatus::Finished);
}

TEST_CASE("6.10.6 mode: MANUAL clears the order and refuses others; the vehicle brakes and is free when it is over")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(4s);
    driver.Inject("mode for=20s");
    CHECK(driver.GetState().operatingMode == EOperatingMode::Manual);
    CHECK(driver.GetState().nodeStates.empty());
    CHECK(driver.GetSpeed() > 0.0);
    driver.Pass(5s);
    CHECK(driver.GetSpeed() == 0.0);
    CHECK_FALSE(driver.GetState().bDriving);
    const double place = driver.GetPose().x;
    driver.SendRoute("order-2");
    CHECK(driver.GetState().orderID == "order-1");
    driver.Pass(60s);
    CHECK(driver.GetPose().x == place);
    CHECK(driver.GetState().operatingMode == EOperatingMode::Automatic);
}

TEST_CASE("6.10.6 mode SERVICE: the order is kept and continues after it")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(4s);
    driver.Inject("mode mode=SERVICE for=20s");
    driver.Pass(10s);
    CHECK(driver.GetState().operatingMode == EOperatingMode::Service);
    CHECK_FALSE(driver.GetState().bDriving);
    CHECK(driver.GetState().nodeStates.size() == 2);
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("battery: the charge is set, below 15 % it is an error, and charging mends it")
{
    VehicleDriver driver("DOCK");
    driver.Inject("battery charge=12");
    CHECK(driver.GetState().batteryState.batteryCharge == 12.0);
    CHECK(FindErrorOrNull(driver.GetState(), "batteryLow") != nullptr);
    driver.SendInstantly(VDA5050::ActionTypes::START_CHARGING, "charge");
    driver.Pass(4s);
    CHECK(driver.GetState().batteryState.bCharging);
    CHECK(FindErrorOrNull(driver.GetState(), "batteryLow") != nullptr);
    driver.Pass(6s);
    CHECK(driver.GetState().batteryState.batteryCharge > 15.0);
    CHECK(FindErrorOrNull(driver.GetState(), "batteryLow") == nullptr);
}

TEST_CASE("Driving never empties a battery below its reserve, and leaves one that was set below it as it is")
{
    VehicleDriver driver("N0");
    driver.Inject("battery charge=2");
    driver.SendRoute();
    driver.Pass(60s);
    CHECK(driver.GetState().batteryState.batteryCharge == 2.0);
    driver.Inject("battery charge=5.1");
    driver.Send(VehicleDriver::Take(driver.MakeRoute("order-2", {"N2", "DOCK"}).MakeOrder(2)));
    driver.Pass(60s);
    CHECK(driver.GetState().batteryState.batteryCharge == Approx(5.08));
}

TEST_CASE("refuse: the next order is refused with the given error, the one after it accepted")
{
    VehicleDriver driver("N0");
    driver.Inject("refuse error=noRouteError");
    driver.SendRoute("order-1");
    const VDA5050::StateMessage state = driver.GetState();
    CHECK(state.orderID.empty());
    REQUIRE(FindErrorOrNull(state, "noRouteError") != nullptr);
    CHECK(*VDA5050::FindReferenceOrNull(*FindErrorOrNull(state, "noRouteError"), "orderId") == "order-1");
    CHECK(driver.HasLine("fault ended", "refuse error=noRouteError"));
    driver.SendRoute("order-2");
    CHECK(driver.GetState().orderID == "order-2");
    CHECK(driver.GetState().errors.empty());
}

TEST_CASE("A fault that waits for a node begins there")
{
    VehicleDriver driver("N0");
    driver.Inject("stuck node=N1 for=5s");
    driver.SendRoute();
    REQUIRE(driver.TryPassUntil([&]() { return driver.GetState().lastNodeID == "N1"; }, 60s));
    driver.Pass(1s);
    CHECK_FALSE(driver.GetState().bDriving);
    CHECK(driver.GetPose().y < 0.1);
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("The time of a fault is that of the clock, also where the simulated time runs ten times as fast")
{
    VehicleDriver driver("N0", 10.0);
    driver.Inject("stuck at=200ms for=3s");
    driver.SendRoute();
    driver.Pass(300ms);
    CHECK_FALSE(driver.GetState().bDriving);
    driver.Pass(2800ms);
    CHECK_FALSE(driver.GetState().bDriving);
    driver.Pass(200ms);
    CHECK(driver.GetState().bDriving);
}

TEST_CASE("A vehicle with a pause and a fault continues when both have ended")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(2s);
    driver.Inject("blocked");
    driver.SendInstantly(VDA5050::ActionTypes::START_PAUSE, "pause");
    driver.Pass(10s);
    CHECK(driver.GetStatus("pause") == EActionStatus::Finished);
    driver.EndFaults();
    driver.Pass(5s);
    CHECK_FALSE(driver.GetState().bDriving);
    driver.Inject("blocked");
    driver.SendInstantly(VDA5050::ActionTypes::STOP_PAUSE, "go");
    driver.Pass(5s);
    CHECK_FALSE(driver.GetState().bDriving);
    driver.EndFaults();
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

} // namespace ACS::Testing
