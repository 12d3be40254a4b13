#include "robots/VehicleCompatibility.hpp"

#include "Catch.hpp"
#include "robots/VehicleFixture.hpp"
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/OrderValidator.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <random>

namespace ACS::Acsd::Test
{

namespace
{

using Planning::CompatibilityChanged;
using VDA5050::EParameterSupport;
using VDA5050::FactsheetMessage;

/// Nodes A, B and C in a line, with a speed on the second edge.
std::shared_ptr<DriveCheck> MakeDrives()
{
    std::vector<Planning::SiteNode> nodes;
    for (const auto& [nodeID, x] : {std::pair("A", 0.0), std::pair("B", 2.0), std::pair("C", 4.0)})
    {
        nodes.push_back({nodeID, x, 1.0, "floor-1", {{"T", 0.5}}});
    }
    Planning::SiteEdgeRule plain{"T", std::nullopt, std::nullopt, std::nullopt, {}, std::nullopt, std::nullopt};
    Planning::SiteEdgeRule slow = plain;
    slow.maxSpeed = 0.4;
    const auto site = Planning::SiteMap::Create(nodes, {{"AB", "A", "B", {plain}}, {"BC", "B", "C", {slow}}}, {});
    REQUIRE(site);
    return std::make_shared<DriveCheck>(VehicleMap(*site, "T"));
}

/// A vehicle that does CassetteLoad by pick and CassetteUnload by drop on that map.
struct CompatibilityFixture : VehicleFixture
{
    explicit CompatibilityFixture(
        VDA5050::MasterOptions options = MakeOptions(),
        std::shared_ptr<DriveCheck> drives = MakeDrives())
        : VehicleFixture(
            JobMethods{{"CassetteLoad", {"pick", 0}}, {"CassetteUnload", {"drop", 0}}},
            std::move(options),
            std::move(drives))
    {
    }

