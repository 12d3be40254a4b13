#include "FloorBound.hpp"

#include <acs/plan/Router.hpp>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

constexpr double HOUR = 3'600; ///< Seconds.

/// Seconds for which a route occupies each node that it cannot avoid, without the jobs.
class Occupation
{
    const SiteMap& _site;
    Router _router;
    std::map<std::pair<std::string, std::string>, std::vector<std::pair<std::size_t, double>>> _known;

public:
    explicit Occupation(const SiteMap& site)
        : _site(site),
          _router(site)
    {
    }

    [[nodiscard]] double GetTravelSeconds(const std::string& from, const std::string& to) const
    {
        return _router.FindRouteOrNull(FLEET_TYPE, from, to)->travelSeconds;
    }

    const std::vector<std::pair<std::size_t, double>>& Get(const std::string& from, const std::string& to)
    {
        const auto [entry, bNew] = _known.try_emplace({from, to});
        if (!bNew)
        {
            return entry->second;
        }
        const Route route = *_router.FindRouteOrNull(FLEET_TYPE, from, to);
        for (std::size_t i = 0; i < route.nodes.size(); ++i)
        {
            const std::size_t node = *_site.FindNodeIndexOrNull(route.nodes[i].nodeID);
            const bool bEnd = i == 0 || i + 1 == route.nodes.size();
            const auto isIt = [node](std::size_t other) {
                return other == node;
            };
            if (bEnd || !_router.FindRouteOrNull(FLEET_TYPE, ELoad::Unknown, from, to, isIt).has_value())
            {
                const double in = i > 0 ? GetLeast(node, true) : 0;
                const double out = i + 1 < route.nodes.size() ? GetLeast(node, false) : 0;
                entry->second.emplace_back(node, in + out);
            }
        }
        return entry->second;
    }

private:
    /// Of the quickest edge to the node or from it.
    [[nodiscard]] double GetLeast(std::size_t node, bool bTo) const
    {
        std::optional<double> least;
        const std::string& nodeID = _site.GetNodes()[node].nodeID;
        for (std::size_t i = 0; i < _site.GetEdges().size(); ++i)
        {
            const SiteEdge& edge = _site.GetEdges()[i];
            if ((bTo ? edge.endNodeID : edge.startNodeID) == nodeID)
            {
                const double seconds = _router.MakeRouteOrNull(FLEET_TYPE, i)->travelSeconds;
                least = std::min(seconds, least.value_or(seconds));
            }
        }
        return least.value_or(0);
    }
};

} // namespace

double FloorBound::GetPerHour() const noexcept
{
    return std::min(fleetPerHour, nodePerHour);
}

FloorBound FindBound(const Floor& floor, const std::vector<Demand>& demands, std::size_t vehicles)
{
    Occupation occupation(floor.site);
    std::vector<double> busy(floor.site.GetNodes().size(), 0);
    double worked = 0;
    for (const Demand& demand : demands)
    {
        const std::string from = MakeDockID(demand.from);
        const std::string to = MakeDockID(demand.to);
        worked += occupation.GetTravelSeconds(from, to) + demand.loadSeconds + demand.unloadSeconds;
        for (const auto& [node, seconds] : occupation.Get(from, to))
        {
            busy[node] += seconds;
        }
        busy[*floor.site.FindNodeIndexOrNull(from)] += demand.loadSeconds;
        busy[*floor.site.FindNodeIndexOrNull(to)] += demand.unloadSeconds;
    }
    const auto count = static_cast<double>(demands.size());
    return {count * HOUR * static_cast<double>(vehicles) / worked, count * HOUR / *std::ranges::max_element(busy)};
}

} // namespace ACS::Testing
