#pragma once

#include "JobData.hpp"
#include "JobMethod.hpp"
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <tl/expected.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The parameters of the vehicle's action for one job, of the types that the factsheet declares. An optional one that the
/// job has no value for is left out. The error says which mandatory one has no value, or which one has the wrong type.
[[nodiscard]] tl::expected<std::vector<VDA5050::ActionParameter>, std::string> MakeActionParameters(
    const JobMethod& method,
    const JobData& data,
    const VDA5050::FactsheetMessage* factsheetOrNull);

/// Why no job can have the parameters, whatever the vehicle: one that the standard demands names a key (`height`, `side`)
/// that no station has.
[[nodiscard]] std::optional<std::string> FindParameterFaultOrNull(
    const JobMethod& method,
    const StationTable& stations);

} // namespace ACS::Acsd