    /// What the adapter reported last; "none" if it has reported nothing since.
    std::string Send(const FactsheetMessage& factsheet)
    {
        actions.clear();
        Receive("factsheet", factsheet);
        const auto events = TakeEvents<CompatibilityChanged>();
        return events.empty() ? "none" : events.back().incompatibility;
    }
};

void List(FactsheetMessage& factsheet, std::initializer_list<const char*> members)
{
    factsheet.protocolFeatures.optionalParameters.emplace();
    for (const char* member : members)
    {
        factsheet.protocolFeatures.optionalParameters->push_back({member, EParameterSupport::Supported, {}});
    }
}

/// A factsheet with limits, members and actions at random, some of them contradictory.
FactsheetMessage MakeRandomFactsheet(std::mt19937& random)
{
    const auto draw = [&random](std::uint32_t most) {
        return std::uniform_int_distribution<std::uint32_t>(0, most)(random);
    };
    FactsheetMessage factsheet;
    factsheet.physicalParameters.speedMax = draw(1) * 1.5;
    VDA5050::MaximumArrayLengths& arrays = factsheet.protocolLimits.maxArrayLengths;
    for (auto* const limit :
         {&arrays.orderNodes,
          &arrays.orderEdges,
          &arrays.nodeActions,
          &arrays.actionParameters,
          &arrays.stateNodeStates})
    {
        if (draw(3) == 0)
        {
            *limit = draw(5);
        }
    }
    VDA5050::MaximumStringLengths& strings = factsheet.protocolLimits.maxStringLengths;
    if (draw(5) == 0)
    {
        strings.identifier = draw(40);
    }
    if (draw(3) == 0)
    {
        strings.message = 200 + draw(1500);
    }
    if (draw(2) != 0)
    {
        auto& list = factsheet.protocolFeatures.optionalParameters.emplace();
        for (const char* member :
             {"order.nodes.nodePosition",
              "order.nodes.nodePosition.theta",
              "order.nodes.nodePosition.allowedDeviationXY",
              "order.nodes.nodePosition.allowedDeviationTheta",
              "order.edges.maxSpeed",
              "order.edges.orientation",
              "order.edges.orientationType",
              "order.edges.rotationAllowed",
              "order.edges.length",
              "order.edges.colour"})
        {
            for (std::uint32_t i = draw(4); i < 3; ++i)
            {
                list.push_back({member, draw(4) == 0 ? EParameterSupport::Required : EParameterSupport::Supported, {}});
            }
        }
    }
    for (const VDA5050::AgvAction& action : VDA5050::GetPredefinedActions())
    {
        if (draw(2) == 0)
        {
            VDA5050::AgvAction& listed = factsheet.protocolFeatures.agvActions.emplace_back(action);
            listed.actionScopes.resize(std::min<std::size_t>(listed.actionScopes.size(), draw(3)));
        }
    }
    return factsheet;
}

} // namespace

TEST_CASE("A vehicle without a factsheet, or with one that allows all, is compatible")
{
    CompatibilityFixture vehicle;
    vehicle.ComeOnline();
    CHECK(vehicle.TakeEvents<CompatibilityChanged>().empty());
    CHECK(vehicle.Send(StandardFactsheet().factsheet) == "none");
}

TEST_CASE("A vehicle that does not support what the map demands is incompatible until its factsheet changes")
{
    CompatibilityFixture vehicle;
    vehicle.ComeOnline();
    FactsheetMessage factsheet = StandardFactsheet().factsheet;
    List(factsheet, {});
    CHECK(
        vehicle.Send(factsheet)
        == "the drive from B to C cannot be ordered: the vehicle does not support order.edges.maxSpeed. Correct the factsheet "
           "(of the vehicle, or robots.NAME.factsheet_file) or the map.");
    CHECK(vehicle.Send(factsheet) == "none"); // it is known
    List(factsheet, {"order.edges.maxSpeed"});
    CHECK(vehicle.Send(factsheet).empty());
}

TEST_CASE("Vehicles with equal factsheets share one check of the map; the results of few factsheets are kept")
{
    const std::shared_ptr<DriveCheck> drives = MakeDrives();
    FactsheetMessage factsheet = StandardFactsheet().factsheet;
    List(factsheet, {});
    factsheet.vehicleConfig.emplace();
    for (const char* address : {"10.0.0.1", "10.0.0.2"})
    {
        factsheet.vehicleConfig->network.emplace().localIpAddress = address;
        CompatibilityFixture vehicle(CompatibilityFixture::MakeOptions(), drives);
        vehicle.ComeOnline();
        CHECK_THAT(vehicle.Send(factsheet), Catch::Contains("does not support order.edges.maxSpeed"));
        CHECK(drives->CountFactsheets() == 1);
    }
    for (std::uint32_t limit = 1; limit < 2 * DriveCheck::MOST_FACTSHEETS; ++limit)
    {
        CAPTURE(limit);
        FactsheetMessage other = StandardFactsheet().factsheet;
        other.protocolLimits.maxArrayLengths.orderNodes = limit;
        CompatibilityFixture vehicle(CompatibilityFixture::MakeOptions(), drives);
        vehicle.ComeOnline();
        CHECK((vehicle.Send(other) == "none") == (limit > 1));
    }
    CHECK(drives->CountFactsheets() == DriveCheck::MOST_FACTSHEETS);
}

TEST_CASE("A vehicle with limits that make driving impossible is incompatible, and the limit is named")
{
    CompatibilityFixture vehicle;
    vehicle.ComeOnline();
    FactsheetMessage factsheet;
    VDA5050::ProtocolLimits& limits = factsheet.protocolLimits;
    SECTION("nodes")
    {
        limits.maxArrayLengths.orderNodes = 1;
        CHECK_THAT(vehicle.Send(factsheet), Catch::Contains("maxArrayLens.order.nodes is 1, found 2"));
    }
    const std::string own =
        "Correct the factsheet (of the vehicle, or robots.NAME.factsheet_file): the ids of orders are those of acsd.";
    SECTION("ids")
    {
        limits.maxStringLengths.identifier = 35;
        const std::string reported = vehicle.Send(factsheet);
        CHECK_THAT(reported, Catch::Contains("maxStringLens.idLen is 35, found 36"));
        CHECK_THAT(reported, Catch::EndsWith(own));
    }
    SECTION("digits only")
    {
        limits.maxStringLengths.bIdentifierNumericalOnly = true;
        const std::string reported = vehicle.Send(factsheet);
        CHECK_THAT(reported, Catch::Contains("maxStringLens.idNumericalOnly"));
        CHECK_THAT(reported, Catch::EndsWith(own));
    }
    SECTION("two nodes, and lengths of 0, are enough")
    {
        limits.maxArrayLengths.orderNodes = 2;
        limits.maxArrayLengths.orderEdges = 0;
        limits.maxStringLengths.identifier = 0;
        CHECK(vehicle.Send(factsheet) == "none");
    }
}

TEST_CASE("Where ids of the map are too long for the vehicle, the map can be corrected too")
{
    const std::string nodeID(40, 'n');
    const auto site = Planning::SiteMap::Create(
        {{nodeID, 0.0, 0.0, "floor-1", {{"T", std::nullopt}}}, {"B", 2.0, 0.0, "floor-1", {{"T", std::nullopt}}}},
        {{"E", nodeID, "B", {{"T", std::nullopt, std::nullopt, std::nullopt, {}, std::nullopt, std::nullopt}}}},
        {});
    REQUIRE(site);
    CompatibilityFixture vehicle(
        CompatibilityFixture::MakeOptions(),
        std::make_shared<DriveCheck>(VehicleMap(*site, "T")));
    vehicle.ComeOnline();
    FactsheetMessage factsheet;
    factsheet.protocolLimits.maxStringLengths.identifier = 39;
    const std::string reported = vehicle.Send(factsheet);
    CHECK_THAT(reported, Catch::Contains("maxStringLens.idLen is 39, found 40"));
    CHECK_THAT(reported, Catch::EndsWith("robots.NAME.factsheet_file) or the map, which has longer ids."));
}

TEST_CASE("A vehicle without zone sets is incompatible with one in the configuration, whose key is named")
{
    VDA5050::MasterOptions options = CompatibilityFixture::MakeOptions();
    options.zoneSetID = "hall-2";
    CompatibilityFixture vehicle(std::move(options));
    vehicle.ComeOnline();
    FactsheetMessage factsheet;
    List(factsheet, {"order.edges.maxSpeed"});
    CHECK_THAT(
        vehicle.Send(factsheet),
        Catch::EndsWith("the vehicle does not support order.zoneSetId. Correct the factsheet (of the vehicle, or "
                        "robots.NAME.factsheet_file) or site.zone_set."));
}

TEST_CASE("A vehicle that can do none of its jobs is incompatible; one that can do some is not")
{
    CompatibilityFixture vehicle;
    vehicle.ComeOnline();
    StandardFactsheet standard;
    std::vector<VDA5050::AgvAction>& listed = standard.factsheet.protocolFeatures.agvActions;
    std::erase_if(listed, [](const VDA5050::AgvAction& action) { return action.actionType != "pick"; });
    listed[0].actionParameters.clear();
    CHECK(vehicle.Send(standard.factsheet) == "none");
    SECTION("another action")
    {
        listed[0].actionType = "lift";
        CHECK_THAT(
            vehicle.Send(standard.factsheet),
            Catch::Contains("it can do none of its jobs: the vehicle's factsheet does not list pick"));
    }
    SECTION("not on nodes")
    {
        listed[0].actionScopes = {VDA5050::EActionScope::Edge};
        CHECK_THAT(vehicle.Send(standard.factsheet), Catch::Contains("does not list pick with the scope NODE"));
    }
}

TEST_CASE("A job order has the position of its node, unless the vehicle does not support it")
{
    CompatibilityFixture vehicle;
    vehicle.ComeOnline();
    FactsheetMessage factsheet;
    const bool bSupported = GENERATE(true, false);
    List(factsheet, {"order.edges.maxSpeed"});
    if (bSupported)
    {
        factsheet.protocolFeatures.optionalParameters->push_back(
            {"order.nodes.nodePosition", EParameterSupport::Required, {}});
    }
    static_cast<void>(vehicle.Send(factsheet));
    vehicle.state.lastNodeID = "B";
    vehicle.ShowState();
    vehicle.Command(MakeJob("CassetteLoad"));
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    REQUIRE(orders[0].nodes[0].nodePosition.has_value() == bSupported);
    if (bSupported)
    {
        CHECK(orders[0].nodes[0].nodePosition->x == 2.0);
        CHECK(orders[0].nodes[0].nodePosition->mapID == "floor-1");
    }
}

TEST_CASE("A base is sent in parts that the vehicle accepts, and the drive ends at its last node only")
{
    CompatibilityFixture vehicle;
    vehicle.ComeOnline();
    FactsheetMessage factsheet;
    factsheet.protocolLimits.maxArrayLengths.orderNodes = 2;
    static_cast<void>(vehicle.Send(factsheet));
    Planning::Drive drive = MakeDrive();
    drive.releasedCount = 3;
    vehicle.Command(drive);
    auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].nodes.size() == 2);
    SECTION("the vehicle confirms while it drives")
    {
        vehicle.ShowOrder(orders[0], {"B"});
        vehicle.ShowState();
    }
    SECTION("the vehicle has reached the end of the first part")
    {
        vehicle.ShowOrder(orders[0], {});
        vehicle.ShowAt("B", 2);
        vehicle.ShowState();
        CHECK(vehicle.TakeEvents<Planning::Arrived>().empty());
    }
    orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].orderUpdateID == 1);
    REQUIRE(orders[0].nodes.size() == 2);
    CHECK(orders[0].nodes[0].nodeID == "B");
    CHECK(orders[0].nodes[1].nodeID == "C");
    CHECK(orders[0].nodes[1].bReleased);
    vehicle.ShowOrder(orders[0], {});
    vehicle.ShowAt("C", 4);
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::Arrived>().size() == 1);
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
}

