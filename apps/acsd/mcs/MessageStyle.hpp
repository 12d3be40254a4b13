#pragma once

#include "config/ErrorNames.hpp"

#include <cstddef>
#include <cstdint>

namespace ACS::Acsd
{

/// Which reports of an outage an MCS that has come back is told (`outbox.replay`): it may also ask for the history.
enum class EOutboxReplay : std::uint8_t
{
    All,
    FinalOnly, ///< Ends of plans and results of controls.
    None,
};

/// How the messages to the MCS are written where the document leaves it open, or an MCS departs from it.
struct MessageStyle
{
    bool bUnassignedRobotEmpty = false;  ///< `mcs.unassigned_robot_id`: "" in plan lists, else null.
    bool bEmptyCarriersOmitted = false;  ///< `mcs.empty_carriers`: carrierIds without its nulls.
    bool bResultFailureIsFail = false;   ///< `mcs.result_report_failure`: "Fail", else "Failed" (D-1).
    bool bRefusedReportsRetried = false; ///< `mcs.on_report_nack`: they are sent again after the next registration.
    std::size_t longestText = 0;         ///< `mcs.tx_max_bytes`: longer lists are cut; 0: none is.
    EOutboxReplay replay = EOutboxReplay::All;
    ErrorNames errors;

    bool operator==(const MessageStyle&) const = default;
};

} // namespace ACS::Acsd
