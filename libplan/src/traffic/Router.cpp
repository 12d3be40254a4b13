#include "site/DriveTime.hpp"
#include "traffic/FloorGraph.hpp"
#include <acs/plan/Router.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

constexpr double NEVER = std::numeric_limits<double>::infinity();
constexpr std::size_t NO_LANE = std::numeric_limits<std::size_t>::max();

/// Cached targets per vehicle type; each takes 50 kB with 2,000 nodes.
constexpr std::size_t TARGETS_KEPT = 128;

/// By time, then by index, so that the result is the same among routes of equal time.
using Entry = std::pair<double, std::size_t>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

/// Times to a target without turning: Dijkstra's algorithm backwards, as far as requested.
struct Field
{
    std::vector<double> seconds;    ///< Of each node.
    std::vector<bool> settled;      ///< Whether the time is final.
    std::vector<std::size_t> lanes; ///< By node: the first lane of the route.
    Queue open;
    std::uint64_t usedAt = 0;
};

struct Graph
{
    FloorGraph floor;
    bool bTurns = false;                 ///< Whether the map gives any rotation speed.
    std::map<std::size_t, Field> fields; ///< By target.
};

/// The actions that are always performed.
std::vector<SiteAction> ListRequired(const std::vector<SiteAction>& actions)
{
    std::vector<SiteAction> required;
    std::ranges::copy_if(actions, std::back_inserter(required), [](const SiteAction& action) {
        return action.requirement == EActionRequirement::Required;
    });
    return required;
}

} // namespace

class Router::Impl
{
    /// By ELoad; the same graph where the map does not distinguish loads.
    using Graphs = std::array<std::shared_ptr<Graph>, 3>;

    const SiteMap& _site;
    std::map<std::string, Graphs, std::less<>> _graphs; ///< By vehicle type. Searches keep what they found.
    std::vector<bool> _blockedNodes;                    ///< Of the map; empty: none.
    std::vector<bool> _blockedEdges;
    mutable std::uint64_t _visitedNodes = 0;
    mutable std::uint64_t _uses = 0;

public:
    explicit Impl(const SiteMap& site)
        : _site(site)
    {
        for (const SiteEdge& edge : site.GetEdges())
        {
            for (const SiteEdgeRule& rule : edge.rules)
            {
                const auto [entry, bNew] = _graphs.try_emplace(rule.vehicleTypeID);
                if (!bNew)
                {
                    continue;
                }
                const bool bRestricted = IsLoadRestricted(site, rule.vehicleTypeID);
                for (const ELoad load : {ELoad::Unknown, ELoad::Empty, ELoad::Loaded})
                {
                    entry->second[static_cast<std::size_t>(load)] =
                        bRestricted || load == ELoad::Unknown ? MakeGraph(rule.vehicleTypeID, load) : entry->second[0];
                }
            }
        }
    }

    void SetBlocked(std::vector<bool> nodes, std::vector<bool> edges)
    {
        _blockedNodes = std::move(nodes);
        _blockedEdges = std::move(edges);
        for (auto& [vehicleTypeID, graphs] : _graphs)
        {
            std::ranges::for_each(graphs, [](const std::shared_ptr<Graph>& graph) { graph->fields.clear(); });
        }
    }

    [[nodiscard]] std::uint64_t CountVisitedNodes() const noexcept
    {
        return _visitedNodes;
    }

    [[nodiscard]] RouteNode MakeNode(std::size_t nodeIndex, std::string_view vehicleTypeID) const
    {
        const SiteNode& node = _site.GetNodes()[nodeIndex];
        const SiteNodeRule* ruleOrNull = node.FindRuleOrNull(vehicleTypeID);
        return {
            node.nodeID,
            node.x,
            node.y,
            ruleOrNull == nullptr ? std::nullopt : ruleOrNull->theta,
            node.mapID,
            _site.GetAllowedDeviation(nodeIndex),
            ruleOrNull == nullptr ? std::vector<SiteAction>() : ListRequired(ruleOrNull->actions)};
    }

