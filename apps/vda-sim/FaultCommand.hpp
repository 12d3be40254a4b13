#pragma once

#include "common/faults/FaultCommand.hpp"
#include "vda-sim/Fault.hpp"

namespace ACS::VdaSim
{

using Apps::EFaultVerb;

/// Its targets are vehicles; "VEHICLES trigger" ends a waitForTrigger.
using FaultCommand = Apps::FaultCommand<Fault>;

} // namespace ACS::VdaSim
