#include "Catch.hpp"
#include "vda-sim/VehicleFactsheet.hpp"
#include "VehicleDriver.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::Action;
using VDA5050::ActionParameter;
using VDA5050::AgvAction;
using VDA5050::EActionScope;
using VDA5050::EActionStatus;
using VdaSim::EVehicleType;
namespace ActionTypes = VDA5050::ActionTypes;

VDA5050::FactsheetMessage MakeFactsheet(
    EVehicleType type,
    VDA5050::EVda5050Version version = VDA5050::EVda5050Version::Version210)
{
    return VdaSim::MakeFactsheet(type, {}, version);
}

std::vector<AgvAction> ListActions()
{
    return MakeFactsheet(EVehicleType::Logistics).protocolFeatures.agvActions;
}

/// Adds the parameters that the row requires.
std::vector<ActionParameter> MakeParameters(const AgvAction& row)
{
    std::vector<ActionParameter> parameters;
    for (const VDA5050::AgvActionParameter& parameter : row.actionParameters)
    {
        const bool bNewMap = row.actionType == ActionTypes::DOWNLOAD_MAP || row.actionType == ActionTypes::DELETE_MAP;
        if (parameter.bOptional.value_or(false))
        {
            continue;
        }
        if (parameter.valueDataType == VDA5050::EValueDataType::Number)
        {
            parameters.push_back({parameter.key, Core::JsonText::FromNumber(0.5)});
        }
        else if (parameter.key == "mapId")
        {
            parameters.push_back(MakeText("mapId", bNewMap ? "cellar" : "floor"));
        }
        else if (parameter.key == "lastNodeId")
        {
            parameters.push_back(MakeText("lastNodeId", "DOCK"));
        }
        else
        {
            parameters.push_back(MakeText(parameter.key, "1"));
        }
    }
    return parameters;
}

/// A vehicle at its charger, whose actions take half a second.
VdaSim::VirtualVehicleOptions MakeOptions()
{
    VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("DOCK");
    options.version = VDA5050::EVda5050Version::Version210; // the one with every action
    for (const AgvAction& action : ListActions())
    {
        options.actionSeconds[action.actionType] = 0.5;
    }
    options.actionSeconds.erase(std::string(ActionTypes::WAIT_FOR_TRIGGER));
    return options;
}

Action MakeAction(std::string_view type, std::vector<ActionParameter> parameters)
{
    Action action;
    action.actionType = type;
    action.actionID = "work";
    action.blockingType = VDA5050::EBlockingType::None;
    action.actionParameters = std::move(parameters);
    AddMandatoryParameters(action);
    return action;
}

void SendOrder(VehicleDriver& driver, const Action& action, EActionScope scope)
{
    auto route = driver.MakeRoute("order-work", {"DOCK", "N2"});
    auto order = VehicleDriver::Take(route.MakeOrder(2));
    (scope == EActionScope::Node ? order.nodes.front().actions : order.edges.front().actions).push_back(action);
    driver.Send(std::move(order));
}

/// Establishes the preconditions of the action.
void Prepare(VehicleDriver& driver, std::string_view actionType)
{
    if (actionType == ActionTypes::DROP)
    {
        auto route = driver.MakeRoute("order-pick", {"DOCK"});
        auto order = VehicleDriver::Take(route.MakeOrder(1));
        order.nodes.front().actions.push_back(MakeAction(ActionTypes::PICK, {}));
        order.nodes.front().actions.front().actionID = "pick";
        driver.Send(std::move(order));
    }
    else if (actionType == ActionTypes::DELETE_MAP)
    {
        driver.SendInstantly(
            ActionTypes::DOWNLOAD_MAP,
            "download",
            {MakeText("mapId", "cellar"), MakeText("mapVersion", "1"), MakeText("mapDownloadLink", "1")});
    }
    else if (actionType == ActionTypes::STOP_PAUSE)
    {
        driver.SendInstantly(ActionTypes::START_PAUSE, "pause");
    }
    else if (actionType == ActionTypes::CANCEL_ORDER)
    {
        auto route = driver.MakeRoute("order-cancel", {"DOCK", "N2"});
        driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    }
    driver.Pass(1s);
}

} // namespace

