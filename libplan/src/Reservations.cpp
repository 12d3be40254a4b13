#include "Reservations.hpp"

#include <algorithm>

namespace ACS::Planning
{

Reservations::Reservations(std::size_t nodeCount)
    : _holders(nodeCount)
{
}

std::optional<std::size_t> Reservations::GetHolderOrNull(std::size_t node) const
{
    return _holders[node];
}

bool Reservations::IsFreeFor(std::size_t node, std::size_t robot) const
{
    return !_holders[node].has_value() || *_holders[node] == robot;
}

bool Reservations::TryClaim(std::span<const std::size_t> nodes, std::size_t robot)
{
    if (!std::ranges::all_of(nodes, [this, robot](std::size_t node) { return IsFreeFor(node, robot); }))
    {
        return false;
    }
    for (const std::size_t node : nodes)
    {
        _holders[node] = robot;
    }
    return true;
}

void Reservations::Release(std::size_t node, std::size_t robot)
{
    if (_holders[node] == robot)
    {
        _holders[node].reset();
    }
}

void Reservations::ReleaseAllBut(std::optional<std::size_t> node, std::size_t robot)
{
    ReleaseAllBut(node.has_value() ? std::span<const std::size_t>(&*node, 1) : std::span<const std::size_t>(), robot);
}

void Reservations::ReleaseAllBut(std::span<const std::size_t> nodes, std::size_t robot)
{
    for (std::size_t i = 0; i < _holders.size(); ++i)
    {
        if (std::ranges::find(nodes, i) == nodes.end())
        {
            Release(i, robot);
        }
    }
}

} // namespace ACS::Planning
