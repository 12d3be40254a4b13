#pragma once

#include "options/AcsctlOptions.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
} // namespace CLI

namespace ACS::Acsctl
{

constexpr const char* DESCRIPTION = "Shows and controls acsd through its operator API.";

/// Adds all commands and options to the app; the options must outlive it.
void BuildCommandLine(CLI::App& app, AcsctlOptions& options);

/// What CLI11 cannot read: `--watch 5` becomes `--watch=5`, `--watch` alone `--watch=2`, and a `--` among the carriers of `carriers` becomes `-`.
[[nodiscard]] std::vector<std::string> NormalizeArguments(const std::vector<std::string>& arguments);

/// Reads the arguments, the first of which is the program. Nullopt: continue; otherwise the exit code, after all output was
/// printed.
[[nodiscard]] std::optional<int> ParseOptionsOrNull(const std::vector<std::string>& arguments, AcsctlOptions& options);

} // namespace ACS::Acsctl
