#include "PlanEngine.Impl.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

/// Robots that must get to a place, in the order of their plans.
std::vector<PlanEngine::Impl::Robot*> PlanEngine::Impl::GetWaiting()
{
    std::vector<Robot*> waiting;
    for (Robot& robot : _robots)
    {
        if (robot.activity == EActivity::Waits && !robot.drive.has_value() && IsUsable(robot))
        {
            waiting.push_back(&robot);
        }
    }
    std::ranges::sort(waiting, [](const Robot* left, const Robot* right) {
        return left->planOrNull->key < right->planOrNull->key;
    });
    return waiting;
}

std::optional<std::size_t> PlanEngine::Impl::GetTargetOrNull(const Robot& robot) const
{
    if (robot.retreatNode.has_value() || robot.planOrNull == nullptr)
    {
        return robot.retreatNode.has_value() ? robot.retreatNode : robot.homeNode;
    }
    return _admission.FindDockOrNull(
        robot.planOrNull->resolved.steps[robot.planOrNull->step].stationID,
        robot.options->vehicleTypeID);
}

void PlanEngine::Impl::MoveWaiting()
{
    for (Robot* robot : GetWaiting())
    {
        static_cast<void>(TryDrive(*robot));
    }
}

/// Robots without work that stand elsewhere than at home.
std::vector<PlanEngine::Impl::Robot*> PlanEngine::Impl::GetHomeless()
{
    std::vector<Robot*> homeless;
    for (Robot& robot : _robots)
    {
        const bool bIdle = robot.planOrNull == nullptr && !robot.drive.has_value() && !robot.bHomeRefused;
        if (bIdle && IsUsable(robot) && robot.homeNode.has_value() && robot.homeNode != robot.node)
        {
            homeless.push_back(&robot);
        }
    }
    return homeless;
}

/// The next way of a robot with a plan: the one that it waits for, else the one after the place where it works or to
/// which it drives. nullopt where it has none.
std::optional<Route> PlanEngine::Impl::FindComingRouteOrNull(const Robot& robot) const
{
    if (robot.planOrNull == nullptr || !IsUsable(robot))
    {
        return std::nullopt;
    }
    const std::string& vehicleTypeID = robot.options->vehicleTypeID;
    const bool bWaits = robot.activity == EActivity::Waits && !robot.drive.has_value();
    const std::size_t from = robot.drive.has_value() ? robot.drive->nodes.back() : *robot.node;
    const bool bRetreating = robot.drive.has_value() && robot.drive->goal == EGoal::Home;
    const std::vector<ResolvedStep>& steps = robot.planOrNull->resolved.steps;
    for (std::size_t step = robot.planOrNull->step + (bWaits || bRetreating ? 0 : 1); step < steps.size(); ++step)
    {
        const std::optional<std::size_t> dock = _admission.FindDockOrNull(steps[step].stationID, vehicleTypeID);
        if (dock.has_value() && dock != from)
        {
            return _router.FindRouteOrNull(
                vehicleTypeID,
                _site.GetNodes()[from].nodeID,
                _site.GetNodes()[*dock].nodeID);
        }
    }
    return std::nullopt;
}

/// A way home is taken whole and may be long: it is put off while a robot with a plan comes next along any of it. Not by
/// who stands in the way of a robot with a plan, or in the way of one who does: nobody waits for one who stays.
void PlanEngine::Impl::SendIdleHome()
{
    std::vector<Robot*> homeless = GetHomeless();
    if (homeless.empty())
    {
        return;
    }
    std::vector<bool> coming(_site.GetNodes().size(), false); // Robots with plans come here next.
    std::vector<bool> cleared(coming.size(), false);          // Nobody may stay here.
    const auto mark = [this](const std::optional<Route>& route, std::vector<bool>& nodes) {
        for (const std::size_t node : route.has_value() ? GetIndices(*route) : std::vector<std::size_t>())
        {
            nodes[node] = true;
        }
    };
    for (Robot& robot : _robots)
    {
        const std::optional<Route> route = FindComingRouteOrNull(robot);
        mark(route, coming);
        mark(route, cleared);
        // One that waits may have to go home first (PartCircles).
        if (robot.activity == EActivity::Waits && IsUsable(robot) && robot.homeNode.has_value())
        {
            mark(
                _router.FindRouteOrNull(
                    robot.options->vehicleTypeID,
                    _site.GetNodes()[*robot.node].nodeID,
                    _site.GetNodes()[*robot.homeNode].nodeID),
                cleared);
        }
    }
    const auto isPutOff = [this, &coming, &cleared](Robot* robot) {
        const bool bFound = TryFindWish(*robot, *robot->homeNode);
        if (!bFound || cleared[*robot->node])
        {
            return false;
        }
        return std::ranges::any_of(GetIndices(*robot->wish), [&coming](std::size_t node) { return coming[node]; });
    };
    // Who must go may itself find another in its way, who must go then, too.
    std::vector<Robot*> leaving;
    for (bool bChanged = true; std::exchange(bChanged, false);)
    {
        for (Robot*& robotOrNull : homeless)
        {
            if (robotOrNull != nullptr && !isPutOff(robotOrNull))
            {
                leaving.push_back(std::exchange(robotOrNull, nullptr));
                mark(leaving.back()->wish, cleared);
                bChanged = true;
            }
        }
    }
    for (Robot* robot : leaving)
    {
        static_cast<void>(TryDrive(*robot));
    }
}

