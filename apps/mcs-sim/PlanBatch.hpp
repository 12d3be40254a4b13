#pragma once

#include "PlannedPlan.hpp"
#include <acs/core/IRandom.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace ACS::McsSim
{

/// Every file in rotation (first, second, first, …), each as often as asked.
struct BatchOptions
{
    std::size_t repeat = 1;
    bool bFreshIDs = false; ///< Always done where repeat is more than 1.
    std::string date;       ///< Eight digits (20261121), for the fresh planIds.
};

/// Gives plans ids that no other plan has: a planId such as PLAN-20261121-0001-3fa2, UUIDs for the transaction and the
/// jobs, and the carriers' own ids followed by the planId's last part: the same carrier within a plan keeps one id. The
/// lotId stays.
class PlanRefresher
{
    Core::IRandom& _random;
    std::string _date;
    std::size_t _count = 0;
    std::unordered_set<std::uint64_t> _used;

public:
    /// The date has eight digits. The random source outlives the refresher.
    PlanRefresher(Core::IRandom& random, std::string date);

    void Refresh(PlannedPlan& planned);

private:
    /// Four hexadecimal digits that no other plan has, as long as there are any left.
    [[nodiscard]] std::string MakeTag();
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
