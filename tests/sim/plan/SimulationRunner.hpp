#pragma once

#include "SimulationOptions.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Simulation
{

/// Runs seeds in parallel and reports on them.
class SimulationRunner final
{
    struct Failure
    {
        std::uint64_t seed = 0;
        std::string violation;
    };

    struct Tally
    {
        std::size_t worlds = 0;
        std::size_t starts = 0;
        double simulatedHours = 0;
        std::optional<Failure> failureOrNull; ///< Of the lowest seed.
    };

    SimulationOptions _options;

public:
    explicit SimulationRunner(const SimulationOptions& options);

    /// The exit code: 0 if no rule was violated.
    [[nodiscard]] int Run() const;

private:
    /// Stops at the first failure.
    [[nodiscard]] Tally RunWorlds(EMutation mutation, bool bProgress) const;
    /// The kind that was requested; otherwise what the mutation needs, or nullopt.
    [[nodiscard]] ScenarioDemands MakeDemands(EMutation mutation) const;
    [[nodiscard]] int RunSeed(std::uint64_t seed) const;
    [[nodiscard]] int RunMutations() const;
    [[nodiscard]] std::string DescribeReplay(EMutation mutation, std::uint64_t seed) const;
};

} // namespace ACS::Simulation
