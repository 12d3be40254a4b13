#include "vda-sim/VehicleProfile.hpp"

#include "Catch.hpp"
#include "vda-sim/ProfileRules.hpp"
#include "VehicleDriver.hpp"
#include <acs/vda5050/MasterOptions.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::Action;
using VDA5050::EActionStatus;
using VDA5050::EBlockingType;
using VDA5050::ETopic;
using VDA5050::OrderMessage;
using VdaSim::EVehicleProfile;

constexpr double PLACE_MARGIN = 1e-9;

VdaSim::VirtualVehicleOptions MakeOptions(EVehicleProfile profile)
{
    VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("N0");
    options.profile = profile;
    return options;
}

Action MakeWork(std::string_view actionType, const std::string& actionID)
{
    Action action;
    action.actionType = std::string(actionType);
    action.actionID = actionID;
    action.blockingType = EBlockingType::Hard;
    action.actionParameters.push_back({"loadId", Core::JsonText::FromString("CASSETTE-1")});
    action.actionParameters.push_back({"lhd", Core::JsonText::FromString("CP01")});
    AddMandatoryParameters(action);
    return action;
}

void Add(Action& action, std::string_view key, std::string_view value)
{
    action.actionParameters.push_back({std::string(key), Core::JsonText::FromString(value)});
}

/// All profiles accept it. A physical line needs no positions.
OrderMessage MakeOrder(VehicleDriver& driver, EVehicleProfile profile, const std::string& orderID = "order-1")
{
    auto order = VehicleDriver::Take(driver.MakeRoute(orderID, {"N0", "N1", "N2"}).MakeOrder(3));
    order.nodes[1].actions.push_back(MakeWork("pick", orderID + "-pick"));
    if (profile == EVehicleProfile::LineGuided)
    {
        std::ranges::for_each(order.nodes, [](VDA5050::OrderNode& node) { node.nodePosition.reset(); });
    }
    return order;
}

struct Violation
{
    EVehicleProfile profile;
    std::string_view key;
    std::string_view value;
    std::function<void(OrderMessage&)> change;
};

/// A straight curve from N0 to N1.
VDA5050::Trajectory MakeLine(std::uint32_t points)
{
    VDA5050::Trajectory line;
    line.degree = 1;
    line.knotVector.push_back(0.0);
    for (std::uint32_t i = 0; i < points; ++i)
    {
        line.controlPoints.push_back({10.0 * i / (points - 1), 0.0, {}});
        line.knotVector.push_back(static_cast<double>(i) / (points - 1));
    }
    line.knotVector.push_back(1.0);
    return line;
}

std::vector<Violation> MakeLengthViolations()
{
    constexpr auto PROFILE = EVehicleProfile::StrictLengths;
    const auto addNode = [](OrderMessage& order) {
        VDA5050::OrderEdge back = order.edges[1];
        back.edgeID = "N2-N1";
        back.sequenceID = 5;
        std::swap(back.startNodeID, back.endNodeID);
        order.edges.push_back(back);
        VDA5050::OrderNode node = order.nodes[1];
        node.sequenceID = 6;
        node.actions.clear();
        order.nodes.push_back(node);
    };
    return {
        {PROFILE, "parameter", "maxArrayLens.order.nodes", addNode},
        {PROFILE, "parameter", "maxArrayLens.order.edges", addNode},
        {PROFILE,
         "parameter",
         "maxArrayLens.node.actions",
         [](OrderMessage& order) {
             order.nodes[1].actions.push_back(MakeWork("finePositioning", "more"));
             order.nodes[1].actions.back().actionParameters.clear();
         }},
        {PROFILE,
         "parameter",
         "maxArrayLens.edge.actions",
         [](OrderMessage& order) {
             for (const char* const actionID : {"one", "two"})
             {
                 Action& action = order.edges[0].actions.emplace_back();
                 action.actionType = "detectObject";
                 action.actionID = actionID;
             }
         }},
        {PROFILE,
         "parameter",
         "maxArrayLens.actions.actionsParameters",
         [](OrderMessage& order) {
             for (const char* const key : {"stationName", "side", "depth"})
             {
                 Add(order.nodes[1].actions[0], key, "any");
             }
             order.nodes[1].actions[0].actionParameters.back().value = Core::JsonText::FromNumber(0.5);
         }},
        {PROFILE,
         "parameter",
         "maxArrayLens.trajectory.controlPoints",
         [](OrderMessage& order) {
             order.edges[0].trajectory = MakeLine(5);
         }},
        {PROFILE,
         "parameter",
         "maxStringLens.idLen",
         [](OrderMessage& order) {
             order.orderID = std::string(37, 'x');
         }},
        {PROFILE, "parameter", "maxStringLens.msgLen", [](OrderMessage& order) {
             order.nodes[1].nodeDescription = std::string(4096, 'x');
         }}};
}

