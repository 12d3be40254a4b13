#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

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

TEST_CASE("5.7 Of deleteMap and enableMap for the same map the one that ends last fails")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    VehicleSessionFixture bench(options);
    VehicleActions out;
    bench.GetSession().OnMaps(
        std::vector<MapState>{
            MapState{"floor", "1", EMapStatus::Enabled, {}},
            MapState{"floor", "2", EMapStatus::Disabled, {}}},
        bench.GetNow(),
        out);
    const std::vector<ActionParameter> parameters{
        {"mapId", Core::JsonText::FromString("floor")},
        {"mapVersion", Core::JsonText::FromString("2")}};
    bench.Instant("deleteMap", "delete", parameters);
    bench.Instant("enableMap", "enable", parameters);
    REQUIRE(bench.GetStartedActions().size() == 2);
    bench.Status("delete", EActionStatus::Running);
    bench.Status("enable", EActionStatus::Running);
    const bool bDeletedFirst = GENERATE(true, false);
    bench.Status(bDeletedFirst ? "delete" : "enable", EActionStatus::Finished);
    bench.Status(bDeletedFirst ? "enable" : "delete", EActionStatus::Finished);
    CHECK(bench.GetStatus(bDeletedFirst ? "delete" : "enable") == EActionStatus::Finished);
    CHECK(bench.GetStatus(bDeletedFirst ? "enable" : "delete") == EActionStatus::Failed);
    CHECK(bench.HasError(ErrorTypes::ACTION_ERROR));
    const std::optional<std::vector<MapState>> maps = bench.GetSession().GetState().maps;
    REQUIRE(maps.has_value());
    REQUIRE(maps->size() == (bDeletedFirst ? 1 : 2));
    CHECK(maps->front().mapStatus == (bDeletedFirst ? EMapStatus::Enabled : EMapStatus::Disabled));
    CHECK(maps->back().mapStatus == EMapStatus::Enabled);
}

TEST_CASE("5.7 A map action whose effect the vehicle has reported before its end is finished")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    VehicleSessionFixture bench(options);
    const auto report = [&bench](std::vector<MapState> maps) {
        VehicleActions out;
        bench.GetSession().OnMaps(std::move(maps), bench.GetNow(), out);
    };
    const MapState first{"floor", "1", EMapStatus::Enabled, {}};
    const MapState second{"floor", "2", EMapStatus::Disabled, {}};
    const std::string actionType = GENERATE("deleteMap", "enableMap", "downloadMap");
    CAPTURE(actionType);
    report(actionType == "downloadMap" ? std::vector{first} : std::vector{first, second});
    std::vector<ActionParameter> parameters{
        {"mapId", Core::JsonText::FromString("floor")},
        {"mapVersion", Core::JsonText::FromString("2")}};
    if (actionType == "downloadMap")
    {
        parameters.push_back({"mapDownloadLink", Core::JsonText::FromString("https://maps")});
    }
    bench.Instant(actionType, "m1", parameters);
    bench.Status("m1", EActionStatus::Running);
    report(actionType == "deleteMap" ? std::vector{first} : std::vector{first, second});
    bench.Status("m1", EActionStatus::Finished);
    CHECK(bench.GetStatus("m1") == EActionStatus::Finished);
}

TEST_CASE("5.6 A parameter of the standard is not reported as unlisted if the factsheet lists the action without any")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.parameterCheck = EParameterCheck::Lenient;
    AgvAction drop;
    drop.actionType = "drop";
    drop.actionScopes = {EActionScope::Node};
    options.factsheet.protocolFeatures.agvActions = {drop};
    VehicleSessionFixture bench(options);
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].actions = {MakeAction("a1", EBlockingType::Hard, "drop")};
    order.nodes[1].actions[0].actionParameters = {{"loadId", Core::JsonText::FromString("L1")}};
    const bool bOwn = GENERATE(false, true);
    if (bOwn)
    {
        order.nodes[1].actions[0].actionParameters.push_back({"color", Core::JsonText::FromString("red")});
    }
    bench.Order(order);
    CHECK(bench.GetSession().GetState().orderID == "order-1");
    CHECK(bench.HasError(ErrorTypes::UNLISTED_PARAMETER) == bOwn);
}

} // namespace ACS::VDA5050::Test
