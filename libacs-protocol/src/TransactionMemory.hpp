#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_set>

namespace ACS::Protocol::Detail
{

/// What one transaction of one command is found by.
[[nodiscard]] std::string MakeTransactionKey(EAcsCommand command, std::string_view transactionID);

/// Which transactions have come; the oldest are forgotten first.
class TransactionMemory
{
    std::unordered_set<std::string> _keys;
    std::deque<const std::string*> _order; ///< Into the keys, which stay where they are.
    std::size_t _capacity;

public:
    explicit TransactionMemory(std::size_t capacity);
    TransactionMemory(const TransactionMemory&) = delete;
    TransactionMemory& operator=(const TransactionMemory&) = delete;
    ~TransactionMemory() = default;

    /// False where it is there already.
    [[nodiscard]] bool TryInsert(EAcsCommand command, std::string_view transactionID);
};

} // namespace ACS::Protocol::Detail
