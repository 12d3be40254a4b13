#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace ACS::Acsd
{

/// What the MCS has answered with Fail since the start.
struct RefusedReports
{
    std::uint64_t count = 0;
    std::string command; ///< This and the next two: of the last one. "JobReport"
    std::string planID;  ///< Empty for what belongs to no plan.
    std::string message; ///< The MCS's.
    std::array<std::uint64_t, Protocol::COMMAND_COUNT> byCommand{};
};

} // namespace ACS::Acsd
