#pragma once

#include "common/faults/FaultCommand.hpp"
#include "vda-sim/Fault.hpp"

namespace ACS::VdaSim
{

using Apps::EFaultVerb;

/// Its targets are vehicles; "VEHICLES trigger" is what a waitForTrigger waits for.
using FaultCommand = Apps::FaultCommand<Fault>;

} // namespace ACS::VdaSim
