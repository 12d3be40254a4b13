#include "robots/DefaultParameters.hpp"
#include "robots/VehicleFixture.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
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

/// The standard's factsheet, without what the codec demands beside it. With a pick that demands the height and the side, too.
VDA5050::FactsheetMessage MakeStandardFactsheet(bool bAllMandatory = false)
{
    StandardFactsheet standard;
    VDA5050::AgvAction& pick = standard.GetPick();
    for (VDA5050::AgvActionParameter& parameter : pick.actionParameters)
    {
        parameter.bOptional = parameter.bOptional.value_or(false) && !bAllMandatory;
    }
    return standard.factsheet;
}

} // namespace

TEST_CASE("A vehicle of four ports and the standard's factsheet receives the place and the port that the plan names")
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

TEST_CASE("A vehicle that reports no node receives its job on the node where the engine has placed it")
{
    VehicleFixture vehicle(MakeMethods());
    vehicle.state.lastNodeID.clear();
    vehicle.ComeOnline();
    Planning::StartJob job = MakeLoad("A01.CP01", "LR01.CP01");
    vehicle.Command(job);
    CHECK(vehicle.TakeOrders().empty());
    CHECK(vehicle.TakeEvents<Planning::JobRejected>().size() == 1);
    job.nodeID = "N7";
    vehicle.Command(job);
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].nodes.at(0).nodeID == "N7");

    vehicle.state.lastNodeID = "A"; // what it reports takes precedence
    vehicle.ShowState();
    job.jobID = "K";
    job.commandID = "U2";
    vehicle.Command(job);
    vehicle.ShowOrder(orders[0], {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    const auto next = vehicle.TakeOrders();
    REQUIRE(next.size() == 1);
    CHECK(next[0].nodes.at(0).nodeID == "A");
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
    vehicle.Receive("factsheet", MakeStandardFactsheet(true));
    vehicle.Command(MakeLoad("A01.CP01", "LR01.CP01"));
    CHECK(vehicle.TakeOrders().empty());
    CHECK(
        vehicle.TakeEvents<Planning::JobFailed>()
        == std::vector<Planning::JobFailed>{
            {"J", "the parameter height of pick cannot be given: the job has no {station.height}"}});
}

TEST_CASE("An action without a method makes the robot unavailable for it from the start")
{
    const VehicleFixture vehicle(MakeMethods());
    CHECK_FALSE(vehicle.adapter.GetRejectionReasonOrNull("CassetteLoad").has_value());
    CHECK(vehicle.adapter.GetRejectionReasonOrNull("TrayLoad") == "the vehicle has no action for TrayLoad");
}

TEST_CASE("The latest factsheet decides which jobs the vehicle can do")
{
    VehicleFixture vehicle(MakeMethods());
    vehicle.ComeOnline();
    const auto check = [&vehicle](const Planning::StartJob& job) {
        return vehicle.TakeEvents<Planning::JobCheckChanged>().back().jobCheck->GetRejectionReasonOrNull(job);
    };
    const Planning::StartJob load = MakeLoad("A01.CP01", "LR01.CP01");
    CHECK_FALSE(check(load).has_value());
    vehicle.Receive("factsheet", MakeStandardFactsheet(true));
    CHECK(check(load) == "the parameter height of pick cannot be given: the job has no {station.height}");
    CHECK(check(MakeLoad("A01.CP02", "LR01.CP01")) == "the vehicle's factsheet does not list takeOver");
    CHECK(check(MakeJob("TrayLoad")) == "the vehicle has no action for TrayLoad");
    vehicle.Receive("factsheet", MakeStandardFactsheet());
    CHECK_FALSE(check(load).has_value());
}

TEST_CASE("A vehicle that is asked for its factsheet is given no job before the answer, at most for 5 s")
{
    for (const bool bAnswers : {true, false})
    {
        VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
        options.bFactsheetRequested = true;
        VehicleFixture vehicle(MakeMethods(), options);
        const auto check = [&vehicle] {
            return vehicle.TakeEvents<Planning::JobCheckChanged>().back().jobCheck->GetRejectionReasonOrNull(
                MakeLoad("A01.CP01", "LR01.CP01"));
        };
        vehicle.ComeOnline();
        CHECK(check() == "the vehicle has not sent its factsheet yet");
        std::optional<Planning::StartAdapterTimer> timer;
        std::vector<std::size_t> kinds; // of the events
        for (const Planning::AdapterAction& action : std::exchange(vehicle.actions, {}))
        {
            const auto* const startOrNull = std::get_if<Planning::StartAdapterTimer>(&action);
            timer = startOrNull != nullptr && startOrNull->delay == std::chrono::seconds(5) ? *startOrNull : timer;
            if (const auto* const raiseOrNull = std::get_if<Planning::RaiseEvent>(&action))
            {
                kinds.push_back(raiseOrNull->event.index());
            }
        }
        REQUIRE(timer.has_value());
        REQUIRE(kinds.size() >= 2);
        // Else a plan that waits would be given to the vehicle in between.
        CHECK(kinds[0] == Planning::RobotEvent(Planning::JobCheckChanged()).index());
        CHECK(kinds[1] == Planning::RobotEvent(Planning::LinkChanged()).index());
        if (bAnswers)
        {
            vehicle.Receive("factsheet", MakeStandardFactsheet());
            const Planning::AdapterAction cancelled = Planning::CancelAdapterTimer{timer->timer};
            CHECK(std::ranges::count(vehicle.actions, cancelled) == 1);
        }
        else
        {
            vehicle.adapter.OnTimer(timer->timer, vehicle.clock.GetNow(), vehicle.actions);
        }
        CHECK_FALSE(check().has_value());
        vehicle.adapter.OnLinkDown(vehicle.clock.GetNow(), vehicle.actions);
        vehicle.ComeOnline();
        CHECK_FALSE(check().has_value());
    }
}

TEST_CASE("A job that is commanded before the factsheet has come is sent after it, with the types that it declares")
{
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.bFactsheetRequested = true;
    JobMethods methods = MakeMethods();
    methods.SetMethod("CassetteLoad", {}, {"pick", 0, {{"fork", *ParameterTemplate::Make("2")}}});
    VehicleFixture vehicle(std::move(methods), options);
    vehicle.ComeOnline();
    vehicle.Command(MakeLoad("A01.CP01", "LR01.CP01"));
    CHECK(vehicle.TakeOrders().empty());
    VDA5050::FactsheetMessage factsheet;
    VDA5050::AgvAction& pick = factsheet.protocolFeatures.agvActions.emplace_back();
    pick.actionType = "pick";
    pick.actionScopes = {VDA5050::EActionScope::Node};
    pick.actionParameters = {{"fork", VDA5050::EValueDataType::Integer, "", false}};
    SECTION("the factsheet comes")
    {
        vehicle.Receive("factsheet", factsheet);
        const auto orders = vehicle.TakeOrders();
        REQUIRE(orders.size() == 1);
        CHECK(MakeText(orders[0].nodes.at(0).actions.at(0)) == "pick fork=2");
    }
    SECTION("the job is cancelled first")
    {
        vehicle.Command(Planning::CancelJob{"J"});
        CHECK(
            vehicle.TakeEvents<Planning::JobFailed>()
            == std::vector<Planning::JobFailed>{{"J", "cancelled before it was sent to the vehicle"}});
        vehicle.Receive("factsheet", factsheet);
        CHECK(vehicle.TakeOrders().empty());
    }
}

TEST_CASE("A job that the vehicle shows after a restart continues before its factsheet has arrived")
{
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.bFactsheetRequested = true;
    JobMethods methods = MakeMethods();
    // Mandatory by the standard, and without a value at the station.
    methods.SetMethod("CassetteLoad", {}, {"pick", 0, {{"stationType", *ParameterTemplate::Make("{station.kind}")}}});
    VehicleFixture vehicle(std::move(methods), options);
    vehicle.state.orderID = "U1";
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ComeOnline();
    vehicle.Command(Planning::RecoverJob{MakeLoad("A01.CP01", "LR01.CP01"), {}});
    CHECK(vehicle.TakeEvents<Planning::JobUnresolved>().empty());
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("A factsheet that is the same again changes nothing")
{
    VehicleFixture vehicle(MakeMethods());
    vehicle.ComeOnline();
    vehicle.Receive("factsheet", MakeStandardFactsheet());
    const std::size_t count = vehicle.TakeEvents<Planning::JobCheckChanged>().size();
    ++vehicle.state.header.headerID;
    vehicle.Receive("factsheet", MakeStandardFactsheet());
    CHECK(vehicle.TakeEvents<Planning::JobCheckChanged>().size() == count);
}

TEST_CASE("A drive that waits for the end of a job's order does not pass the node of this order")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    const VDA5050::OrderMessage job = vehicle.TakeOrders().at(0);
    vehicle.ShowOrder(job, {"A"}); // not yet reached by its own account
    vehicle.ShowAt("A", 4);
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    REQUIRE(vehicle.TakeEvents<Planning::JobFinished>().size() == 1);
    vehicle.Command(MakeDrive());
    CHECK(vehicle.TakeOrders().empty());
    vehicle.ShowOrder(job, {});
    vehicle.ShowAt("A", 0);
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::NodePassed>().empty());
    CHECK(vehicle.TakeOrders().size() == 1);
}

} // namespace ACS::Acsd::Test
