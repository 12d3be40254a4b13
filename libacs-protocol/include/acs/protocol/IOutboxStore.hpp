#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol/DurableRequest.hpp>

#include <cstdint>

namespace ACS::Protocol
{

/// Stable storage of a DurableOutbox.
class ACS_API IOutboxStore
{
public:
    IOutboxStore() = default;
    IOutboxStore(const IOutboxStore&) = delete;
    IOutboxStore& operator=(const IOutboxStore&) = delete;
    virtual ~IOutboxStore() = default;

    /// Returns when the request survives a crash. After an error it may or may not be stored.
    [[nodiscard]] virtual Core::Result<void> Append(const DurableRequest& request) = 0;

    /// The MCS has acknowledged the request. It need not be durable on return: a request that is restored after its Ack
    /// is sent once more, and the MCS recognises its transactionID.
    [[nodiscard]] virtual Core::Result<void> Remove(std::uint64_t sequence) = 0;
};

} // namespace ACS::Protocol
