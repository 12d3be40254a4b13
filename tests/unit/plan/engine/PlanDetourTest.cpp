#include "fixtures/PlanWorldSteps.hpp"

#include <chrono>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::FinishPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

namespace
{

using std::chrono::operator""ms;
using std::chrono::operator""s;

/// The test site with a way around L02.
SiteMap MakeSite()
{
    const SiteMap site = MakeTestSite();
    std::vector<SiteNode> nodes = site.GetNodes();
    std::vector<SiteEdge> edges = site.GetEdges();
    SiteNode around = nodes.front();
    around.nodeID = "AROUND";
    around.x = 1;
    around.y = -1;
    nodes.push_back(around);
    for (const auto& [from, to] : {std::pair{"L01", "AROUND"}, std::pair{"AROUND", "L03"}})
    {
        SiteEdge edge = edges.front();
        edge.edgeID = std::string(from) + ">" + to;
        edge.startNodeID = from;
        edge.endNodeID = to;
        edges.push_back(edge);
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), site.GetStations());
}

EngineOptions MakeOptions()
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    return options;
}

void PublishCr(PlanWorld& world, bool bInTheWay)
{
    StateChanged state;
    state.lastNodeID = bInTheWay ? "L02" : "D-CHG02";
    state.bAutomatic = !bInTheWay;
    world.Raise("CR01", state);
}

std::size_t CountCancelled(const PlanWorld& world)
{
    return world.GetTraceOf("command LR01 CancelDrive").size();
}

/// LR01 waits on L01 because CR01 was put on L02, and is commanded to reroute around it.
void BeginDetour(PlanWorld& world, bool bHears)
{
    world.Connect();
    world.GetRobot("LR01").bIgnoresDriveCancel = !bHears;
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 Dispatched"));
    PublishCr(world, true);
    REQUIRE(world.TryRun([&world] { return CountCancelled(world) == 1; }));
}

} // namespace

TEST_CASE("Traffic: a vehicle that waits for one that cannot move is rerouted")
{
    PlanWorld world(1, MakeOptions(), MakeSite());
    BeginDetour(world, true);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").drives == 4);
}

TEST_CASE("Traffic: a vehicle that rejects a reroute continues when its route is free, also after a pause")
{
    enum class EBetween
    {
        Nothing,
        Pause,
        RefusedPause,
    };
    const auto between = GENERATE(EBetween::Nothing, EBetween::Pause, EBetween::RefusedPause);
    PlanWorld world(1, MakeOptions(), MakeSite());
    BeginDetour(world, false);
    if (between == EBetween::Pause)
    {
        ACS::Testing::PausePlan(world);
        world.Control(EPlanControl::Resume, "P1");
        REQUIRE(TryRunUntil(world, "P1", "ResumeResult Success"));
    }
    if (between == EBetween::RefusedPause)
    {
        world.store.bFails = true;
        world.Control(EPlanControl::Pause, "P1", 3);
        CHECK_FALSE(world.replies.at(3).bAccepted);
        world.store.bFails = false;
    }
    static_cast<void>(TryRunFor(world, MakeOptions().controls.cancelTimeout));
    PublishCr(world, false);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").drives == 3); // for its steps, and to its parking position
}
