#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/EAcsCommand.hpp>

#include <chrono>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace ACS::Protocol::Detail
{

/// Which requests came in and how they were answered, so that one that comes again is not executed again. Bounded in
/// time and number; the oldest go first.
class AnswerStore
{
public:
    struct Entry
    {
        std::string text; ///< The Ack as it was sent; empty: not answered yet.
        Core::SteadyTime receivedAt{};
        bool bLegacyName = false;
    };

private:
    std::unordered_map<std::string, Entry> _entries;
    std::deque<std::string> _order;
    std::chrono::milliseconds _memory;
    std::size_t _capacity;

public:
    AnswerStore(std::chrono::milliseconds memory, std::size_t capacity);

    [[nodiscard]] Entry* FindOrNull(EAcsCommand command, std::string_view transactionID, Core::Now now);
    void Insert(EAcsCommand command, std::string_view transactionID, bool bLegacyName, Core::Now now);

private:
    void Forget(Core::Now now);
};

} // namespace ACS::Protocol::Detail
