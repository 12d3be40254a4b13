#pragma once

#include "robots/VehicleDrive.hpp"
#include <acs/plan/RobotCommand.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Which REQUIRED actions of the vehicle's node have not finished, and the order that repeats them before a job.
class VehicleRepetition final
{
    /// An order that the vehicle shows after a restart. It repeats actions before the job of the commandID.
    struct Shown
    {
        std::string orderID;
        std::string commandID;
    };

    /// The node of the last drive whose REQUIRED actions have not finished, with these.
    std::optional<Planning::RouteNode> _openNode;
    std::size_t _count = 0; ///< Of orders.
    std::optional<Shown> _shown;

public:
    void OnDriveEnded(const VehicleDrive& drive);
    /// The actions with which a drive along the route begins.
    [[nodiscard]] std::vector<Planning::SiteAction> ListStartActions(const Planning::Route& route) const;
    /// A drive with this node only; nullopt if it has no such action.
    [[nodiscard]] std::optional<Planning::Drive> MakeDriveOrNull(
        const std::string& commandID,
        const std::string& nodeID);

    /// After a restart: whether the order repeats actions before this job or before one of those before it.
    [[nodiscard]] bool TryRecognize(const Planning::RecoverJob& recovery, const std::string& orderID);
    /// The job before which the recognized order repeats actions; null if the order is another one.
    [[nodiscard]] const std::string* FindCommandOrNull(std::string_view orderID) const noexcept;
};

} // namespace ACS::Acsd
