#pragma once

#include <acs/core/Timestamp.hpp>
#include <acs/protocol/EAckResult.hpp>
#include <acs/protocol/EAcsCommand.hpp>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace ACS::Protocol::Detail
{

/// Key of a transaction of a command.
[[nodiscard]] std::string MakeTransactionKey(EAcsCommand command, std::string_view transactionID);

/// The answer to a request: encoded again, it is the same text.
struct GivenAnswer
{
    EAckResult result = EAckResult::Success;
    std::string message;
    Core::Timestamp timestamp;
};

/// The received transactions and their answers; the oldest are dropped first.
class TransactionMemory
{
    std::unordered_map<std::string, std::optional<GivenAnswer>> _answers;
    std::deque<const std::string*> _order; ///< Pointers to the keys, which never move.
    std::size_t _capacity;
    std::size_t _maximumBytes;
    std::size_t _bytes = 0; ///< Of the messages.

public:
    /// @param capacity Maximum number of transactions; at least one is kept.
    /// @param maximumBytes Maximum size of the messages of all answers; one is always kept.
    TransactionMemory(std::size_t capacity, std::size_t maximumBytes);
    TransactionMemory(const TransactionMemory&) = delete;
    TransactionMemory& operator=(const TransactionMemory&) = delete;
    ~TransactionMemory() = default;

    /// False if it is known already.
    [[nodiscard]] bool TryInsert(EAcsCommand command, std::string_view transactionID);

    /// Inserts the transaction if it is unknown.
    void KeepAnswer(EAcsCommand command, std::string_view transactionID, GivenAnswer answer);

    /// Valid until the next call of another function. nullptr: unknown, or without an answer.
    [[nodiscard]] const GivenAnswer* FindAnswerOrNull(EAcsCommand command, std::string_view transactionID) const;

private:
    void EraseOldest();
};

} // namespace ACS::Protocol::Detail
