#include "config/ReachCheck.hpp"

#include "config/ReachFinder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

struct StationReach
{
    bool bEmpty = false;
    bool bLoaded = false;

    bool operator==(const StationReach&) const = default;
};

/// The part of the map and the robots of one vehicle type.
class TypeCheck final
{
    const Planning::EngineOptions& _options;
    const Planning::SiteMap& _site;
    const std::string& _vehicleTypeID;
    Nodes _starts;
    Nodes _docks;
    std::set<std::string_view> _parking; ///< Stations that are the parking position or charger of a robot.
    std::set<std::string_view> _ownParking;
    ReachFinder _closed;
    ReachFinder _unrestricted;
    ReachFinder _open;
    Reach _closedReach;
    Reach _unrestrictedReach;
    Reach _openReach;

public:
    TypeCheck(
        const Planning::EngineOptions& options,
        const Planning::SiteMap& open,
        const Planning::SiteMap& closed,
        const std::string& vehicleTypeID)
        : _options(options),
          _site(closed),
          _vehicleTypeID(vehicleTypeID),
          _closed(closed, vehicleTypeID, true),
          _unrestricted(closed, vehicleTypeID, false),
          _open(open, vehicleTypeID, true)
    {
        FindPlaces();
        FindReach();
    }

    /// Empty: the station is reached, or not meant for the type.
    [[nodiscard]] std::string Describe(const Planning::SiteStation& station) const
    {
        const Nodes own = ListUsable(station);
        const bool bParking = _parking.contains(station.stationID);
        if (own.empty() || (bParking && !_ownParking.contains(station.stationID)))
        {
            return {};
        }
        const Nodes docks = ListWithNeighbours(station, own);
        const StationReach reach = Get(_closedReach, docks);
        const bool bNever = !reach.bEmpty && !reach.bLoaded;
        if ((reach.bEmpty && reach.bLoaded) || (bParking && !bNever)) // FindParkingFaults reports loads there
        {
            return {};
        }
        return fmt::format(
            "site.map: {} cannot reach the station {}{}, because {}",
            _vehicleTypeID,
            station.stationID,
            bNever             ? ""
                : reach.bEmpty ? " with a load"
                               : " without a load",
            GetReason(docks, reach, bNever));
    }

private:
    void FindPlaces()
    {
        for (const Planning::RobotOptions& robot : _options.robots)
        {
            AddRobot(robot);
        }
        for (const Planning::SiteStation& station : _site.GetStations())
        {
            const Nodes docks = ListUsable(station);
            _docks.insert(_docks.end(), docks.begin(), docks.end());
        }
    }

    void FindReach()
    {
        _closedReach = _closed.Find(_starts, _docks);
        _unrestrictedReach = _unrestricted.Find(_starts, _docks);
        _openReach = _open.Find(_starts, _docks);
    }

    void AddRobot(const Planning::RobotOptions& robot)
    {
        const bool bOwn = robot.vehicleTypeID == _vehicleTypeID;
        if (bOwn && robot.startNodeID.has_value())
        {
            _starts.push_back(*_site.FindNodeIndexOrNull(*robot.startNodeID));
        }
        for (const std::optional<std::string>& stationID : {robot.homeStationID, robot.chargingStationID})
        {
            const Planning::SiteStation* const stationOrNull =
                stationID.has_value() ? _site.FindStationOrNull(*stationID) : nullptr;
            if (stationOrNull != nullptr)
            {
                _parking.insert(stationOrNull->stationID);
            }
            if (stationOrNull != nullptr && bOwn)
            {
                _ownParking.insert(stationOrNull->stationID);
            }
        }
    }

    /// The nodes of the station that the vehicle type may use.
    [[nodiscard]] Nodes ListUsable(const Planning::SiteStation& station) const
    {
        Nodes usable;
        for (const std::string& nodeID : station.nodeIDs)
        {
            const std::size_t node = *_site.FindNodeIndexOrNull(nodeID);
            if (_site.GetNodes()[node].FindRuleOrNull(_vehicleTypeID) != nullptr)
            {
                usable.push_back(node);
            }
        }
        return usable;
    }

    /// And those of the stations from which a robot can work at this one.
    [[nodiscard]] Nodes ListWithNeighbours(const Planning::SiteStation& station, Nodes docks) const
    {
        for (const auto& [stationID, others] : _options.reach)
        {
            if (std::ranges::count(others, station.stationID) > 0)
            {
                const Nodes more = ListUsable(*_site.FindStationOrNull(stationID));
                docks.insert(docks.end(), more.begin(), more.end());
            }
        }
        return docks;
    }

    [[nodiscard]] static StationReach Get(const Reach& reach, const Nodes& docks)
    {
        const auto contains = [&docks](const LoadReach& nodes) {
            return std::ranges::any_of(docks, [&nodes](std::size_t dock) { return nodes.arrived[dock]; });
        };
        return {contains(reach.empty), contains(reach.loaded)};
    }

    [[nodiscard]] std::string_view GetReason(const Nodes& docks, const StationReach& reach, bool bNever) const
    {
        if (Get(_openReach, docks) != reach)
        {
            return "the factsheet of a robot closes edges of the map, see above";
        }
        if (!bNever || Get(_unrestrictedReach, docks) != reach)
        {
            return "edges have a loadRestriction";
        }
        if (std::ranges::none_of(docks, [this](std::size_t dock) { return _closed.HasLaneTo(dock); }))
        {
            return "no edge with properties for this vehicle type ends at its nodes";
        }
        return "no edges with properties for this vehicle type lead there from the start_node of its robots";
    }
};

} // namespace

std::vector<std::string> FindUnreachableStations(
    const Planning::EngineOptions& options,
    const Planning::SiteMap& open,
    const Planning::SiteMap& closed)
{
    std::set<std::string> vehicleTypeIDs;
    for (const Planning::RobotOptions& robot : options.robots)
    {
        vehicleTypeIDs.insert(robot.vehicleTypeID);
    }
    std::vector<std::string> warnings;
    std::size_t more = 0;
    for (const std::string& vehicleTypeID : vehicleTypeIDs)
    {
        const TypeCheck check(options, open, closed, vehicleTypeID);
        for (const Planning::SiteStation& station : closed.GetStations())
        {
            std::string warning = check.Describe(station);
            if (!warning.empty() && warnings.size() < MOST_REACH_WARNINGS)
            {
                warnings.push_back(std::move(warning));
            }
            else if (!warning.empty())
            {
                ++more;
            }
        }
    }
    if (more > 0)
    {
        warnings.back() = fmt::format("site.map: {} more stations cannot be reached", more + 1);
    }
    return warnings;
}

} // namespace ACS::Acsd
