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

/// Which requests came in and how they were answered, so that one that comes again is not executed again. Bounded in
/// time, number and bytes; the oldest go first, questions before what was executed.
class AnswerCache
{
public:
    struct Entry
    {
        EAcsCommand command = EAcsCommand::ExecutionPlan;
        std::string text; ///< The Ack as it was sent; empty: not answered yet.
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
    /// @param capacity Entries; at least one is kept.
    /// @param maximumBytes Of all Acks together.
    AnswerCache(std::chrono::milliseconds memory, std::size_t capacity, std::size_t maximumBytes);

    /// Valid until the next call of another function.
    [[nodiscard]] const Entry* FindOrNull(EAcsCommand command, std::string_view transactionID, Core::Now now);
    void Insert(
        EAcsCommand command,
        std::string_view transactionID,
        bool bLegacyName,
        std::uint64_t digest,
        Core::Now now);
    /// The Ack of an entry that is there.
    void KeepText(EAcsCommand command, std::string_view transactionID, const std::string& text);

private:
    void Forget(Core::Now now);
    void Erase(const std::deque<std::string>::const_iterator& place);
};

} // namespace ACS::Protocol::Detail
