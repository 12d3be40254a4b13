#include "robots/VehicleMap.hpp"

#include <acs/plan/Router.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace ACS::Acsd
{

VehicleMap::VehicleMap(const Planning::SiteMap& site, std::string_view vehicleTypeID)
{
    const Planning::Router router(site);
    for (std::size_t i = 0; i < site.GetEdges().size(); ++i)
    {
        const Planning::SiteEdgeRule* const ruleOrNull = site.GetEdges()[i].FindRuleOrNull(vehicleTypeID);
        if (ruleOrNull == nullptr
            || (!ruleOrNull->IsPermitted(Planning::ELoad::Empty) && !ruleOrNull->IsPermitted(Planning::ELoad::Loaded)))
        {
            continue;
        }
        std::optional<Planning::Route> route = router.MakeRouteOrNull(vehicleTypeID, i);
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
