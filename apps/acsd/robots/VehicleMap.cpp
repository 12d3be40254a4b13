#include "robots/VehicleMap.hpp"

#include <acs/plan/Router.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace ACS::Acsd
{

VehicleMap::VehicleMap(const Planning::SiteMap& site, std::string_view vehicleTypeID)
{
    const Planning::Router router(site);
    for (const Planning::SiteEdge& edge : site.GetEdges())
    {
        const Planning::SiteEdgeRule* const ruleOrNull = edge.FindRuleOrNull(vehicleTypeID);
        if (ruleOrNull == nullptr)
        {
            continue;
        }
        const Planning::ELoad load =
            ruleOrNull->IsPermitted(Planning::ELoad::Empty) ? Planning::ELoad::Empty : Planning::ELoad::Loaded;
        std::optional<Planning::Route> route =
            router.FindRouteOrNull(vehicleTypeID, load, edge.startNodeID, edge.endNodeID, {});
        if (route.has_value())
        {
            _routes.push_back(std::move(*route));
        }
    }
}

const std::vector<Planning::Route>& VehicleMap::GetRoutes() const noexcept
{
    return _routes;
}

const Planning::RouteNode* VehicleMap::FindNodeOrNull(std::string_view nodeID) const
{
    for (const Planning::Route& route : _routes)
    {
        const auto node = std::ranges::find(route.nodes, nodeID, &Planning::RouteNode::nodeID);
        if (node != route.nodes.end())
        {
            return &*node;
        }
    }
    return nullptr;
}

} // namespace ACS::Acsd
