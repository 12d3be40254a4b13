#pragma once

#include "EMutation.hpp"
#include "Scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::Simulation
{

/// The options of the command line.
struct SimulationOptions
{
    std::uint64_t first = 1;
    std::size_t seeds = 2000;
    std::optional<std::uint64_t> seedOrNull; ///< Only this one.
    bool bTrace = false;
    std::size_t workers = 2;
    FaultSet without;
    std::optional<ERobotKind> robots; ///< Absent: from the seed.
    EMutation mutation = EMutation::None;
    bool bShared = false; ///< All runs have a shared store.
    bool bAllMutations = false;
    bool bListMutations = false;
    bool bKeepsGoing = false;
};

/// The error is the exit code with which the program ends.
[[nodiscard]] std::optional<int> ReadOptionsOrNull(int argc, const char* const* argv, SimulationOptions& options);

} // namespace ACS::Simulation
