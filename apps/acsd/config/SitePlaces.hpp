#pragma once

#include "robots/JobData.hpp"
#include <acs/core/Location.hpp>
#include <acs/plan/EngineOptions.hpp>

#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The places that jobs of a site can name: the stations of its map, site.ports, and the ports of its robots.
class SitePlaces final
{
    struct RobotPlace
    {
        Planning::ERobotType robotType = Planning::ERobotType::LR;
        Core::Location place;
    };

    std::vector<Core::Location> _stations;
    std::vector<Core::Location> _ports;
    std::vector<RobotPlace> _robotPlaces;

public:
    SitePlaces(const StationTable& stations, const Planning::EngineOptions& engine);

    /// Whether a place that the rule allows to robots of the type has such a segment. Also true if the site lists no place
    /// of the rule: then it has no such jobs.
    [[nodiscard]] bool HasSegment(Planning::EPlaceRule rule, Planning::ERobotType robotType, Core::ESegmentKind kind)
        const;

    /// Likewise for stations. Also true if no station is a place of MCS-ACS.
    [[nodiscard]] bool HasStationSegment(Core::ESegmentKind kind) const;

    /// Whether a job of the action can work at the station.
    [[nodiscard]] bool HasPlaceAt(std::string_view stationID, const Planning::ActionRule& rule) const;
};

} // namespace ACS::Acsd
