#include "PlanBatch.hpp"

#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <unordered_set>

namespace ACS::McsSim
{

namespace
{

constexpr std::uint64_t TAG_MASK = 0xFFFF;

/// Four hexadecimal digits that no other plan of the batch has, as long as there are any left.
class TagMaker
{
    Core::IRandom& _random;
    std::unordered_set<std::uint64_t> _used;

public:
    explicit TagMaker(Core::IRandom& random)
        : _random(random)
    {
    }

    std::string Make()
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
};

void Refresh(PlannedPlan& planned, const std::string& date, std::size_t number, TagMaker& tags, Core::IRandom& random)
{
    const std::string tag = tags.Make();
    planned.plan.planID = fmt::format("PLAN-{}-{:04}-{}", date, number, tag);
    planned.transactionID = Core::MakeUuid(random);
    for (Protocol::PlanStep& step : planned.plan.steps)
    {
        for (std::string& carrierID : step.carrierIDs)
        {
            carrierID += carrierID.empty() ? "" : "-" + tag;
        }
        for (Protocol::PlanJob& job : step.jobs)
        {
            job.jobID = Core::MakeUuid(random);
        }
    }
}

} // namespace

std::vector<PlannedPlan> MakeBatch(
    const std::vector<PlannedPlan>& files,
    const BatchOptions& options,
    Core::IRandom& random)
{
    const bool bFresh = options.bFreshIDs || options.repeat > 1;
    TagMaker tags(random);
    std::vector<PlannedPlan> plans;
    plans.reserve(files.size() * options.repeat);
    for (std::size_t i = 0; i < options.repeat; ++i)
    {
        for (const PlannedPlan& file : files)
        {
            PlannedPlan& planned = plans.emplace_back(file);
            if (bFresh)
            {
                Refresh(planned, options.date, plans.size(), tags, random);
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
