#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/EAcsCommand.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace ACS::Protocol::Detail
{

/// The received requests and their Acks: a repeated request is answered from here and not executed again. Limited in time,
/// number and bytes; the oldest entries are dropped first, queries before commands.
class AnswerCache
{
public:
    struct Entry
    {
        EAcsCommand command = EAcsCommand::ExecutionPlan;
        std::string text; ///< The sent Ack; empty: not answered yet.
        Core::SteadyTime receivedAt{};
        bool bLegacyName = false;
        std::uint64_t digest = 0; ///< Of the request.
    };

private:
    std::unordered_map<std::string, Entry> _entries;
    std::deque<std::string> _order;
    std::chrono::milliseconds _memory;
    std::size_t _capacity;
    std::size_t _maximumBytes;
    std::size_t _bytes = 0; ///< Of the texts.

public:
    /// @param capacity Maximum number of entries; at least one is kept.
    /// @param maximumBytes Maximum size of all Acks.
    AnswerCache(std::chrono::milliseconds memory, std::size_t capacity, std::size_t maximumBytes);

    /// Valid until the next call of another function.
    [[nodiscard]] const Entry* FindOrNull(EAcsCommand command, std::string_view transactionID, Core::Now now);
    void Insert(
        EAcsCommand command,
        std::string_view transactionID,
        bool bLegacyName,
        std::uint64_t digest,
        Core::Now now);
    /// Sets the Ack of an entry, if it still exists.
    void KeepText(EAcsCommand command, std::string_view transactionID, const std::string& text);

private:
    void Forget(Core::Now now);
    void EraseLeastNeeded();
    void Erase(const std::deque<std::string>::const_iterator& place);
};

} // namespace ACS::Protocol::Detail
