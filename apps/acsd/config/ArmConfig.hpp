#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/ArmOptions.hpp"

namespace ACS::Acsd
{

/// Reads the keys of `arm` or of `robots.NAME.arm`. Each is optional; an absent key keeps its value of `defaults`.
[[nodiscard]] ArmOptions ReadArmOptions(const Apps::ConfigSection& arm, const ArmOptions& defaults);

} // namespace ACS::Acsd
