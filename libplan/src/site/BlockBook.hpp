#pragma once

#include <acs/plan/Block.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// The blocks of the operator. Those whose id is not on the map are kept without effect, in case it returns.
class BlockBook
{
    const SiteMap& _site;
    std::vector<Block> _blocks;
    std::vector<bool> _nodes; ///< By index in the map.
    std::vector<bool> _edges; ///< By index in the map.

public:
    /// The site must outlive the book.
    explicit BlockBook(const SiteMap& site);

    void Restore(std::vector<Block> blocks);
    /// No block has this kind and id.
    void Add(Block block);
    void Remove(EBlockKind kind, std::string_view id);

    [[nodiscard]] bool IsOnMap(EBlockKind kind, std::string_view id) const;
    [[nodiscard]] const Block* FindOrNull(EBlockKind kind, std::string_view id) const;
    /// In the order in which they were added.
    [[nodiscard]] const std::vector<Block>& GetBlocks() const noexcept;
    [[nodiscard]] bool IsEmpty() const noexcept;
    /// By index in the map: which nodes and edges are blocked.
    [[nodiscard]] const std::vector<bool>& GetNodes() const noexcept;
    [[nodiscard]] const std::vector<bool>& GetEdges() const noexcept;
    /// The block of the node, or of a station that has it as a dock.
    [[nodiscard]] const Block* FindOfDockOrNull(std::size_t node) const;
    /// The block of the station, or of this dock of it.
    [[nodiscard]] const Block* FindOfTargetOrNull(std::string_view stationID, std::size_t dock) const;
    /// Number of nodes from the start of the route up to the first, from this index on, that a vehicle may not enter.
    [[nodiscard]] std::size_t CountOpen(const Route& route, std::size_t first) const;
    /// Why a vehicle may not enter the node of the route: its own block, or that of the edge to it.
    [[nodiscard]] const Block* FindOnRouteOrNull(const Route& route, std::size_t index) const;
    /// "node L03 is blocked: oil"
    [[nodiscard]] static std::string Describe(const Block& block);

private:
    void UpdateMarks();
};

} // namespace ACS::Planning
