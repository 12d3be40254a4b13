#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

namespace ACS::VDA5050::Test
{

TEST_CASE("5.3 The effect of a pause on an order action, by its status")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions = {
        MakeAction("pausable", EBlockingType::None),
        MakeAction("stubborn", EBlockingType::None),
        MakeAction("ended", EBlockingType::None),
        MakeAction("later", EBlockingType::Hard)};
    bench.Order(order);
    bench.Status("pausable", EActionStatus::Running);
    bench.Status("stubborn", EActionStatus::Running);
    bench.Status("ended", EActionStatus::Running);
    bench.Status("ended", EActionStatus::Finished);
    bench.Clear();
    bench.Instant("startPause", "p1");
    CHECK(Pick<PauseAction>(bench.GetOutput()) == std::vector{PauseAction{"pausable"}, PauseAction{"stubborn"}});
    CHECK(bench.GetStatus("p1") == EActionStatus::Finished);
    bench.Status("pausable", EActionStatus::Paused);
    // An action that cannot be paused continues to its end. Waiting actions do not begin.
    bench.Status("stubborn", EActionStatus::Finished);
    CHECK(bench.GetStatus("later") == EActionStatus::Waiting);
    CHECK(bench.GetStartedActions().empty());
    bench.Instant("stopPause", "p2");
    CHECK(Pick<ResumeAction>(bench.GetOutput()) == std::vector{ResumeAction{"pausable"}});
    bench.Status("pausable", EActionStatus::Running);
    bench.Status("pausable", EActionStatus::Finished);
    CHECK(bench.GetStartedActions() == std::vector<std::string>{"later"});
}

TEST_CASE("5.3 An action that pauses only after stopPause is resumed at once; one that its owner pauses is not")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions = {MakeAction("late", EBlockingType::None), MakeAction("own", EBlockingType::None)};
    bench.Order(order);
    bench.Status("late", EActionStatus::Running);
    bench.Status("own", EActionStatus::Running);
    bench.Status("own", EActionStatus::Paused);
    bench.Status("own", EActionStatus::Running);
    bench.Instant("startPause", "p1");
    bench.Status("own", EActionStatus::Paused);
    bench.Instant("stopPause", "p2");
    bench.Status("own", EActionStatus::Running);
    bench.Clear();
    bench.Status("own", EActionStatus::Paused);
    CHECK(Pick<ResumeAction>(bench.GetOutput()).empty());
    bench.Status("late", EActionStatus::Paused);
    CHECK(Pick<ResumeAction>(bench.GetOutput()) == std::vector{ResumeAction{"late"}});
    bench.Status("late", EActionStatus::Running);
    bench.Status("late", EActionStatus::Finished);
    CHECK(Pick<ResumeAction>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.3 A cancelled action that pauses only after stopPause is not resumed")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions = {MakeAction("late", EBlockingType::None)};
    bench.Order(order);
    bench.Status("late", EActionStatus::Running);
    bench.Instant("startPause", "p1");
    bench.Instant("stopPause", "p2");
    bench.Instant("cancelOrder", "c1");
    bench.Status("late", EActionStatus::Paused);
    CHECK(Pick<ResumeAction>(bench.GetOutput()).empty());
}

TEST_CASE("5.3 A paused vehicle takes orders and updates, and does not move before stopPause")
{
    VehicleSessionFixture bench;
    bench.Instant("startPause", "p1");
    CHECK(bench.GetPublishedState().bPaused == true);
    bench.Clear();
    OrderBuilder builder = MakeBuilder(3);
    bench.Order(*builder.MakeOrder(2));
    bench.Order(*builder.MakeUpdate(3));
    CHECK(bench.GetPublishedState().orderUpdateID == 1);
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
    bench.Instant("stopPause", "p2");
    CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    CHECK(bench.GetPublishedState().bPaused == false);
}

TEST_CASE("5.3 An order whose last action ends during a pause is complete at once")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(1, 1);
    order.nodes[0].actions.push_back(MakeAction("stubborn", EBlockingType::None));
    bench.Order(order);
    bench.Status("stubborn", EActionStatus::Running);
    bench.Instant("startPause", "p1");
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).empty());
    bench.Status("stubborn", EActionStatus::Finished);
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
    bench.Order(MakeOrder(1, 1, "order-2")); // nothing to do
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 2);
}

TEST_CASE("5.3 startPause and stopPause while paused or not are finished: both can be repeated")
{
    VehicleSessionFixture bench;
    bench.Instant("stopPause", "p1");
    bench.Instant("startPause", "p2");
    bench.Instant("startPause", "p3");
    bench.Instant("stopPause", "p4");
    bench.Instant("stopPause", "p5");
    for (const char* actionID : {"p1", "p2", "p3", "p4", "p5"})
    {
        CAPTURE(actionID);
        CHECK(bench.GetStatus(actionID) == EActionStatus::Finished);
    }
    CHECK(bench.GetPublishedState().bPaused == false);
}

