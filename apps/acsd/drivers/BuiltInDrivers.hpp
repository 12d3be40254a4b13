#pragma once

#include <acs/acsd/IRobotDriver.hpp>

namespace ACS::Acsd
{

/// The drivers that every acsd has: `vda5050` and `vda5050_openstream`.
[[nodiscard]] RobotDrivers MakeBuiltInDrivers();

} // namespace ACS::Acsd
