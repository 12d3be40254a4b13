#pragma once

#include "PlannedPlan.hpp"
#include <acs/core/IRandom.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_set>

namespace ACS::McsSim
{

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

} // namespace ACS::McsSim
