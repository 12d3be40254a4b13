#include "PlanBatch.hpp"

#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace ACS::McsSim
{

namespace
{

constexpr std::uint64_t TAG_MASK = 0xFFFF;

} // namespace

PlanRefresher::PlanRefresher(Core::IRandom& random, std::string date)
    : _random(random),
      _date(std::move(date))
{
}

void PlanRefresher::Refresh(PlannedPlan& planned)
{
    const std::string tag = MakeTag();
    planned.plan.planID = fmt::format("PLAN-{}-{:04}-{}", _date, ++_count, tag);
    planned.transactionID = Core::MakeUuid(_random);
    for (Protocol::PlanStep& step : planned.plan.steps)
    {
        for (std::string& carrierID : step.carrierIDs)
        {
            carrierID += carrierID.empty() ? "" : "-" + tag;
        }
        for (Protocol::PlanJob& job : step.jobs)
        {
            job.jobID = Core::MakeUuid(_random);
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

std::vector<PlannedPlan> MakeBatch(
    const std::vector<PlannedPlan>& files,
    const BatchOptions& options,
    Core::IRandom& random)
{
    const bool bFresh = options.bFreshIDs || options.repeat > 1;
    PlanRefresher refresher(random, options.date);
    std::vector<PlannedPlan> plans;
    plans.reserve(files.size() * options.repeat);
    for (std::size_t i = 0; i < options.repeat; ++i)
    {
        for (const PlannedPlan& file : files)
        {
            PlannedPlan& planned = plans.emplace_back(file);
            if (bFresh)
            {
                refresher.Refresh(planned);
            }
            else if (planned.transactionID.empty())
            {
                planned.transactionID = Core::MakeUuid(random);
            }
        }
    }
    return plans;
}

std::optional<std::string> FindSharedTransactionOrNull(const std::vector<PlannedPlan>& plans)
{
    std::unordered_set<std::string> seen;
    for (const PlannedPlan& planned : plans)
    {
        if (!seen.insert(planned.transactionID).second)
        {
            return planned.transactionID;
        }
    }
    return std::nullopt;
}

} // namespace ACS::McsSim
