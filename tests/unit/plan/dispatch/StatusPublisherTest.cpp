#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("StatusPublisher: the first rule that holds decides")
{
    EngineParts parts;
    const auto derive = [&parts] {
        return parts.status.DeriveStatus(parts.lr);
    };
    CHECK(derive() == ERobotStatus::Disconnected);
    parts.lr.view.bOnline = true;
    CHECK(derive() == ERobotStatus::Init);
    parts.PutOn(parts.lr, "D-CHG01");
    CHECK(derive() == ERobotStatus::Idle);
    parts.lr.view.state->bOccupied = true;
    CHECK(derive() == ERobotStatus::Working);
    parts.lr.view.state->bCharging = true;
    CHECK(derive() == ERobotStatus::Charging);
    parts.lr.view.state->bAutomatic = false;
    CHECK(derive() == ERobotStatus::Manual);
    parts.lr.view.state->bPaused = true;
    CHECK(derive() == ERobotStatus::Stopped);
    parts.lr.view.state->errors = {RobotError{"AGV-1", EAlarmLevel::Light, {}}};
    CHECK(derive() == ERobotStatus::Stopped);
    parts.lr.view.state->errors = {RobotError{"AGV-1", EAlarmLevel::Heavy, {}}};
    CHECK(derive() == ERobotStatus::Error);
    parts.lr.view.bOnline = false;
    CHECK(derive() == ERobotStatus::Disconnected);
}

TEST_CASE("StatusPublisher: a robot with a plan drives out of a station, along lanes, into a station, and works")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    const auto derive = [&parts] {
        return parts.status.DeriveStatus(parts.lr);
    };
    CHECK(derive() == ERobotStatus::Moving);
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
    ActiveDrive& drive = *parts.lr.drive;
    drive.bTaken = true;
    CHECK(derive() == ERobotStatus::UnDocking);
    drive.passed = 1;
    CHECK(derive() == ERobotStatus::Moving);
    drive.passed = 3;
    parts.lr.planOrNull->bStepArrived = true;
    CHECK(derive() == ERobotStatus::Moving); // it waits for its last node
    drive.grantedCount = drive.nodes.size();
    CHECK(derive() == ERobotStatus::Docking);
    parts.lr.planOrNull->bStepArrived = false;
    CHECK(derive() == ERobotStatus::Moving);
    parts.lr.drive.reset();
    parts.lr.place.node = parts.FindNode("D-A01.CP01");
    CHECK(derive() == ERobotStatus::Working);
}

TEST_CASE("StatusPublisher: only a status that has changed is published")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    parts.Discard();
    static_cast<void>(parts.lr.changes.TryUnmarkStatus());
    parts.status.PublishStatusChanges();
    CHECK(parts.Collect().actions.empty());
    parts.lr.changes.MarkStatus();
    parts.status.PublishStatusChanges();
    const auto published = parts.Collect().ListActions<RobotStatusChanged>();
    REQUIRE(published.size() == 1);
    CHECK(published.front().status.robotID == "LR01");
    CHECK(published.front().status.status == ERobotStatus::Idle);
    CHECK(published.front().status == parts.status.GetRobotStatuses().front());
    parts.lr.changes.MarkStatus();
    parts.status.PublishStatusChanges();
    CHECK(parts.Collect().actions.empty());
}

TEST_CASE("StatusPublisher: the status names plan, step, job and carriers")
{
    EngineParts parts;
    parts.BeginLoad();
    parts.lr.ports.Correct({"CASSETTE_01"});
    parts.status.Reset(parts.lr);
    CHECK(parts.Collect().actions.empty());
    const RobotStatus& status = parts.status.GetRobotStatuses().front();
    CHECK(status.status == ERobotStatus::Working);
    CHECK(status.planID == "P1");
    CHECK(status.stepNo == 1);
    CHECK(status.jobID == "P1-a4");
    CHECK(status.carrierIDs == std::vector<std::optional<std::string>>{"CASSETTE_01"});
}

TEST_CASE("StatusPublisher: a robot without a plan states what it waits for on its way to its parking position")
{
    EngineOptions options = MakeTestOptions(false);
    options.robots.front().chargingStationID = "CHG03";
    EngineParts parts(options);
    const auto getMessage = [&parts] {
        parts.status.Reset(parts.lr);
        return parts.status.GetRobotStatuses().front().message;
    };
    parts.PutOn(parts.lr, "D-A01.CP01");
    parts.PutOn(parts.cr, "D-CHG03");
    CHECK(getMessage().empty());
    SECTION("another robot, also with a low battery")
    {
        parts.lr.view.state->batteryPercent = 10;
        parts.charging.UpdateBattery(parts.lr);
        CHECK(getMessage() == "Battery low.");
        REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
        CHECK(getMessage() == "LR01 waits for CR01 to clear its route.");
    }
    SECTION("another attempt, after one without a route")
    {
        parts.coordinator.RefuseHome(parts.lr, "LR01 has no route from D-A01.CP01 to D-CHG01.");
        CHECK(getMessage() == "LR01 has no route from D-A01.CP01 to D-CHG01.");
        parts.PutOn(parts.lr, "D-CHG01");
        CHECK(getMessage().empty());
    }
    SECTION("its release at the end of its base")
    {
        parts.BeginDrive(parts.lr, "D-CHG01");
        parts.lr.drive->bConfirmed = true;
        parts.lr.search.blockers = {parts.cr.index};
        CHECK(getMessage().empty());
        parts.lr.drive->releasedCount = 1;
        parts.lr.drive->grantedCount = 1;
        CHECK(getMessage() == "LR01 waits for node L03 on its route: there it could close the way of CR01.");
        parts.lr.view.state->bDriving = true;
        CHECK(getMessage().empty());
    }
}

TEST_CASE("StatusPublisher: the option decides which position a moving robot has")
{
    EngineOptions options = MakeTestOptions(false);
    const auto [position, expected] = GENERATE(table<EMovingPosition, std::string>(
        {{EMovingPosition::Last, "CHG01"}, {EMovingPosition::Target, "A01.CP01"}, {EMovingPosition::None, ""}}));
    options.movingPosition = position;
    EngineParts parts(options);
    parts.BeginDriveToLoad();
    parts.status.PublishStatus(parts.lr, ERobotStatus::Moving);
    CHECK(parts.status.GetRobotStatuses().front().position == expected);
    parts.status.PublishStatus(parts.lr, ERobotStatus::Docking);
    CHECK(parts.status.GetRobotStatuses().front().position == "A01.CP01");
}
