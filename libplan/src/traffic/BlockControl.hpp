#pragma once

#include "traffic/TrafficCoordinator.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Handles the operator's blocks of nodes, edges and stations. Owns no data.
class BlockControl
{
    BlockBook& _blocks;
    EngineTransaction& _transaction;
    TrafficCoordinator& _coordinator;

public:
    BlockControl(EngineState& engine, TrafficCoordinator& coordinator);

    /// After a restart; called once, before all else.
    void Restore(std::vector<Block> blocks);
    void Add(const BlockPlace& command);
    void Remove(const UnblockPlace& command);
    /// Why the command would be refused now.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const BlockPlace& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const UnblockPlace& command) const;
};

} // namespace ACS::Planning
