#include "floor/FloorChecker.hpp"

#include "Catch.hpp"
#include "floor/FloorPlans.hpp"
#include "ManualClock.hpp"
#include "plans/SamplePlans.hpp"
#include "TemporaryFolder.hpp"
#include "world/MemoryWorld.hpp"
#include "world/WorldFile.hpp"

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

using namespace ACS::Sim; // NOLINT(google-build-using-namespace)
using ACS::McsSim::DeliveryCount;
using ACS::McsSim::EStocking;
using ACS::McsSim::FloorChecker;
using ACS::McsSim::PlannedPlan;
using ACS::McsSim::PlanTracker;
using ACS::Protocol::AcsPayload;
using ACS::Protocol::EAckResult;
using ACS::Protocol::EJobStatus;
using ACS::Protocol::EPlanStatus;
using ACS::Protocol::EStepStatus;
using ACS::Protocol::JobReport;
using ACS::Protocol::StepReport;
using ACS::Testing::MakeAck;
using ACS::Testing::MakePlanReport;
using ACS::Testing::MakeTrayPlan;
using ACS::Testing::ManualClock;

namespace
{

const std::string ROBOT = "CR01";

std::vector<PlannedPlan> MakePlans(std::size_t count)
{
    std::vector<PlannedPlan> plans;
    for (std::size_t i = 1; i <= count; ++i)
    {
        plans.push_back(MakeTrayPlan("P" + std::to_string(i)));
    }
    return plans;
}

/// Tray plans P1, P2, … with an ACS and a control robot at their other end.
class FloorFixture
{
public:
    ManualClock clock;
    MemoryWorld world;
    PlanTracker tracker;
    FloorChecker checker;
    PlanTracker::Lines lines;

    explicit FloorFixture(std::size_t plans = 1, EStocking stocking = EStocking::Restock)
        : tracker(MakePlans(plans)),
          checker(tracker, world, stocking)
    {
        tracker.OnRegistered();
    }

    /// The planIds of those that went.
    std::string Send()
    {
        std::string sent;
        for (std::optional<std::size_t> next = tracker.GetNextToSendOrNull(clock.GetNow()); next.has_value();
             next = tracker.GetNextToSendOrNull(clock.GetNow()))
        {
            checker.OnSending(*next, lines);
            tracker.OnSent(*next, clock.GetNow(), lines);
            sent += tracker.GetPlans()[*next].planned.plan.planID + " ";
        }
        return sent;
    }

    void Report(const AcsPayload& payload)
    {
        tracker.OnRequest(payload, {}, lines);
        checker.OnRequest(payload, lines);
        checker.EndPlans(lines);
    }

    void BeginJob(const std::string& planID, std::int32_t stepNo, std::size_t job)
    {
        for (const EJobStatus status : {EJobStatus::Instructed, EJobStatus::InProgress})
        {
            Report(JobReport{planID, ROBOT, stepNo, planID + "-" + std::to_string(job), status, ""});
        }
    }

    void CompleteJob(const std::string& planID, std::int32_t stepNo, std::size_t job)
    {
        Report(JobReport{planID, ROBOT, stepNo, planID + "-" + std::to_string(job), EJobStatus::Completed, ""});
    }

    void BeginPlan(const std::string& planID)
    {
        Report(MakePlanReport(planID, EPlanStatus::InProgress));
    }

    void BeginStep(const std::string& planID, std::int32_t stepNo)
    {
        Report(StepReport{planID, ROBOT, stepNo, EStepStatus::Dispatched, ""});
        Report(StepReport{planID, ROBOT, stepNo, EStepStatus::InProgress, ""});
    }

    void EndStep(const std::string& planID, std::int32_t stepNo)
    {
        Report(StepReport{planID, ROBOT, stepNo, EStepStatus::Completed, ""});
    }

    void Dock(const std::string& station)
    {
        Act(RobotDocked{ROBOT, {station}});
    }

    void Act(const WorldEvent& event)
    {
        const auto done = world.Act(event);
        INFO((done.has_value() ? std::string() : Describe(done.error())));
        REQUIRE(done.has_value());
    }

    void MoveTray(const std::string& trayID, const std::string& from, const std::string& to)
    {
        Act(CarrierMoved{ROBOT, trayID, from, to});
    }

    /// Sends plan P1, whose first job loads TRAY_01 but is not reported Completed.
    void LoadFirstTray()
    {
        static_cast<void>(Send());
        BeginPlan("P1");
        BeginStep("P1", 1);
        Dock("A01.CP02");
        BeginJob("P1", 1, 1);
        MoveTray("TRAY_01", "A01.CP02.TP01", "CR01.TP01");
    }

