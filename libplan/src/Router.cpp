#include <acs/plan/Router.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <string>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// An edge as a search goes along it: with the direction of travel or against it.
struct Lane
{
    std::size_t edgeIndex = 0;
    std::size_t nodeIndex = 0; ///< Where it leads.
    double seconds = 0;
};

using Lanes = std::vector<std::vector<Lane>>; ///< By the node where they begin.

/// What a vehicle type may drive along.
struct Graph
{
    Lanes onward;
    Lanes back;
};

/// How a search has reached a node.
struct Reached
{
    std::uint64_t search = 0; ///< Which one; what an earlier one has left means nothing.
    double seconds = 0;
    std::size_t edgeIndex = 0;
    std::size_t fromIndex = 0;
};

/// A route's nodes and edges by index, its beginning left out.
struct Leg
{
    std::size_t nodeIndex = 0;
    std::size_t edgeIndex = 0;
};

} // namespace

class Router::Impl
{
    const SiteMap& _site;
    std::map<std::string, Graph, std::less<>> _graphs;
    mutable std::uint64_t _visitedNodes = 0;
    mutable std::uint64_t _lastSearch = 0;
    mutable std::vector<Reached>
        _reached; ///< By node; kept, so that a search costs nothing for nodes that it never sees.

public:
    explicit Impl(const SiteMap& site)
        : _site(site),
          _reached(site.GetNodes().size())
    {
        for (std::size_t i = 0; i < site.GetEdges().size(); ++i)
        {
            for (const SiteEdgeRule& rule : site.GetEdges()[i].rules)
            {
                AddEdge(i, rule);
            }
        }
    }

    void AddEdge(std::size_t edgeIndex, const SiteEdgeRule& rule)
    {
        const SiteEdge& edge = _site.GetEdges()[edgeIndex];
        const std::size_t nodeCount = _site.GetNodes().size();
        Graph& graph = _graphs.try_emplace(rule.vehicleTypeID, Graph{Lanes(nodeCount), Lanes(nodeCount)}).first->second;
        const std::size_t start = *_site.FindNodeIndexOrNull(edge.startNodeID);
        const std::size_t end = *_site.FindNodeIndexOrNull(edge.endNodeID);
        const SiteNode& startNode = _site.GetNodes()[start];
        const SiteNode& endNode = _site.GetNodes()[end];
        const bool bFirstRule = edge.FindRuleOrNull(rule.vehicleTypeID) == &rule;
        if (!bFirstRule || startNode.FindRuleOrNull(rule.vehicleTypeID) == nullptr
            || endNode.FindRuleOrNull(rule.vehicleTypeID) == nullptr)
        {
            return;
        }
        const double seconds = GetDistance(startNode, endNode) / rule.maxSpeed.value_or(DEFAULT_SPEED);
        graph.onward[start].push_back(Lane{edgeIndex, end, seconds});
        graph.back[end].push_back(Lane{edgeIndex, start, seconds});
    }

    [[nodiscard]] std::uint64_t CountVisitedNodes() const noexcept
    {
        return _visitedNodes;
    }

    [[nodiscard]] RouteNode MakeNode(std::size_t nodeIndex, std::string_view vehicleTypeID) const
    {
        const SiteNode& node = _site.GetNodes()[nodeIndex];
        const SiteNodeRule* ruleOrNull = node.FindRuleOrNull(vehicleTypeID);
        return {node.nodeID, node.x, node.y, ruleOrNull == nullptr ? std::nullopt : ruleOrNull->theta, node.mapID};
    }

    [[nodiscard]] RouteEdge MakeEdge(std::size_t edgeIndex, std::string_view vehicleTypeID) const
    {
        const SiteEdge& edge = _site.GetEdges()[edgeIndex];
        const SiteEdgeRule& rule = *edge.FindRuleOrNull(vehicleTypeID);
        return {
            edge.edgeID,
            edge.startNodeID,
            edge.endNodeID,
            GetDistance(*_site.FindNodeOrNull(edge.startNodeID), *_site.FindNodeOrNull(edge.endNodeID)),
            rule.maxSpeed,
            rule.maxRotationSpeed,
            rule.orientation,
            rule.orientationType,
            rule.bRotationAllowed};
    }

