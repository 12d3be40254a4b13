#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace ACS::Acsd
{

/// The reports that the MCS has answered with Fail since the start.
struct RefusedReports
{
    std::uint64_t count = 0;
    std::string command;   ///< Of the last one, as are the next three: "JobReport"
    std::string planID;    ///< Empty if it is not about a plan.
    std::string message;   ///< The reason that the MCS gave.
    bool bRetried = false; ///< It is sent again after the next registration (`mcs.on_report_nack`).
    std::array<std::uint64_t, Protocol::COMMAND_COUNT> byCommand{};
};

} // namespace ACS::Acsd
