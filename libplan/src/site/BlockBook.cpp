#include "site/BlockBook.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace ACS::Planning
{

BlockBook::BlockBook(const SiteMap& site)
    : _site(site),
      _nodes(site.GetNodes().size(), false),
      _edges(site.GetEdges().size(), false)
{
}

void BlockBook::Restore(std::vector<Block> blocks)
{
    _blocks = std::move(blocks);
    UpdateMarks();
}

void BlockBook::Add(Block block)
{
    _blocks.push_back(std::move(block));
    UpdateMarks();
}

void BlockBook::Remove(EBlockKind kind, std::string_view id)
{
    std::erase_if(_blocks, [kind, id](const Block& block) { return block.kind == kind && block.id == id; });
    UpdateMarks();
}

bool BlockBook::IsOnMap(EBlockKind kind, std::string_view id) const
{
    switch (kind)
    {
        case EBlockKind::Node:
            return _site.FindNodeOrNull(id) != nullptr;
        case EBlockKind::Edge:
            return std::ranges::count(_site.GetEdges(), id, &SiteEdge::edgeID) > 0;
        case EBlockKind::Station:
            return _site.FindStationOrNull(id) != nullptr;
        default:
            return false;
    }
}

const Block* BlockBook::FindOrNull(EBlockKind kind, std::string_view id) const
{
    const auto found =
        std::ranges::find_if(_blocks, [kind, id](const Block& block) { return block.kind == kind && block.id == id; });
    return found == _blocks.end() ? nullptr : &*found;
}

const std::vector<Block>& BlockBook::GetBlocks() const noexcept
{
    return _blocks;
}

bool BlockBook::IsEmpty() const noexcept
{
    return _blocks.empty();
}

const std::vector<bool>& BlockBook::GetNodes() const noexcept
{
    return _nodes;
}

const std::vector<bool>& BlockBook::GetEdges() const noexcept
{
    return _edges;
}

const Block* BlockBook::FindOfDockOrNull(std::size_t node) const
{
    const std::string& nodeID = _site.GetNodes()[node].nodeID;
    const auto found = std::ranges::find_if(_blocks, [this, &nodeID](const Block& block) {
        const SiteStation* stationOrNull =
            block.kind == EBlockKind::Station ? _site.FindStationOrNull(block.id) : nullptr;
        return (block.kind == EBlockKind::Node && block.id == nodeID)
            || (stationOrNull != nullptr && std::ranges::count(stationOrNull->nodeIDs, nodeID) > 0);
    });
    return found == _blocks.end() ? nullptr : &*found;
}

const Block* BlockBook::FindOfTargetOrNull(std::string_view stationID, std::size_t dock) const
{
    const Block* const blockOrNull = FindOrNull(EBlockKind::Station, stationID);
    return blockOrNull != nullptr || !_nodes[dock] ? blockOrNull
                                                   : FindOrNull(EBlockKind::Node, _site.GetNodes()[dock].nodeID);
}

std::size_t BlockBook::CountOpen(const Route& route, std::size_t first) const
{
    std::size_t count = IsEmpty() ? route.nodes.size() : first;
    while (count < route.nodes.size() && FindOnRouteOrNull(route, count) == nullptr)
    {
        ++count;
    }
    return count;
}

const Block* BlockBook::FindOnRouteOrNull(const Route& route, std::size_t index) const
{
    const Block* const edgeOrNull = index == 0 ? nullptr : FindOrNull(EBlockKind::Edge, route.edges[index - 1].edgeID);
    return edgeOrNull != nullptr ? edgeOrNull : FindOrNull(EBlockKind::Node, route.nodes[index].nodeID);
}

std::string BlockBook::Describe(const Block& block)
{
    return fmt::format(
        "{} {} is blocked{}{}",
        GetText(block.kind),
        block.id,
        block.reason.empty() ? "" : ": ",
        block.reason);
}

void BlockBook::UpdateMarks()
{
    _nodes.assign(_nodes.size(), false);
    _edges.assign(_edges.size(), false);
    for (const Block& block : _blocks)
    {
        if (const std::optional<std::size_t> node = _site.FindNodeIndexOrNull(block.id);
            block.kind == EBlockKind::Node && node.has_value())
        {
            _nodes[*node] = true;
        }
        if (block.kind == EBlockKind::Edge)
        {
            const auto edge = std::ranges::find(_site.GetEdges(), block.id, &SiteEdge::edgeID);
            if (edge != _site.GetEdges().end())
            {
                _edges[static_cast<std::size_t>(edge - _site.GetEdges().begin())] = true;
            }
        }
    }
}

} // namespace ACS::Planning