TEST_CASE("6.8.2 The factsheet lists every action that the standard names, with its scopes and parameters")
{
    const std::vector<AgvAction> listed = ListActions();
    CHECK(listed.size() == VDA5050::GetPredefinedActions().size());
    for (const AgvAction& standard : VDA5050::GetPredefinedActions())
    {
        CAPTURE(standard.actionType);
        const auto row = std::ranges::find(listed, standard.actionType, &AgvAction::actionType);
        REQUIRE(row != listed.end());
        CHECK(row->actionScopes == standard.actionScopes);
        REQUIRE(row->actionParameters.size() == standard.actionParameters.size());
        for (std::size_t index = 0; index < row->actionParameters.size(); ++index)
        {
            CHECK(row->actionParameters[index].key == standard.actionParameters[index].key);
            CHECK(row->actionParameters[index].valueDataType == standard.actionParameters[index].valueDataType);
            CHECK(row->actionParameters[index].bOptional == standard.actionParameters[index].bOptional);
        }
        CHECK(row->blockingTypes.size() == 3);
    }
}

TEST_CASE("6.8.2 Every action of the factsheet comes to its end in each of its scopes")
{
    for (const AgvAction& row : ListActions())
    {
        for (const EActionScope scope : row.actionScopes)
        {
            CAPTURE(row.actionType, static_cast<int>(scope));
            VehicleDriver driver(MakeOptions());
            Prepare(driver, row.actionType);
            if (scope == EActionScope::Instant)
            {
                driver.SendInstantly(row.actionType, "work", MakeParameters(row));
            }
            else
            {
                Action action = MakeAction(row.actionType, MakeParameters(row));
                const bool bStays = row.actionType == ActionTypes::START_CHARGING;
                action.blockingType = bStays ? VDA5050::EBlockingType::Hard : action.blockingType;
                SendOrder(driver, action, scope);
            }
            driver.Pass(1s);
            if (row.actionType == ActionTypes::WAIT_FOR_TRIGGER)
            {
                CHECK(driver.GetStatus("work") == EActionStatus::Running);
                CHECK(driver.Trigger() == 1);
            }
            driver.Pass(20s);
            CHECK(driver.GetStatus("work") == EActionStatus::Finished);
        }
    }
}

TEST_CASE("6.8 detectObject on an edge finishes at the edge's end; a pick that is not done by then has failed")
{
    for (const std::string_view type : {ActionTypes::DETECT_OBJECT, ActionTypes::PICK})
    {
        CAPTURE(type);
        VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("DOCK");
        options.actionSeconds[std::string(type)] = 1000.0;
        VehicleDriver driver(std::move(options));
        SendOrder(driver, MakeAction(type, {}), EActionScope::Edge);
        driver.Pass(1s);
        CHECK(driver.GetStatus("work") == EActionStatus::Running);
        driver.Pass(30s);
        CHECK(driver.GetState().lastNodeID == "N2");
        const bool bFound = driver.GetStatus("work") == EActionStatus::Finished;
        CHECK(bFound == (type == ActionTypes::DETECT_OBJECT));
        CHECK(driver.GetState().loads->empty());
    }
}

