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
        bool bAwaited = false;
    };

    static constexpr std::size_t CAPACITY = 128;

    std::deque<Entry> _entries;

public:
    /// @param bAwaited The request was abandoned, and a late Ack is of interest.
    void Remember(EAcsCommand command, std::string transactionID, bool bAwaited);

    /// The transaction is pending again.
    void Forget(EAcsCommand command, std::string_view transactionID);

    [[nodiscard]] ELateAck TakeAck(EAcsCommand command, std::string_view transactionID);
};

} // namespace ACS::Protocol::Detail
