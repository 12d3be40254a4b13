#pragma once

#include "api/ApiTypes.hpp"

#include <string_view>

namespace ACS::Acsctl
{

/// Which blocked places are in the way of which plan and robot, from the map of acsd.
class BlockedPlaces final
{
    const SiteAnswer& _site;

public:
    /// The answer must outlive it.
    explicit BlockedPlaces(const SiteAnswer& site);

    /// Whether the block closes the station, or one of its docks.
    [[nodiscard]] bool IsAtStation(const BlockInfo& block, std::string_view stationID) const;

    /// Whether the block is on what is left of the route.
    [[nodiscard]] bool IsOnRoute(const BlockInfo& block, const RobotInfo& robot) const;

    /// Whether the reason of the plan or of one of its robots names the block, in the words of acsd.
    [[nodiscard]] static bool IsNamed(const BlockInfo& block, const WaitsInfo& waits);
};

} // namespace ACS::Acsctl
