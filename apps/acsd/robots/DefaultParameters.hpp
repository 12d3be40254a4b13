#pragma once

#include "robots/JobMethod.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The parameters of a vehicle's action that has none in the configuration. Pick and drop have all parameters of VDA5050 2.x
/// for which the job has a value; any other action has the place and the load. Parameters that the factsheet does not list
/// are left out; the port is mandatory for a robot with several ports.
[[nodiscard]] std::vector<VehicleParameter> MakeDefaultParameters(
    std::string_view actionType,
    const Planning::ActionRule& rule,
    std::size_t portCount);

} // namespace ACS::Acsd