    /// Reports as a correct ACS does, except for the port of the last tray.
    void RunPlan(const std::string& planID, const std::string& lastPort = "A01.CP02.TP04")
    {
        RunSteps(planID, lastPort);
        Report(MakePlanReport(planID, EPlanStatus::Completed));
    }

    void RunSteps(const std::string& planID, const std::string& lastPort)
    {
        BeginPlan(planID);
        BeginStep(planID, 1);
        Dock("A01.CP02");
        BeginJob(planID, 1, 1);
        MoveTray("TRAY_01", "A01.CP02.TP01", "CR01.TP01");
        CompleteJob(planID, 1, 1);
        BeginJob(planID, 1, 2);
        MoveTray("TRAY_02", "A01.CP02.TP02", "CR01.TP02");
        CompleteJob(planID, 1, 2);
        EndStep(planID, 1);
        BeginStep(planID, 2);
        Dock("A01.SET01");
        BeginJob(planID, 2, 3);
        Act(MemoryMoved{ROBOT, "CR01.TP01.MP01", "A01.SET01.MP01"});
        CompleteJob(planID, 2, 3);
        BeginJob(planID, 2, 4);
        Act(MemoryMoved{ROBOT, "CR01.TP02.MP01", "A01.SET01.MP02"});
        CompleteJob(planID, 2, 4);
        EndStep(planID, 2);
        BeginStep(planID, 3);
        Dock("A01.CP02");
        BeginJob(planID, 3, 5);
        MoveTray("TRAY_01", "CR01.TP01", "A01.CP02.TP03");
        CompleteJob(planID, 3, 5);
        BeginJob(planID, 3, 6);
        MoveTray("TRAY_02", "CR01.TP02", lastPort);
        CompleteJob(planID, 3, 6);
        EndStep(planID, 3);
    }

    /// All violations, each with a line end.
    std::string Finish()
    {
        checker.Finish(lines);
        std::string violations;
        for (const std::string& violation : tracker.GetViolations())
        {
            violations += violation + "\n";
        }
        return violations;
    }
};

} // namespace

TEST_CASE("A plan whose jobs were moved as they are reported has no violation, and its trays are delivered")
{
    FloorFixture fixture;
    CHECK(fixture.Send() == "P1 ");
    fixture.RunPlan("P1");
    CHECK(fixture.Finish().empty());
    CHECK(fixture.checker.GetCount() == DeliveryCount{2, 0});
    CHECK(fixture.tracker.IsSuccess());
}

TEST_CASE("A job that is reported Completed before its move, or without one, is a violation")
{
    FloorFixture fixture;
    static_cast<void>(fixture.Send());
    fixture.BeginPlan("P1");
    fixture.BeginStep("P1", 1);
    fixture.BeginJob("P1", 1, 1);
    fixture.CompleteJob("P1", 1, 1);
    CHECK(fixture.tracker.CountViolations() == 1);
    CHECK(
        fixture.Finish()
        == "P1 JobReport step 1 Completed, but not moved: CR01: TRAY_01 from A01.CP02.TP01 to CR01.TP01\n"
           "P1 TRAY_01 is at A01.CP02.TP01, not at CR01.TP01\n");
}

TEST_CASE("Another place than the job's is a report without a move, a move without a report, and a misplaced carrier")
{
    FloorFixture fixture;
    static_cast<void>(fixture.Send());
    fixture.RunPlan("P1", "A01.CP02.TP02");
    CHECK(
        fixture.Finish()
        == "P1 JobReport step 3 Completed, but not moved: CR01: TRAY_02 from CR01.TP02 to A01.CP02.TP04\n"
           "P1 TRAY_02 is at A01.CP02.TP02, not at A01.CP02.TP04\n"
           "done without a report: CR01: TRAY_02 from CR01.TP02 to A01.CP02.TP02\n");
    CHECK(fixture.checker.GetCount() == DeliveryCount{1, 1});
    CHECK_FALSE(fixture.tracker.IsSuccess());
}

TEST_CASE("One move serves one report only")
{
    FloorFixture fixture;
    fixture.LoadFirstTray();
    fixture.CompleteJob("P1", 1, 1);
    CHECK(fixture.tracker.CountViolations() == 0);
    fixture.CompleteJob("P1", 1, 1); // also wrong by the rules of the reports
    CHECK(fixture.tracker.CountViolations() == 2);
}

