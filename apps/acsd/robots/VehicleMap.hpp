#pragma once

#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The part of the site's map that a vehicle type may use, in the form in which it is sent to vehicles.
class VehicleMap final
{
    std::vector<Planning::Route> _routes;

public:
    /// Empty: nothing is known of the map.
    VehicleMap() = default;

    VehicleMap(const Planning::SiteMap& site, std::string_view vehicleTypeID);

    /// Each edge that the vehicle type may use, as a route of its own.
    [[nodiscard]] const std::vector<Planning::Route>& GetRoutes() const noexcept;

    /// Null if no route has the node.
    [[nodiscard]] const Planning::RouteNode* FindNodeOrNull(std::string_view nodeID) const;
};

} // namespace ACS::Acsd
