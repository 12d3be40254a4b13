#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <cstdint>

namespace ACS::Protocol
{

/// A report that must reach the MCS, also across reconnects and restarts.
struct DurableRequest
{
    std::uint64_t sequence = 0; ///< Its place in the order of sending.
    AcsRequest request;         ///< With the same transactionID and timestamp on every attempt.

    bool operator==(const DurableRequest&) const = default;
};

} // namespace ACS::Protocol
