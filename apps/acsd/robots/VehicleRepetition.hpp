#pragma once

#include "robots/VehicleDrive.hpp"
#include <acs/plan/RobotCommand.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Which REQUIRED actions of the vehicle's node have not finished, and the order that repeats them before a job.
class VehicleRepetition final
{
    /// The node of the last drive whose REQUIRED actions have not finished, with these.
    std::optional<Planning::RouteNode> _openNode;
    std::size_t _count = 0; ///< Of orders.

public:
    void OnDriveEnded(const VehicleDrive& drive);
    /// The actions with which a drive along the route begins.
    [[nodiscard]] std::vector<Planning::SiteAction> ListStartActions(const Planning::Route& route) const;
    /// A drive with this node only; nullopt if it has no such action.
    [[nodiscard]] std::optional<Planning::Drive> MakeDriveOrNull(
        const std::string& commandID,
        const std::string& nodeID);
};

} // namespace ACS::Acsd
