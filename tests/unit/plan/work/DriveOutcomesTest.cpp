#include "work/DriveOutcomes.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

struct DriveParts : EngineParts
{
    DriveOutcomes drives{engine, tsc, answers, rejections, places, waiting, coordinator, work, controls};

    [[nodiscard]] std::string GetDriveID() const
    {
        return lr.drive->driveID;
    }
};

} // namespace

TEST_CASE("DriveOutcomes: the first node confirms the drive, later ones begin the step and extend the base")
{
    DriveParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.drives.OnNodePassed(parts.lr, NodePassed{"another", "D-CHG01"});
    CHECK_FALSE(parts.lr.drive->bConfirmed);
    parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "D-CHG01"});
    CHECK(parts.lr.drive->bConfirmed);
    CHECK(parts.lr.drive->bTaken);
    CHECK(parts.Collect().IsTimerCancelled(EEngineTimer::DriveExtension));
    CHECK(plan.record.progress.steps[0].state == EStepState::Dispatched);
    parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "L01"});
    CHECK(plan.record.progress.steps[0].state == EStepState::InProgress);
    CHECK(parts.Collect().ListCommands<ExtendDrive>() == std::vector{ExtendDrive{parts.GetDriveID(), 5}});
    parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "D-CHG01"});
    CHECK(parts.lr.drive->passed == 1);
}

TEST_CASE("DriveOutcomes: the arrival is reported at the last node before the place, the work begins there")
{
    DriveParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "L02"});
    CHECK_FALSE(plan.record.progress.bArrived);
    parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "L03"});
    CHECK(plan.record.progress.bArrived);
    CHECK(parts.lr.activity == EActivity::Waits);
    parts.Discard();
    parts.drives.OnArrived(parts.lr, Arrived{parts.GetDriveID()});
    CHECK_FALSE(parts.lr.drive.has_value());
    CHECK(parts.lr.place.position == "A01.CP01");
    CHECK(parts.Collect().ListCommands<StartJob>().size() == 1);
}

TEST_CASE("DriveOutcomes: an arrival ends a plan that is to be aborted, and fails its cancellation")
{
    DriveParts parts;
    const EPlanControl control = GENERATE(EPlanControl::Abort, EPlanControl::Cancel);
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.controls.Control(ControlPlan{control, "P1", {}, 7, {}});
    parts.Discard();
    parts.drives.OnArrived(parts.lr, Arrived{parts.GetDriveID()});
    const auto results = parts.Collect().ListReports<ControlResultReport>();
    REQUIRE(results.size() == 1);
    CHECK(results.front().bSucceeded == (control == EPlanControl::Abort));
    CHECK(
        plan.record.progress.state == (control == EPlanControl::Abort ? EPlanState::Aborted : EPlanState::InProgress));
}

TEST_CASE("DriveOutcomes: the plan of a rejected drive waits, one to the parking position is repeated later")
{
    DriveParts parts;
    SECTION("to a step")
    {
        ActivePlan& plan = parts.BeginDriveToLoad();
        parts.drives.OnDriveRejected(parts.lr, DriveRejected{parts.GetDriveID(), "blocked"});
        CHECK(plan.record.progress.state == EPlanState::InProgress);
        CHECK(parts.lr.planOrNull == &plan);
        CHECK(parts.lr.activity == EActivity::Waits);
        CHECK_FALSE(parts.lr.drive.has_value());
        CHECK(parts.lr.view.rejections.GetCount() == 1);
        const CallOutcome outcome = parts.Collect();
        CHECK(outcome.GetDelayOrNull(EEngineTimer::RejectionRetry).has_value());
        CHECK_FALSE(outcome.GetDelayOrNull(EEngineTimer::HomeRetry).has_value());
    }
    SECTION("to the parking position")
    {
        parts.PutOn(parts.lr, "D-A01.CP01");
        parts.drives.SendIdleHome();
        REQUIRE(parts.lr.drive.has_value());
        CHECK(parts.lr.drive->goal == EDriveGoal::Home);
        parts.Discard();
        parts.drives.OnDriveRejected(parts.lr, DriveRejected{parts.GetDriveID(), "blocked"});
        CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::HomeRetry).has_value());
        parts.drives.SendIdleHome();
        CHECK_FALSE(parts.lr.drive.has_value());
    }
}

