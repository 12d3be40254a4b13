#pragma once

#include <acs/acsd/IRobot.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <string_view>

namespace ACS::Acsd
{

/// As VDA5050 writes it: "MANUAL".
[[nodiscard]] std::string_view GetModeText(VDA5050::EOperatingMode mode);

/// What the last state of a vehicle shows to operators: its version, mode and errors.
void AddStateDetails(const VDA5050::StateMessage& state, DriverDetails& details);

} // namespace ACS::Acsd