    [[nodiscard]] RouteEdge MakeEdge(std::size_t edgeIndex, double length, std::string_view vehicleTypeID) const
    {
        const SiteEdge& edge = _site.GetEdges()[edgeIndex];
        const SiteEdgeRule& rule = *edge.FindRuleOrNull(vehicleTypeID);
        return {
            edge.edgeID,
            edge.startNodeID,
            edge.endNodeID,
            length,
            rule.maxSpeed,
            rule.maxRotationSpeed,
            rule.orientation,
            rule.orientationType,
            rule.bRotationAllowed,
            rule.minHeight,
            rule.maxHeight,
            rule.trajectory,
            edge.corridor,
            ListRequired(rule.actions)};
    }

    [[nodiscard]] std::optional<Route> MakeRouteOrNull(std::string_view vehicleTypeID, std::size_t edgeIndex) const
    {
        const SiteEdge& edge = _site.GetEdges()[edgeIndex];
        const std::size_t from = *_site.FindNodeIndexOrNull(edge.startNodeID);
        const std::size_t to = *_site.FindNodeIndexOrNull(edge.endNodeID);
        const SiteEdgeRule* const ruleOrNull = edge.FindRuleOrNull(vehicleTypeID);
        if (ruleOrNull == nullptr || _site.GetNodes()[from].FindRuleOrNull(vehicleTypeID) == nullptr
            || _site.GetNodes()[to].FindRuleOrNull(vehicleTypeID) == nullptr)
        {
            return std::nullopt;
        }
        const double length = _site.GetLength(edge, *ruleOrNull);
        return Route{
            {MakeNode(from, vehicleTypeID), MakeNode(to, vehicleTypeID)},
            {MakeEdge(edgeIndex, length, vehicleTypeID)},
            GetDriveSeconds(length, ruleOrNull->maxSpeed)};
    }

    [[nodiscard]] std::optional<Route> FindOrNull(
        std::string_view vehicleTypeID,
        ELoad load,
        std::string_view fromNodeID,
        std::string_view toNodeID,
        const NodeFilter& isExcluded) const
    {
        const std::optional<std::size_t> from = _site.FindNodeIndexOrNull(fromNodeID);
        const std::optional<std::size_t> to = _site.FindNodeIndexOrNull(toNodeID);
        if (!from.has_value() || !to.has_value())
        {
            return std::nullopt;
        }
        if (*from == *to)
        {
            Route route;
            route.nodes.push_back(MakeNode(*from, vehicleTypeID));
            return route;
        }
        Graph* const graphOrNull = FindGraphOrNull(vehicleTypeID, load);
        if (graphOrNull == nullptr)
        {
            return std::nullopt;
        }
        Graph& graph = *graphOrNull;
        Field& field = GetField(graph, *to);
        Settle(
            graph.floor,
            field,
            [from](std::size_t node) { return node == *from; },
            *from);
        if (!field.settled[*from])
        {
            return std::nullopt;
        }
        if (isExcluded || graph.bTurns)
        {
            return SearchOrNull(graph, field, *from, *to, isExcluded, vehicleTypeID);
        }
        std::vector<std::size_t> lanes;
        for (std::size_t node = *from; node != *to; node = graph.floor.GetLanes()[lanes.back()].to)
        {
            lanes.push_back(field.lanes[node]);
        }
        return MakeRoute(*from, lanes, field.seconds[*from], vehicleTypeID, graph.floor);
    }

    [[nodiscard]] std::optional<QuickestStart> FindQuickestStartOrNull(
        std::string_view vehicleTypeID,
        ELoad load,
        std::span<const std::size_t> starts,
        std::size_t target) const
    {
        if (std::ranges::count(starts, target) > 0)
        {
            return QuickestStart{target, 0.0};
        }
        Graph* const graphOrNull = FindGraphOrNull(vehicleTypeID, load);
        if (graphOrNull == nullptr || starts.empty())
        {
            return std::nullopt;
        }
        Field& field = GetField(*graphOrNull, target);
        std::vector<bool> marks(_site.GetNodes().size(), false);
        bool bKnown = false;
        for (const std::size_t start : starts)
        {
            marks[start] = true;
            bKnown = bKnown || field.settled[start];
        }
        if (!bKnown)
        {
            Settle(
                graphOrNull->floor,
                field,
                [&marks](std::size_t node) { return marks[node]; },
                NO_LANE);
        }
        std::optional<QuickestStart> quickest;
        for (const std::size_t start : starts)
        {
            const bool bQuicker = !quickest.has_value()
                || Entry(field.seconds[start], start) < Entry(quickest->travelSeconds, quickest->nodeIndex);
            if (field.settled[start] && bQuicker)
            {
                quickest = QuickestStart{start, field.seconds[start]};
            }
        }
        return quickest;
    }

private:
    [[nodiscard]] bool IsBlocked(const Lane& lane) const
    {
        return !_blockedNodes.empty() && (_blockedNodes[lane.to] || _blockedEdges[lane.edge]);
    }