/// Whether the robot has begun to drive, or stands where it wants to be.
bool PlanEngine::Impl::TryDrive(Robot& robot)
{
    const std::optional<std::size_t> target = GetTargetOrNull(robot);
    if (!target.has_value())
    {
        return false;
    }
    if (robot.node == target)
    {
        robot.retreatNode.reset();
        if (robot.planOrNull != nullptr && GetTargetOrNull(robot) == target)
        {
            BeginWork(robot);
        }
        return true;
    }
    if (!TryFindWish(robot, *target))
    {
        OnNoRoute(robot, *target);
        return false;
    }
    if (TryBeginDrive(robot, *robot.wish))
    {
        return true;
    }
    // Around those who stand in the way and have no reason to leave soon.
    const auto isStandingInTheWay = [this, &robot](std::size_t node) {
        const std::optional<std::size_t> holder = _reservations.GetHolderOrNull(node);
        return holder.has_value() && *holder != robot.index && !_robots[*holder].drive.has_value();
    };
    const std::vector<std::size_t> nodes = GetIndices(*robot.wish);
    if (!_reservations.IsFreeFor(*target, robot.index) || std::ranges::none_of(nodes, isStandingInTheWay))
    {
        return false;
    }
    const std::optional<Route> detour = _router.FindRouteOrNull(
        robot.options->vehicleTypeID,
        _site.GetNodes()[*robot.node].nodeID,
        _site.GetNodes()[*target].nodeID,
        isStandingInTheWay);
    return detour.has_value() && TryBeginDrive(robot, *detour);
}

bool PlanEngine::Impl::TryFindWish(Robot& robot, std::size_t target)
{
    if (!robot.wish.has_value() || robot.wishTarget != target)
    {
        robot.wishTarget = target;
        robot.wish = _router.FindRouteOrNull(
            robot.options->vehicleTypeID,
            _site.GetNodes()[*robot.node].nodeID,
            _site.GetNodes()[target].nodeID);
    }
    return robot.wish.has_value();
}

void PlanEngine::Impl::OnNoRoute(Robot& robot, std::size_t target)
{
    const std::string text = fmt::format(
        "{} has no way from {} to {}.",
        GetRobotID(robot),
        _site.GetNodes()[*robot.node].nodeID,
        _site.GetNodes()[target].nodeID);
    if (robot.planOrNull != nullptr && !robot.retreatNode.has_value())
    {
        FailPlan(*robot.planOrNull, text);
        return;
    }
    robot.retreatNode.reset();
    robot.bHomeRefused = true;
    StartTimer(EEngineTimer::HomeRetry, GetRobotID(robot), _options.homeRetry);
    Note(robot, text);
}

std::vector<std::size_t> PlanEngine::Impl::GetIndices(const Route& route) const
{
    std::vector<std::size_t> indices;
    for (const RouteNode& node : route.nodes)
    {
        indices.push_back(*_site.FindNodeIndexOrNull(node.nodeID));
    }
    return indices;
}

bool PlanEngine::Impl::TryBeginDrive(Robot& robot, const Route& route)
{
    ActiveDrive drive;
    drive.nodes = GetIndices(route);
    if (!_reservations.TryClaim(drive.nodes, robot.index))
    {
        return false;
    }
    drive.driveID = Core::MakeUuid(_random);
    robot.previousID = std::exchange(robot.commandID, drive.driveID);
    drive.route = route;
    drive.releasedCount = std::min(_options.baseLength, drive.nodes.size() - 1);
    drive.goal = robot.planOrNull == nullptr || robot.retreatNode.has_value() ? EGoal::Home : EGoal::Step;
    robot.bTouched = true;
    Command(robot, Drive{drive.driveID, drive.route, drive.releasedCount});
    StartTimer(EEngineTimer::DriveExtension, GetRobotID(robot), _options.extensionDelay);
    robot.drive = std::move(drive);
    return true;
}

/// A robot that wants to drive and cannot: it holds its place until it can.
bool PlanEngine::Impl::IsStanding(std::size_t robot) const
{
    const Robot& candidate = _robots[robot];
    return !candidate.drive.has_value() && candidate.activity != EActivity::Works && IsUsable(candidate);
}

