#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

#include <memory>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

class SingleActionCheck final : public IJobCheck
{
    std::string _rejected;

public:
    explicit SingleActionCheck(std::string rejected)
        : _rejected(std::move(rejected))
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const StartJob& job) const override
    {
        return job.action == _rejected ? std::optional("no program for " + job.action) : std::nullopt;
    }
};

} // namespace

TEST_CASE("Dispatcher: the nearest of the free robots gets the plan")
{
    EngineParts parts(MakeTestOptions(true));
    Robot& other = parts.engine.fleet[2];
    ActivePlan& plan = parts.AddLoad();
    parts.PutOn(parts.lr, "D-A01.CP02");
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == &parts.lr);
    parts.PutOn(other, "D-CHG03"); // one way: A01.CP02 is after A01.CP01
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == &other);
    parts.PutOn(parts.lr, "D-CHG01");
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == &parts.lr);
    parts.lr.view.bInMaintenance = true;
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == &other);
    other.view.state->bAutomatic = false;
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == nullptr);
}

TEST_CASE("Dispatcher: a robot that has the carrier on record is preferred to a nearer one")
{
    EngineParts parts(MakeTestOptions(true));
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.erase(plan.steps.begin());
    plan.steps.front().carrierIDs.clear();
    ActivePlan& active = parts.Add(plan);
    parts.PutOn(parts.lr, "D-CHG01");
    parts.PutOn(parts.engine.fleet[2], "D-CHG03");
    CHECK(parts.dispatcher.FindNearestOrNull(active) == &parts.lr);
    parts.engine.fleet[2].ports.Correct({"CASSETTE_01"});
    CHECK(parts.dispatcher.FindNearestOrNull(active) == &parts.engine.fleet[2]);
}

TEST_CASE("Dispatcher: a plan is kept from the robots that reject one of its jobs")
{
    EngineParts parts;
    ActivePlan& plan = parts.AddLoad();
    parts.PutOn(parts.lr, "D-CHG01");
    parts.Discard();
    parts.dispatcher.OnJobCheck(parts.lr, JobCheckChanged{std::make_shared<SingleActionCheck>("CassetteUnload")});
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    CHECK(Dispatcher::DescribeRejectionOrNull(plan, parts.lr) == "no program for CassetteUnload");
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == nullptr);
    REQUIRE(plan.verdicts.rejections.contains(parts.lr.index));
    CHECK(plan.verdicts.rejections.at(parts.lr.index).reason == "no program for CassetteUnload");
    CHECK(parts.dispatcher.IsRejectedByAll(plan));
    parts.lr.view.bOnline = false;
    CHECK_FALSE(parts.dispatcher.IsRejectedByAll(plan));
    parts.lr.view.bOnline = true;
    parts.dispatcher.OnJobCheck(parts.lr, JobCheckChanged{std::make_shared<SingleActionCheck>("TrayLoad")});
    CHECK_FALSE(parts.dispatcher.IsRejectedByAll(plan));
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == &parts.lr);
}

TEST_CASE("Dispatcher: a plan that a robot has keeps its robot")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.dispatcher.OnJobCheck(parts.lr, JobCheckChanged{std::make_shared<SingleActionCheck>("CassetteLoad")});
    CHECK(plan.verdicts.rejections.empty());
}

TEST_CASE("Dispatcher: the nearest robot is found over edges for its load, and a robot without such a route has none")
{
    for (const bool bEmptyOnly : {true, false})
    {
        // No edge leads from L05 to L06 but the restricted one.
        const SiteMap restricted = MakeRestrictedSite({bEmptyOnly, !bEmptyOnly});
        std::vector<SiteEdge> edges = restricted.GetEdges();
        std::erase_if(edges, [](const SiteEdge& edge) { return edge.edgeID == "L05>AROUND"; });
        EngineParts parts(
            MakeTestOptions(true),
            *SiteMap::Create(restricted.GetNodes(), edges, restricted.GetStations()));
        Robot& other = parts.engine.fleet[2];
        Plan plan = MakeLogisticsPlan("P1");
        plan.steps.front().position = "A01.CP06";
        plan.steps.front().jobs.front().from = "A01.CP06";
        ActivePlan& active = parts.Add(plan);
        parts.PutOn(parts.lr, "D-CHG01");
        parts.PutOn(other, "D-A01.CP02");
        CHECK(parts.dispatcher.HasWay(active, other) == bEmptyOnly);
        // Without a route to wait for, the first candidate is returned.
        CHECK(parts.dispatcher.FindNearestOrNull(active) == (bEmptyOnly ? &other : &parts.lr));
    }
}

TEST_CASE("Dispatcher: the successor of a plan's robot is free and can do its jobs by its latest factsheet")
{
    EngineParts parts(MakeTestOptions(true));
    Robot& other = parts.engine.fleet[2];
    ActivePlan& plan = parts.BeginDriveToLoad();
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == nullptr);
    parts.PutOn(other, "D-CHG03");
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == &other);
    parts.dispatcher.OnJobCheck(other, JobCheckChanged{std::make_shared<SingleActionCheck>("CassetteUnload")});
    CHECK(parts.dispatcher.FindNearestOrNull(plan) == nullptr);
}