    [[nodiscard]] std::shared_ptr<Graph> MakeGraph(std::string_view vehicleTypeID, ELoad load) const
    {
        auto graph = std::make_shared<Graph>(Graph{FloorGraph(_site, vehicleTypeID, load), false, {}});
        graph->bTurns =
            std::ranges::any_of(graph->floor.GetLanes(), [](const Lane& lane) { return lane.turnSpeed > 0; });
        return graph;
    }

    [[nodiscard]] Graph* FindGraphOrNull(std::string_view vehicleTypeID, ELoad load) const
    {
        const auto found = _graphs.find(vehicleTypeID);
        return found == _graphs.end() ? nullptr : found->second[static_cast<std::size_t>(load)].get();
    }

    [[nodiscard]] Field& GetField(Graph& graph, std::size_t target) const
    {
        const auto [place, bNew] = graph.fields.try_emplace(target);
        Field& field = place->second;
        ++_uses;
        field.usedAt = _uses;
        if (!bNew)
        {
            return field;
        }
        field.seconds.assign(graph.floor.GetNodeCount(), NEVER);
        field.settled.assign(graph.floor.GetNodeCount(), false);
        field.lanes.assign(graph.floor.GetNodeCount(), NO_LANE);
        field.seconds[target] = 0;
        field.open.emplace(0, target);
        if (graph.fields.size() > TARGETS_KEPT)
        {
            graph.fields.erase(
                std::ranges::min_element(graph.fields, {}, [](const auto& entry) { return entry.second.usedAt; }));
        }
        return field;
    }

    /// Continues until a wanted node is settled.
    template <typename TWanted>
    void Settle(const FloorGraph& floor, Field& field, TWanted isWanted, std::size_t askedNode) const
    {
        if (askedNode != NO_LANE && field.settled[askedNode])
        {
            return;
        }
        while (!field.open.empty())
        {
            const std::size_t node = field.open.top().second;
            field.open.pop();
            if (field.settled[node])
            {
                continue; // a quicker route was found since
            }
            field.settled[node] = true;
            ++_visitedNodes;
            for (const std::size_t index : floor.GetLanesTo(node))
            {
                const Lane& lane = floor.GetLanes()[index];
                const double seconds = field.seconds[node] + lane.seconds;
                if (seconds < field.seconds[lane.from] && !IsBlocked(lane))
                {
                    field.seconds[lane.from] = seconds;
                    field.lanes[lane.from] = index;
                    field.open.emplace(seconds, lane.from);
                }
            }
            if (isWanted(node))
            {
                return;
            }
        }
    }

