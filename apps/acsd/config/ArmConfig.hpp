#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/ArmOptions.hpp"

namespace ACS::Acsd
{

/// Reads the keys of `arm`, or of `robots.NAME.arm`, of which each is optional; what is not given is as in the defaults.
[[nodiscard]] ArmOptions ReadArmOptions(const Apps::ConfigSection& arm, const ArmOptions& defaults);

} // namespace ACS::Acsd
