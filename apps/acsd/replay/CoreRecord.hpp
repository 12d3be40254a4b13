#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <string>

namespace ACS::Acsd
{

/// One input or output of AcsdCore, as it is written to the trace.
struct CoreRecord
{
    Core::Now now;             ///< Of its input. To the microsecond and, of the calendar, to the millisecond.
    bool bInput = false;       ///< Otherwise an output, or an answer to a question of the core.
    std::size_t depth = 0;     ///< Of an input: number of inputs around it.
    std::string kind;          ///< "robot", "timer", "report", …: see docs/reference/trace.md.
    std::string robotID;       ///< Empty: of no robot.
    std::string planID;        ///< Empty: of no plan, or of several.
    std::string transactionID; ///< Empty: of no message of the MCS.
    std::string text;          ///< JSON; depends on the kind.
    std::string place;         ///< "FILE:LINE" of one that was read; else empty.
};

} // namespace ACS::Acsd