TEST_CASE("A move without a plan is a violation at the end; a change by hand is not")
{
    FloorFixture fixture;
    fixture.Act(CarrierPlaced{"TRAY_09", "A01.CP03.TP01"});
    static_cast<void>(fixture.Send());
    fixture.Dock("A01.CP03");
    fixture.MoveTray("TRAY_09", "A01.CP03.TP01", "CR01.TP03");
    fixture.Act(CarrierPlaced{"TRAY_08", "A01.CP03.TP01"});
    CHECK(fixture.Finish() == "done without a report: CR01: TRAY_09 from A01.CP03.TP01 to CR01.TP03\n");
}

TEST_CASE("A job that was begun and is not Completed may have been done: its move is excused, once")
{
    FloorFixture fixture;
    fixture.LoadFirstTray();
    fixture.Report(MakePlanReport("P1", EPlanStatus::Aborted));
    SECTION("once")
    {
        CHECK(fixture.Finish().empty());
    }
    SECTION("not twice")
    {
        fixture.MoveTray("TRAY_01", "CR01.TP01", "A01.CP02.TP01");
        fixture.MoveTray("TRAY_01", "A01.CP02.TP01", "CR01.TP01");
        CHECK(fixture.Finish().substr(0, 65) == "done without a report: CR01: TRAY_01 from CR01.TP01 to A01.CP02.T");
        CHECK(fixture.tracker.CountViolations() == 2);
    }
    CHECK(fixture.checker.GetCount() == DeliveryCount{});
}

TEST_CASE("A carrier that an aborted plan left on the robot is neither delivered nor misplaced")
{
    FloorFixture fixture;
    fixture.LoadFirstTray();
    fixture.CompleteJob("P1", 1, 1);
    fixture.Report(MakePlanReport("P1", EPlanStatus::Aborted));
    CHECK(fixture.Finish().empty());
    CHECK(fixture.checker.GetCount() == DeliveryCount{});
}

TEST_CASE("Restocked plans that share a station go one after the other, each with the floor that it needs")
{
    FloorFixture fixture(3);
    CHECK(fixture.Send() == "P1 ");
    fixture.RunPlan("P1");
    CHECK(fixture.Send() == "P2 ");
    CHECK(fixture.world.GetPlaceOrNull("TRAY_01") == "A01.CP02.TP01");
    CHECK_FALSE(fixture.world.GetCarrierOrNull("A01.CP02.TP03").has_value());
    CHECK(fixture.world.GetMemory("A01.SET01.MP01") == EMemory::Empty);
    CHECK(fixture.world.GetMemory("A01.CP02.TP01.MP01") == EMemory::Occupied);
    fixture.tracker.OnAck(
        MakeAck(fixture.tracker.GetPlans()[1].planned, EAckResult::Fail, "Queue Full"),
        fixture.lines);
    fixture.checker.EndPlans(fixture.lines);
    CHECK(fixture.Send() == "P3 ");
    fixture.RunPlan("P3");
    CHECK(fixture.Finish().empty());
    CHECK(fixture.checker.GetCount() == DeliveryCount{4, 0});
}

TEST_CASE("A move of an earlier plan does not prove a job of a later one")
{
    FloorFixture fixture(2);
    static_cast<void>(fixture.Send());
    fixture.RunPlan("P1");
    fixture.Act(CarrierPlaced{"TRAY_01", "A01.CP02.TP01"});
    fixture.MoveTray("TRAY_01", "A01.CP02.TP01", "CR01.TP01");
    fixture.MoveTray("TRAY_01", "CR01.TP01", "A01.CP02.TP01");
    CHECK(fixture.Send() == "P2 ");
    fixture.BeginPlan("P2");
    fixture.BeginStep("P2", 1);
    fixture.BeginJob("P2", 1, 1);
    fixture.CompleteJob("P2", 1, 1);
    CHECK(fixture.tracker.CountViolations() == 1);
}

TEST_CASE("Without restocking the floor stays as it is, and all plans go at once")
{
    FloorFixture fixture(2, EStocking::Leave);
    CHECK(fixture.Send() == "P1 P2 ");
    CHECK_FALSE(fixture.world.GetPlaceOrNull("TRAY_01").has_value());
}

