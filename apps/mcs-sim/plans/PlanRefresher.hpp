#pragma once

#include "plans/PlannedPlan.hpp"
#include <acs/core/IRandom.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_set>

namespace ACS::McsSim
{

enum class ECarrierNames : std::uint8_t
{
    Fresh, ///< Their own ids followed by the planId's last part: the same carrier within a plan keeps one id.
    Kept,  ///< They are on a floor that has them by these ids.
};

/// Gives plans ids that no other plan has: a planId such as PLAN-20261121-0001-3fa2, UUIDs for the transaction and the
/// jobs, and ids for the carriers. The lotId stays.
class PlanRefresher
{
    Core::IRandom& _random;
    std::string _date;
    ECarrierNames _carrierNames;
    std::size_t _count = 0;
    std::unordered_set<std::uint64_t> _used;

public:
    /// The date has eight digits. The random source outlives the refresher.
    PlanRefresher(Core::IRandom& random, std::string date, ECarrierNames carrierNames);

    void Refresh(PlannedPlan& planned);

private:
    /// Four hexadecimal digits that no other plan has, while there are any left.
    [[nodiscard]] std::string MakeTag();
};

} // namespace ACS::McsSim
