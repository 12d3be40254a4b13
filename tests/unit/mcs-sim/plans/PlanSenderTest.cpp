#include "plans/PlanSender.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "plans/SamplePlans.hpp"
#include "world/MemoryWorld.hpp"

#include <string>
#include <utility>
#include <vector>

using namespace ACS::McsSim; // NOLINT(google-build-using-namespace)
using ACS::Protocol::ERobotType;

namespace
{

/// The plans that were sent, in their order.
struct SenderFixture
{
    ACS::Testing::ManualClock clock;
    ACS::Sim::MemoryWorld world;
    PlanTracker tracker;
    RobotBoard board;
    FloorChecker checker;
    PlanTracker::Lines lines;
    std::vector<std::string> sent;
    PlanSender sender;

    explicit SenderFixture(std::vector<PlannedPlan> plans, EProfile profile = EProfile::Spec)
        : tracker(std::move(plans)),
          checker(tracker, world, EStocking::Restock),
          sender(
              tracker,
              board,
              &checker,
              profile,
              true,
              [this](const auto& plan, const std::string& /*transactionID*/) {
                  sent.push_back(plan.planID);
                  return true;
              })
    {
        tracker.OnRegistered();
    }

    void Report(const std::string& robotID, ERobotType type)
    {
        ACS::Protocol::RobotStatusUpdate update;
        update.robotID = robotID;
        update.robotType = type;
        board.OnStatus(update, lines);
    }
};

PlannedPlan MakeCassetteLoad(const std::string& planID)
{
    PlannedPlan planned = ACS::Testing::MakeSamplePlan(planID, "T-" + planID);
    planned.plan.steps = {{1, "CassetteLoad", "A01.CP01", {"C1"}, {{planID + "-1", "A01.CP01", "AMR.CP01"}}}};
    return planned;
}

PlannedPlan MakeTrayLoad(const std::string& planID)
{
    PlannedPlan planned = ACS::Testing::MakeSamplePlan(planID, "T-" + planID);
    planned.plan.steps = {{1, "TrayLoad", "A02.CP01", {"TRAY_01"}, {{planID + "-1", "A02.CP01.TP01", "AMR.TP01"}}}};
    return planned;
}

} // namespace

TEST_CASE("12 A plan that waits for a robot of its type lets later plans go")
{
    SenderFixture fixture({MakeTrayLoad("TRAY"), MakeCassetteLoad("CASSETTE")}, EProfile::Nexus);
    fixture.Report("LR01", ERobotType::Logistics);
    fixture.sender.SendDue(fixture.clock.GetNow(), fixture.lines);
    CHECK(fixture.sent == std::vector<std::string>{"CASSETTE"});
    fixture.Report("CR01", ERobotType::Control);
    fixture.sender.SendDue(fixture.clock.GetNow(), fixture.lines);
    CHECK(fixture.sent == std::vector<std::string>{"CASSETTE", "TRAY"});
}

TEST_CASE("The floor is restocked for a plan when it goes, not while it is held")
{
    SenderFixture fixture({});
    CHECK(fixture.sender.TrySendOrHold(MakeCassetteLoad("P1"), true, false, fixture.clock.GetNow(), fixture.lines));
    fixture.sender.SendHeld(false, fixture.clock.GetNow(), fixture.lines);
    CHECK_FALSE(fixture.world.GetCarrierOrNull("A01.CP01").has_value());
    fixture.sender.SendHeld(true, fixture.clock.GetNow(), fixture.lines);
    CHECK(fixture.world.GetCarrierOrNull("A01.CP01") == "C1");
    CHECK(fixture.sent == std::vector<std::string>{"P1"});
}
