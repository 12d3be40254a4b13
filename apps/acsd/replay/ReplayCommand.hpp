#pragma once

#include <acs/acsd/IRobotDriver.hpp>

namespace ACS::Acsd
{

/// `acsd replay FILE|DIR`; argv[0] is "replay". Returns the exit code: 0 without a difference, 1 with one, 2 if the trace cannot be
/// replayed.
[[nodiscard]] int RunReplayCommand(int argc, const char* const* argv, const RobotDrivers& drivers);

} // namespace ACS::Acsd
