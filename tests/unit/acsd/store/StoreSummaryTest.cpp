#include "store/StoreSummary.hpp"

#include "Catch.hpp"

namespace ACS::Acsd::Test
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

PlanRecord MakeRecord(EPlanState state)
{
    PlanRecord record;
    record.progress.state = state;
    return record;
}

} // namespace

TEST_CASE("The summary of a start has the numbers of what the store contains")
{
    StoredState state;
    CHECK(MakeStoreSummary({true, false, 0, 3}, state) == "new, schema 3");
    CHECK(
        MakeStoreSummary({false, false, 3, 3}, state)
        == "schema 3, no open plans resumed, no ended plans, no reports not acknowledged, no alarms");
    for (const EPlanState plan :
         {EPlanState::Pending,
          EPlanState::InProgress,
          EPlanState::Paused,
          EPlanState::Completed,
          EPlanState::Failed,
          EPlanState::Cancelled,
          EPlanState::Aborted})
    {
        state.plans.push_back(MakeRecord(plan));
    }
    state.outbox.resize(2);
    state.alarms.resize(1);
    CHECK(
        MakeStoreSummary({false, false, 3, 3}, state)
        == "schema 3, 3 open plans resumed, 4 ended plans, 2 reports not acknowledged, 1 alarm");
    state.robotsInMaintenance = {"CR01", "LR01"};
    state.tscState = ETscState::Paused;
    CHECK(
        MakeStoreSummary({false, true, 2, 3, true}, state)
        == "schema 3 migrated from 2, 3 open plans resumed, 4 ended plans, 2 reports not acknowledged, 1 alarm, in "
           "maintenance CR01 LR01, TSC Paused; restored from the copy that was made when the database was removed while it "
           "was open; migrated from the former layout; its files are kept with .former in their names");
}

} // namespace ACS::Acsd::Test
