#include "config/MapRestriction.hpp"

#include "robots/DriveCheck.hpp"
#include <acs/plan/Router.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// Why the vehicle refuses a drive along the route; empty: it does not.
std::string FindFault(const VDA5050::MasterSession& session, const Planning::Route& route)
{
    const Core::Result<void> checked = CheckDrive(session, route, Core::Now{});
    return checked ? std::string() : checked.error().expected;
}

Planning::Route RemoveDemands(Planning::Route route)
{
    for (Planning::RouteNode& node : route.nodes)
    {
        node.actions.clear();
    }
    for (Planning::RouteEdge& edge : route.edges)
    {
        edge.minHeight.reset();
        edge.maxHeight.reset();
        edge.trajectory.reset();
        edge.actions.clear();
    }
    return route;
}

} // namespace

std::vector<std::string> RestrictMap(const std::vector<KnownVehicle>& vehicles, Planning::SiteMap& site)
{
    const Planning::Router router(site);
    std::vector<Planning::SiteEdge> edges = site.GetEdges();
    std::vector<std::string> warnings;
    for (const KnownVehicle& vehicle : vehicles)
    {
        const VDA5050::MasterSession session(vehicle.options);
        std::map<std::string, std::string> edgesByFault;
        for (std::size_t i = 0; i < edges.size(); ++i)
        {
            const std::optional<Planning::Route> route = router.MakeRouteOrNull(vehicle.vehicleTypeID, i);
            const std::string fault = route.has_value() ? FindFault(session, *route) : std::string();
            if (fault.empty() || !FindFault(session, RemoveDemands(*route)).empty())
            {
                continue;
            }
            std::string& listed = edgesByFault[fault];
            listed += (listed.empty() ? "" : ", ") + edges[i].edgeID;
            std::erase_if(edges[i].rules, [&vehicle](const Planning::SiteEdgeRule& rule) {
                return rule.vehicleTypeID == vehicle.vehicleTypeID;
            });
        }
        for (const auto& [fault, listed] : edgesByFault)
        {
            warnings.push_back(fmt::format(
                "site.map: {} does not use the edges {}, because the factsheet of robots.{} does not allow what the map "
                "demands there: {}",
                vehicle.vehicleTypeID,
                listed,
                vehicle.robotID,
                fault));
        }
    }
    if (!warnings.empty())
    {
        site = *Planning::SiteMap::Create(site.GetNodes(), std::move(edges), site.GetStations());
    }
    return warnings;
}

} // namespace ACS::Acsd
