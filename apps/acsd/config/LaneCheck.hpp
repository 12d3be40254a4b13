#pragma once

#include "config/ReachFinder.hpp"
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Finds the nodes that routes of others must use and that a parked robot closes: its node and those within the clearance. Keeps
/// references to the options and the map.
class LaneCheck final
{
    /// The node where robots work at a station.
    struct Dock
    {
        std::size_t node = 0;
        const Planning::RobotOptions* ownerOrNull = nullptr; ///< The robot that parks or charges there.
    };

    const Planning::EngineOptions& _options;
    const Planning::SiteMap& _site;
    std::map<std::string, ReachFinder> _finders; ///< By vehicle type.
    std::map<std::string, const Planning::RobotOptions*>
        _owners;                                     ///< By station: the robot that parks or charges there.
    std::map<std::string, std::vector<Dock>> _docks; ///< By vehicle type: of the stations that it may use.

public:
    LaneCheck(const Planning::EngineOptions& options, const Planning::SiteMap& site);

    /// The warning about the node that the robot closes to others at this station; empty if it closes none. `name` is what the
    /// station is for the robot.
    [[nodiscard]] std::string Describe(
        const Planning::RobotOptions& robot,
        const std::string& stationID,
        std::string_view name) const;

private:
    void FindDocks();

    /// The nodes that a robot on the dock closes, the nearest first.
    [[nodiscard]] Nodes ListClosed(std::size_t dock) const;

    /// The docks of stations that other robots of the type use.
    [[nodiscard]] Nodes ListDocks(const Planning::RobotOptions& parked, const std::string& vehicleTypeID) const;

    /// Whether a route between the docks exists only over the closed nodes.
    [[nodiscard]] static bool IsCut(
        const ReachFinder& finder,
        const Nodes& docks,
        const Nodes& closed,
        std::size_t nodes);

    /// The nearest of the closed nodes that cuts routes alone; otherwise the nearest one that is passed.
    [[nodiscard]] std::optional<std::size_t> FindCutOrNull(
        const ReachFinder& finder,
        const Nodes& docks,
        const Nodes& closed) const;
};

} // namespace ACS::Acsd
