#pragma once

#include "config/ErrorNames.hpp"

#include <cstddef>
#include <cstdint>

namespace ACS::Acsd
{

/// Which reports of an outage are sent when the MCS is back (`outbox.replay`). An MCS may request the history instead.
enum class EOutboxReplay : std::uint8_t
{
    All,
    FinalOnly, ///< Ends of plans and results of controls.
    None,
};

/// How messages to the MCS are written where MCS-ACS leaves it open or an MCS deviates from it.
struct MessageStyle
{
    bool bUnassignedRobotEmpty = false;  ///< `mcs.unassigned_robot_id`: "" in plan lists, else null.
    bool bEmptyCarriersOmitted = false;  ///< `mcs.empty_carriers`: carrierIds without its nulls.
    bool bResultFailureIsFail = false;   ///< `mcs.result_report_failure`: "Fail", else "Failed" (D-1).
    bool bRefusedReportsRetried = false; ///< `mcs.on_report_nack`: sent again after the next registration.
    std::size_t longestText = 0;         ///< `mcs.tx_max_bytes`: longer lists are cut; 0 disables.
    EOutboxReplay replay = EOutboxReplay::All;
    ErrorNames errors;

    bool operator==(const MessageStyle&) const = default;
};

} // namespace ACS::Acsd
