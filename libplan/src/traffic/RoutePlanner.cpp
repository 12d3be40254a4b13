#include "traffic/RoutePlanner.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// The second route begins at the last node of the first one.
Route Join(Route first, Route second)
{
    first.nodes.insert(
        first.nodes.end(),
        std::make_move_iterator(second.nodes.begin() + 1),
        std::make_move_iterator(second.nodes.end()));
    first.edges.insert(
        first.edges.end(),
        std::make_move_iterator(second.edges.begin()),
        std::make_move_iterator(second.edges.end()));
    first.travelSeconds += second.travelSeconds;
    return first;
}

} // namespace

RoutePlanner::RoutePlanner(const SiteMap& site, const BlockBook& blocks)
    : _site(site),
      _blocks(blocks),
      _router(site)
{
}

void RoutePlanner::OnBlocksChanged()
{
    if (_blocks.IsEmpty())
    {
        _openRouter.reset();
        return;
    }
    if (_openRouter == nullptr)
    {
        _openRouter = std::make_unique<Router>(_site);
    }
    _openRouter->SetBlocked(_blocks.GetNodes(), _blocks.GetEdges());
}

const Router& RoutePlanner::GetOpenRouter() const noexcept
{
    return _openRouter == nullptr ? _router : *_openRouter;
}

const Block* RoutePlanner::FindBlockOrNull(const Robot& robot, std::size_t target) const
{
    if (_blocks.IsEmpty() || PlanRouteOrNull(robot, target, {}).has_value())
    {
        return nullptr;
    }
    std::optional<Route> route = FindLaneOrNull(robot, target);
    if (!route.has_value() || _blocks.CountOpen(*route, 1) == route->nodes.size())
    {
        const std::vector<SiteNode>& nodes = _site.GetNodes();
        const std::string startID = route.has_value() ? route->nodes.back().nodeID : nodes[*robot.place.node].nodeID;
        route =
            _router.FindRouteOrNull(robot.options->vehicleTypeID, robot.GetLoad(), startID, nodes[target].nodeID, {});
    }
    const std::size_t open = route.has_value() ? _blocks.CountOpen(*route, 1) : 0;
    return route.has_value() && open < route->nodes.size() ? _blocks.FindOnRouteOrNull(*route, open) : nullptr;
}

const Router& RoutePlanner::GetRouter() const noexcept
{
    return _router;
}

bool RoutePlanner::HasRoute(const Robot& robot, std::size_t target)
{
    const std::optional<PlannedRoute>& planned = robot.search.plannedRoute;
    return planned.has_value() && planned->target == target && planned->load == robot.GetLoad();
}

bool RoutePlanner::TryPlanRoute(Robot& robot, std::size_t target) const
{
    if (!HasRoute(robot, target))
    {
        robot.search.plannedRoute = PlanRouteOrNull(robot, target, {});
    }
    return robot.search.plannedRoute.has_value();
}

std::optional<PlannedRoute> RoutePlanner::PlanRouteOrNull(
    const Robot& robot,
    std::size_t target,
    const Router::NodeFilter& isExcluded) const
{
    const std::vector<SiteNode>& nodes = _site.GetNodes();
    std::optional<Route> lane = FindLaneOrNull(robot, target);
    if (lane.has_value() && _blocks.CountOpen(*lane, 1) < lane->nodes.size())
    {
        return std::nullopt; // it cannot turn round
    }
    const std::string startID = lane.has_value() ? lane->nodes.back().nodeID : nodes[*robot.place.node].nodeID;
    std::optional<Route> route =
        GetOpenRouter()
            .FindRouteOrNull(robot.options->vehicleTypeID, robot.GetLoad(), startID, nodes[target].nodeID, isExcluded);
    if (!route.has_value())
    {
        return std::nullopt;
    }
    if (lane.has_value())
    {
        route = Join(std::move(*lane), std::move(*route));
    }
    PlannedRoute plannedRoute;
    plannedRoute.target = target;
    plannedRoute.load = robot.GetLoad();
    for (const RouteNode& node : route->nodes)
    {
        plannedRoute.nodes.push_back(*_site.FindNodeIndexOrNull(node.nodeID));
    }
    plannedRoute.route = std::move(*route);
    return plannedRoute;
}

std::optional<Route> RoutePlanner::FindLaneOrNull(const Robot& robot, std::size_t target) const
{
    if (!robot.place.heading.has_value())
    {
        return std::nullopt;
    }
    const std::vector<SiteNode>& nodes = _site.GetNodes();
    const std::string& vehicleTypeID = robot.options->vehicleTypeID;
    const std::string& nextID = nodes[*robot.place.heading].nodeID;
    const ELoad load = robot.GetLoad();
    const auto isExcluded = [](std::size_t) {
        return true; // another way there may be quicker
    };
    std::optional<Route> lane =
        _router.FindRouteOrNull(vehicleTypeID, load, nodes[*robot.place.node].nodeID, nextID, isExcluded);
    const bool bReaches =
        lane.has_value() && _router.FindRouteOrNull(vehicleTypeID, load, nextID, nodes[target].nodeID, {}).has_value();
    return bReaches ? lane : std::nullopt;
}

void RoutePlanner::ReachStart(const Robot& robot, Route& route)
{
    if (!robot.view.state.has_value())
    {
        return;
    }
    constexpr double MARGIN = 0.1;
    RouteNode& first = route.nodes.front();
    const double distance = std::hypot(robot.view.state->x - first.x, robot.view.state->y - first.y);
    first.allowedDeviation = std::max(first.allowedDeviation, distance + MARGIN);
}

} // namespace ACS::Planning
