#include "plans/PlanBatch.hpp"

#include "Catch.hpp"
#include "plans/SamplePlans.hpp"
#include "SeededRandom.hpp"

#include <set>
#include <string>
#include <vector>

using ACS::McsSim::ECarrierNames;
using ACS::McsSim::FindSharedTransactionOrNull;
using ACS::McsSim::MakeBatch;
using ACS::McsSim::PlannedPlan;
using ACS::Testing::MakeSamplePlan;
using ACS::Testing::SeededRandom;

TEST_CASE("Without fresh ids the plans go out as they are, but for a transactionId that the file lacks")
{
    SeededRandom random;
    const std::vector<PlannedPlan> files{MakeSamplePlan("A", ""), MakeSamplePlan("B", "T")};
    const std::vector<PlannedPlan> plans = MakeBatch(files, {1, false, "20261121", ECarrierNames::Fresh}, random);
    REQUIRE(plans.size() == 2);
    CHECK(plans[0].plan == files[0].plan);
    CHECK(plans[0].transactionID.size() == 36);
    CHECK(plans[1] == files[1]);
}

TEST_CASE("Repeated files go out in rotation, always with fresh ids")
{
    SeededRandom random;
    std::vector<PlannedPlan> files{MakeSamplePlan("A", "T"), MakeSamplePlan("B", "T")};
    files[1].plan.lotID = "OTHER";
    const std::vector<PlannedPlan> plans = MakeBatch(files, {3, false, "20261121", ECarrierNames::Fresh}, random);
    REQUIRE(plans.size() == 6);
    std::set<std::string> ids;
    for (std::size_t i = 0; i < plans.size(); ++i)
    {
        const PlannedPlan& planned = plans[i];
        CHECK(planned.plan.lotID == (i % 2 == 0 ? "LOT" : "OTHER"));
        CHECK(planned.plan.planID.substr(0, 19) == "PLAN-20261121-000" + std::to_string(i + 1) + "-");
        CHECK(planned.plan.planID.size() == 23);
        ids.insert(planned.plan.planID);
        ids.insert(planned.transactionID);
        for (const auto& step : planned.plan.steps)
        {
            for (const auto& job : step.jobs)
            {
                CHECK(job.jobID.size() == 36);
                ids.insert(job.jobID);
            }
        }
    }
    CHECK(ids.size() == 6 * (1 + 1 + 3));
}

TEST_CASE("A carrier that appears twice in a plan keeps one fresh id, and another plan gives it another")
{
    SeededRandom random;
    const std::vector<PlannedPlan> plans =
        MakeBatch({MakeSamplePlan("A", "T")}, {2, true, "20261121", ECarrierNames::Fresh}, random);
    const auto& steps = plans[0].plan.steps;
    CHECK(steps[0].carrierIDs[0] == steps[1].carrierIDs[0]);
    CHECK(steps[0].carrierIDs[0] == "C1-" + plans[0].plan.planID.substr(19));
    CHECK(steps[0].carrierIDs[1] == "C2-" + plans[0].plan.planID.substr(19));
    CHECK(steps[0].carrierIDs[0] != plans[1].plan.steps[0].carrierIDs[0]);
}

TEST_CASE("Carriers that are on a floor under their own ids keep them")
{
    SeededRandom random;
    const std::vector<PlannedPlan> plans =
        MakeBatch({MakeSamplePlan("A", "T")}, {2, true, "20261121", ECarrierNames::Kept}, random);
    CHECK(plans[0].plan.steps[0].carrierIDs == std::vector<std::string>{"C1", "C2"});
    CHECK(plans[1].plan.steps[0].carrierIDs == std::vector<std::string>{"C1", "C2"});
    CHECK(plans[0].plan.planID != plans[1].plan.planID);
}

TEST_CASE("Carriers of many plans never share an id")
{
    SeededRandom random;
    const std::vector<PlannedPlan> plans =
        MakeBatch({MakeSamplePlan("A", "T")}, {5'000, true, "20261121", ECarrierNames::Fresh}, random);
    std::set<std::string> carriers;
    for (const PlannedPlan& planned : plans)
    {
        carriers.insert(planned.plan.steps[0].carrierIDs[0]);
    }
    CHECK(carriers.size() == plans.size());
}

TEST_CASE("Two whole messages with one transactionId are detected")
{
    CHECK_FALSE(FindSharedTransactionOrNull({MakeSamplePlan("A", "T1"), MakeSamplePlan("B", "T2")}).has_value());
    CHECK(FindSharedTransactionOrNull({MakeSamplePlan("A", "T1"), MakeSamplePlan("B", "T1")}) == "T1");
}
