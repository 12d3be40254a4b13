#include "traffic/Traffic.hpp"

#include <algorithm>
#include <utility>

// Where robots can wait instead of parking.

namespace ACS::Planning
{

std::optional<std::size_t> Traffic::FindRefugeOrNull(std::size_t robot, std::optional<std::size_t> avoidedOrNull)
{
    FindReturns();
    Vehicle& vehicle = _vehicles[robot];
    const ESafeStateScope scope =
        _ways.IsAnyBlocked() || IsAnyFixed() ? ESafeStateScope::AsIs : ESafeStateScope::AllMove;
    if (vehicle.path.empty())
    {
        return std::nullopt;
    }
    Cover(vehicle, _covers, false);
    const std::optional<std::size_t> refuge =
        _ways.FindRefugeOrNull(vehicle.parking, GetEnd(vehicle), _covers, scope, avoidedOrNull);
    Cover(vehicle, _covers, true);
    return refuge;
}

void Traffic::CoverNode(std::size_t node, std::vector<std::uint16_t>& covers) const
{
    std::ranges::for_each(_ways.GetNear(node), [&covers](std::uint32_t near) { ++covers[near]; });
}

std::size_t Traffic::CountBeforeWayOut(std::size_t robot, std::span<const std::size_t> ahead, std::size_t target) const
{
    const std::vector<std::size_t> holders = GetHolders(target, robot);
    if (holders.empty() || ahead.empty())
    {
        return ahead.size();
    }
    std::vector<std::uint16_t> covers(_covers.size(), 0);
    Cover(_vehicles[robot], covers, true);
    const auto isClosed = [this, &covers](std::size_t holder) {
        const Vehicle& vehicle = _vehicles[holder];
        return vehicle.parking.home.has_value() && !vehicle.path.empty()
            && std::ranges::none_of(vehicle.parking.graphs, [this, &vehicle, &covers](const LoadGraph& graph) {
                   return _ways.HasWay(
                       vehicle.parking,
                       graph,
                       GetEnd(vehicle),
                       *vehicle.parking.home,
                       covers,
                       ESafeStateScope::AllMove);
               });
    };
    std::size_t count = 0;
    for (; count < ahead.size(); ++count)
    {
        CoverNode(ahead[count], covers);
        if (std::ranges::any_of(holders, isClosed))
        {
            break;
        }
    }
    return count;
}

} // namespace ACS::Planning
