#pragma once

#include <acs/core/Api.hpp>
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

/// Whether the payload is a report that may be sent until its Ack: PlanReport, StepReport, JobReport, CancelResultReport,
/// AbortResultReport, PauseResultReport, ResumeResultReport or ErrorReport. The other payloads of an ACS are states and
/// positions, of which only the latest counts, and the Registration, which the session sends.
[[nodiscard]] ACS_API bool IsDurable(const AcsPayload& payload) noexcept;

} // namespace ACS::Protocol
