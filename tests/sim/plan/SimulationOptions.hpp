#pragma once

#include "EMutation.hpp"
#include "Scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::Simulation
{

/// What the command line asks for.
struct SimulationOptions
{
    std::uint64_t first = 1;
    std::size_t seeds = 2000;
    std::optional<std::uint64_t> seedOrNull; ///< Only this one.
    bool bTrace = false;
    std::size_t workers = 2;
    FaultSet without;
    std::optional<ERobotKind> robots; ///< Absent: as each seed says.
    EMutation mutation = EMutation::None;
    bool bAllMutations = false;
    bool bListMutations = false;
    bool bKeepsGoing = false;
};

/// Nothing where the program is to end: with the exit code.
[[nodiscard]] std::optional<int> ReadOptionsOrNull(int argc, const char* const* argv, SimulationOptions& options);

} // namespace ACS::Simulation
