#pragma once

#include "common/config/ConfigSection.hpp"
#include <acs/core/Location.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Reads a list of ranges such as "A01.CP01.TP01-04" and prepends the prefix to each ("LR01." for ports of a robot).
[[nodiscard]] std::vector<Core::Location> ReadPlaces(
    const Apps::ConfigSection& section,
    const std::string& key,
    const std::string& prefix);

} // namespace ACS::Acsd
