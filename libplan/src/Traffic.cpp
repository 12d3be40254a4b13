#include "Traffic.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr std::uint32_t NOWHERE = std::numeric_limits<std::uint32_t>::max();

} // namespace

Traffic::Traffic(const SiteMap& site, double clearance)
    : _holders(site.GetNodes().size()),
      _covers(_holders.size(), 0),
      _homes(_holders.size(), 0),
      _seen(_holders.size(), 0)
{
    FindNear(site, clearance);
    for (const SiteEdge& edge : site.GetEdges())
    {
        for (const SiteEdgeRule& rule : edge.rules)
        {
            if (!_graphs.contains(rule.vehicleTypeID))
            {
                _graphs.emplace(rule.vehicleTypeID, FloorGraph(site, rule.vehicleTypeID));
            }
        }
    }
}

void Traffic::FindNear(const SiteMap& site, double clearance)
{
    const std::vector<SiteNode>& nodes = site.GetNodes();
    _near.resize(nodes.size());
    std::vector<std::uint32_t> byX(nodes.size());
    std::iota(byX.begin(), byX.end(), 0U);
    std::ranges::sort(byX, {}, [&nodes](std::uint32_t node) { return nodes[node].x; });
    for (std::size_t i = 0; i < byX.size(); ++i)
    {
        const SiteNode& left = nodes[byX[i]];
        _near[byX[i]].push_back(byX[i]);
        for (std::size_t j = i + 1; j < byX.size() && nodes[byX[j]].x - left.x <= clearance; ++j)
        {
            const SiteNode& right = nodes[byX[j]];
            if (left.mapID == right.mapID && GetDistance(left, right) <= clearance)
            {
                _near[byX[i]].push_back(byX[j]);
                _near[byX[j]].push_back(byX[i]);
            }
        }
    }
}

void Traffic::AddRobot(std::string_view vehicleTypeID, std::optional<std::size_t> home)
{
    Vehicle& vehicle = _vehicles.emplace_back();
    const auto found = _graphs.find(vehicleTypeID);
    vehicle.graphOrNull = found == _graphs.end() ? nullptr : &found->second;
    vehicle.home = home;
    if (home.has_value() && vehicle.graphOrNull != nullptr)
    {
        FindWaysHome(vehicle);
    }
    for (const std::uint32_t node : home.has_value() ? _near[*home] : std::vector<std::uint32_t>())
    {
        ++_homes[node];
    }
    _bReturnsKnown = false;
    Note(false);
}

/// Whoever lives between the homes of others, on a lane, can not be promised to come home.
void Traffic::FindReturns()
{
    if (std::exchange(_bReturnsKnown, true))
    {
        return;
    }
    const std::vector<std::uint16_t> none(_covers.size(), 0);
    for (Vehicle& vehicle : _vehicles)
    {
        vehicle.bCanReturn =
            vehicle.home.has_value() && vehicle.graphOrNull != nullptr
            && std::ranges::any_of(
                vehicle.graphOrNull->GetLanesFrom(*vehicle.home),
                [this, &vehicle, &none](const Lane& lane) {
                    return !IsHomeOfOther(vehicle, lane.to) && HasWay(vehicle, lane.to, *vehicle.home, none);
                });
    }
}

bool Traffic::IsSpur(std::string_view vehicleTypeID, std::size_t node) const
{
    const auto found = _graphs.find(vehicleTypeID);
    if (found == _graphs.end() || found->second.GetLanesFrom(node).empty() || found->second.GetLanesTo(node).empty())
    {
        return false;
    }
    const FloorGraph& graph = found->second;
    const std::size_t neighbour = graph.GetLanesFrom(node).front().to;
    return std::ranges::all_of(graph.GetLanesFrom(node), [neighbour](const Lane& lane) { return lane.to == neighbour; })
        && std::ranges::all_of(graph.GetLanesTo(node), [&graph, neighbour](std::size_t lane) {
               return graph.GetLanes()[lane].from == neighbour;
           });
}

