#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

/// The second step of the logistics plan alone: CASSETTE_01 from LR01.CP01 to A02.CP03.
Plan MakeUnloadPlan(const std::string& planID)
{
    Plan plan = MakeLogisticsPlan(planID);
    plan.steps.erase(plan.steps.begin());
    return plan;
}

} // namespace

TEST_CASE("PortCheck: a port that is taken is not loaded, unless the options allow it")
{
    EngineOptions options = MakeTestOptions(false);
    options.dispatch.bLoadsIntoTakenPorts = GENERATE(false, true);
    EngineParts parts(options);
    const PortCheck check(parts.engine);
    const ActivePlan& plan = parts.AddLoad();
    CHECK_FALSE(check.JudgePorts(plan, parts.lr).unavailabilityOrNull.has_value());
    parts.lr.ports.Correct({"OTHER"});
    CHECK(check.JudgePorts(plan, parts.lr).unavailabilityOrNull.has_value() != options.dispatch.bLoadsIntoTakenPorts);
}

TEST_CASE("PortCheck: a robot can unload a carrier that its port has on record, or that no robot has")
{
    EngineParts parts(MakeTestOptions(true));
    const PortCheck check(parts.engine);
    const ActivePlan& plan = parts.Add(MakeUnloadPlan("P1"));
    PortVerdict verdict = check.JudgePorts(plan, parts.lr);
    CHECK_FALSE(verdict.unavailabilityOrNull.has_value());
    CHECK(verdict.bSupposed);
    parts.lr.ports.Correct({"CASSETTE_01"});
    verdict = check.JudgePorts(plan, parts.lr);
    CHECK_FALSE(verdict.unavailabilityOrNull.has_value());
    CHECK_FALSE(verdict.bSupposed);
    CHECK(check.JudgePorts(plan, parts.engine.fleet[2]).unavailabilityOrNull.has_value());
    parts.lr.ports.Correct({"OTHER"});
    CHECK(check.JudgePorts(plan, parts.lr).unavailabilityOrNull.has_value());
    parts.lr.ports.Correct({std::string(UNKNOWN_CARRIER)});
    CHECK_FALSE(check.JudgePorts(plan, parts.lr).unavailabilityOrNull.has_value());
}

TEST_CASE("PortCheck: only the first use of each port is compared with the record")
{
    EngineParts parts;
    const PortCheck check(parts.engine);
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.push_back(plan.steps.front());
    plan.steps.back().stepNo = 3;
    plan.steps.back().jobs.front().jobID = "P1-again";
    const ActivePlan& active = parts.Add(plan);
    const PortVerdict verdict = check.JudgePorts(active, parts.lr);
    CHECK_FALSE(verdict.unavailabilityOrNull.has_value());
    CHECK_FALSE(verdict.bSupposed);
}

TEST_CASE("PortCheck: memory in a tray needs the tray on record or loaded by the plan before")
{
    EngineParts parts;
    const PortCheck check(parts.engine);
    CHECK_FALSE(check.JudgePorts(parts.Add(MakeControlPlan("P1")), parts.cr).unavailabilityOrNull.has_value());
    Plan plan = MakeControlPlan("P2");
    plan.steps = {plan.steps[1]};
    ActivePlan& active = parts.Add(plan);
    CHECK(check.JudgePorts(active, parts.cr).unavailabilityOrNull.has_value());
    parts.PutOn(parts.cr, "D-CHG02");
    parts.assignment.Offer(active, parts.cr);
    CHECK(PortCheck::DescribeMissingTrayOrNull(parts.cr).has_value());
    parts.cr.ports.Correct({"TRAY_01", std::nullopt, std::nullopt});
    CHECK_FALSE(PortCheck::DescribeMissingTrayOrNull(parts.cr).has_value());
    CHECK(check.JudgePorts(active, parts.cr).unavailabilityOrNull.has_value());
    parts.cr.ports.Correct({"TRAY_01", "TRAY_02", std::nullopt});
    CHECK_FALSE(check.JudgePorts(active, parts.cr).unavailabilityOrNull.has_value());
}