TEST_CASE("7.4 The factsheet lists the limits of a vehicle: message sizes, load positions, members of its version")
{
    const VDA5050::FactsheetMessage factsheet = MakeFactsheet(EVehicleType::Logistics);
    const VDA5050::ProtocolLimits& limits = factsheet.protocolLimits;
    CHECK(limits.maxStringLengths.message == VDA5050::CodecLimits{}.payloadBytes);
    CHECK(limits.maxStringLengths.identifier == 1024U);
    CHECK(limits.maxStringLengths.loadID == 1024U);
    const VDA5050::MaximumArrayLengths& arrays = limits.maxArrayLengths;
    CHECK(arrays.orderNodes == 1000U);
    CHECK(arrays.orderEdges == 1000U);
    CHECK(arrays.nodeActions == 100U);
    CHECK(arrays.edgeActions == 100U);
    CHECK(arrays.actionParameters == 100U);
    CHECK(arrays.instantActions == 100U);
    CHECK(arrays.trajectoryKnotVector == 111U);
    CHECK(arrays.trajectoryControlPoints == 100U);
    CHECK(arrays.stateNodeStates == 1000U);
    CHECK(arrays.stateEdgeStates == 1000U);
    CHECK(arrays.stateActionStates == 2000U);
    CHECK(arrays.stateErrors == 64U);
    CHECK(arrays.stateLoads == 4U);
    CHECK(factsheet.loadSpecification.loadPositions == std::vector<std::string>{"CP01", "CP02", "CP03", "CP04"});

    const VDA5050::FactsheetMessage base = MakeFactsheet(EVehicleType::Control);
    CHECK(base.loadSpecification.loadPositions.empty());
    CHECK_FALSE(base.protocolLimits.maxArrayLengths.stateLoads.has_value());
    CHECK_FALSE(VDA5050::CanPerform(base, ActionTypes::PICK, EActionScope::Node));
    CHECK_FALSE(VDA5050::CanPerform(base, ActionTypes::DROP, EActionScope::Node));
    CHECK(VDA5050::CanPerform(base, ActionTypes::FINE_POSITIONING, EActionScope::Node));

    const auto hasCorridor = [](VDA5050::EVda5050Version version) {
        return VDA5050::IsSupported(MakeFactsheet(EVehicleType::Logistics, version), "order.edges.corridor");
    };
    CHECK(hasCorridor(VDA5050::EVda5050Version::Version210));
    CHECK_FALSE(hasCorridor(VDA5050::EVda5050Version::Version200));
}

TEST_CASE("6.8 A pick uses the load position that it names, or the first free one, and fails if there is none")
{
    VehicleDriver driver(MakeOptions());
    auto route = driver.MakeRoute("order-loads", {"DOCK"});
    auto order = VehicleDriver::Take(route.MakeOrder(1));
    const auto add = [&order](std::string_view type, const std::string& actionID, std::vector<ActionParameter> with) {
        order.nodes[0].actions.push_back(MakeAction(type, std::move(with)));
        order.nodes[0].actions.back().actionID = actionID;
        order.nodes[0].actions.back().blockingType = VDA5050::EBlockingType::Hard;
    };
    add(ActionTypes::PICK, "second", {MakeText("lhd", "CP02"), MakeText("loadId", "A")});
    add(ActionTypes::PICK, "taken", {MakeText("lhd", "CP02")});
    add(ActionTypes::PICK, "twice", {MakeText("loadId", "A")});
    add(ActionTypes::PICK, "nowhere", {MakeText("lhd", "CP05")});
    add(ActionTypes::PICK, "long", {MakeText("loadId", std::string(1025, 'L'))});
    add(ActionTypes::PICK, "first", {});
    add(ActionTypes::PICK, "third", {});
    add(ActionTypes::PICK, "fourth", {});
    add(ActionTypes::PICK, "full", {});
    add(ActionTypes::DROP, "elsewhere", {MakeText("lhd", "CP01"), MakeText("loadId", "A")});
    add(ActionTypes::DROP, "drop", {MakeText("lhd", "CP03")});
    driver.Send(std::move(order));
    driver.Pass(30s);
    for (const std::string failed : {"taken", "twice", "nowhere", "long", "full", "elsewhere"})
    {
        CAPTURE(failed);
        CHECK(driver.GetStatus(failed) == EActionStatus::Failed);
    }
    for (const std::string done : {"second", "first", "third", "fourth", "drop"})
    {
        CAPTURE(done);
        CHECK(driver.GetStatus(done) == EActionStatus::Finished);
    }
    std::vector<std::string> places;
    for (const VDA5050::Load& load : driver.GetState().loads.value_or(std::vector<VDA5050::Load>()))
    {
        places.push_back(load.loadPosition);
    }
    CHECK(places == std::vector<std::string>{"CP02", "CP01", "CP04"});
}

