#include "EngineControl.hpp"
#include "FleetWorld.hpp"
#include <acs/plan/Router.hpp>

#include <benchmark/benchmark.h>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/astar_search.hpp>
#include <fmt/format.h>

#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

constexpr std::size_t COLUMNS = 50;
constexpr std::size_t ROWS = 40;
constexpr std::size_t NODES = COLUMNS * ROWS;

/// 2,000 nodes: rows alternately one-way, columns two-way.
SiteMap MakeLargeSite()
{
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    SiteEdgeRule rule;
    rule.vehicleTypeID = "lr";
    const auto join = [&edges, &rule](std::size_t from, std::size_t to) {
        edges.push_back({fmt::format("{}>{}", from, to), std::to_string(from), std::to_string(to), {rule}});
    };
    for (std::size_t node = 0; node < NODES; ++node)
    {
        const std::size_t column = node % COLUMNS;
        const std::size_t row = node / COLUMNS;
        nodes.push_back(
            {std::to_string(node), static_cast<double>(column), static_cast<double>(row), "", {{"lr", std::nullopt}}});
        if (column > 0 && row % 2 == 0)
        {
            join(node - 1, node);
        }
        if (column > 0 && row % 2 == 1)
        {
            join(node, node - 1);
        }
        if (row > 0)
        {
            join(node - COLUMNS, node);
            join(node, node - COLUMNS);
        }
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), {});
}

/// Ends of the next route, all over the site: each target is repeated after 2,000 routes.
std::pair<std::size_t, std::size_t> GetEnds(std::size_t number)
{
    return {number * 1'237 % NODES, number * 733 % NODES};
}

/// To a target that is not cached any more.
void BenchRouteToNewTarget(benchmark::State& state)
{
    const SiteMap site = MakeLargeSite();
    const Router router(site);
    std::size_t number = 0;
    for (auto iteration : state)
    {
        static_cast<void>(iteration);
        ++number;
        const auto [from, to] = GetEnds(number);
        benchmark::DoNotOptimize(
            router.FindRouteOrNull("lr", site.GetNodes()[from].nodeID, site.GetNodes()[to].nodeID));
    }
}
BENCHMARK(BenchRouteToNewTarget);

/// To one of ten targets, as stations are.
void BenchRouteToKnownTarget(benchmark::State& state)
{
    const SiteMap site = MakeLargeSite();
    const Router router(site);
    std::size_t number = 0;
    for (auto iteration : state)
    {
        static_cast<void>(iteration);
        ++number;
        const std::size_t from = GetEnds(number).first;
        const std::size_t to = GetEnds(number % 10).second;
        benchmark::DoNotOptimize(
            router.FindRouteOrNull("lr", site.GetNodes()[from].nodeID, site.GetNodes()[to].nodeID));
    }
}
BENCHMARK(BenchRouteToKnownTarget);

using Graph = boost::adjacency_list<
    boost::vecS,
    boost::vecS,
    boost::directedS,
    boost::no_property,
    boost::property<boost::edge_weight_t, double>>;
using Vertex = boost::graph_traits<Graph>::vertex_descriptor;

class CrowHeuristic final : public boost::astar_heuristic<Graph, double>
{
    const SiteMap* _site;
    Vertex _target;

public:
    CrowHeuristic(const SiteMap& site, Vertex target)
        : _site(&site),
          _target(target)
    {
    }

    double operator()(Vertex vertex) const
    {
        return GetDistance(_site->GetNodes()[vertex], _site->GetNodes()[_target]);
    }
};

struct TargetReached final : std::exception
{
};

class TargetVisitor final : public boost::default_astar_visitor
{
    Vertex _target;

public:
    explicit TargetVisitor(Vertex target)
        : _target(target)
    {
    }

    /// Ends Boost's search, which has no other way to stop.
    void examine_vertex(Vertex vertex, const Graph& /*graph*/)
        const // NOLINT(readability-identifier-naming): Boost's name
    {
        if (vertex == _target)
        {
            throw TargetReached{};
        }
    }
};

/// Boost.Graph's A* on the same graph for the same routes: the reference for BenchRouteToNewTarget. It composes no
/// route.
void BenchRouteBoost(benchmark::State& state)
{
    const SiteMap site = MakeLargeSite();
    Graph graph(NODES);
    for (const SiteEdge& edge : site.GetEdges())
    {
        const std::size_t from = *site.FindNodeIndexOrNull(edge.startNodeID);
        const std::size_t to = *site.FindNodeIndexOrNull(edge.endNodeID);
        boost::add_edge(from, to, GetDistance(site.GetNodes()[from], site.GetNodes()[to]), graph);
    }
    std::size_t number = 0;
    for (auto iteration : state)
    {
        static_cast<void>(iteration);
        ++number;
        const auto [from, to] = GetEnds(number);
        std::vector<Vertex> predecessors(NODES);
        std::vector<double> seconds(NODES);
        try
        {
            boost::astar_search(
                graph,
                from,
                CrowHeuristic(site, to),
                boost::predecessor_map(predecessors.data()).distance_map(seconds.data()).visitor(TargetVisitor(to)));
        }
        catch (const TargetReached&)
        {
            benchmark::DoNotOptimize(predecessors.data());
        }
    }
}
BENCHMARK(BenchRouteBoost);

/// Events per second of a fleet, all with work, in virtual time; the argument is the number of vehicles. The cost of an
/// event should not depend on it.
void BenchFleetEvents(benchmark::State& state)
{
    std::size_t events = 0;
    const Testing::Floor floor = Testing::MakeGridFloor(false);
    for (auto iteration : state)
    {
        static_cast<void>(iteration);
        Testing::FleetOptions options;
        options.vehicles = static_cast<std::size_t>(state.range(0));
        options.transports = 10 * options.vehicles;
        Testing::FleetWorld world(floor, options, std::make_unique<Testing::EngineControl>(floor, options.vehicles));
        if (!world.TryRun())
        {
            state.SkipWithError("the transports were not done");
            break;
        }
        events += world.events;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(events));
}
BENCHMARK(BenchFleetEvents)->Arg(5)->Arg(10)->Arg(20)->Arg(36)->Unit(benchmark::kMillisecond);

} // namespace

} // namespace ACS::Planning
