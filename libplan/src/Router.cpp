#include <acs/plan/Router.hpp>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths_no_color_map.hpp>
#include <boost/graph/filtered_graph.hpp>

#include <algorithm>
#include <cassert>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace ACS::Planning
{

namespace
{

struct Lane
{
    std::size_t edgeIndex = 0;
    double seconds = 0;
};

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Lane>;

/// Which nodes a search may use; Boost copies it and wants it without arguments too.
class NodePredicate
{
    const std::vector<bool>* _allowedOrNull = nullptr;

public:
    NodePredicate() = default;

    explicit NodePredicate(const std::vector<bool>& allowed)
        : _allowedOrNull(&allowed)
    {
    }

    bool operator()(std::size_t nodeIndex) const
    {
        return (*_allowedOrNull)[nodeIndex];
    }
};

} // namespace

class Router::Impl
{
    const SiteMap& _site;
    std::map<std::string, Graph, std::less<>> _graphs;

public:
    explicit Impl(const SiteMap& site)
        : _site(site)
    {
        std::set<std::string> types;
        for (const SiteEdge& edge : site.GetEdges())
        {
            for (const SiteEdgeRule& rule : edge.rules)
            {
                types.insert(rule.vehicleTypeID);
            }
        }
        for (const std::string& type : types)
        {
            // Filled where it stands: Boost's graphs are copied where one would move them.
            AddEdges(type, _graphs.try_emplace(type, site.GetNodes().size()).first->second);
        }
    }

    void AddEdges(std::string_view vehicleTypeID, Graph& graph) const
    {
        for (std::size_t i = 0; i < _site.GetEdges().size(); ++i)
        {
            const SiteEdge& edge = _site.GetEdges()[i];
            const std::size_t start = *_site.FindNodeIndexOrNull(edge.startNodeID);
            const std::size_t end = *_site.FindNodeIndexOrNull(edge.endNodeID);
            const SiteNode& startNode = _site.GetNodes()[start];
            const SiteNode& endNode = _site.GetNodes()[end];
            const SiteEdgeRule* ruleOrNull = edge.FindRuleOrNull(vehicleTypeID);
            if (ruleOrNull == nullptr || startNode.FindRuleOrNull(vehicleTypeID) == nullptr
                || endNode.FindRuleOrNull(vehicleTypeID) == nullptr)
            {
                continue;
            }
            const double seconds = GetDistance(startNode, endNode) / ruleOrNull->maxSpeed.value_or(DEFAULT_SPEED);
            boost::add_edge(start, end, Lane{i, seconds}, graph);
        }
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
        const Graph& graph = found->second;
        std::vector<bool> allowed(_site.GetNodes().size(), true);
        for (std::size_t i = 0; isExcluded && i < allowed.size(); ++i)
        {
            allowed[i] = i == *from || i == *to || !isExcluded(i);
        }
        const NodePredicate predicate(allowed);
        const boost::filtered_graph<Graph, boost::keep_all, NodePredicate> free(graph, boost::keep_all(), predicate);
        std::vector<std::size_t> predecessors(allowed.size());
        std::vector<double> seconds(allowed.size());
        boost::dijkstra_shortest_paths_no_color_map(
            free,
            *from,
            boost::weight_map(boost::get(&Lane::seconds, graph))
                .predecessor_map(
                    boost::make_iterator_property_map(predecessors.begin(), boost::get(boost::vertex_index, graph)))
                .distance_map(
                    boost::make_iterator_property_map(seconds.begin(), boost::get(boost::vertex_index, graph))));
        if (predecessors[*to] == *to)
        {
            return std::nullopt;
        }
        route.travelSeconds = seconds[*to];
        AppendPath(graph, predecessors, *from, *to, vehicleTypeID, route);
        return route;
    }

    void AppendPath(
        const Graph& graph,
        const std::vector<std::size_t>& predecessors,
        std::size_t from,
        std::size_t to,
        std::string_view vehicleTypeID,
        Route& route) const
    {
        std::vector<std::size_t> path{to};
        while (path.back() != from)
        {
            path.push_back(predecessors[path.back()]);
        }
        std::ranges::reverse(path);
        for (std::size_t i = 0; i < path.size(); ++i)
        {
            route.nodes.push_back(MakeNode(path[i], vehicleTypeID));
            if (i > 0)
            {
                route.edges.push_back(MakeEdge(FindQuickestEdge(graph, path[i - 1], path[i]), vehicleTypeID));
            }
        }
    }

    /// Two nodes may have several edges.
    [[nodiscard]] static std::size_t FindQuickestEdge(const Graph& graph, std::size_t from, std::size_t to)
    {
        const Lane* bestOrNull = nullptr;
        const auto [begin, end] = boost::out_edges(from, graph);
        for (auto edge = begin; edge != end; ++edge)
        {
            const Lane& lane = graph[*edge];
            if (boost::target(*edge, graph) == to && (bestOrNull == nullptr || lane.seconds < bestOrNull->seconds))
            {
                bestOrNull = &lane;
            }
        }
        assert(bestOrNull != nullptr);
        return bestOrNull->edgeIndex;
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

} // namespace ACS::Planning
