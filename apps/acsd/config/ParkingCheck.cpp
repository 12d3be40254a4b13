#include "config/ParkingCheck.hpp"

#include "config/LaneCheck.hpp"
#include "config/ReachFinder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <list>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::ELoad;

constexpr std::size_t MOST_NAMES = 10;
constexpr std::size_t MOST_LANE_WARNINGS = 20;

std::string JoinNames(const std::vector<std::string>& names, std::string_view separator)
{
    const std::span<const std::string> shown(names.data(), std::min(names.size(), MOST_NAMES));
    const std::string more =
        names.size() > shown.size() ? fmt::format(" and {} more", names.size() - shown.size()) : std::string();
    return fmt::format("{}{}", fmt::join(shown, separator), more);
}

std::string_view DescribeLoad(ELoad load)
{
    switch (load)
    {
        case ELoad::Empty:
            return " without a load";
        case ELoad::Loaded:
            return " with a load";
        case ELoad::Unknown:
        default:
            return "";
    }
}

/// Robots of a type that cannot park from the same stations.
struct ParkingGroup
{
    std::vector<std::string> robotIDs;
    std::string parking; ///< Of the last one.
};

class ParkingCheck final
{
    /// Nodes that are all reached from each other, with a load and without.
    struct Area
    {
        std::vector<bool> sourcesEmpty;
        std::vector<bool> sourcesLoaded;
        std::vector<bool> nodes;
        Reach reach;
    };

    /// The part of the map of one vehicle type.
    struct Floor
    {
        ReachFinder finder;
        Nodes docks;                                        ///< One for each station that the type may use.
        std::vector<const Planning::SiteStation*> stations; ///< By dock.
        std::list<Area> areas; ///< Of parking positions: robots of one area share the searches.
    };

    /// Vehicle type, load and stations.
    using GroupKey = std::tuple<std::string, ELoad, std::vector<std::string>>;

    const Planning::EngineOptions& _options;
    const Planning::SiteMap& _site;
    std::map<std::string, Floor> _floors;              ///< By vehicle type.
    std::map<std::string, std::string> _parkingRobots; ///< By station: the robot that parks or charges there.
    std::map<GroupKey, ParkingGroup> _groups;
    std::vector<std::string> _warnings;

public:
    ParkingCheck(const Planning::EngineOptions& options, const Planning::SiteMap& site)
        : _options(options),
          _site(site)
    {
        for (const Planning::RobotOptions& robot : options.robots)
        {
            if (!_floors.contains(robot.vehicleTypeID))
            {
                _floors.emplace(robot.vehicleTypeID, MakeFloor(robot.vehicleTypeID));
            }
            for (const std::optional<std::string>& stationID : {robot.homeStationID, robot.chargingStationID})
            {
                if (stationID.has_value())
                {
                    _parkingRobots.emplace(*stationID, robot.robotID.GetText());
                }
            }
        }
    }

    [[nodiscard]] std::vector<std::string> Find()
    {
        for (const Planning::RobotOptions& robot : _options.robots)
        {
            const std::optional<std::string>& parking =
                robot.homeStationID.has_value() ? robot.homeStationID : robot.chargingStationID;
            if (parking.has_value()) // otherwise acsd chooses one that can be reached
            {
                CheckRoutes(robot, *parking);
            }
        }
        for (const auto& [key, group] : _groups)
        {
            _warnings.push_back(fmt::format(
                "robots.{}: no route leads from {} to {}{}; {} may block other robots{}",
                JoinNames(group.robotIDs, ", robots."),
                JoinNames(std::get<2>(key), ", "),
                group.robotIDs.size() == 1 ? "its parking position " + group.parking : "their parking positions",
                DescribeLoad(std::get<1>(key)),
                group.robotIDs.size() == 1 ? "it" : "they",
                std::get<1>(key) == ELoad::Unknown ? "" : " if a job fails there"));
        }
        CheckLanes();
        return std::move(_warnings);
    }

private:
    void CheckLanes()
    {
        const LaneCheck lanes(_options, _site);
        const std::size_t most = _warnings.size() + MOST_LANE_WARNINGS;
        for (const Planning::RobotOptions& robot : _options.robots)
        {
            if (_warnings.size() >= most) // each costs searches of the whole map
            {
                _warnings.emplace_back("traffic.clearance: the parking positions of further robots were not checked");
                return;
            }
            const std::optional<std::string>& home = robot.homeStationID;
            const std::optional<std::string>& charger = robot.chargingStationID;
            AddNotEmpty(home.has_value() ? lanes.Describe(robot, *home, "parking position") : std::string());
            AddNotEmpty(
                charger.has_value() && charger != home ? lanes.Describe(robot, *charger, "charging station")
                                                       : std::string());
        }
    }

    void AddNotEmpty(std::string warning)
    {
        if (!warning.empty())
        {
            _warnings.push_back(std::move(warning));
        }
    }

    [[nodiscard]] Floor MakeFloor(const std::string& vehicleTypeID) const
    {
        Floor floor{ReachFinder(_site, vehicleTypeID, true), {}, {}, {}};
        for (const Planning::SiteStation& station : _site.GetStations())
        {
            for (const std::string& nodeID : station.nodeIDs)
            {
                const std::size_t node = *_site.FindNodeIndexOrNull(nodeID);
                if (_site.GetNodes()[node].FindRuleOrNull(vehicleTypeID) != nullptr)
                {
                    floor.docks.push_back(node);
                    floor.stations.push_back(&station);
                    break; // the engine uses this one
                }
            }
        }
        return floor;
    }

