#pragma once

#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/Report.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// What a site calls an error, and how bad it is there. What is left out stays as acsd has it.
struct ErrorName
{
    std::optional<std::string> code;
    std::optional<Planning::EAlarmLevel> level;
    std::optional<std::string> message;

    bool operator==(const ErrorName&) const = default;
};

/// By acsd's own code ("ACS-1002", "AGV-…", "ARM-…").
using ErrorNames = std::map<std::string, ErrorName, std::less<>>;

/// Reads a file of `errors.map`: a table per code with `code`, `level`, `message`. Mistakes have file and line.
[[nodiscard]] ErrorNames ReadErrorNames(const std::string& fileName, std::vector<std::string>& mistakes);

/// As the MCS is to see it.
[[nodiscard]] Planning::Alarm Rename(Planning::Alarm alarm, const ErrorNames& names);

} // namespace ACS::Acsd
