#pragma once

#include "config/VehicleConfig.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace ACS::Acsd
{

inline constexpr std::size_t MOST_FACTSHEET_WARNINGS = 10;

/// Why the factsheet of the vehicle's factsheet_file may not be the vehicle's: contradictions, and a header of another manufacturer or
/// version. A sentence each with the key, at most MOST_FACTSHEET_WARNINGS; the last one then states how many more there are.
[[nodiscard]] std::vector<std::string> CheckFactsheetFile(const VehicleConfig& vehicle);

} // namespace ACS::Acsd
