#pragma once

#include "ArmOptions.hpp"
#include "common/ConfigSection.hpp"

namespace ACS::Acsd
{

/// Reads the keys of `arm`, or of `robots.NAME.arm`, of which each is optional; what is not given is as in the defaults.
[[nodiscard]] ArmOptions ReadArmOptions(const Apps::ConfigSection& arm, const ArmOptions& defaults);

} // namespace ACS::Acsd
