#pragma once

#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

namespace ACS::VDA5050
{

/// What the vehicle's control hands in and is no number: JSON has no word for it, and any number in its place would be a
/// lie. Optional members are left out, a box without its place or size too.
void DropNonFinite(Velocity& velocity);
void DropNonFinite(AgvPosition& position);
void DropNonFinite(BatteryState& battery);
void DropNonFinite(Load& load);

/// Cuts a state to what the factsheet promises. Of the errors the fatal ones stay longest, then the latest.
void FitState(StateMessage& state, const MaximumArrayLengths& limits);

} // namespace ACS::VDA5050
