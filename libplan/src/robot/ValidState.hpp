#pragma once

#include <acs/plan/RobotEvent.hpp>

#include <optional>

namespace ACS::Planning
{

/// The state with finite numbers only, because an adapter may pass on what its robot sends: a pose that is not finite is not known, a
/// battery that is not finite is that of the state before, 0 without one, and limited to 0 to 100.
[[nodiscard]] StateChanged MakeValidState(StateChanged state, const std::optional<StateChanged>& beforeOrNull);

} // namespace ACS::Planning
