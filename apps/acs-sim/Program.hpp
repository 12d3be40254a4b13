#pragma once

#include "AcsSimOptions.hpp"

namespace ACS::AcsSim
{

/// Runs the program until its plans have ended, its time has passed or a signal comes; returns its exit code.
[[nodiscard]] int Run(const AcsSimOptions& options);

} // namespace ACS::AcsSim
