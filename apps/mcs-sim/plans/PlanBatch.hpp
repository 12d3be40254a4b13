#pragma once

#include "plans/PlannedPlan.hpp"
#include "plans/PlanRefresher.hpp"
#include <acs/core/IRandom.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// Every file in rotation (first, second, first, …), each as often as asked.
struct BatchOptions
{
    std::size_t repeat = 1;
    bool bFreshIDs = false; ///< Always done where repeat is more than 1.
    std::string date;       ///< Eight digits (20261121), for the fresh planIds.
    ECarrierNames carrierNames = ECarrierNames::Fresh;
};

/// The plans to send, in order. Fresh ids are those of a PlanRefresher. A plan without a transactionId gets one in any
/// case.
[[nodiscard]] std::vector<PlannedPlan> MakeBatch(
    const std::vector<PlannedPlan>& files,
    const BatchOptions& options,
    Core::IRandom& random);

/// A transactionId that two plans share, which only whole messages sent as they are can; nullopt where none is.
[[nodiscard]] std::optional<std::string> FindSharedTransactionOrNull(const std::vector<PlannedPlan>& plans);

} // namespace ACS::McsSim
