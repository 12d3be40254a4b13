#pragma once

#include <acs/acsd/IRobotDriver.hpp>
#include <acs/core/Api.hpp>

namespace ACS::Acsd
{

/// acsd's command line and event loop: the main() of a program that adds robot drivers. The drivers `vda5050` and
/// `vda5050_openstream` are built in. Catches every exception. Returns the exit code: 0 after a clean stop, 1 if acsd cannot run,
/// also because of a driver with an invalid or repeated name, 2 for an error in the command line or the configuration.
[[nodiscard]] ACS_API int RunAcsd(int argc, char** argv, RobotDrivers drivers);

} // namespace ACS::Acsd