std::vector<Violation> MakePartialViolations()
{
    constexpr auto PROFILE = EVehicleProfile::PartialFactsheet;
    return {
        {PROFILE,
         "parameter",
         "order.nodes.nodePosition.theta",
         [](OrderMessage& order) {
             order.nodes[2].nodePosition->theta = 0.0;
         }},
        {PROFILE,
         "parameter",
         "order.nodes.nodePosition.allowedDeviationXY",
         [](OrderMessage& order) {
             order.nodes[0].nodePosition->allowedDeviationXY = 0.5;
         }},
        {PROFILE,
         "parameter",
         "order.nodes.nodePosition.allowedDeviationTheta",
         [](OrderMessage& order) {
             order.nodes[0].nodePosition->allowedDeviationTheta = 0.5;
         }},
        {PROFILE,
         "parameter",
         "order.edges.orientationType",
         [](OrderMessage& order) {
             order.edges[0].orientationType = VDA5050::EOrientationType::Global;
         }},
        {PROFILE,
         "parameter",
         "order.edges.maxRotationSpeed",
         [](OrderMessage& order) {
             order.edges[0].maxRotationSpeed = 1.0;
         }},
        {PROFILE,
         "parameter",
         "order.edges.length",
         [](OrderMessage& order) {
             order.edges[0].length = 10.0;
         }},
        {PROFILE,
         "parameter",
         "order.edges.trajectory",
         [](OrderMessage& order) {
             order.edges[0].trajectory = MakeLine(2);
         }},
        {PROFILE,
         "parameter",
         "side",
         [](OrderMessage& order) {
             Add(order.nodes[1].actions[0], "side", "left");
         }},
        {PROFILE, "parameter", "actionType", [](OrderMessage& order) {
             order.nodes[1].actions[0] = MakeWork("finePositioning", "work");
             order.nodes[1].actions[0].actionParameters.clear();
         }}};
}

std::vector<Violation> MakeOtherViolations()
{
    constexpr auto NODE_ACTIONS = EVehicleProfile::NodeActions;
    constexpr std::string_view POSITION = "order.nodes.nodePosition";
    const auto dropHorizon = [](OrderMessage& order) {
        order.nodes[2].bReleased = false;
        order.edges[1].bReleased = false;
    };
    const auto keepFirst = [](OrderMessage& order) {
        order.nodes[0].actions.push_back(order.nodes[1].actions[0]);
        order.nodes.resize(1);
        order.edges.clear();
    };
    return {
        {EVehicleProfile::NoHorizon, "edgeId", "N1-N2", dropHorizon},
        {EVehicleProfile::NoHorizon, "nodeId", "N2", dropHorizon},
        {NODE_ACTIONS,
         "parameter",
         POSITION,
         [](OrderMessage& order) {
             order.nodes[1].nodePosition.reset();
         }},
        {NODE_ACTIONS,
         "parameter",
         POSITION,
         [keepFirst](OrderMessage& order) {
             keepFirst(order);
             order.nodes[0].nodePosition.reset();
         }},
        {NODE_ACTIONS,
         "parameter",
         POSITION,
         [keepFirst](OrderMessage& order) {
             keepFirst(order);
             order.nodes[0].nodePosition->x = 2 * VdaSim::PLACE_TOLERANCE;
         }},
        {NODE_ACTIONS,
         "edgeId",
         "N0-N1",
         [](OrderMessage& order) {
             order.edges[0].actions.push_back(MakeWork("finePositioning", "work"));
             order.edges[0].actions[0].actionParameters.clear();
         }},
        {EVehicleProfile::Blocking,
         "parameter",
         "blockingType",
         [](OrderMessage& order) {
             order.nodes[1].actions[0].blockingType = EBlockingType::Soft;
         }},
        {EVehicleProfile::Blocking,
         "parameter",
         "blockingType",
         [](OrderMessage& order) {
             order.nodes[1].actions[0].blockingType = EBlockingType::None;
         }},
        {EVehicleProfile::LineGuided,
         "parameter",
         POSITION,
         [](OrderMessage& order) {
             order.nodes[1].nodePosition = VDA5050::NodePosition{10.0, 0.0, {}, {}, {}, "floor", {}};
         }},
        {EVehicleProfile::LineGuided, "parameter", "order.edges.trajectory", [](OrderMessage& order) {
             order.edges[0].trajectory = MakeLine(2);
         }}};
}