TEST_CASE("A part waits while the vehicle's state has no room for it")
{
    CompatibilityFixture vehicle;
    vehicle.ComeOnline();
    FactsheetMessage factsheet;
    factsheet.protocolLimits.maxArrayLengths.stateNodeStates = 1;
    static_cast<void>(vehicle.Send(factsheet));
    Planning::Drive drive = MakeDrive();
    drive.releasedCount = 3;
    vehicle.Command(drive);
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].nodes.size() == 2);
    vehicle.ShowOrder(orders[0], {"B"});
    vehicle.ShowState();
    CHECK(vehicle.TakeOrders().empty());
    vehicle.ShowOrder(orders[0], {});
    vehicle.ShowAt("B", 2);
    vehicle.ShowState();
    CHECK(vehicle.TakeOrders().size() == 1);
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
}

TEST_CASE("A vehicle is reported as incompatible before it can be given a plan")
{
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.bFactsheetRequested = true;
    CompatibilityFixture vehicle(options);
    vehicle.ComeOnline();
    vehicle.actions.clear();
    FactsheetMessage factsheet;
    List(factsheet, {});
    vehicle.Receive("factsheet", factsheet);
    std::vector<std::string> raised;
    for (const Planning::AdapterAction& action : vehicle.actions)
    {
        if (const auto* const raise = std::get_if<Planning::RaiseEvent>(&action))
        {
            raised.emplace_back(
                std::holds_alternative<CompatibilityChanged>(raise->event) ? "incompatible" : "job check");
        }
    }
    CHECK(raised == std::vector<std::string>{"incompatible", "job check"});
}