TEST_CASE("6.6 An order is refused whose action lacks a mandatory parameter, or has another type or an unlisted one")
{
    struct Refused
    {
        std::string_view actionType;
        std::vector<ActionParameter> parameters;
        std::string_view blamed;
    };
    const ActionParameter type = MakeText("stationType", "rack");
    const ActionParameter load = MakeText("loadType", "cassette");
    for (const Refused& refused : {
             Refused{ActionTypes::PICK, {load}, "stationType"},
             Refused{ActionTypes::PICK, {type}, "loadType"},
             Refused{ActionTypes::PICK, {type, {"loadType", Core::JsonText::FromNumber(7)}}, "loadType"},
             Refused{ActionTypes::PICK, {type, load, MakeText("height", "0.8")}, "height"},
             Refused{ActionTypes::PICK, {type, load, MakeText("priority", "high")}, "priority"},
             Refused{ActionTypes::DROP, {MakeText("priority", "high")}, "priority"},
             Refused{ActionTypes::START_CHARGING, {MakeText("current", "high")}, "current"},
             Refused{ActionTypes::WAIT_FOR_TRIGGER, {}, "triggerType"},
         })
    {
        CAPTURE(refused.actionType, refused.blamed);
        VehicleDriver driver(MakeOptions());
        Action action;
        action.actionType = refused.actionType;
        action.actionID = "work";
        action.actionParameters = refused.parameters;
        SendOrder(driver, action, EActionScope::Node);
        CHECK(driver.GetState().orderID.empty());
        REQUIRE(driver.GetState().errors.size() == 1);
        const VDA5050::VehicleError error = driver.GetState().errors[0];
        CHECK(error.errorType == VDA5050::ErrorTypes::ORDER_ERROR);
        REQUIRE(VDA5050::FindReferenceOrNull(error, "parameter") != nullptr);
        CHECK(*VDA5050::FindReferenceOrNull(error, "parameter") == refused.blamed);
        CHECK(*VDA5050::FindReferenceOrNull(error, "actionId") == "work");
    }
}

TEST_CASE("--lenient-parameters: unlisted parameters are accepted and reported, mandatory ones stay mandatory")
{
    VdaSim::VirtualVehicleOptions options = MakeOptions();
    options.parameterCheck = VDA5050::EParameterCheck::Lenient;
    VehicleDriver driver(std::move(options));
    SendOrder(
        driver,
        MakeAction(
            ActionTypes::PICK,
            {MakeText("height", "0.8"), MakeText("priority", "high"), MakeText("colour", "red")}),
        EActionScope::Node);
    driver.Pass(1s);
    CHECK(driver.GetStatus("work") == EActionStatus::Finished);
    REQUIRE(driver.GetState().errors.size() == 1);
    const VDA5050::VehicleError error = driver.GetState().errors[0];
    CHECK(error.errorType == VDA5050::ErrorTypes::UNLISTED_PARAMETER);
    CHECK(error.errorLevel == VDA5050::EErrorLevel::Warning);
    CHECK(*VDA5050::FindReferenceOrNull(error, "actionId") == "work");
    CHECK(std::ranges::count(error.errorReferences, "parameter", &VDA5050::ErrorReference::referenceKey) == 2);
    CHECK(std::ranges::any_of(driver.GetLog().GetLines(), [](const RecordedLine& line) {
        return line.level == Core::ELogLevel::Warning && line.HasField("parameters", "priority, colour");
    }));

    driver.Pass(20s);
    auto route = driver.MakeRoute("order-next", {"N2", "DOCK"});
    auto order = VehicleDriver::Take(route.MakeOrder(2));
    driver.Send(order);
    CHECK(driver.GetState().errors.empty());
    driver.Pass(20s);
    Action drop = MakeAction(ActionTypes::WAIT_FOR_TRIGGER, {});
    drop.actionParameters.clear();
    SendOrder(driver, drop, EActionScope::Node);
    REQUIRE(driver.GetState().errors.size() == 1);
    CHECK(driver.GetState().errors[0].errorType == VDA5050::ErrorTypes::ORDER_ERROR);
}

