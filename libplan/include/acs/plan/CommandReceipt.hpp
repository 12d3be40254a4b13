#pragma once

#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <string>

namespace ACS::Planning
{

/// That a command of an operator was accepted: its sender may have got no answer and send it again, also to a later process.
/// Stored in the same transaction as the effect of the command. The engine does not read it.
struct CommandReceipt
{
    /// A receipt that is older than the newest one by this is dropped.
    static constexpr std::chrono::minutes KEPT{10};
    /// The oldest are dropped.
    static constexpr std::size_t MOST_RECEIPTS = 1'000;

    std::string owner;        ///< Who sent the command, as the caller writes it.
    std::string key;          ///< Chosen by the owner.
    std::string answer;       ///< What the owner was answered, as the caller writes it.
    Core::WallTime time = {}; ///< When it was answered.

    bool operator==(const CommandReceipt&) const = default;
};

} // namespace ACS::Planning
