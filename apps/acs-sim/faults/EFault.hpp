#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::AcsSim
{

/// What the ACS does wrong on request. A correct MCS copes with each.
enum class EFault : std::uint8_t
{
    LateReport,      ///< The next reports are held for three seconds.
    DuplicateReport, ///< The next report is sent again after its Ack.
    OutOfOrder,      ///< The next report is sent after the one that follows it.
    UnknownReport,   ///< A report about a plan that the MCS has not sent.
    UnknownCommand,  ///< A request with an unknown command.
    BadPayload,      ///< A report without its planId.
    Malformed,       ///< A text that is not JSON.
    UnknownAck,      ///< An Ack of nothing that was asked.
    LateAck,         ///< The next answer to the MCS is sent three seconds late.
    RefusePlan,      ///< The next plan is refused: the queue is full.
    FailJob,         ///< The next job fails.
    NotConnected,    ///< isConnected is false for three seconds.
    Reconnect,       ///< The connection is cut before the Ack of a report is noticed.
};

inline constexpr std::size_t FAULT_COUNT = 13;

/// "late-report"
[[nodiscard]] std::string_view GetName(EFault fault);
[[nodiscard]] std::optional<EFault> ReadFaultOrNull(std::string_view name);
/// "late-report, duplicate-report, …"
[[nodiscard]] std::string ListFaults();

} // namespace ACS::AcsSim