TEST_CASE("--lenient-parameters: initPosition accepts numbers as text")
{
    VdaSim::VirtualVehicleOptions options = MakeOptions();
    options.parameterCheck = VDA5050::EParameterCheck::Lenient;
    VehicleDriver driver(std::move(options));
    const auto place = [&driver](const std::string& actionID, std::string_view x) {
        driver.SendInstantly(
            ActionTypes::INIT_POSITION,
            actionID,
            {MakeText("x", x),
             MakeText("y", "0"),
             MakeText("theta", "0.5"),
             MakeText("mapId", driver.GetState().agvPosition->mapID),
             MakeText("lastNodeId", "N1")});
        driver.Pass(1s);
        return driver.GetStatus(actionID);
    };
    CHECK(place("good", "4.5") == EActionStatus::Finished);
    CHECK(driver.GetState().agvPosition->x == Approx(4.5));
    CHECK(place("bad", "nan") == EActionStatus::Failed);
}

TEST_CASE("Instant actions are checked against the factsheet, too")
{
    for (const bool bLenient : {false, true})
    {
        VdaSim::VirtualVehicleOptions options = MakeOptions();
        options.parameterCheck = bLenient ? VDA5050::EParameterCheck::Lenient : VDA5050::EParameterCheck::Strict;
        VehicleDriver driver(std::move(options));
        driver.SendInstantly(ActionTypes::LOG_REPORT, "more", {MakeText("reason", "test"), MakeText("lines", "10")});
        driver.SendInstantly(ActionTypes::LOG_REPORT, "less");
        driver.Pass(2s);
        CHECK(driver.GetStatus("more") == (bLenient ? EActionStatus::Finished : EActionStatus::Failed));
        CHECK(driver.GetStatus("less") == EActionStatus::Failed);
    }
}

TEST_CASE("6.6 The base of an arm has no load positions: an order with a pick is refused")
{
    VdaSim::VirtualVehicleOptions options = MakeOptions();
    options.type = EVehicleType::Control;
    VehicleDriver driver(std::move(options));
    SendOrder(driver, MakeAction(ActionTypes::PICK, {}), EActionScope::Node);
    CHECK(driver.GetState().orderID.empty());
    REQUIRE(driver.GetState().errors.size() == 1);
    CHECK(driver.GetState().errors[0].errorType == VDA5050::ErrorTypes::ORDER_ERROR);
}

TEST_CASE("6.8 waitForTrigger waits for its trigger, however long that takes")
{
    VehicleDriver driver("N0");
    driver.Send(driver.MakeOrderWith(VDA5050::ActionTypes::WAIT_FOR_TRIGGER, "wait"));
    driver.Pass(300s);
    CHECK(driver.GetStatus("wait") == EActionStatus::Running);
    CHECK(driver.Trigger() == 1);
    driver.Pass(100ms);
    CHECK(driver.GetStatus("wait") == EActionStatus::Finished);
    CHECK(driver.Trigger() == 0);
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("6.8 waitForTrigger that is triggered during a pause ends after the pause")
{
    VehicleDriver driver("N0");
    driver.Send(driver.MakeOrderWith(VDA5050::ActionTypes::WAIT_FOR_TRIGGER, "wait"));
    driver.Pass(60s);
    REQUIRE(driver.GetStatus("wait") == EActionStatus::Running);
    driver.SendInstantly(VDA5050::ActionTypes::START_PAUSE, "pause");
    CHECK(driver.GetStatus("wait") == EActionStatus::Paused);
    CHECK(driver.Trigger() == 1);
    driver.Pass(100ms);
    CHECK(driver.GetStatus("wait") == EActionStatus::Paused);
    driver.SendInstantly(VDA5050::ActionTypes::STOP_PAUSE, "go");
    driver.Pass(1s);
    CHECK(driver.GetStatus("wait") == EActionStatus::Finished);
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
}

TEST_CASE("6.8 logReport names its log, and the time of an action's type can be set")
{
    VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("N0");
    options.actionSeconds["logReport"] = 7.0;
    VehicleDriver driver(std::move(options));
    driver.SendInstantly(VDA5050::ActionTypes::LOG_REPORT, "log", {MakeText("reason", "test")});
    driver.Pass(6900ms);
    CHECK(driver.GetStatus("log") == EActionStatus::Running);
    driver.Pass(200ms);
    CHECK(driver.GetStatus("log") == EActionStatus::Finished);
    CHECK_FALSE(driver.GetState().actionStates.front().resultDescription.empty());
}

} // namespace ACS::Testing