std::vector<std::size_t> PlanEngine::Impl::GetStandingBlockers(Robot& robot)
{
    std::vector<std::size_t> blockers;
    const std::optional<std::size_t> target = GetTargetOrNull(robot);
    if (!target.has_value() || robot.node == target || !TryFindWish(robot, *target))
    {
        return blockers;
    }
    for (const std::size_t node : GetIndices(*robot.wish))
    {
        const std::optional<std::size_t> holder = _reservations.GetHolderOrNull(node);
        if (holder.has_value() && *holder != robot.index && IsStanding(*holder))
        {
            blockers.push_back(*holder);
        }
    }
    return blockers;
}

/// Robots that stand and wait for each other, the least urgent first: of those with plans the latest, then those without.
std::vector<PlanEngine::Impl::Robot*> PlanEngine::Impl::GetInCircles()
{
    std::vector<std::vector<std::size_t>> blockers(_robots.size());
    for (Robot& robot : _robots)
    {
        if (IsStanding(robot.index))
        {
            blockers[robot.index] = GetStandingBlockers(robot);
        }
    }
    const auto isFree = [&blockers](const Robot* start) {
        std::vector<bool> reached(blockers.size(), false);
        std::vector<std::size_t> open = blockers[start->index];
        while (!open.empty())
        {
            const std::size_t robot = open.back();
            open.pop_back();
            if (!reached[robot])
            {
                reached[robot] = true;
                open.insert(open.end(), blockers[robot].begin(), blockers[robot].end());
            }
        }
        return !reached[start->index];
    };
    std::vector<Robot*> standing = GetWaiting();
    std::ranges::reverse(standing);
    std::ranges::copy(GetHomeless(), std::back_inserter(standing));
    std::erase_if(standing, isFree);
    return standing;
}

/// Circles last for ever: one robot of them goes home first. Where none can get there, one goes to any place that is in
/// nobody's way, and whoever put off going home does so no longer.
void PlanEngine::Impl::PartCircles()
{
    if (GetWaiting().empty())
    {
        return;
    }
    const std::vector<Robot*> robots = GetInCircles();
    const bool bParted = std::ranges::any_of(robots, [this](Robot* robot) {
        return robot->homeNode.has_value() && TryRetreat(*robot, *robot->homeNode);
    });
    if (bParted || robots.empty()
        || std::ranges::any_of(robots, [this](Robot* robot) { return TryRetreatAnywhere(*robot); }))
    {
        return;
    }
    for (Robot* robot : GetHomeless())
    {
        static_cast<void>(TryDrive(*robot));
    }
}

bool PlanEngine::Impl::TryRetreat(Robot& robot, std::size_t node)
{
    if (robot.bHomeRefused || robot.retreatNode.has_value() || robot.node == node || !TryFindWish(robot, node))
    {
        return false;
    }
    robot.retreatNode = node;
    if (TryDrive(robot))
    {
        Note(robot, fmt::format("goes to {} first, out of the way of others", _site.GetNodes()[node].nodeID));
        return true;
    }
    robot.retreatNode.reset();
    return false;
}

bool PlanEngine::Impl::TryRetreatAnywhere(Robot& robot)
{
    std::vector<bool> wished(_site.GetNodes().size(), false);
    for (Robot& other : _robots)
    {
        const std::optional<std::size_t> target = GetTargetOrNull(other);
        const bool bWishes = &other != &robot && target.has_value() && IsStanding(other.index) && other.node != target;
        if (bWishes && TryFindWish(other, *target))
        {
            for (const std::size_t node : GetIndices(*other.wish))
            {
                wished[node] = true;
            }
        }
    }
    const std::string& vehicleTypeID = robot.options->vehicleTypeID;
    std::vector<std::pair<double, std::size_t>> refuges;
    for (const SiteStation& station : _site.GetStations())
    {
        const std::optional<std::size_t> dock = _admission.FindDockOrNull(station.stationID, vehicleTypeID);
        if (!dock.has_value() || wished[*dock] || !_reservations.IsFreeFor(*dock, robot.index))
        {
            continue;
        }
        const std::optional<Route> route = _router.FindRouteOrNull(
            vehicleTypeID,
            _site.GetNodes()[*robot.node].nodeID,
            _site.GetNodes()[*dock].nodeID);
        if (route.has_value())
        {
            refuges.emplace_back(route->travelSeconds, *dock);
        }
    }
    std::ranges::sort(refuges);
    return std::ranges::any_of(refuges, [this, &robot](const std::pair<double, std::size_t>& refuge) {
        return TryRetreat(robot, refuge.second);
    });
}

} // namespace ACS::Planning
