#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/OrderBuilder.hpp>

namespace ACS::VDA5050::Test
{

TEST_CASE("5.7 A failed action of an order is a warning and the order continues, unless the action is critical")
{
    for (const bool bCritical : {false, true})
    {
        CAPTURE(bCritical);
        VehicleOptions options = VehicleSessionFixture::MakeOptions();
        if (bCritical)
        {
            options.criticalActionTypes = {"pick"};
        }
        VehicleSessionFixture bench(options);
        OrderMessage order = MakeOrder(2, 2);
        order.nodes[0].actions = {MakeAction("fails", EBlockingType::Hard), MakeAction("next", EBlockingType::None)};
        bench.Order(order);
        bench.Status("fails", EActionStatus::Running);
        bench.Clear();
        bench.Status("fails", EActionStatus::Failed);
        const StateMessage state = bench.GetPublishedState();
        REQUIRE(state.errors.size() == 1);
        CHECK(state.errors[0].errorType == ErrorTypes::ACTION_ERROR);
        CHECK(state.errors[0].errorLevel == (bCritical ? EErrorLevel::Fatal : EErrorLevel::Warning));
        CHECK(*FindReferenceOrNull(state.errors[0], "actionId") == "fails");
        CHECK(*FindReferenceOrNull(state.errors[0], "nodeId") == "N0");
        CHECK(bench.GetStartedActions().empty() == bCritical);
        CHECK(Pick<DriveTo>(bench.GetOutput()).empty() == bCritical);
        bench.Instant("cancelOrder", "c1");
        if (!bCritical)
        {
            bench.Status("next", EActionStatus::Running);
            bench.Status("next", EActionStatus::Failed);
        }
        bench.Drive(false);
        CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
        bench.Order(MakeOrder(2, 2, "order-2"));
        CHECK(bench.GetPublishedState().errors.empty());
    }
}

TEST_CASE("5.7 An update does not end the error of a critical action that still holds the order")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.criticalActionTypes = {"pick"};
    VehicleSessionFixture bench(options);
    OrderBuilder builder = *OrderBuilder::Create("order", MakeOrder(3, 3).nodes, MakeOrder(3, 3).edges);
    OrderMessage order = *builder.MakeOrder(2);
    order.nodes[0].actions = {MakeAction("fails", EBlockingType::Hard)};
    bench.Order(order);
    bench.Status("fails", EActionStatus::Running);
    bench.Status("fails", EActionStatus::Failed);
    REQUIRE(bench.GetPublishedState().errors.size() == 1);
    bench.Clear();
    bench.Order(*builder.MakeUpdate(3));
    CHECK(Pick<OrderTaken>(bench.GetOutput()).size() == 1);
    const StateMessage state = bench.GetPublishedState();
    REQUIRE(state.errors.size() == 1);
    CHECK(state.errors[0].errorLevel == EErrorLevel::Fatal);
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
}

} // namespace ACS::VDA5050::Test
