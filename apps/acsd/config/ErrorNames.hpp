#pragma once

#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/Report.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The site's own code, level and message of an error. An absent member keeps acsd's value.
struct ErrorName
{
    std::optional<std::string> code;
    std::optional<Planning::EAlarmLevel> level;
    std::optional<std::string> message;

    bool operator==(const ErrorName&) const = default;
};

/// By acsd's own code ("ACS-1002", "AGV-…", "ARM-…").
using ErrorNames = std::map<std::string, ErrorName, std::less<>>;

/// Reads a file of `errors.map`: a table per code with `code`, `level`, `message`. Errors have file and line.
[[nodiscard]] ErrorNames ReadErrorNames(const std::string& fileName, std::vector<std::string>& errors);

/// The codes as the plan engine needs them, by acsd's own code.
[[nodiscard]] std::map<std::string, std::string, std::less<>> MakeMcsCodes(const ErrorNames& names);

/// The alarm as it is sent to the MCS: with the code that it was set with, and the present level and message.
[[nodiscard]] Planning::Alarm Rename(Planning::Alarm alarm, const ErrorNames& names);

} // namespace ACS::Acsd
