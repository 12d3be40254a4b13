#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/Plan.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string>
#include <utility>
#include <vector>

/// The floor of lessons 7 and 8: HOME and the cassette port A01.CP01 with a node each, one robot, one plan. A real site
/// comes from a VDMA LIF file (DecodeLIF), a real plan from the MCS.
namespace ExampleFloor
{

inline constexpr const char* HOME = "HOME";
inline constexpr const char* PORT = "A01.CP01";
inline constexpr const char* ROBOT = "LR01";
inline constexpr const char* VEHICLE_TYPE = "lr-base";

inline ACS::Core::Result<ACS::Planning::SiteMap> MakeSite()
{
    std::vector<ACS::Planning::SiteNode> nodes;
    std::vector<ACS::Planning::SiteStation> stations;
    for (const std::string place : {HOME, PORT})
    {
        // A vehicle type uses only the nodes and edges that name it.
        nodes.push_back({"N-" + place, 3.0 * static_cast<double>(nodes.size()), 0, "hall", {{VEHICLE_TYPE, {}}}});
        stations.push_back({place, {"N-" + place}});
    }
    ACS::Planning::SiteEdgeRule rule;
    rule.vehicleTypeID = VEHICLE_TYPE;
    std::vector<ACS::Planning::SiteEdge> edges{
        {"out", nodes[0].nodeID, nodes[1].nodeID, {rule}},
        {"back", nodes[1].nodeID, nodes[0].nodeID, {rule}}};
    return ACS::Planning::SiteMap::Create(std::move(nodes), std::move(edges), std::move(stations));
}

/// Every value from outside is checked and may fail; FindErrors then checks the whole.
inline ACS::Core::Result<ACS::Planning::EngineOptions> MakeOptions(const ACS::Planning::SiteMap& site)
{
    auto robotID = ACS::Core::RobotID::Parse(ROBOT);
    auto ports = ACS::Core::ParseLocationRange("LR01.CP01");
    if (!robotID.has_value() || !ports.has_value())
    {
        return tl::unexpected(robotID.has_value() ? ports.error() : robotID.error());
    }
    ACS::Planning::EngineOptions options;
    options.robots.push_back(
        {*robotID, ACS::Planning::ERobotType::LR, VEHICLE_TYPE, "N-HOME", HOME, std::move(*ports), {}, {}});
    const std::vector<ACS::Core::Error> mistakes = FindErrors(options, site);
    if (!mistakes.empty())
    {
        return tl::unexpected(mistakes.front());
    }
    return options;
}

/// Drive to the port and take the cassette. "AMR" is whichever robot gets the plan.
inline ACS::Planning::Plan MakePlan()
{
    return {"PLAN-1", "LOT-1", {}, {{1, "CassetteLoad", PORT, {"CASSETTE_01"}, {{"JOB-1", PORT, "AMR.CP01"}}}}};
}

} // namespace ExampleFloor
