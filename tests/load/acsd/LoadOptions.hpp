#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <vector>

namespace ACS::Load
{

/// What the programs that measure acsd with a fleet have in common.
struct LoadOptions
{
    std::vector<std::size_t> robots; ///< A row each.
    int seconds = 30;                ///< Measuring time of each row.
    bool bCountsOnly = false;        ///< Values out of their bounds are no failure.
};

/// Adds --robots, --seconds and --counts-only. example: "10,100".
void AddLoadOptions(CLI::App& app, LoadOptions& options, const char* example, std::size_t fewest, std::size_t most);

} // namespace ACS::Load
