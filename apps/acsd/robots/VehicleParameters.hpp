#pragma once

#include "robots/JobData.hpp"
#include "robots/JobMethod.hpp"
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <tl/expected.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

constexpr VDA5050::EBlockingType JOB_BLOCKING = VDA5050::EBlockingType::Hard; ///< Of the vehicle's actions for jobs.

/// The parameters of the vehicle's action for one job, of the types that the factsheet declares. An optional one without a
/// value of its type is left out, and a default beyond the number that the factsheet allows. The error names a mandatory one without a value, or one that the factsheet does not list.
[[nodiscard]] tl::expected<std::vector<VDA5050::ActionParameter>, std::string> MakeActionParameters(
    const JobMethod& method,
    const JobData& data,
    const VDA5050::FactsheetMessage* factsheetOrNull);

/// Why the vehicle cannot do any job by this method, as far as its factsheet shows it without a job; nullopt if it can.
[[nodiscard]] std::optional<std::string> FindMethodFaultOrNull(
    const JobMethod& method,
    const VDA5050::FactsheetMessage& factsheet);

} // namespace ACS::Acsd