TEST_CASE("DriveOutcomes: a cancelled drive ends the plan that was to end, and no other")
{
    DriveParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    SECTION("the plan was to be cancelled")
    {
        parts.controls.Control(ControlPlan{EPlanControl::Cancel, "P1", {}, 7, {}});
        parts.drives.OnDriveCancelled(parts.lr, DriveCancelled{parts.GetDriveID(), "L01"});
        CHECK(plan.record.progress.state == EPlanState::Cancelled);
        CHECK(parts.lr.place.node == parts.FindNode("L01"));
    }
    SECTION("the cancellation has timed out before")
    {
        parts.controls.Control(ControlPlan{EPlanControl::Cancel, "P1", {}, 7, {}});
        parts.controls.OnControlTimeout(parts.lr);
        parts.drives.OnDriveCancelled(parts.lr, DriveCancelled{parts.GetDriveID(), "L01"});
        CHECK(plan.record.progress.state == EPlanState::InProgress);
        CHECK_FALSE(parts.lr.drive.has_value());
        parts.drives.MoveWaiting();
        CHECK(parts.lr.drive.has_value());
    }
    SECTION("nothing was to be cancelled")
    {
        parts.drives.OnDriveCancelled(parts.lr, DriveCancelled{parts.GetDriveID(), "L01"});
        CHECK(plan.record.progress.state == EPlanState::InProgress);
        CHECK(parts.lr.view.rejections.GetReason() == "it was cancelled");
        CHECK(parts.lr.place.node == parts.FindNode("L01"));
    }
}

TEST_CASE("DriveOutcomes: each node after the first and the arrival end a row of rejected drives")
{
    DriveParts parts;
    parts.BeginDriveToLoad();
    parts.lr.view.rejections.Add("no route", 3);
    parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "D-CHG01"});
    CHECK(parts.lr.view.rejections.GetCount() == 1);
    SECTION("a node")
    {
        parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "L01"});
    }
    SECTION("the arrival")
    {
        parts.drives.OnArrived(parts.lr, Arrived{parts.GetDriveID()});
    }
    CHECK(parts.lr.view.rejections.GetCount() == 0);
}

TEST_CASE(
    "DriveOutcomes: the plan of a robot that entered a reserved node fails, and the place of the robot is unknown")
{
    DriveParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.PutOn(parts.cr, "D-A01.CP01");
    parts.drives.OnArrived(parts.lr, Arrived{parts.GetDriveID()});
    CHECK(plan.record.progress.state == EPlanState::Failed);
    CHECK_FALSE(parts.lr.place.bPlaced);
    CHECK(parts.lr.view.rejections.GetCount() == 0);
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListSetAlarms() == std::vector<std::string>{"ACS-1003"});
    CHECK(outcome.ListClearedAlarms().empty());
    parts.PutOn(parts.cr, "D-CHG02");
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 0U);
}

TEST_CASE("DriveOutcomes: a robot that arrives while it is to cancel its drive has a place if the node is free")
{
    DriveParts parts;
    parts.BeginDriveToLoad();
    parts.lr.drive->reroute = Reroute{};
    parts.lr.view.state->lastNodeID = "D-A01.CP01";
    parts.coordinator.VerifyRoute(parts.lr);
    parts.drives.OnArrived(parts.lr, Arrived{parts.GetDriveID()});
    CHECK(parts.lr.place.bPlaced);
    CHECK(parts.lr.place.node == parts.FindNode("D-A01.CP01"));
    CHECK(parts.engine.alarms.GetAlarms().empty());
}

TEST_CASE("DriveOutcomes: a robot that loses its drive and its position together keeps all nodes of its base")
{
    DriveParts parts;
    parts.BeginDriveToLoad();
    parts.drives.OnNodePassed(parts.lr, NodePassed{parts.GetDriveID(), "D-CHG01"});
    const ActiveDrive& drive = *parts.lr.drive;
    const std::vector<std::size_t> granted(
        drive.nodes.begin(),
        drive.nodes.begin() + static_cast<std::ptrdiff_t>(drive.grantedCount));
    REQUIRE(granted.size() > 2);
    const auto countHeld = [&parts, &granted] {
        return static_cast<std::size_t>(std::ranges::count_if(granted, [&parts](std::size_t node) {
            return parts.places.GetTraffic().GetHolderOrNull(node) == 0U;
        }));
    };
    std::size_t held = granted.size();
    StateChanged& state = *parts.lr.view.state;
    state.bPoseKnown = false;
    SECTION("it has forgotten its last node")
    {
        state.lastNodeID.clear();
    }
    SECTION("it knows its last node, and had a pose before")
    {
        parts.lr.view.bHadPose = true;
    }
    SECTION("it is line-guided: it never has a pose")
    {
        held = 1;
    }
    parts.drives.OnDriveRejected(parts.lr, DriveRejected{parts.GetDriveID(), "lost"});
    CHECK(countHeld() == held);
    parts.places.Place(parts.lr);
    CHECK(countHeld() == held);
    const SiteNode& node = parts.engine.site.GetNodes()[granted.front()];
    state.lastNodeID = node.nodeID;
    state.bPoseKnown = true;
    state.x = node.x;
    state.y = node.y;
    parts.places.Place(parts.lr);
    CHECK(countHeld() == 1);
    CHECK(parts.lr.place.bPlaced);
}
