#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <chrono>
#include <optional>

namespace ACS::McsSim
{

/// Acks that are sent late or never.
struct AckHold
{
    std::optional<Protocol::EAcsCommand> command;   ///< Whose Acks; nullopt: those of every command.
    std::optional<std::chrono::milliseconds> delay; ///< Nullopt: the Acks are never sent.
    std::chrono::milliseconds duration{0};          ///< Of the hold, from its start.

    bool operator==(const AckHold&) const = default;
};

} // namespace ACS::McsSim
