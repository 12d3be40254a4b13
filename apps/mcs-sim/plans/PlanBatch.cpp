#include "plans/PlanBatch.hpp"

#include <acs/core/Uuid.hpp>

#include <unordered_set>

namespace ACS::McsSim
{

std::vector<PlannedPlan> MakeBatch(
    const std::vector<PlannedPlan>& files,
    const BatchOptions& options,
    Core::IRandom& random)
{
    const bool bFresh = options.bFreshIDs || options.repeat > 1;
    PlanRefresher refresher(random, options.date, options.carrierNames);
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
                planned.transactionID = Core::MakeUUID(random);
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
