#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

/// The interval at which acsd reads the counters. Longer than on a real site, because a run lasts hours.
inline constexpr std::chrono::milliseconds ARM_PERIOD{100};

/// One program of an arm: the words that acsd writes before it, and what it does with them. As on the example site.
struct ArmProgramTexts
{
    std::uint32_t program = 0;
    std::vector<std::pair<std::string, std::string>> inputs; ///< Relay and template.
    std::vector<std::string> from;
    std::vector<std::string> to;
    std::string openedSet; ///< Empty: it moves something from `from` to `to`.
};

/// By action.
[[nodiscard]] const std::map<std::string, ArmProgramTexts>& GetArmPrograms();

} // namespace ACS::Simulation
