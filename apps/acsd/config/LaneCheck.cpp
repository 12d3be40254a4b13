#include "config/LaneCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ACS::Acsd
{

namespace
{

using Planning::ELoad;

/// Routes from the start to docks, and back from them.
struct Routes
{
    std::vector<bool> targets;
    std::vector<bool> sources;

    Routes(const ReachFinder& finder, std::size_t start, ELoad load, const std::vector<bool>& closed)
        : targets(finder.FindTargets(start, load, closed)),
          sources(finder.FindSources(start, load, closed))
    {
    }

    [[nodiscard]] bool HasMoreThan(const Routes& other, const Nodes& docks) const
    {
        return std::ranges::any_of(docks, [this, &other](std::size_t dock) {
            return (targets[dock] && !other.targets[dock]) || (sources[dock] && !other.sources[dock]);
        });
    }
};

} // namespace

LaneCheck::LaneCheck(const Planning::EngineOptions& options, const Planning::SiteMap& site)
    : _options(options),
      _site(site)
{
    for (const Planning::RobotOptions& robot : options.robots)
    {
        if (!_finders.contains(robot.vehicleTypeID))
        {
            _finders.emplace(robot.vehicleTypeID, ReachFinder(site, robot.vehicleTypeID, true));
        }
        for (const std::optional<std::string>& stationID : {robot.homeStationID, robot.chargingStationID})
        {
            if (stationID.has_value())
            {
                _owners.emplace(*stationID, &robot);
            }
        }
    }
    FindDocks();
}

void LaneCheck::FindDocks()
{
    for (const auto& entry : _finders)
    {
        const std::string& vehicleTypeID = entry.first;
        std::vector<Dock>& docks = _docks[vehicleTypeID];
        for (const Planning::SiteStation& station : _site.GetStations())
        {
            const auto owner = _owners.find(station.stationID);
            const auto node = std::ranges::find_if(station.nodeIDs, [this, &vehicleTypeID](const std::string& nodeID) {
                return _site.FindNodeOrNull(nodeID)->FindRuleOrNull(vehicleTypeID) != nullptr;
            });
            if (node != station.nodeIDs.end())
            {
                docks.push_back({*_site.FindNodeIndexOrNull(*node), owner == _owners.end() ? nullptr : owner->second});
            }
        }
    }
}

std::string LaneCheck::Describe(
    const Planning::RobotOptions& robot,
    const std::string& stationID,
    std::string_view name) const
{
    const std::size_t dock = *_site.FindNodeIndexOrNull(_site.FindStationOrNull(stationID)->nodeIDs.front());
    const Nodes closed = ListClosed(dock);
    std::optional<std::size_t> cut;
    for (const auto& [vehicleTypeID, finder] : _finders)
    {
        const Nodes docks = ListDocks(robot, vehicleTypeID);
        cut = cut.has_value() ? cut : FindCutOrNull(finder, docks, closed);
    }
    if (!cut.has_value())
    {
        return {};
    }
    const Planning::SiteNode& node = _site.GetNodes()[*cut];
    const std::string place = *cut == dock ? fmt::format("is on the node {}, which routes of others use", node.nodeID)
                                           : fmt::format(
                                               "is {:.2f} m from the node {}, within traffic.clearance ({:.2f} m)",
                                               Planning::GetDistance(_site.GetNodes()[dock], node),
                                               node.nodeID,
                                               _options.clearance);
    return fmt::format(
        "robots.{0}: its {1} {2} {3}: while {0} is there, no other vehicle enters {4}",
        robot.robotID.GetText(),
        name,
        stationID,
        place,
        node.nodeID);
}

Nodes LaneCheck::ListClosed(std::size_t dock) const
{
    const std::vector<Planning::SiteNode>& nodes = _site.GetNodes();
    const auto getDistance = [&nodes, dock](std::size_t node) {
        return Planning::GetDistance(nodes[dock], nodes[node]);
    };
    Nodes closed{dock};
    for (std::size_t node = 0; node < nodes.size(); ++node)
    {
        if (node != dock && std::abs(nodes[node].x - nodes[dock].x) <= _options.clearance
            && getDistance(node) <= _options.clearance && nodes[node].mapID == nodes[dock].mapID)
        {
            closed.push_back(node);
        }
    }
    std::ranges::stable_sort(closed, {}, getDistance);
    return closed;
}

Nodes LaneCheck::ListDocks(const Planning::RobotOptions& parked, const std::string& vehicleTypeID) const
{
    const auto isOther = [&parked, &vehicleTypeID](const Planning::RobotOptions& robot) {
        return robot.vehicleTypeID == vehicleTypeID && robot.robotID != parked.robotID;
    };
    if (std::ranges::none_of(_options.robots, isOther))
    {
        return {};
    }
    Nodes docks;
    for (const Dock& dock : _docks.at(vehicleTypeID))
    {
        if (dock.ownerOrNull == nullptr || isOther(*dock.ownerOrNull))
        {
            docks.push_back(dock.node);
        }
    }
    return docks;
}

bool LaneCheck::IsCut(const ReachFinder& finder, const Nodes& docks, const Nodes& closed, std::size_t nodes)
{
    std::vector<bool> isClosed(nodes, false);
    std::ranges::for_each(closed, [&isClosed](std::size_t node) { isClosed[node] = true; });
    const bool bDock = std::ranges::any_of(docks, [&isClosed](std::size_t dock) { return isClosed[dock]; });
    for (const ELoad load : {ELoad::Empty, ELoad::Loaded})
    {
        if (!bDock && finder.IsBypassed(isClosed, load))
        {
            continue;
        }
        for (const std::size_t node : closed)
        {
            const std::vector<bool> sources = finder.FindSources(node, load);
            const auto start = std::ranges::find_if(docks, [&sources, &isClosed](std::size_t dock) {
                return sources[dock] && !isClosed[dock];
            });
            if (start != docks.end()
                && Routes(finder, *start, load, {}).HasMoreThan(Routes(finder, *start, load, isClosed), docks))
            {
                return true;
            }
        }
    }
    return false;
}

std::optional<std::size_t> LaneCheck::FindCutOrNull(const ReachFinder& finder, const Nodes& docks, const Nodes& closed)
    const
{
    Nodes used; // a dead end of no station cuts nothing
    std::ranges::copy_if(closed, std::back_inserter(used), [&finder, &docks](std::size_t node) {
        return finder.IsPassed(node) || std::ranges::count(docks, node) > 0;
    });
    const std::size_t nodes = _site.GetNodes().size();
    if (used.empty() || !IsCut(finder, docks, closed, nodes))
    {
        return std::nullopt;
    }
    const auto alone = std::ranges::find_if(used, [&finder, &docks, nodes](std::size_t node) {
        return IsCut(finder, docks, {node}, nodes);
    });
    return alone == used.end() ? used.front() : *alone;
}

} // namespace ACS::Acsd
