#pragma once

#include <acs/core/Location.hpp>
#include <acs/plan/EngineOptions.hpp>

#include <string_view>

namespace ACS::Planning
{

/// What a place must be by the rule, with an example ("a tray port of the robot (AMR.TP01)").
[[nodiscard]] std::string_view DescribePlaceRule(EPlaceRule rule);

[[nodiscard]] bool IsPlaceAllowed(const Core::Location& place, EPlaceRule rule);

} // namespace ACS::Planning
