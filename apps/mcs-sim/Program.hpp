#pragma once

#include "McsSimOptions.hpp"

namespace ACS::McsSim
{

/// Runs the program until its plans have ended or a signal comes; returns its exit code.
[[nodiscard]] int Run(const McsSimOptions& options);

} // namespace ACS::McsSim
