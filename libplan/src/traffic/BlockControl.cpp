#include "traffic/BlockControl.hpp"

#include <acs/core/ControlCharacter.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Planning
{

BlockControl::BlockControl(EngineState& engine, TrafficCoordinator& coordinator)
    : _blocks(engine.blocks),
      _transaction(engine.transaction),
      _coordinator(coordinator)
{
}

void BlockControl::Restore(std::vector<Block> blocks)
{
    if (blocks.empty())
    {
        return;
    }
    _blocks.Restore(std::move(blocks));
    _coordinator.OnBlocksChanged();
}

void BlockControl::Add(const BlockPlace& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _transaction.Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    Block block{command.kind, command.id, command.reason, _transaction.GetNow().wall};
    _transaction.Store(BlockAdded{block});
    _blocks.Add(std::move(block));
    _coordinator.OnBlocksChanged();
    _transaction.Reply(
        command.replyToken,
        true,
        fmt::format("The {} {} is blocked.", GetText(command.kind), command.id));
}

void BlockControl::Remove(const UnblockPlace& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _transaction.Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    _transaction.Store(BlockRemoved{command.kind, command.id});
    _blocks.Remove(command.kind, command.id);
    _coordinator.OnBlocksChanged();
    _transaction.Reply(command.replyToken, true, fmt::format("The {} {} is open.", GetText(command.kind), command.id));
}

std::optional<std::string> BlockControl::GetRejectionReasonOrNull(const BlockPlace& command) const
{
    if (!_blocks.IsOnMap(command.kind, command.id))
    {
        return fmt::format("There is no {} {}.", GetText(command.kind), command.id);
    }
    if (_blocks.FindOrNull(command.kind, command.id) != nullptr)
    {
        return fmt::format("The {} {} is blocked already.", GetText(command.kind), command.id);
    }
    if (command.reason.size() > MAXIMUM_REASON_LENGTH || Core::HasControlCharacter(command.reason))
    {
        return fmt::format(
            "Invalid reason: expected at most {} bytes without control characters.",
            MAXIMUM_REASON_LENGTH);
    }
    if (_blocks.GetBlocks().size() >= MAXIMUM_BLOCKS)
    {
        return fmt::format("There are {} blocks already. Remove some first.", MAXIMUM_BLOCKS);
    }
    return std::nullopt;
}

std::optional<std::string> BlockControl::GetRejectionReasonOrNull(const UnblockPlace& command) const
{
    return _blocks.FindOrNull(command.kind, command.id) != nullptr
        ? std::nullopt
        : std::optional(fmt::format("The {} {} is not blocked.", GetText(command.kind), command.id));
}

} // namespace ACS::Planning
