#include "Catch.hpp"
#include "mcs/PlanMapper.hpp"
#include "mcs/ReportMapper.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <chrono>
#include <numbers>
#include <string>
#include <variant>

namespace ACS::Acsd::Test
{

namespace
{

using namespace std::chrono_literals;

const Planning::SubmitPlan& AsSubmit(const std::optional<Planning::PlanCommand>& commandOrNull)
{
    REQUIRE(commandOrNull.has_value());
    return std::get<Planning::SubmitPlan>(*commandOrNull);
}

} // namespace

TEST_CASE("4.1 An ExecutionPlan becomes a SubmitPlan with the sender's own spellings")
{
    Protocol::ExecutionPlan message;
    message.planID = "P";
    message.lotID = "L";
    message.priority = 10;
    message.steps.push_back({2, "CassetteLoad", "a01.cp1", {"C1"}, {{"J1", "A01.CP01", "AMR.CP01"}, {"J2", "", ""}}});

    const auto command = MakePlanCommandOrNull(message, "T", 7);

    const Planning::SubmitPlan& submit = AsSubmit(command);
    CHECK(submit.replyToken == 7);
    CHECK(submit.plan.planID == "P");
    CHECK(submit.plan.lotID == "L");
    CHECK(submit.plan.priority == 10);
    REQUIRE(submit.plan.steps.size() == 1);
    const Planning::Step& step = submit.plan.steps.front();
    CHECK(step.stepNo == 2);
    CHECK(step.action == "CassetteLoad");
    CHECK(step.position == "a01.cp1");
    CHECK(step.carrierIDs == std::vector<std::string>{"C1"});
    CHECK(step.jobs.at(0) == Planning::Job{"J1", "A01.CP01", "AMR.CP01"});
    CHECK(step.jobs.at(1) == Planning::Job{"J2", std::nullopt, std::nullopt});
}

TEST_CASE("4.2 Each control command keeps its kind, plan and reason")
{
    using Planning::EPlanControl;
    const auto expect = [](const Protocol::AcsPayload& payload, EPlanControl kind) {
        const auto command = MakePlanCommandOrNull(payload, "T", 3);
        REQUIRE(command.has_value());
        const auto& control = std::get<Planning::ControlPlan>(*command);
        CHECK(control.control == kind);
        CHECK(control.planID == "P");
        CHECK(control.replyToken == 3);
    };
    expect(Protocol::CancelPlan{"P", "why"}, EPlanControl::Cancel);
    expect(Protocol::AbortPlan{"P", "why"}, EPlanControl::Abort);
    expect(Protocol::PausePlan{"P", "why"}, EPlanControl::Pause);
    expect(Protocol::ResumePlan{"P", ""}, EPlanControl::Resume);
}

TEST_CASE("4.3 A query is not a command of the engine")
{
    CHECK_FALSE(MakePlanCommandOrNull(Protocol::RequestAcsPlans{}, "T", 1).has_value());
    CHECK_FALSE(MakePlanCommandOrNull(Protocol::RequestAcsErrorList{}, "T", 1).has_value());
}

TEST_CASE("9 A report is resent with the same transactionId and time")
{
    const Core::WallTime time{1'700'000'000s};
    const Planning::OutboxEntry entry{
        5,
        "T",
        time,
        Planning::JobReport{"P", "LR01", 1, "J", Planning::EJobState::Completed, "m"}};

    const Protocol::AcsRequest request = MakeReportRequest(entry, 540min);

    CHECK(request == MakeReportRequest(entry, 540min));
    CHECK(request.transactionID == "T");
    CHECK(request.timestamp == Core::Timestamp{time, 540min});
    CHECK(
        std::get<Protocol::JobReport>(request.payload)
        == Protocol::JobReport{"P", "LR01", 1, "J", Protocol::EJobStatus::Completed, "m"});
}

TEST_CASE("5.7 The outcome of each control command has its own report, with Failed as the failure word")
{
    const auto make = [](Planning::EPlanControl control, bool bSucceeded) {
        return MakeReportRequest({1, "T", {}, Planning::ControlResultReport{control, "P", bSucceeded, "m"}}, 0min)
            .payload;
    };
    CHECK(
        std::get<Protocol::CancelResultReport>(make(Planning::EPlanControl::Cancel, false)).result
        == Protocol::EReportResult::Failed);
    CHECK(
        std::get<Protocol::AbortResultReport>(make(Planning::EPlanControl::Abort, true)).result
        == Protocol::EReportResult::Success);
    CHECK(std::get<Protocol::PauseResultReport>(make(Planning::EPlanControl::Pause, true)).planID == "P");
    CHECK(std::get<Protocol::ResumeResultReport>(make(Planning::EPlanControl::Resume, true)).message == "m");
}

TEST_CASE("11 Details that MCS-ACS leaves open are written as configured")
{
    MessageStyle style;
    style.bResultFailureIsFail = true;
    style.bEmptyCarriersOmitted = true;
    style.bUnassignedRobotEmpty = true;
    style.errors["ACS-1002"] = {"E77", Planning::EAlarmLevel::Light, std::nullopt};

    const auto make = [&style](bool bSucceeded) {
        const Planning::ControlResultReport report{Planning::EPlanControl::Cancel, "P", bSucceeded, "m"};
        const Protocol::AcsRequest request = MakeReportRequest({1, "T", {}, report}, 0min, style);
        std::string text;
        Protocol::AcsCodec::EncodeRequest(request, text);
        return text;
    };
    CHECK(make(false).find(R"("result":"Fail",)") != std::string::npos);
    CHECK(make(true).find(R"("result":"Success",)") != std::string::npos);

    Planning::RobotStatus status;
    status.carrierIDs = {std::nullopt, "TRAY_02"};
    CHECK(MakeStatusUpdate(status).carrierIDs.size() == 2);
    CHECK(MakeStatusUpdate(status, style).carrierIDs == std::vector<std::optional<std::string>>{"TRAY_02"});

    Planning::PlanSummary summary;
    CHECK_FALSE(MakePlanEntry(summary, 0min).robotID.has_value());
    CHECK(MakePlanEntry(summary, 0min, style).robotID == std::string());
    summary.robotID = "LR01";
    CHECK(MakePlanEntry(summary, 0min, style).robotID == "LR01");

    Planning::Alarm alarm;
    alarm.errorCode = "ACS-1002";
    CHECK(MakeErrorReport(alarm, true).errorCode == "ACS-1002");
    for (const bool bSet : {true, false}) // cleared under the name that it was set with
    {
        CHECK(MakeErrorReport(alarm, bSet, style).errorCode == "E77");
        CHECK(MakeErrorReport(alarm, bSet, style).level == Protocol::EErrorLevel::Light);
    }
    alarm.mcsCode = "E76"; // set before errors.map was changed
    CHECK(MakeErrorReport(alarm, false, style).errorCode == "E76");
}

TEST_CASE("5.10 Positions are metres, degrees from 0 to below 360, and a whole battery percentage")
{
    const auto updates = MakePositionUpdates(
        {{"LR01", 1.5, 2.5, std::numbers::pi / 2, 75.4},
         {"CR01", 0, 0, -std::numbers::pi / 2, 75.5},
         {"CR02", 0, 0, -1e-17, 0}});
    REQUIRE(updates.size() == 1);
    const Protocol::RobotPositionUpdate& update = updates.front();
    REQUIRE(update.robots.size() == 3);
    CHECK(update.robots[2].angle == 0.0);
    CHECK(update.robots[0].x == 1.5);
    CHECK(update.robots[0].angle == Approx(90.0));
    CHECK(update.robots[0].battery == 75.0);
    CHECK(update.robots[1].angle == Approx(270.0));
    CHECK(update.robots[1].battery == 76.0);
}

TEST_CASE("5.10, 12 Positions that are too long for one message are cut to as few as fit, with each robot once")
{
    constexpr std::size_t ROBOTS = 120;
    std::vector<Planning::RobotPose> poses;
    for (std::size_t i = 0; i < ROBOTS; ++i)
    {
        poses.push_back({"CR" + std::to_string(1000 + i), 10.24 + static_cast<double>(i), 3.5, 1.0, 80});
    }
    CHECK(MakePositionUpdates(poses).size() == 1);
    CHECK(MakePositionUpdates({}).size() == 1);

    MessageStyle style;
    style.longestText = 4096;
    const auto updates = MakePositionUpdates(poses, style);
    CHECK(updates.size() > 1);
    const auto countBytes = [](const Protocol::RobotPositionUpdate& update) {
        std::string text;
        Protocol::AcsCodec::EncodeRequest({"0f8fad5b-d9cb-469f-a165-70867728950e", {{}, -11h - 30min}, update}, text);
        return text.size();
    };
    std::vector<std::string> robotIDs;
    for (std::size_t i = 0; i < updates.size(); ++i)
    {
        CHECK(countBytes(updates[i]) <= style.longestText);
        if (i + 1 < updates.size())
        {
            Protocol::RobotPositionUpdate longer = updates[i];
            longer.robots.push_back(updates[i + 1].robots.front());
            CHECK(countBytes(longer) > style.longestText - 2);
        }
        for (const Protocol::RobotPosition& position : updates[i].robots)
        {
            robotIDs.push_back(position.robotID);
        }
    }
    REQUIRE(robotIDs.size() == ROBOTS);
    for (std::size_t i = 0; i < ROBOTS; ++i)
    {
        CHECK(robotIDs[i] == poses[i].robotID);
    }
}

TEST_CASE("5.9 A robot's status has null for members that do not apply")
{
    Planning::RobotStatus status;
    status.robotID = "CR01";
    status.type = Planning::ERobotType::CR;
    status.status = Planning::ERobotStatus::UnDocking;
    status.carrierIDs = {std::nullopt, "T2"};

    const Protocol::RobotStatusUpdate update = MakeStatusUpdate(status);

    CHECK(update.robotType == Protocol::ERobotType::Control);
    CHECK(update.robotStatus == Protocol::ERobotStatus::UnDocking);
    CHECK_FALSE(update.position.has_value());
    CHECK_FALSE(update.planID.has_value());
    CHECK(update.carrierIDs == status.carrierIDs);
}

TEST_CASE("The names of the enumerators in the engine and on the wire are the same")
{
    const auto expectSame = [](auto domain, auto wire) {
        CHECK(GetText(domain) == GetText(wire));
    };
    for (int i = 0; i <= static_cast<int>(Planning::EPlanState::Aborted); ++i)
    {
        expectSame(static_cast<Planning::EPlanState>(i), static_cast<Protocol::EPlanStatus>(i));
    }
    for (int i = 0; i <= static_cast<int>(Planning::EStepState::Skipped); ++i)
    {
        expectSame(static_cast<Planning::EStepState>(i), static_cast<Protocol::EStepStatus>(i));
    }
    for (int i = 0; i <= static_cast<int>(Planning::EJobState::Failed); ++i)
    {
        expectSame(static_cast<Planning::EJobState>(i), static_cast<Protocol::EJobStatus>(i));
    }
    for (int i = 0; i <= static_cast<int>(Planning::ERobotStatus::Stopped); ++i)
    {
        expectSame(static_cast<Planning::ERobotStatus>(i), static_cast<Protocol::ERobotStatus>(i));
    }
    for (int i = 0; i <= static_cast<int>(Planning::EAlarmLevel::Light); ++i)
    {
        expectSame(static_cast<Planning::EAlarmLevel>(i), static_cast<Protocol::EErrorLevel>(i));
    }
    for (int i = 0; i <= static_cast<int>(Planning::ERobotType::CR); ++i)
    {
        expectSame(static_cast<Planning::ERobotType>(i), static_cast<Protocol::ERobotType>(i));
    }
}

} // namespace ACS::Acsd::Test
