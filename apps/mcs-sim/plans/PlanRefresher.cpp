#include "plans/PlanRefresher.hpp"

#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::McsSim
{

namespace
{

constexpr std::uint64_t TAG_MASK = 0xFFFF;

} // namespace

PlanRefresher::PlanRefresher(Core::IRandom& random, std::string date, ECarrierNames carrierNames)
    : _random(random),
      _date(std::move(date)),
      _carrierNames(carrierNames)
{
}

void PlanRefresher::Refresh(PlannedPlan& planned)
{
    const std::string tag = MakeTag();
    planned.plan.planID = fmt::format("PLAN-{}-{:04}-{}", _date, ++_count, tag);
    planned.transactionID = Core::MakeUUID(_random);
    for (Protocol::PlanStep& step : planned.plan.steps)
    {
        for (std::string& carrierID : step.carrierIDs)
        {
            carrierID += carrierID.empty() || _carrierNames == ECarrierNames::Kept ? "" : "-" + tag;
        }
        for (Protocol::PlanJob& job : step.jobs)
        {
            job.jobID = Core::MakeUUID(_random);
        }
    }
}

std::string PlanRefresher::MakeTag()
{
    std::uint64_t tag = _random.GetNext() & TAG_MASK;
    if (_used.size() > TAG_MASK)
    {
        _used.clear();
    }
    while (!_used.insert(tag).second)
    {
        tag = (tag + 1) & TAG_MASK;
    }
    return fmt::format("{:04x}", tag);
}

} // namespace ACS::McsSim