    /// A* over lanes, because turning depends on the previous lane. The field is the estimate of the remaining time.
    [[nodiscard]] std::optional<Route> SearchOrNull(
        const Graph& graph,
        Field& field,
        std::size_t from,
        std::size_t to,
        const NodeFilter& isExcluded,
        std::string_view vehicleTypeID) const
    {
        const FloorGraph& floor = graph.floor;
        const SiteNodeRule* targetRuleOrNull = _site.GetNodes()[to].FindRuleOrNull(vehicleTypeID);
        std::vector<double> seconds(floor.GetLanes().size(), NEVER);
        std::vector<std::size_t> previous(seconds.size(), NO_LANE);
        std::vector<bool> done(seconds.size(), false);
        Queue open;
        const auto reach = [&](const Lane& lane, double before, std::size_t last) {
            const std::size_t index = floor.GetIndex(lane);
            if (lane.to == from || IsBlocked(lane) || (lane.to != to && isExcluded && isExcluded(lane.to)))
            {
                return;
            }
            Settle(
                floor,
                field,
                [&lane](std::size_t node) { return node == lane.to; },
                lane.to);
            double reached = before + lane.seconds;
            if (lane.to == to && targetRuleOrNull != nullptr && targetRuleOrNull->theta.has_value()
                && lane.turnSpeed > 0)
            {
                reached += GetAngleBetween(lane.heading, *targetRuleOrNull->theta) / lane.turnSpeed;
            }
            if (field.settled[lane.to] && reached < seconds[index])
            {
                seconds[index] = reached;
                previous[index] = last;
                open.emplace(reached + field.seconds[lane.to], index);
            }
        };
        for (const Lane& lane : floor.GetLanesFrom(from))
        {
            reach(lane, 0, NO_LANE);
        }
        while (!open.empty())
        {
            const std::size_t index = open.top().second;
            open.pop();
            if (done[index])
            {
                continue;
            }
            done[index] = true;
            ++_visitedNodes;
            const Lane& lane = floor.GetLanes()[index];
            if (lane.to == to)
            {
                return MakeRoute(from, GetPath(floor, previous, index), seconds[index], vehicleTypeID, floor);
            }
            for (const Lane& next : floor.GetLanesFrom(lane.to))
            {
                reach(next, seconds[index] + FloorGraph::GetTurnSeconds(lane, next), index);
            }
        }
        return std::nullopt;
    }

    /// In driving order. Loops that avoid turning are removed: a route has each node once.
    [[nodiscard]] static std::vector<std::size_t> GetPath(
        const FloorGraph& floor,
        const std::vector<std::size_t>& previous,
        std::size_t last)
    {
        std::vector<std::size_t> path;
        for (std::size_t index = last; index != NO_LANE; index = previous[index])
        {
            const std::size_t node = floor.GetLanes()[index].to;
            const auto again = std::ranges::find_if(path, [&floor, node](std::size_t later) {
                return floor.GetLanes()[later].to == node;
            });
            path.erase(again, path.end());
            path.push_back(index);
        }
        std::ranges::reverse(path);
        return path;
    }

    [[nodiscard]] Route MakeRoute(
        std::size_t from,
        const std::vector<std::size_t>& lanes,
        double travelSeconds,
        std::string_view vehicleTypeID,
        const FloorGraph& floor) const
    {
        Route route;
        route.travelSeconds = travelSeconds;
        route.nodes.push_back(MakeNode(from, vehicleTypeID));
        for (const std::size_t index : lanes)
        {
            const Lane& lane = floor.GetLanes()[index];
            route.edges.push_back(MakeEdge(lane.edge, lane.length, vehicleTypeID));
            route.nodes.push_back(MakeNode(lane.to, vehicleTypeID));
        }
        return route;
    }
};

Router::Router(const SiteMap& site)
    : _impl(std::make_unique<Impl>(site))
{
}

Router::~Router() = default;

void Router::SetBlocked(std::vector<bool> nodes, std::vector<bool> edges)
{
    _impl->SetBlocked(std::move(nodes), std::move(edges));
}

std::optional<Route> Router::FindRouteOrNull(
    std::string_view vehicleTypeID,
    std::string_view fromNodeID,
    std::string_view toNodeID) const
{
    return _impl->FindOrNull(vehicleTypeID, ELoad::Unknown, fromNodeID, toNodeID, {});
}

std::optional<Route> Router::FindRouteOrNull(
    std::string_view vehicleTypeID,
    ELoad load,
    std::string_view fromNodeID,
    std::string_view toNodeID,
    const NodeFilter& isExcluded) const
{
    return _impl->FindOrNull(vehicleTypeID, load, fromNodeID, toNodeID, isExcluded);
}

std::optional<QuickestStart> Router::FindQuickestStartOrNull(
    std::string_view vehicleTypeID,
    ELoad load,
    std::span<const std::size_t> startIndices,
    std::size_t targetIndex) const
{
    return _impl->FindQuickestStartOrNull(vehicleTypeID, load, startIndices, targetIndex);
}

std::optional<Route> Router::MakeRouteOrNull(std::string_view vehicleTypeID, std::size_t edgeIndex) const
{
    return _impl->MakeRouteOrNull(vehicleTypeID, edgeIndex);
}

std::uint64_t Router::CountVisitedNodes() const noexcept
{
    return _impl->CountVisitedNodes();
}

} // namespace ACS::Planning