    [[nodiscard]] std::size_t GetDock(const std::string& stationID) const
    {
        return *_site.FindNodeIndexOrNull(_site.FindStationOrNull(stationID)->nodeIDs.front());
    }

    void CheckRoutes(const Planning::RobotOptions& robot, const std::string& parking)
    {
        Floor& floor = _floors.at(robot.vehicleTypeID);
        const std::size_t home = GetDock(parking);
        const std::size_t start = robot.startNodeID.has_value() ? *_site.FindNodeIndexOrNull(*robot.startNodeID) : home;
        const Area& area = GetArea(floor, home, start);
        const std::vector<bool>& empty = area.sourcesEmpty;
        const std::vector<bool>& loaded = area.sourcesLoaded;
        const auto isReached = [&floor, home](const std::vector<bool>& sources) {
            return std::ranges::any_of(floor.docks, [&sources, home](std::size_t dock) {
                return dock != home && sources[dock];
            });
        };
        const bool bEmpty = isReached(empty);
        const bool bLoaded = isReached(loaded);
        const bool bOthers = std::ranges::any_of(floor.docks, [home](std::size_t dock) { return dock != home; });
        if (bOthers && !(bEmpty && bLoaded))
        {
            _warnings.push_back(fmt::format(
                "robots.{}: its parking position {} cannot be reached{}; it may block other robots",
                robot.robotID.GetText(),
                parking,
                DescribeLoad(GetMissing(bEmpty, bLoaded))));
        }
        CheckCharger(robot, parking, area.reach);
        std::map<ELoad, std::vector<std::string>> stations;
        for (const std::size_t index : ListEntered(robot, floor, area.reach))
        {
            const std::size_t dock = floor.docks[index];
            // The load does not change at a charger.
            const bool bCharger = floor.stations[index]->stationID == robot.chargingStationID;
            const bool bLeftEmpty = !bEmpty || empty[dock] || (bCharger && !area.reach.empty.arrived[dock]);
            const bool bLeftLoaded = !bLoaded || loaded[dock] || (bCharger && !area.reach.loaded.arrived[dock]);
            if (!bLeftEmpty || !bLeftLoaded)
            {
                stations[GetMissing(bLeftEmpty, bLeftLoaded)].push_back(floor.stations[index]->stationID);
            }
        }
        for (auto& [load, stationIDs] : stations)
        {
            ParkingGroup& group = _groups[{robot.vehicleTypeID, load, std::move(stationIDs)}];
            group.robotIDs.push_back(robot.robotID.GetText());
            group.parking = parking;
        }
    }

    /// With a low battery the charger is the parking position.
    void CheckCharger(const Planning::RobotOptions& robot, const std::string& parking, const Reach& reach)
    {
        if (!robot.chargingStationID.has_value() || *robot.chargingStationID == parking)
        {
            return;
        }
        const std::size_t dock = GetDock(*robot.chargingStationID);
        if (reach.empty.arrived[dock] != reach.loaded.arrived[dock]) // ReachCheck reports neither
        {
            _warnings.push_back(fmt::format(
                "robots.{}: its charging station {} cannot be reached{}; with a low battery it may block other robots",
                robot.robotID.GetText(),
                *robot.chargingStationID,
                DescribeLoad(GetMissing(reach.empty.arrived[dock], reach.loaded.arrived[dock]))));
        }
    }

    [[nodiscard]] static const Area& GetArea(Floor& floor, std::size_t home, std::size_t start)
    {
        const auto known = std::ranges::find_if(floor.areas, [home, start](const Area& area) {
            return area.nodes[home] && area.nodes[start];
        });
        if (known != floor.areas.end())
        {
            return *known;
        }
        Area area{
            floor.finder.FindSources(home, ELoad::Empty),
            floor.finder.FindSources(home, ELoad::Loaded),
            floor.finder.FindTargets(home, ELoad::Empty),
            floor.finder.Find({home, start}, floor.docks)};
        const std::vector<bool> loaded = floor.finder.FindTargets(home, ELoad::Loaded);
        for (std::size_t node = 0; node < loaded.size(); ++node)
        {
            area.nodes[node] = area.nodes[node] && loaded[node] && area.sourcesEmpty[node] && area.sourcesLoaded[node];
        }
        if (!area.nodes[start]) // what it reaches is of this robot alone
        {
            area.nodes.assign(loaded.size(), false);
        }
        return floor.areas.emplace_back(std::move(area));
    }

    /// Stations, by index in `floor`, that the robot can enter and that are not where another one parks or charges.
    [[nodiscard]] std::vector<std::size_t> ListEntered(
        const Planning::RobotOptions& robot,
        const Floor& floor,
        const Reach& reach) const
    {
        std::vector<std::size_t> entered;
        for (std::size_t i = 0; i < floor.docks.size(); ++i)
        {
            const auto parked = _parkingRobots.find(floor.stations[i]->stationID);
            const bool bForeign = parked != _parkingRobots.end() && parked->second != robot.robotID.GetText();
            if (!bForeign && (reach.empty.arrived[floor.docks[i]] || reach.loaded.arrived[floor.docks[i]]))
            {
                entered.push_back(i);
            }
        }
        return entered;
    }

    /// Of which load there is no route; Unknown: of neither.
    [[nodiscard]] static ELoad GetMissing(bool bEmpty, bool bLoaded)
    {
        if (bEmpty)
        {
            return ELoad::Loaded;
        }
        return bLoaded ? ELoad::Empty : ELoad::Unknown;
    }
};

} // namespace

std::vector<std::string> FindParkingFaults(const Planning::EngineOptions& options, const Planning::SiteMap& site)
{
    return ParkingCheck(options, site).Find();
}

} // namespace ACS::Acsd