/// Backwards from the home, the quickest first.
void Traffic::FindWaysHome(Vehicle& vehicle) const
{
    using Entry = std::pair<double, std::size_t>;
    const FloorGraph& graph = *vehicle.graphOrNull;
    std::vector<double> seconds(_holders.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    vehicle.nextToHome.assign(_holders.size(), NOWHERE);
    seconds[*vehicle.home] = 0;
    open.emplace(0, *vehicle.home);
    while (!open.empty())
    {
        const auto [reached, node] = open.top();
        open.pop();
        if (reached > seconds[node])
        {
            continue;
        }
        for (const std::size_t index : graph.GetLanesTo(node))
        {
            const Lane& lane = graph.GetLanes()[index];
            if (reached + lane.seconds < seconds[lane.from])
            {
                seconds[lane.from] = reached + lane.seconds;
                vehicle.nextToHome[lane.from] = static_cast<std::uint32_t>(node);
                open.emplace(seconds[lane.from], lane.from);
            }
        }
    }
}

void Traffic::SetMovable(std::size_t robot, bool bMovable)
{
    if (std::exchange(_vehicles[robot].bMovable, bMovable) != bMovable)
    {
        Note(false);
    }
}

bool Traffic::IsMovable(std::size_t robot) const
{
    return _vehicles[robot].bMovable;
}

std::size_t Traffic::GetEnd(const Vehicle& vehicle)
{
    return vehicle.path.back();
}

/// What was true of homecomings stays true where nodes were only given back, or granted, if it was so of all robots.
void Traffic::Note(bool bOnlyFreed)
{
    for (Homecoming& homecoming : _homecomings)
    {
        homecoming.bValid = homecoming.bValid && bOnlyFreed && homecoming.bAll;
    }
    ++_freedCount;
}

void Traffic::Hold(std::size_t robot, std::size_t node)
{
    _holders[node] = robot;
    for (const std::uint32_t near : _near[node])
    {
        ++_covers[near];
    }
}

void Traffic::Free(std::size_t node)
{
    _holders[node].reset();
    for (const std::uint32_t near : _near[node])
    {
        --_covers[near];
    }
}

void Traffic::FreeAll(std::size_t robot)
{
    Vehicle& vehicle = _vehicles[robot];
    for (const std::size_t node : vehicle.path)
    {
        Free(node);
    }
    std::ranges::for_each(vehicle.extra, [this](std::size_t node) { Free(node); });
    vehicle.path.clear();
    vehicle.extra.clear();
}

bool Traffic::TryStand(std::size_t robot, std::size_t node, std::span<const std::size_t> extra)
{
    const auto isOthers = [this, robot](std::size_t wanted) {
        return _holders[wanted].has_value() && _holders[wanted] != robot;
    };
    if (isOthers(node) || std::ranges::any_of(extra, isOthers))
    {
        return false;
    }
    // Within what it holds already it takes nothing from others.
    const auto isOwn = [this, robot](std::size_t wanted) {
        return _holders[wanted] == robot;
    };
    const bool bHeld = isOwn(node) && std::ranges::all_of(extra, isOwn);
    FreeAll(robot);
    _vehicles[robot].path.push_back(node);
    Hold(robot, node);
    if (!extra.empty())
    {
        HoldFree(robot, extra);
    }
    Note(bHeld);
    return true;
}

void Traffic::HoldFree(std::size_t robot, std::span<const std::size_t> nodes)
{
    for (const std::size_t node : nodes)
    {
        if (!_holders[node].has_value())
        {
            Hold(robot, node);
            _vehicles[robot].extra.push_back(node);
        }
    }
    Note(false);
}

std::size_t Traffic::Extend(std::size_t robot, std::span<const std::size_t> ahead)
{
    _blockers.clear();
    Vehicle& vehicle = _vehicles[robot];
    assert(!vehicle.path.empty());
    std::size_t count = 0;
    while (count < ahead.size() && IsFreeFor(ahead[count], robot))
    {
        ++count;
    }
    if (count == 0)
    {
        _blockers = ahead.empty() ? std::vector<std::size_t>() : GetHolders(ahead.front(), robot);
        return 0;
    }
    if (!IsSafe(robot, ahead.first(count)))
    {
        // The next one at least; what lies between is asked for again as it goes.
        count = count > 1 && IsSafe(robot, ahead.first(1)) ? 1 : 0;
    }
    for (const std::size_t node : ahead.first(count))
    {
        if (std::erase(vehicle.extra, node) == 0)
        {
            Hold(robot, node);
        }
        vehicle.path.push_back(node);
    }
    if (count > 0)
    {
        _blockers.clear();
        Note(true);
    }
    return count;
}

bool Traffic::TryOverrun(std::size_t robot, std::span<const std::size_t> ahead)
{
    Vehicle& vehicle = _vehicles[robot];
    const bool bTaken = std::ranges::any_of(ahead, [this](std::size_t node) { return _holders[node].has_value(); });
    if (bTaken)
    {
        return false;
    }
    for (const std::size_t node : ahead)
    {
        Hold(robot, node);
        vehicle.path.push_back(node);
    }
    Note(false);
    return true;
}

void Traffic::Pass(std::size_t robot, std::size_t count)
{
    Vehicle& vehicle = _vehicles[robot];
    assert(count < vehicle.path.size());
    for (std::size_t i = 0; i < count; ++i)
    {
        Free(vehicle.path[i]);
    }
    vehicle.path.erase(vehicle.path.begin(), vehicle.path.begin() + static_cast<std::ptrdiff_t>(count));
    if (count > 0)
    {
        std::ranges::for_each(vehicle.extra, [this](std::size_t node) { Free(node); });
        vehicle.extra.clear();
        Note(true);
    }
}

void Traffic::Shorten(std::size_t robot, std::size_t count)
{
    Vehicle& vehicle = _vehicles[robot];
    assert(count > 0);
    while (vehicle.path.size() > count)
    {
        Free(vehicle.path.back());
        vehicle.path.pop_back();
    }
    Note(true);
}

std::optional<std::size_t> Traffic::GetHolderOrNull(std::size_t node) const
{
    return _holders[node];
}

std::span<const std::size_t> Traffic::GetHeld(std::size_t robot) const
{
    return _vehicles[robot].path;
}

bool Traffic::IsFreeFor(std::size_t node, std::size_t robot) const
{
    return _covers[node] == 0 || std::ranges::all_of(_near[node], [this, robot](std::uint32_t near) {
               return !_holders[near].has_value() || _holders[near] == robot;
           });
}

bool Traffic::IsOpenFor(std::size_t node, std::size_t robot) const
{
    return IsFreeFor(node, robot) && !IsHomeOfOther(_vehicles[robot], node);
}

std::vector<std::size_t> Traffic::GetHolders(std::size_t node, std::size_t robot) const
{
    std::vector<std::size_t> holders;
    for (const std::uint32_t near : _near[node])
    {
        const std::optional<std::size_t>& holder = _holders[near];
        if (holder.has_value() && *holder != robot && std::ranges::count(holders, *holder) == 0)
        {
            holders.push_back(*holder);
        }
    }
    return holders;
}

bool Traffic::IsNear(std::size_t left, std::size_t right) const
{
    return std::ranges::count(_near[left], right) > 0;
}

const std::vector<std::size_t>& Traffic::GetBlockers() const noexcept
{
    return _blockers;
}

std::vector<std::size_t> Traffic::GetFixed(std::size_t robot) const
{
    std::vector<std::size_t> fixed;
    for (std::size_t other = 0; other < _vehicles.size(); ++other)
    {
        const bool bHolds = !_vehicles[other].path.empty() || !_vehicles[other].extra.empty();
        if (other != robot && !_vehicles[other].bMovable && bHolds)
        {
            fixed.push_back(other);
        }
    }
    return fixed;
}

std::uint64_t Traffic::GetFreedCount() const noexcept
{
    return _freedCount;
}

void Traffic::Cover(const Vehicle& vehicle, std::vector<std::uint16_t>& covers, bool bAdd) const
{
    const auto change = [this, &covers, bAdd](std::size_t node) {
        for (const std::uint32_t near : _near[node])
        {
            covers[near] = static_cast<std::uint16_t>(bAdd ? covers[near] + 1 : covers[near] - 1);
        }
    };
    std::ranges::for_each(vehicle.path, change);
    std::ranges::for_each(vehicle.extra, change);
}

bool Traffic::IsAnyFixed() const
{
    return std::ranges::any_of(_vehicles, [](const Vehicle& vehicle) {
        return !vehicle.bMovable && (!vehicle.path.empty() || !vehicle.extra.empty());
    });
}

bool Traffic::IsHomeOfOther(const Vehicle& vehicle, std::size_t node) const
{
    const std::size_t own = vehicle.home.has_value() && IsNear(*vehicle.home, node) ? 1 : 0;
    return _homes[node] > own;
}

/// Around what is covered and around the homes of others, so that it does not matter who has come home before.
bool Traffic::HasWay(const Vehicle& vehicle, std::size_t from, std::size_t to, const std::vector<std::uint16_t>& covers)
    const
{
    if (from == to)
    {
        return true;
    }
    if (covers[to] > 0)
    {
        return false;
    }
    ++_search;
    _open.assign(1, static_cast<std::uint32_t>(from));
    _seen[from] = _search;
    for (std::size_t next = 0; next < _open.size(); ++next)
    {
        for (const Lane& lane : vehicle.graphOrNull->GetLanesFrom(_open[next]))
        {
            if (lane.to == to)
            {
                return true;
            }
            if (_seen[lane.to] != _search && covers[lane.to] == 0 && !IsHomeOfOther(vehicle, lane.to))
            {
                _seen[lane.to] = _search;
                _open.push_back(static_cast<std::uint32_t>(lane.to));
            }
        }
    }
    return false;
}

bool Traffic::HasStraightWayHome(const Vehicle& vehicle, std::size_t from, const std::vector<std::uint16_t>& covers)
    const
{
    for (std::size_t node = from; node != *vehicle.home; node = vehicle.nextToHome[node])
    {
        const std::uint32_t next = vehicle.nextToHome[node];
        if (next == NOWHERE || covers[next] > 0 || IsHomeOfOther(vehicle, next))
        {
            return false;
        }
    }
    return true;
}

/// Covers are those of all others.
bool Traffic::CanGoHome(const Vehicle& vehicle, std::size_t from, const std::vector<std::uint16_t>& covers)
{
    FindReturns();
    if (!vehicle.bCanReturn)
    {
        return false;
    }
    return HasStraightWayHome(vehicle, from, covers) || HasWay(vehicle, from, *vehicle.home, covers);
}

/// Whoever can drive home does, and leaves the floor to the rest; in which order makes no difference to who can. All that
/// a robot was granted counts as taken until it goes, as it may be stopped on any of it.
Traffic::Homecoming Traffic::FindHomecoming(EStanding standing)
{
    Homecoming found;
    found.reachable.assign(_vehicles.size(), false);
    found.bValid = true;
    std::vector<std::uint16_t> covers = _covers;
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < _vehicles.size(); ++i)
    {
        if (!_vehicles[i].path.empty() && (standing == AllMove || _vehicles[i].bMovable))
        {
            waiting.push_back(i);
        }
    }
    for (bool bChanged = true; std::exchange(bChanged, false);)
    {
        const auto isGone = [this, &covers, &found, &bChanged](std::size_t robot) {
            const Vehicle& vehicle = _vehicles[robot];
            Cover(vehicle, covers, false);
            if (CanGoHome(vehicle, GetEnd(vehicle), covers))
            {
                found.reachable[robot] = true;
                bChanged = true;
                return true;
            }
            Cover(vehicle, covers, true);
            return false;
        };
        std::erase_if(waiting, isGone);
    }
    found.bAll = waiting.empty();
    return found;
}

