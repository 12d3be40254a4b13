#include "DefaultParameters.hpp"
#include "VehicleFixture.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

#include <memory>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A robot of four ports that loads with the default pick, and in another way at A01.CP02.
JobMethods MakeMethods()
{
    const Planning::ActionRule rule = Planning::MakeStandardActions().at("CassetteLoad");
    auto stations = std::make_shared<const StationTable>(
        StationTable{{"A01.CP01", {{"type", std::string("rack")}}}, {"A01.CP02", {{"type", std::string("belt")}}}});
    JobMethods methods(
        LoadPositions(*Core::ParseLocationRange("LR01.CP01-04"), {{"CP03", "rear"}}),
        std::move(stations));
    methods.SetMethod("CassetteLoad", {}, {"pick", 0, MakeDefaultParameters("pick", rule, 4)});
    methods.SetMethod(
        "CassetteLoad",
        "A01.CP02",
        {"takeOver", 0, {{"kind", *ParameterTemplate::Make("{station.type}")}}});
    methods.SetMethod("Weigh", {}, {"pick", 0, {{"stationType", *ParameterTemplate::Make("{station.side}")}}});
    return methods;
}

Planning::StartJob MakeLoad(const std::string& place, const std::string& port)
{
    Planning::StartJob job = MakeJob("CassetteLoad");
    job.from = place;
    job.to = port;
    return job;
}

std::string MakeText(const VDA5050::Action& action)
{
    std::string text = action.actionType;
    for (const VDA5050::ActionParameter& parameter : action.actionParameters)
    {
        text += " " + parameter.key + "=" + parameter.value.GetText();
    }
    return text;
}

/// The standard's factsheet, without what the codec demands beside it.
VDA5050::FactsheetMessage MakeStandardFactsheet()
{
    VDA5050::FactsheetMessage factsheet;
    factsheet.protocolFeatures.agvActions = VDA5050::GetPredefinedActions();
    return factsheet;
}

} // namespace

TEST_CASE("A vehicle of four ports and the standard's factsheet is told the place and the port that the plan names")
{
    VehicleFixture vehicle(MakeMethods());
    vehicle.ComeOnline();
    vehicle.Receive("factsheet", MakeStandardFactsheet());
    const auto send = [&vehicle](const std::string& place, const std::string& port) {
        Planning::StartJob job = MakeLoad(place, port);
        job.commandID = port;
        vehicle.Command(job);
        const auto orders = vehicle.TakeOrders();
        REQUIRE(orders.size() == 1);
        vehicle.ShowOrder(orders[0], {});
        vehicle.state.actionStates = {{port, "pick", "", VDA5050::EActionStatus::Finished, ""}};
        vehicle.ShowState();
        return MakeText(orders[0].nodes.at(0).actions.at(0));
    };
    const std::string begin = R"(pick stationName="A01.CP01" loadId="C1" stationType="rack" loadType="cassette" lhd=)";
    CHECK(send("A01.CP01", "LR01.CP01") == begin + R"("CP01")");
    CHECK(send("A01.CP01", "LR01.CP03") == begin + R"("rear")");
}

TEST_CASE("A station may have a method of its own, which applies to the job's place, not to where the robot is docked")
{
    VehicleFixture vehicle(MakeMethods());
    vehicle.ComeOnline();
    vehicle.Command(MakeLoad("A01.CP02", "LR01.CP01"));
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(MakeText(orders[0].nodes.at(0).actions.at(0)) == R"(takeOver kind="belt")");
}

TEST_CASE("A job whose mandatory parameter has no value fails with the reason, and nothing is sent")
{
    VehicleFixture vehicle(MakeMethods());
    vehicle.ComeOnline();
    VDA5050::FactsheetMessage factsheet = MakeStandardFactsheet();
    auto& pick = *std::ranges::find(
        factsheet.protocolFeatures.agvActions,
        VDA5050::ActionTypes::PICK,
        &VDA5050::AgvAction::actionType);
    for (VDA5050::AgvActionParameter& parameter : pick.actionParameters)
    {
        parameter.bOptional = false;
    }
    vehicle.Receive("factsheet", factsheet);
    vehicle.Command(MakeLoad("A01.CP01", "LR01.CP01"));
    CHECK(vehicle.TakeOrders().empty());
    CHECK(
        vehicle.TakeEvents<Planning::JobFailed>()
        == std::vector<Planning::JobFailed>{
            {"J", "the parameter height of pick cannot be given: the job has no {station.height}"}});
}

TEST_CASE("A mandatory parameter that no configured station has a value for makes the robot unavailable for the action")
{
    const VehicleFixture vehicle(MakeMethods());
    CHECK_FALSE(vehicle.adapter.GetRejectionReasonOrNull("CassetteLoad").has_value());
    CHECK(
        vehicle.adapter.GetRejectionReasonOrNull("Weigh")
        == "the parameter stationType of pick cannot be given: no station has a side");
    CHECK(vehicle.adapter.GetRejectionReasonOrNull("TrayLoad") == "the vehicle has no action for TrayLoad");
}

} // namespace ACS::Acsd::Test
