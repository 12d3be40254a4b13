#pragma once

#include "robots/JobMethod.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The parameters of a vehicle's action that has none in the configuration. A pick and a drop have all that VDA5050 2.x
/// names and a job knows, any other action has the place and the load. They are left out where the factsheet does not list
/// them, except that a robot of several ports does not work without naming the one.
[[nodiscard]] std::vector<VehicleParameter> MakeDefaultParameters(
    std::string_view actionType,
    const Planning::ActionRule& rule,
    std::size_t portCount);

} // namespace ACS::Acsd