    [[nodiscard]] std::optional<Route> FindOrNull(
        std::string_view vehicleTypeID,
        std::string_view fromNodeID,
        std::string_view toNodeID,
        const NodeFilter& isExcluded) const
    {
        const std::optional<std::size_t> from = _site.FindNodeIndexOrNull(fromNodeID);
        const std::optional<std::size_t> to = _site.FindNodeIndexOrNull(toNodeID);
        const auto found = _graphs.find(vehicleTypeID);
        if (!from.has_value() || !to.has_value() || (found == _graphs.end() && *from != *to))
        {
            return std::nullopt;
        }
        Route route;
        if (*from == *to)
        {
            route.nodes.push_back(MakeNode(*from, vehicleTypeID));
            return route;
        }
        const auto isAllowed = [&isExcluded, &from, &to](std::size_t node) {
            return node == *from || node == *to || !isExcluded || !isExcluded(node);
        };
        const auto isThere = [&to](std::size_t node) {
            return node == *to;
        };
        if (!SearchOrNull(found->second.onward, *from, isAllowed, isThere).has_value())
        {
            return std::nullopt;
        }
        route.travelSeconds = _reached[*to].seconds;
        AppendPath(*from, *to, vehicleTypeID, route);
        return route;
    }

    [[nodiscard]] std::optional<QuickestStart> FindQuickestStartOrNull(
        std::string_view vehicleTypeID,
        std::span<const std::size_t> starts,
        std::size_t target) const
    {
        std::vector<bool> startMarks(_site.GetNodes().size(), false);
        for (const std::size_t start : starts)
        {
            startMarks[start] = true;
        }
        const auto isStart = [&startMarks](std::size_t node) {
            return startMarks[node];
        };
        const auto isAllowed = [](std::size_t) {
            return true;
        };
        if (isStart(target))
        {
            return QuickestStart{target, 0.0};
        }
        const auto found = _graphs.find(vehicleTypeID);
        if (found == _graphs.end())
        {
            return std::nullopt;
        }
        const std::optional<std::size_t> start = SearchOrNull(found->second.back, target, isAllowed, isStart);
        return start.has_value() ? std::optional(QuickestStart{*start, _reached[*start].seconds}) : std::nullopt;
    }

private:
    /// Dijkstra's algorithm, which goes no farther than to the first node that is wanted: Boost's knows no end but an
    /// exception. Of several such nodes as near, that of the lowest index.
    template <typename TAllowed, typename TWanted>
    [[nodiscard]] std::optional<std::size_t> SearchOrNull(
        const Lanes& lanes,
        std::size_t start,
        TAllowed isAllowed,
        TWanted isWanted) const
    {
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
        const std::uint64_t search = ++_lastSearch;
        _reached[start] = Reached{search, 0.0, 0, start};
        open.emplace(0.0, start);
        while (!open.empty())
        {
            const Entry nearest = open.top();
            open.pop();
            const std::size_t node = nearest.second;
            if (nearest.first > _reached[node].seconds)
            {
                continue; // a quicker way was found since
            }
            ++_visitedNodes;
            if (isWanted(node))
            {
                return node;
            }
            for (const Lane& lane : lanes[node])
            {
                const double seconds = nearest.first + lane.seconds;
                Reached& reached = _reached[lane.nodeIndex];
                const bool bQuicker = reached.search != search || seconds < reached.seconds;
                if (bQuicker && isAllowed(lane.nodeIndex))
                {
                    reached = Reached{search, seconds, lane.edgeIndex, node};
                    open.emplace(seconds, lane.nodeIndex);
                }
            }
        }
        return std::nullopt;
    }

    void AppendPath(std::size_t from, std::size_t to, std::string_view vehicleTypeID, Route& route) const
    {
        std::vector<Leg> legs;
        for (std::size_t node = to; node != from; node = _reached[node].fromIndex)
        {
            legs.push_back(Leg{node, _reached[node].edgeIndex});
        }
        route.nodes.push_back(MakeNode(from, vehicleTypeID));
        std::ranges::reverse(legs);
        for (const Leg& leg : legs)
        {
            route.edges.push_back(MakeEdge(leg.edgeIndex, vehicleTypeID));
            route.nodes.push_back(MakeNode(leg.nodeIndex, vehicleTypeID));
        }
    }
};

Router::Router(const SiteMap& site)
    : _impl(std::make_unique<Impl>(site))
{
}

Router::~Router() = default;

std::optional<Route> Router::FindRouteOrNull(
    std::string_view vehicleTypeID,
    std::string_view fromNodeID,
    std::string_view toNodeID) const
{
    return _impl->FindOrNull(vehicleTypeID, fromNodeID, toNodeID, {});
}

std::optional<Route> Router::FindRouteOrNull(
    std::string_view vehicleTypeID,
    std::string_view fromNodeID,
    std::string_view toNodeID,
    const NodeFilter& isExcluded) const
{
    return _impl->FindOrNull(vehicleTypeID, fromNodeID, toNodeID, isExcluded);
}

std::optional<QuickestStart> Router::FindQuickestStartOrNull(
    std::string_view vehicleTypeID,
    std::span<const std::size_t> startIndices,
    std::size_t targetIndex) const
{
    return _impl->FindQuickestStartOrNull(vehicleTypeID, startIndices, targetIndex);
}

std::uint64_t Router::CountVisitedNodes() const noexcept
{
    return _impl->CountVisitedNodes();
}

} // namespace ACS::Planning
