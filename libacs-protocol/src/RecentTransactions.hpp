#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace ACS::Protocol::Detail
{

/// What an Ack is whose request waits no more.
enum class ELateAck : std::uint8_t
{
    Unknown,  ///< Its transactionId is a foreign one.
    Late,     ///< The first one of a request that was given up.
    Repeated, ///< There was one already, or nobody wants to know.
};

/// The transactions that waited for an Ack last: a late or second Ack must not be taken for that of another one.
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
    /// @param bAwaited It was given up, and a late Ack is of interest.
    void Remember(EAcsCommand command, std::string transactionID, bool bAwaited);

    /// It waits again.
    void Forget(EAcsCommand command, std::string_view transactionID);

    [[nodiscard]] ELateAck TakeAck(EAcsCommand command, std::string_view transactionID);
};

} // namespace ACS::Protocol::Detail