const Traffic::Homecoming& Traffic::GetHomecoming(EStanding standing)
{
    if (!_homecomings[standing].bValid)
    {
        _homecomings[standing] = FindHomecoming(standing);
    }
    return _homecomings[standing];
}

/// Whether nobody has lost his way home by what is held on trial; who has is a blocker of the robot.
bool Traffic::IsAsGood(EStanding standing, std::size_t robot)
{
    const Homecoming after = FindHomecoming(standing);
    bool bGood = true;
    for (std::size_t other = 0; other < _vehicles.size(); ++other)
    {
        const bool bLost = _homecomings[standing].reachable[other] && !after.reachable[other];
        bGood = bGood && !bLost;
        if (bLost && other != robot && std::ranges::count(_blockers, other) == 0)
        {
            _blockers.push_back(other);
        }
    }
    return bGood;
}

bool Traffic::IsSafe(std::size_t robot, std::span<const std::size_t> ahead)
{
    Vehicle& vehicle = _vehicles[robot];
    // Where it can go home before all others, the floor is then as free as if it had never been here.
    Cover(vehicle, _covers, false);
    const bool bFirst = vehicle.bMovable && CanGoHome(vehicle, ahead.back(), _covers);
    Cover(vehicle, _covers, true);
    if (bFirst)
    {
        return true;
    }
    // As it is now; not after the nodes are held below.
    static_cast<void>(GetHomecoming(AllMove));
    const std::size_t heldCount = vehicle.path.size();
    std::vector<std::size_t> held;
    const auto take = [this, robot, ahead, &vehicle, &held] {
        for (const std::size_t node : ahead)
        {
            vehicle.path.push_back(node);
            if (std::ranges::count(vehicle.extra, node) == 0)
            {
                Hold(robot, node);
                held.push_back(node);
            }
        }
    };
    const auto giveBack = [this, heldCount, &vehicle, &held] {
        vehicle.path.resize(heldCount);
        std::ranges::for_each(held, [this](std::size_t node) { Free(node); });
        held.clear();
    };
    take();
    bool bSafe = IsAsGood(AllMove, robot);
    giveBack();
    if (bSafe && IsAnyFixed())
    {
        static_cast<void>(GetHomecoming(AsIs));
        take();
        bSafe = IsAsGood(AsIs, robot);
        giveBack();
    }
    if (!bSafe && _blockers.empty())
    {
        _blockers = GetFixed(robot);
    }
    return bSafe;
}

bool Traffic::CanServe(std::size_t robot, std::size_t node) const
{
    const Vehicle& vehicle = _vehicles[robot];
    if (vehicle.path.empty() || !vehicle.home.has_value() || vehicle.graphOrNull == nullptr || !IsAnyFixed())
    {
        return true;
    }
    const auto canServe = [this, &vehicle, node](const std::vector<std::uint16_t>& covers) {
        return HasWay(vehicle, GetEnd(vehicle), node, covers) && HasWay(vehicle, node, *vehicle.home, covers);
    };
    std::vector<std::uint16_t> covers(_covers.size(), 0);
    const std::vector<std::uint16_t> none = covers;
    for (const Vehicle& other : _vehicles)
    {
        if (!other.bMovable && &other != &vehicle)
        {
            Cover(other, covers, true);
        }
    }
    return canServe(covers) || !canServe(none);
}

} // namespace ACS::Planning