TEST_CASE("With a factsheet of the configuration none is awaited, and a received one replaces it")
{
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.bFactsheetRequested = true;
    options.factsheet.emplace();
    List(*options.factsheet, {});
    CompatibilityFixture vehicle(options);
    vehicle.ComeOnline();
    const auto events = vehicle.TakeEvents<CompatibilityChanged>();
    REQUIRE(events.size() == 1);
    CHECK_THAT(events[0].incompatibility, Catch::Contains("order.edges.maxSpeed"));
    const auto checks = vehicle.TakeEvents<Planning::JobCheckChanged>();
    REQUIRE_FALSE(checks.empty());
    CHECK_FALSE(checks.back().jobCheck->GetRejectionReasonOrNull(MakeJob("CassetteUnload")).has_value());
    CHECK(vehicle.Send(FactsheetMessage()).empty());
}

TEST_CASE("Whatever the factsheet, no order is sent that it does not allow")
{
    std::mt19937 random(18); // NOLINT(cert-msc32-c,cert-msc51-cpp): the same factsheets in each run
    const std::shared_ptr<DriveCheck> drives = MakeDrives();
    std::size_t sentDrives = 0;
    std::size_t sentJobs = 0;
    std::size_t incompatible = 0;
    for (int round = 0; round < 500; ++round)
    {
        CAPTURE(round);
        CompatibilityFixture vehicle(CompatibilityFixture::MakeOptions(), drives);
        vehicle.ComeOnline();
        const FactsheetMessage factsheet = MakeRandomFactsheet(random);
        const std::string incompatibility = vehicle.Send(factsheet);
        incompatible += incompatibility == "none" ? 0U : 1U;
        const bool bDrive = round % 2 == 0;
        if (bDrive)
        {
            Planning::Drive drive = MakeDrive();
            drive.releasedCount = 3;
            vehicle.Command(drive);
        }
        else
        {
            vehicle.Command(MakeJob("CassetteUnload"));
        }
        VDA5050::OrderContext context;
        context.factsheet = &factsheet;
        context.lastNodeID = "A";
        for (const VDA5050::MqttMessage& message : vehicle.outputs.messages)
        {
            context.payloadBytes = message.topic.ends_with("/order") ? message.payload.size() : 0;
        }
        for (const VDA5050::OrderMessage& order : vehicle.TakeOrders())
        {
            const VDA5050::OrderJudgement judgement = VDA5050::JudgeOrder(order, context);
            INFO((judgement.violations.empty() ? std::string() : judgement.violations.front().rule));
            CHECK(judgement.verdict == VDA5050::EOrderVerdict::NewOrder);
            sentDrives += bDrive ? 1U : 0U;
            sentJobs += bDrive ? 0U : 1U;
        }
    }
    CHECK(sentDrives > 10);
    CHECK(sentJobs > 10);
    CHECK(incompatible > 10);
}

} // namespace ACS::Acsd::Test
