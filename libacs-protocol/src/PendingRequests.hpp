#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/EAcsCommand.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::Protocol::Detail
{

/// Empty where the payload names no plan.
[[nodiscard]] inline std::string GetPlanID(const AcsPayload& payload)
{
    return std::visit(
        [](const auto& typed) -> std::string {
            if constexpr (requires { std::string(typed.planID); })
            {
                return typed.planID;
            }
            else
            {
                return {};
            }
        },
        payload);
}

/// The entry that an Ack belongs to.
struct PendingMatch
{
    std::size_t index = 0;
    bool bFound = false;
    bool bByCommand = false; ///< The transactionId was unknown (D-4).
};

/// The oldest entry of this command with this transaction, otherwise the oldest of this command. Entries have the members
/// command and transactionID and are in the order of sending.
template <typename TEntry>
[[nodiscard]] PendingMatch FindPendingByID(
    const std::vector<TEntry>& entries,
    EAcsCommand command,
    std::string_view transactionID)
{
    const auto found = std::find_if(entries.begin(), entries.end(), [command, transactionID](const TEntry& entry) {
        return entry.command == command && entry.transactionID == transactionID;
    });
    return {static_cast<std::size_t>(found - entries.begin()), found != entries.end(), false};
}

/// @param isPossible Whether the Ack may belong to the entry.
template <typename TEntry, typename TPredicate>
[[nodiscard]] PendingMatch FindPendingByCommand(
    const std::vector<TEntry>& entries,
    EAcsCommand command,
    TPredicate isPossible)
{
    const auto found = std::find_if(entries.begin(), entries.end(), [command, &isPossible](const TEntry& entry) {
        return entry.command == command && isPossible(entry);
    });
    return {static_cast<std::size_t>(found - entries.begin()), found != entries.end(), true};
}

template <typename TEntry>
[[nodiscard]] PendingMatch FindPendingByCommand(const std::vector<TEntry>& entries, EAcsCommand command)
{
    return FindPendingByCommand(entries, command, [](const TEntry& /*entry*/) { return true; });
}

/// Time until the earliest deadline, rounded up, at least zero. Requires at least one entry.
template <typename TEntry>
[[nodiscard]] std::chrono::milliseconds GetNextDelay(const std::vector<TEntry>& entries, Core::Now now)
{
    const auto earliest = std::min_element(entries.begin(), entries.end(), [](const TEntry& left, const TEntry& right) {
        return left.deadline < right.deadline;
    });
    return std::max(
        std::chrono::ceil<std::chrono::milliseconds>(earliest->deadline - now.steady),
        std::chrono::milliseconds(0));
}

} // namespace ACS::Protocol::Detail
