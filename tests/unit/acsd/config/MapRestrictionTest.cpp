#include "config/MapRestriction.hpp"

#include "Catch.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

Planning::SiteEdge MakeSiteEdge(std::string edgeID, std::string from, std::string to)
{
    Planning::SiteEdge edge{std::move(edgeID), std::move(from), std::move(to), {}};
    for (const char* const type : {"lr", "cr"})
    {
        Planning::SiteEdgeRule rule;
        rule.vehicleTypeID = type;
        edge.rules.push_back(std::move(rule));
    }
    return edge;
}

/// N1 - N2 - N3 - N4, 3 m each. For "lr" E1 has a trajectory, N3 the action "lift", and E3 a maximum height.
Planning::SiteMap MakeSite()
{
    std::vector<Planning::SiteNode> nodes;
    for (int i = 1; i <= 4; ++i)
    {
        nodes.push_back({"N" + std::to_string(i), 3.0 * i, 0, "floor", {{"lr", std::nullopt}, {"cr", std::nullopt}}});
    }
    Planning::SiteAction lift;
    lift.actionType = "lift";
    lift.requirement = Planning::EActionRequirement::Required;
    nodes[2].rules[0].actions.push_back(lift);
    std::vector<Planning::SiteEdge> edges{
        MakeSiteEdge("E1", "N1", "N2"),
        MakeSiteEdge("E2", "N2", "N3"),
        MakeSiteEdge("E3", "N3", "N4")};
    edges[0].rules[0].trajectory = Core::Nurbs{1, {0, 0, 1, 1}, {{3, 0, {}}, {6, 0, {}}}};
    edges[0].corridor = Planning::SiteCorridor{1, 1, false};
    edges[2].rules[0].maxHeight = 2;
    Core::Result<Planning::SiteMap> site = Planning::SiteMap::Create(std::move(nodes), std::move(edges), {});
    REQUIRE(site);
    return *site;
}

/// One that supports these optional members and actions of nodes.
KnownVehicle MakeVehicle(const std::vector<std::string>& parameters, const std::vector<std::string>& actionTypes)
{
    VDA5050::FactsheetMessage factsheet;
    std::vector<VDA5050::OptionalParameter>& list = factsheet.protocolFeatures.optionalParameters.emplace();
    for (const std::string& parameter : parameters)
    {
        list.push_back({parameter, VDA5050::EParameterSupport::Supported, {}});
    }
    for (const std::string& actionType : actionTypes)
    {
        VDA5050::AgvAction action;
        action.actionType = actionType;
        action.actionScopes = {VDA5050::EActionScope::Node};
        factsheet.protocolFeatures.agvActions.push_back(std::move(action));
    }
    KnownVehicle vehicle{"LR01", "lr", {}};
    vehicle.options.address = {"uagv", "ACS", "LR01"};
    vehicle.options.version = VDA5050::EVda5050Version::Version210;
    vehicle.options.factsheet = std::move(factsheet);
    return vehicle;
}

std::vector<std::string> ListOpen(const Planning::SiteMap& site, const std::string& vehicleTypeID)
{
    std::vector<std::string> open;
    for (const Planning::SiteEdge& edge : site.GetEdges())
    {
        if (edge.FindRuleOrNull(vehicleTypeID) != nullptr)
        {
            open.push_back(edge.edgeID);
        }
    }
    return open;
}

} // namespace

TEST_CASE("Edges are closed for a vehicle type whose robot does not support what the map demands there")
{
    struct Row
    {
        std::vector<std::string> parameters;
        std::vector<std::string> actionTypes;
        std::vector<std::string> open;
        std::string warning; ///< Of the edge that is closed.
    };

    const std::string trajectory = "order.edges.trajectory";
    const std::string height = "order.edges.maxHeight";
    const std::string begin = "site.map: lr does not use the edges ";
    const std::string cause = ", because the factsheet of robots.LR01 does not allow what the map demands there: ";
    const std::vector<Row> rows{
        {{trajectory, height}, {"lift"}, {"E1", "E2", "E3"}, {}},
        {{height}, {"lift"}, {"E2", "E3"}, "E1" + cause + "the vehicle does not support " + trajectory},
        {{trajectory, height}, {"lower"}, {"E1", "E3"}, "E2" + cause + "the vehicle cannot perform lift here"},
        {{trajectory}, {"lift"}, {"E1", "E2"}, "E3" + cause + "the vehicle does not support " + height},
    };
    for (const Row& row : rows)
    {
        Planning::SiteMap site = MakeSite();
        const std::vector<std::string> warnings = RestrictMap({MakeVehicle(row.parameters, row.actionTypes)}, site);
        CHECK(ListOpen(site, "lr") == row.open);
        CHECK(ListOpen(site, "cr").size() == 3);
        CHECK(
            warnings
            == (row.warning.empty() ? std::vector<std::string>() : std::vector<std::string>{begin + row.warning}));
    }
}

TEST_CASE("A factsheet that allows no drive at all closes no edge, and without factsheets none is closed")
{
    Planning::SiteMap site = MakeSite();
    KnownVehicle vehicle = MakeVehicle({"order.edges.trajectory"}, {"lift"});
    vehicle.options.factsheet->protocolLimits.maxStringLengths.identifier = 5;
    CHECK(RestrictMap({vehicle}, site).empty());
    CHECK(RestrictMap({}, site).empty());
    CHECK(ListOpen(site, "lr").size() == 3);
}

} // namespace ACS::Acsd::Test
