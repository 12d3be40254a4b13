#pragma once

#include "vda-sim/VdaSimOptions.hpp"

namespace ACS::VdaSim
{

/// Runs the vehicles until SIGINT or SIGTERM; each then publishes OFFLINE. Returns the exit code.
[[nodiscard]] int RunVdaSim(const VdaSimOptions& options);

} // namespace ACS::VdaSim
