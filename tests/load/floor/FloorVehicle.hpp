#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

enum class EDrivePhase : std::uint8_t
{
    None,
    Sent,   ///< Not accepted yet.
    OnNode, ///< On the node of FloorVehicle::index.
    OnLeg,  ///< Between this node and the next one, also while it is paused there.
};

/// A vehicle, and where it really is.
struct FloorVehicle
{
    std::string robotID;
    std::string nodeID;
    std::optional<Planning::Drive> drive;
    std::size_t index = 0;
    EDrivePhase phase = EDrivePhase::None;
    bool bStopping = false;
    bool bPaused = false;
    bool bLost = false;
    double speed = 1;   ///< Metres per second.
    double legDone = 0; ///< Part of the leg that was done at legTime.
    Core::SteadyTime legTime;
    std::string jobID;
    bool bLoaded = false;
    std::uint64_t generation = 0; ///< Number of its latest leg.
    std::vector<Planning::RobotEvent> undelivered;

    /// Metres.
    [[nodiscard]] double GetLegLength() const;
    /// Part of the leg.
    [[nodiscard]] double GetLegDone(Core::SteadyTime now) const;
    [[nodiscard]] std::pair<double, double> GetPosition(const Planning::SiteMap& site, Core::SteadyTime now) const;
    /// Seconds from legTime to the end of the leg; nullopt: it does not drive.
    [[nodiscard]] std::optional<double> GetLegSecondsOrNull() const;
    /// Takes effect at the present point of the leg, and begins another generation of it.
    void ChangeSpeed(double metresPerSecond, bool bPause, Core::SteadyTime now);
    /// Its place and its drive.
    [[nodiscard]] std::string Describe() const;
};

} // namespace ACS::Testing
