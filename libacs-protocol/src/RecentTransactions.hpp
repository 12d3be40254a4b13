#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace ACS::Protocol::Detail
{

/// The kind of an Ack whose request is not pending.
enum class ELateAck : std::uint8_t
{
    Unknown,  ///< Its transactionId is unknown.
    Late,     ///< The first Ack of a request that was abandoned.
    Repeated, ///< A second Ack, or of no interest.
};

/// The last transactions that were pending: a late or second Ack must not be matched to another one.
class RecentTransactions
{
    struct Entry
    {
        EAcsCommand command = EAcsCommand::Registration;
        std::string transactionID;
    };

    static constexpr std::size_t MOST_ANSWERED = 128;

    std::size_t _mostAwaited;
    std::deque<Entry> _awaited;
    std::deque<Entry> _answered;

public:
    /// @param mostAwaited Maximum number of abandoned requests whose late Ack is still known; at least 1.
    explicit RecentTransactions(std::size_t mostAwaited);

    /// @param bAwaited The request was abandoned, and a late Ack is of interest.
    void Remember(EAcsCommand command, std::string transactionID, bool bAwaited);

    /// The transaction is pending again.
    void Forget(EAcsCommand command, std::string_view transactionID);

    [[nodiscard]] ELateAck TakeAck(EAcsCommand command, std::string_view transactionID);

private:
    static void Add(std::deque<Entry>& entries, std::size_t most, Entry entry);
    /// Returns the number of erased entries.
    static std::size_t Erase(std::deque<Entry>& entries, EAcsCommand command, std::string_view transactionID);
};

} // namespace ACS::Protocol::Detail
