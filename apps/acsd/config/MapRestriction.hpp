#pragma once

#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/MasterOptions.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// A robot whose factsheet is known before it comes online.
struct KnownVehicle
{
    std::string robotID;
    std::string vehicleTypeID;
    VDA5050::MasterOptions options; ///< With the factsheet.
};

/// Closes edges for a vehicle type if one of its robots does not support what the map demands there, on the edge or on the node at
/// its end. Edges that the factsheet would not allow without these demands either stay open: they are no matter of the map. Returns
/// a warning for each robot and reason, with all edges.
[[nodiscard]] std::vector<std::string> RestrictMap(const std::vector<KnownVehicle>& vehicles, Planning::SiteMap& site);

} // namespace ACS::Acsd
