#pragma once

#include "vda-sim/Fault.hpp"
#include "vda-sim/VehicleMotion.hpp"
#include "vda-sim/VehicleSpec.hpp"
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::VdaSim
{

/// What one step of a drive has done.
struct DriveStep
{
    double metres = 0.0;
    std::optional<VDA5050::DriveTo> reached; ///< The leg that has ended at its node.
};

/// Where a vehicle is, and its drive along the legs of an order. Faults and the session make it brake. Pure: time is a
/// parameter, in seconds.
class VehicleDrive
{
    enum class ECourse : std::uint8_t
    {
        Continue,
        Stop,    ///< Requested by the session, until the next leg.
        Abandon, ///< The order is cleared, and the vehicle still brakes.
    };

    const Planning::SiteMap* _site;
    MotionLimits _limits;
    VehicleMotion _motion;
    std::optional<VDA5050::DriveTo> _leg;
    ECourse _course = ECourse::Continue;
    std::string _nodeID;      ///< Its current or last node.
    std::string _placeNodeID; ///< The node that it is on; empty between nodes.
    std::string _mapID;

public:
    /// Stationary on the node, at the position or else at that of the node. The site outlives it.
    VehicleDrive(
        const Planning::SiteMap& site,
        const MotionLimits& limits,
        const std::string& nodeID,
        const std::optional<StartPosition>& positionOrNull);

    /// Begins a leg, or updates the end of the same leg under way.
    void Begin(const VDA5050::DriveTo& leg);
    /// Brakes until the next leg begins.
    void Stop();
    /// The order is cleared: the leg ends where the vehicle comes to a stop.
    void Abandon();
    /// Ends an abandoned drive that has come to a stop.
    void EndAbandoned();
    /// Ends the movement past a node after which no leg follows.
    void EndPassing();
    /// Another position on a map; false while it is driving.
    [[nodiscard]] bool TryPlace(const Pose& pose, std::string mapID);

    [[nodiscard]] DriveStep Advance(double seconds);

    /// Brakes, or leaves the route to pass an obstacle, as the faults and the session demand.
    void UpdateBrake(const FaultBoard& faults);
    /// By an obstacle that it has no room to pass.
    [[nodiscard]] bool IsBlocked(const FaultBoard& faults) const;

    [[nodiscard]] const VehicleMotion& GetMotion() const noexcept;
    [[nodiscard]] bool IsMoving() const noexcept;
    [[nodiscard]] const VDA5050::DriveTo* GetLegOrNull() const noexcept;
    /// Its current or last node.
    [[nodiscard]] const std::string& GetNodeID() const noexcept;
    /// The node that it is on, stationary or passing; empty between nodes.
    [[nodiscard]] const std::string& GetPlaceNodeID() const noexcept;
    [[nodiscard]] const std::string& GetMapID() const noexcept;

private:
    /// Finds whether it is on its current or last node.
    void FindPlace();
    [[nodiscard]] std::optional<double> GetSwerveOrNull(const Fault& obstacle) const;
};

} // namespace ACS::VdaSim