TEST_CASE("5.3 stopPause before the vehicle is stationary fails startPause")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.Drive(true);
    bench.Instant("startPause", "p1");
    CHECK(bench.GetStatus("p1") == EActionStatus::Running);
    bench.Clear();
    bench.Instant("stopPause", "p2");
    CHECK(bench.GetStatus("p1") == EActionStatus::Failed);
    CHECK(bench.GetStatus("p2") == EActionStatus::Finished);
    CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.3 A pause at the vehicle itself is shown in paused; stopPause ends it unless it overrides the master")
{
    struct Case
    {
        bool bOverridesMaster;
        EActionStatus status;
        bool bPausedAfter;
    };
    const std::vector<Case> cases{{false, EActionStatus::Finished, false}, {true, EActionStatus::Failed, true}};
    for (const Case& button : cases)
    {
        CAPTURE(button.bOverridesMaster);
        VehicleSessionFixture bench;
        bench.Order(MakeOrder(2, 2));
        bench.Drive(true);
        bench.Clear();
        bench.HardwarePause(true, button.bOverridesMaster);
        CHECK(Pick<StopDriving>(bench.GetOutput()).size() == 1);
        CHECK(bench.GetPublishedState().bPaused == false);
        bench.Drive(false);
        CHECK(bench.GetPublishedState().bPaused == true);
        bench.Instant("startPause", "p1");
        CHECK(bench.GetStatus("p1") == button.status);
        bench.Instant("stopPause", "p2");
        CHECK(bench.GetStatus("p2") == button.status);
        CHECK(bench.GetPublishedState().bPaused == button.bPausedAfter);
        CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR) == button.bOverridesMaster);
        bench.HardwarePause(false, false);
        CHECK(bench.GetPublishedState().bPaused == false);
        CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    }
}

TEST_CASE("5.3 A cancel during a pause leaves paused true until stopPause")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.Drive(true);
    bench.Instant("startPause", "p1");
    bench.Drive(false);
    bench.Instant("cancelOrder", "c1");
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    CHECK(bench.GetPublishedState().bPaused == true);
    bench.Instant("stopPause", "p2");
    CHECK(bench.GetPublishedState().bPaused == false);
}

TEST_CASE("5.6 The parameters of actions that the session performs itself are checked if unlisted ones are refused")
{
    const EParameterCheck check =
        GENERATE(EParameterCheck::Tolerant, EParameterCheck::Strict, EParameterCheck::Lenient);
    const std::string actionType =
        GENERATE("cancelOrder", "startPause", "stopPause", "stateRequest", "factsheetRequest");
    const bool bListed = GENERATE(false, true);
    CAPTURE(static_cast<int>(check), actionType, bListed);
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.parameterCheck = check;
    if (bListed)
    {
        options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    }
    VehicleSessionFixture bench(options);
    bench.Order(MakeOrder(2, 2));
    bench.Instant(actionType, "i1", {{"color", Core::JsonText::FromString("red")}});
    const bool bRefused = check == EParameterCheck::Strict;
    CHECK((bench.GetStatus("i1") == EActionStatus::Failed) == bRefused);
    CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR) == bRefused);
    CHECK(bench.HasError(ErrorTypes::UNLISTED_PARAMETER) == (check == EParameterCheck::Lenient && bListed));
    CHECK(bench.GetSession().IsOrderRunning());
    if (bRefused)
    {
        REQUIRE(bench.GetPublishedState().errors.size() == 1);
        CHECK(*FindReferenceOrNull(bench.GetPublishedState().errors[0], "parameter") == "color");
    }
}

TEST_CASE("5.4 A cancelOrder that names another order fails with noOrderToCancel, and the order continues")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.parameterCheck = GENERATE(EParameterCheck::Tolerant, EParameterCheck::Strict, EParameterCheck::Lenient);
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    VehicleSessionFixture bench(options);
    bench.Order(MakeOrder(2, 2));
    bench.Drive(true);
    bench.Instant("cancelOrder", "c1", {{"orderId", Core::JsonText::FromString("order-2")}});
    CHECK(bench.GetStatus("c1") == EActionStatus::Failed);
    CHECK(bench.HasError(ErrorTypes::NO_ORDER_TO_CANCEL));
    CHECK(bench.GetSession().IsOrderRunning());
    bench.Instant("cancelOrder", "c2", {{"orderId", Core::JsonText::FromString("order-1")}});
    CHECK_FALSE(bench.HasError(ErrorTypes::UNLISTED_PARAMETER));
    bench.Drive(false);
    CHECK(bench.GetStatus("c2") == EActionStatus::Finished);
}

} // namespace ACS::VDA5050::Test