TEST_CASE("A carrier is not misplaced where another plan, which is not over, has moved it on")
{
    FloorFixture fixture(2, EStocking::Leave);
    fixture.Act(CarrierPlaced{"TRAY_01", "A01.CP02.TP01"});
    fixture.Act(CarrierPlaced{"TRAY_02", "A01.CP02.TP02"});
    CHECK(fixture.Send() == "P1 P2 ");
    fixture.RunSteps("P1", "A01.CP02.TP04");
    fixture.Act(CarrierPlaced{"TRAY_01", "A01.CP02.TP01"});
    fixture.Report(MakePlanReport("P1", EPlanStatus::Completed));
    CHECK(fixture.checker.GetCount() == DeliveryCount{1, 0});
    CHECK(fixture.tracker.CountViolations() == 0);
}

TEST_CASE("A planId that is there already claims nothing and stocks nothing: the ACS must see it at once")
{
    FloorFixture fixture;
    PlannedPlan again = MakeTrayPlan("P1");
    again.transactionID = "T-again";
    static_cast<void>(fixture.Send());
    fixture.Dock("A01.CP02");
    fixture.MoveTray("TRAY_01", "A01.CP02.TP01", "CR01.TP01");
    static_cast<void>(fixture.tracker.AddPlan(again));
    fixture.checker.OnPlansAdded();
    CHECK(fixture.Send() == "P1 ");
    CHECK(fixture.world.GetPlaceOrNull("TRAY_01") == "CR01.TP01");
}

TEST_CASE("A carrier on a robot is not restocked: the ACS has it on record")
{
    FloorFixture fixture(2);
    fixture.Act(CarrierPlaced{"TRAY_01", "CR01.TP01"});
    CHECK(fixture.Send() == "P1 ");
    CHECK(fixture.lines.front() == "A01.CP02.TP01 not restocked: TRAY_01 is on CR01.TP01");
    CHECK(fixture.world.GetPlaceOrNull("TRAY_01") == "CR01.TP01");
    CHECK(fixture.world.GetPlaceOrNull("TRAY_02") == "A01.CP02.TP02");
}

TEST_CASE("A world that is unreadable or not writable is a violation, once for each reason")
{
    const ACS::Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "world.json";
    std::ofstream(file) << R"({"version":1})";
    const auto world = WorldFile::Open(file);
    REQUIRE(world.has_value());
    const EStocking stocking = GENERATE(EStocking::Restock, EStocking::Leave);
    PlanTracker tracker(MakePlans(2));
    FloorChecker checker(tracker, **world, stocking);
    PlanTracker::Lines lines;
    std::ofstream(file + ".journal", std::ios::app) << "no JSON\n";
    checker.OnSending(0, lines);
    checker.OnSending(1, lines);
    checker.Finish(lines);
    const std::vector<std::string>& violations = tracker.GetViolations();
    REQUIRE(violations.size() == (stocking == EStocking::Restock ? 3U : 1U));
    for (const std::string& violation : violations)
    {
        CHECK_THAT(violation, Catch::Contains("world.json.journal:1: "));
    }
    CHECK_THAT(
        violations.front(),
        Catch::StartsWith(
            stocking == EStocking::Restock ? "P1 is sent without restocking: " : "the world cannot be read"));
    CHECK_FALSE(tracker.IsSuccess());
}

TEST_CASE("A step without jobs is compared by its own report")
{
    ManualClock clock;
    MemoryWorld world;
    PlannedPlan planned;
    planned.plan.planID = "P";
    planned.plan.steps = {{1, "CloseSetCover", "A01.SET01", {}, {}}, {2, "OpenSetCover", "A01.SET01", {}, {}}};
    PlanTracker tracker({planned});
    FloorChecker checker(tracker, world, EStocking::Restock);
    PlanTracker::Lines lines;
    checker.OnSending(0, lines);
    tracker.OnSent(0, clock.GetNow(), lines);
    tracker.OnRequest(MakePlanReport("P", EPlanStatus::InProgress), {}, lines);
    REQUIRE(world.Act(RobotDocked{ROBOT, {"A01.SET01"}}).has_value());
    REQUIRE(world.Act(CoverMoved{ROBOT, "A01.SET01", true}).has_value());
    for (const std::int32_t stepNo : {1, 2})
    {
        for (const EStepStatus status : {EStepStatus::Dispatched, EStepStatus::InProgress, EStepStatus::Completed})
        {
            const StepReport report{"P", ROBOT, stepNo, status, ""};
            tracker.OnRequest(report, {}, lines);
            checker.OnRequest(report, lines);
        }
    }
    CHECK(
        tracker.GetViolations()
        == std::vector<std::string>{"P StepReport step 2 Completed, but not moved: CR01: cover of A01.SET01 opened"});
}