std::vector<Violation> MakeViolations()
{
    std::vector<Violation> all = MakeLengthViolations();
    for (const std::vector<Violation>& more : {MakePartialViolations(), MakeOtherViolations()})
    {
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

VDA5050::FactsheetMessage ReadFactsheet(const VehicleDriver& driver)
{
    for (const auto& [time, message] : driver.GetPublished())
    {
        if (message.topic.ends_with("/factsheet"))
        {
            VDA5050::Vda5050Codec codec;
            return VehicleDriver::Take(codec.Decode<VDA5050::FactsheetMessage>(message.payload));
        }
    }
    throw std::runtime_error("no factsheet was published");
}

} // namespace

TEST_CASE("A profile has a name")
{
    CHECK(VdaSim::GetProfiles().size() == 9);
    for (const VdaSim::VehicleProfile& profile : VdaSim::GetProfiles())
    {
        CHECK(VdaSim::ParseProfile(profile.name) == profile.profile);
        CHECK(&VdaSim::GetProfile(profile.profile) == &profile);
    }
    const auto unknown = VdaSim::ParseProfile("fast");
    REQUIRE_FALSE(unknown.has_value());
    CHECK_THAT(Core::Describe(unknown.error()), Catch::Contains("one of standard, strict-lengths"));
}

TEST_CASE("Each profile executes a correct order, and the job order after it")
{
    for (const VdaSim::VehicleProfile& profile : VdaSim::GetProfiles())
    {
        CAPTURE(profile.name);
        VehicleDriver driver(MakeOptions(profile.profile));
        driver.Send(MakeOrder(driver, profile.profile));
        driver.Pass(60s);
        VDA5050::StateMessage state = driver.GetState();
        CHECK(state.errors.empty());
        CHECK(state.lastNodeID == "N2");
        CHECK(driver.GetStatus("order-1-pick") == EActionStatus::Finished);
        CHECK(state.loads->size() == 1);
        OrderMessage job = MakeOrder(driver, profile.profile, "job");
        job.nodes.erase(job.nodes.begin(), job.nodes.begin() + 2);
        job.nodes[0].sequenceID = 0;
        job.nodes[0].actions = {MakeWork("drop", "job-drop")};
        job.edges.clear();
        driver.Send(job);
        driver.Pass(20s);
        state = driver.GetState();
        CHECK(state.errors.empty());
        CHECK(driver.GetStatus("job-drop") == EActionStatus::Finished);
        CHECK(state.loads->empty());
    }
}

TEST_CASE("6.6.4 Each violation of a profile's rules is rejected with an orderError that refers to it")
{
    for (const Violation& violation : MakeViolations())
    {
        CAPTURE(VdaSim::GetProfile(violation.profile).name, violation.key, violation.value);
        VehicleDriver driver(MakeOptions(violation.profile));
        OrderMessage wrong = MakeOrder(driver, violation.profile);
        violation.change(wrong);
        driver.Send(wrong);
        driver.Pass(5s);
        VDA5050::StateMessage state = driver.GetState();
        CHECK(state.orderID.empty());
        CHECK(state.actionStates.empty());
        CHECK(driver.GetPose() == VdaSim::Pose{});
        REQUIRE_FALSE(state.errors.empty());
        for (const VDA5050::VehicleError& error : state.errors)
        {
            CHECK(error.errorType == VDA5050::ErrorTypes::ORDER_ERROR);
            CHECK(HasReference(error, "orderId", wrong.orderID));
        }
        CHECK(std::ranges::any_of(state.errors, [&violation](const VDA5050::VehicleError& error) {
            return HasReference(error, violation.key, violation.value);
        }));
        driver.Send(MakeOrder(driver, violation.profile, "order-2"));
        driver.Pass(1s);
        CHECK(driver.GetState().orderID == "order-2");
        CHECK(driver.GetState().errors.empty());
        VehicleDriver tolerant(MakeOptions(EVehicleProfile::Standard));
        tolerant.Send(wrong);
        CHECK(tolerant.GetState().orderID == wrong.orderID);
    }
}

TEST_CASE("6.6.4 A vehicle without a horizon rejects an update that has one, and drives its base to the end")
{
    VehicleDriver driver(MakeOptions(EVehicleProfile::NoHorizon));
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2", "DOCK"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2, 0)));
    auto refused = route;
    driver.Send(VehicleDriver::Take(refused.MakeUpdate(3)));
    driver.Pass(60s);
    CHECK(driver.GetState().orderUpdateID == 0);
    REQUIRE(driver.GetState().errors.size() == 1);
    CHECK(HasReference(driver.GetState().errors[0], "edgeId", "N2-DOCK"));
    CHECK(HasReference(driver.GetState().errors[0], "orderUpdateId", "1"));
    CHECK(driver.GetState().lastNodeID == "N1");
    driver.Send(VehicleDriver::Take(route.MakeUpdate(3, 0)));
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK(ReadFactsheet(driver).protocolLimits.maxArrayLengths.orderNodes == 1000);
}

TEST_CASE("6.10.3 In MANUAL a manual-clears vehicle forgets order, actions and node, but not its loads")
{
    for (const auto profile : {EVehicleProfile::Standard, EVehicleProfile::ManualClears})
    {
        const bool bForgets = profile == EVehicleProfile::ManualClears;
        CAPTURE(bForgets);
        VehicleDriver driver(MakeOptions(profile));
        OrderMessage order = MakeOrder(driver, profile);
        driver.Send(order);
        REQUIRE(driver.TryPassUntil([&]() { return !driver.GetState().loads->empty(); }, 60s));
        driver.Pass(2s);
        driver.Inject("mode for=3s");
        driver.Pass(2s);
        VDA5050::StateMessage state = driver.GetState();
        CHECK(state.operatingMode == VDA5050::EOperatingMode::Manual);
        CHECK(state.orderID == (bForgets ? "" : "order-1"));
        CHECK(state.actionStates.size() == (bForgets ? 0 : 1));
        CHECK(state.lastNodeID == (bForgets ? "" : "N1"));
        CHECK(state.nodeStates.empty());
        CHECK(state.loads->size() == 1);
        driver.Pass(2s);
        order = MakeOrder(driver, profile, "order-2");
        order.nodes.erase(order.nodes.begin());
        order.edges.erase(order.edges.begin());
        order.nodes[0].sequenceID = 0;
        order.nodes[0].actions.clear();
        order.nodes[0].nodePosition->allowedDeviationXY = 5.0;
        order.edges[0].sequenceID = 1;
        order.nodes[1].sequenceID = 2;
        driver.Send(order);
        driver.Pass(60s);
        CHECK(driver.GetState().errors.empty());
        CHECK(driver.GetState().lastNodeID == "N2");
    }
}

TEST_CASE("6.6 A slow vehicle shows an order after longer than the resend interval, and executes it once")
{
    VehicleDriver driver(MakeOptions(EVehicleProfile::SlowAccept));
    auto route = driver.MakeRoute("order-1", {"N0", "N1", "N2"});
    OrderMessage order = VehicleDriver::Take(route.MakeOrder(2));
    order.nodes[0].actions.push_back(MakeWork("pick", "work"));
    const std::chrono::milliseconds resend = VDA5050::MasterOptions{}.resendInterval;
    driver.Send(order);
    driver.Pass(resend);
    CHECK(driver.GetState().orderID.empty());
    driver.Send(order);
    driver.Pass(resend);
    CHECK(driver.GetState().orderID == "order-1");
    driver.Pass(1s);
    const OrderMessage update = VehicleDriver::Take(route.MakeUpdate(3));
    driver.Send(update);
    driver.Send(update);
    driver.Pass(resend);
    CHECK(driver.GetState().orderUpdateID == 0);
    driver.Pass(60s);
    CHECK(driver.GetState().orderUpdateID == 1);
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK(driver.GetState().errors.empty());
    CHECK(driver.GetState().loads->size() == 1);
    CHECK(driver.GetState().actionStates.size() == 1);
}

TEST_CASE("6.6 A cancelOrder that follows an order does not overtake it on a slow vehicle")
{
    VehicleDriver driver(MakeOptions(EVehicleProfile::SlowAccept));
    driver.Send(MakeOrder(driver, EVehicleProfile::SlowAccept));
    driver.SendInstantly("cancelOrder", "cancel");
    driver.Pass(60s);
    CHECK(driver.GetStatus("cancel") == EActionStatus::Finished);
    CHECK(driver.GetState().nodeStates.empty());
    CHECK(driver.GetState().loads->empty());
    CHECK_FALSE(driver.GetState().bDriving);
}

TEST_CASE("6.11 A vehicle of the profile blocking is stationary, exactly on its node, while an action runs there")
{
    VehicleDriver driver(MakeOptions(EVehicleProfile::Blocking));
    driver.Send(MakeOrder(driver, EVehicleProfile::Blocking));
    std::size_t count = 0;
    driver.Pass(60s, [&]() {
        const VDA5050::StateMessage state = driver.GetState();
        if (driver.GetStatus("order-1-pick") == EActionStatus::Running)
        {
            ++count;
            CHECK_FALSE(state.bDriving);
            CHECK(driver.GetSpeed() == 0.0);
            CHECK(driver.GetPose().x == Approx(10.0).margin(PLACE_MARGIN));
            CHECK(driver.GetPose().y == Approx(0.0).margin(PLACE_MARGIN));
        }
    });
    CHECK(count > 0);
    CHECK(driver.GetState().lastNodeID == "N2");
    const VDA5050::FactsheetMessage factsheet = ReadFactsheet(driver);
    CHECK(factsheet.protocolFeatures.agvActions.size() > 10);
}

TEST_CASE("6.10.6 A line-guided vehicle reports where it is by lastNodeId only")
{
    VehicleDriver driver(MakeOptions(EVehicleProfile::LineGuided));
    CHECK(ReadFactsheet(driver).typeSpecification.navigationTypes == std::vector<std::string>{"PHYSICAL_LINE_GUIDED"});
    driver.Send(MakeOrder(driver, EVehicleProfile::LineGuided));
    driver.Pass(3s);
    driver.SendInstantly("cancelOrder", "cancel");
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N1");
    CHECK(driver.GetStatus("cancel") == EActionStatus::Finished);
    CHECK(driver.GetTimes(ETopic::Visualization).empty());
    for (const auto& [time, message] : driver.GetPublished())
    {
        CHECK(message.payload.find("agvPosition") == std::string::npos);
        CHECK(message.payload.find("velocity") == std::string::npos);
        CHECK(message.payload.find("\"maps\"") == std::string::npos);
    }
}

} // namespace ACS::Testing
