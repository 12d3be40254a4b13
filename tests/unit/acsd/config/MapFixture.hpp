#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

/// The parts of a map of vehicles "lr", and the options of its robots.
struct MapFixture
{
    std::vector<Planning::SiteNode> nodes;
    std::vector<Planning::SiteEdge> edges;
    std::vector<Planning::SiteStation> stations;
    Planning::EngineOptions options;

    void AddNode(const std::string& nodeID, double x, double y)
    {
        nodes.push_back({nodeID, x, y, "floor", {{"lr", std::nullopt}}});
    }

    /// Its ID is "FROM-TO".
    void AddEdge(const std::string& from, const std::string& to)
    {
        Planning::SiteEdgeRule rule;
        rule.vehicleTypeID = "lr";
        edges.push_back({from + "-" + to, from, to, {rule}});
    }

    /// A station of one dock: "st-DOCK".
    void AddStation(const std::string& dock)
    {
        stations.push_back({"st-" + dock, {dock}});
    }

    Planning::RobotOptions& AddRobot(
        const std::string& name,
        const std::string& vehicleTypeID,
        const std::string& startNodeID)
    {
        Planning::RobotOptions robot{*Core::RobotID::Parse(name), {}, {}, {}, {}, {}, {}, {}};
        robot.vehicleTypeID = vehicleTypeID;
        robot.startNodeID = startNodeID;
        return options.robots.emplace_back(std::move(robot));
    }

    [[nodiscard]] Planning::SiteEdge& GetEdge(const std::string& edgeID)
    {
        return *std::ranges::find(edges, edgeID, &Planning::SiteEdge::edgeID);
    }

    void Restrict(const std::string& edgeID, bool bUnloaded, bool bLoaded)
    {
        GetEdge(edgeID).rules[0].loadRestriction = Planning::SiteLoadRestriction{bUnloaded, bLoaded};
    }

    [[nodiscard]] Planning::SiteMap MakeSite() const
    {
        return Planning::SiteMap::Create(nodes, edges, stations).value();
    }
};

} // namespace ACS::Acsd::Test
