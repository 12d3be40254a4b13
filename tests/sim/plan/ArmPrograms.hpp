#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace ACS::Simulation
{

/// How often acsd has an arm's counters told. Less often than in a real site: a world has hours of them.
inline constexpr std::chrono::milliseconds ARM_PERIOD{100};

/// Which program of an arm does which action.
[[nodiscard]] inline const std::map<std::string, std::uint32_t>& GetArmPrograms()
{
    static const std::map<std::string, std::uint32_t> PROGRAMS{
        {"TrayLoad", 11},
        {"TrayUnload", 12},
        {"MemoryPickAndPlace", 13},
        {"OpenSetCover", 14}};
    return PROGRAMS;
}

} // namespace ACS::Simulation
