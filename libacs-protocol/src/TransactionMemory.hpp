#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_set>

namespace ACS::Protocol::Detail
{

/// Key of a transaction of a command.
[[nodiscard]] std::string MakeTransactionKey(EAcsCommand command, std::string_view transactionID);

/// The received transactions; the oldest are dropped first.
class TransactionMemory
{
    std::unordered_set<std::string> _keys;
    std::deque<const std::string*> _order; ///< Pointers to the keys, which never move.
    std::size_t _capacity;

public:
    explicit TransactionMemory(std::size_t capacity);
    TransactionMemory(const TransactionMemory&) = delete;
    TransactionMemory& operator=(const TransactionMemory&) = delete;
    ~TransactionMemory() = default;

    /// False if it is known already.
    [[nodiscard]] bool TryInsert(EAcsCommand command, std::string_view transactionID);
};

} // namespace ACS::Protocol::Detail
