#pragma once

#include <acs/acsd/IRobot.hpp>
#include <acs/vda5050/StateMessage.hpp>

namespace ACS::Acsd
{

/// What the last state of a vehicle shows to operators: its version, mode and errors.
void AddStateDetails(const VDA5050::StateMessage& state, DriverDetails& details);

} // namespace ACS::Acsd
