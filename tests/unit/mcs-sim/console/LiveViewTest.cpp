#include "console/LiveView.hpp"

#include "Catch.hpp"
#include "console/CleanText.hpp"
#include "ManualClock.hpp"
#include "plans/SamplePlans.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using ACS::McsSim::GetColumns;
using ACS::McsSim::LiveView;
using ACS::McsSim::PlannedPlan;
using ACS::McsSim::PlanTracker;
using ACS::McsSim::RobotBoard;
using ACS::McsSim::StyledLine;
using ACS::McsSim::StyledLines;
using ACS::McsSim::ViewHeading;
using ACS::Protocol::EAckResult;
using ACS::Protocol::EJobStatus;
using ACS::Protocol::EPlanStatus;
using ACS::Protocol::ERobotStatus;
using ACS::Protocol::ERobotType;
using ACS::Protocol::EStepStatus;
using ACS::Testing::MakeAck;
using ACS::Testing::MakeJobReport;
using ACS::Testing::MakePlanReport;
using ACS::Testing::MakeSamplePlan;
using ACS::Testing::MakeStepReport;
using ACS::Testing::ManualClock;

namespace
{

ViewHeading MakeHeading()
{
    return {"ws://127.0.0.1:9001/acs/", true, false, std::chrono::milliseconds(12'345)};
}

std::string Join(const StyledLines& lines, std::size_t columns)
{
    std::string text;
    for (const StyledLine& line : lines)
    {
        text += MakeText(line, columns, false) + "\n";
    }
    return text;
}

void SendAll(PlanTracker& tracker)
{
    PlanTracker::Lines lines;
    const ManualClock clock;
    tracker.OnRegistered();
    for (std::size_t i = 0; i < tracker.GetPlans().size(); ++i)
    {
        tracker.OnSent(i, clock.GetNow(), lines);
    }
}

/// Two robots; of three plans the first is being worked on, the second was refused, the third waits for its Ack.
struct Scene
{
    PlanTracker tracker{
        {MakeSamplePlan("PLAN-20261121-0001-3fa2", "T1"),
         MakeSamplePlan("PLAN-20261121-0002-88c0", "T2"),
         MakeSamplePlan("PLAN-20261121-0003-07d1", "T3")}};
    RobotBoard board;
    std::vector<std::string> lines;

    Scene()
    {
        SendAll(tracker);
        const std::string planID = "PLAN-20261121-0001-3fa2";
        tracker.OnAck(MakeAck(tracker.GetPlans()[0].planned, EAckResult::Success), lines);
        tracker.OnAck(MakeAck(tracker.GetPlans()[1].planned, EAckResult::Fail, "no such place as A09.CP01"), lines);
        tracker.OnRequest(MakePlanReport(planID, EPlanStatus::InProgress), {}, lines);
        tracker.OnRequest(MakeStepReport(planID, 1, EStepStatus::Dispatched), {}, lines);
        tracker.OnRequest(MakeStepReport(planID, 1, EStepStatus::InProgress), {}, lines);
        tracker.OnRequest(MakeJobReport(planID, 1, "J1", EJobStatus::Instructed), {}, lines);
        tracker.OnRequest(MakeJobReport(planID, 1, "J1", EJobStatus::InProgress), {}, lines);
        tracker.OnRequest(MakeJobReport(planID, 1, "J1", EJobStatus::Completed), {}, lines);
        tracker.OnRequest(MakeStepReport(planID, 1, EStepStatus::Completed), {}, lines);
        tracker.OnRequest(MakeStepReport(planID, 2, EStepStatus::Dispatched), {}, lines);
        tracker.OnRequest(MakeStepReport(planID, 2, EStepStatus::InProgress), {}, lines);
        board.OnStatus(
            {"LR01",
             ERobotType::Logistics,
             ERobotStatus::Working,
             "A02.CP03",
             {"CASSETTE_01-3fa2"},
             planID,
             2,
             "J3",
             ""},
            lines);
        board.OnStatus(
            {"CR01",
             ERobotType::Control,
             ERobotStatus::Disconnected,
             std::nullopt,
             {"TRAY_01-88c0", std::nullopt, "TRAY_03-88c0"},
             std::nullopt,
             std::nullopt,
             std::nullopt,
             ""},
            lines);
        board.OnPosition({{{"LR01", 32.456, 4.0, 90.0, 87.0}, {"CR01", 9.0, 14.25, 0.0, 100.0}}}, lines);
    }
};

} // namespace

TEST_CASE("The live view has a line per robot and a line per plan")
{
    const Scene scene;
    const StyledLines lines = LiveView(100, 24).Render(scene.tracker, scene.board, MakeHeading());
    const char* const expected =
        R"( MCS ws://127.0.0.1:9001/acs/   ACS registered   0/3 plans completed, 1 failed   12.3 s

 robot type status       at           x,    y  batt  plan      step job carriers
 CR01  CR   Disconnected –          9.0, 14.2 100 %  –                  TRAY_01-88c0 – TRAY_03-88c0
 LR01  LR   Working      A02.CP03  32.5,  4.0  87 %  …001-3fa2 2/2  2/2 CASSETTE_01-3fa2

 plan                    robot status     step action             job  progress
 PLAN-20261121-0001-3fa2 LR01  InProgress 2/2  CassetteUnload     1/2  █████████████░░░░░░░░░  60 %
 PLAN-20261121-0002-88c0       Refused    no such place as A09.CP01
 PLAN-20261121-0003-07d1       Sent       1/2  CassetteLoad       1/1  ░░░░░░░░░░░░░░░░░░░░░░   0 %
)";
    CHECK(Join(lines, 99) == expected);
}

TEST_CASE("On a narrow terminal plans lose the front of their ids, not how far they have come")
{
    const Scene scene;
    const std::string text = Join(LiveView(80, 24).Render(scene.tracker, scene.board, MakeHeading()), 79);
    CHECK(text.find(" …-20261121-0001-3fa2 LR01  InProgress 2/2") != std::string::npos);
    CHECK(text.find("███░░  60 %\n") != std::string::npos);
}

TEST_CASE("No line of the live view is wider than the terminal, whatever its content")
{
    Scene scene;
    scene.board.OnStatus(
        {"로봇한글이름입니다",
         ERobotType::Control,
         ERobotStatus::Working,
         "A01.CP01.TP01.MP01",
         {"긴운반체이름긴운반체이름긴운반체이름", "긴운반체이름긴운반체이름긴운반체이름"},
         "계획계획계획계획계획계획",
         1,
         std::nullopt,
         ""},
        scene.lines);
    for (const std::size_t columns : {40U, 60U, 80U, 100U, 200U})
    {
        for (const StyledLine& line : LiveView(columns, 24).Render(scene.tracker, scene.board, MakeHeading()))
        {
            CHECK(GetColumns(MakeText(line, columns - 1, false)) <= columns - 1);
        }
    }
}

TEST_CASE("Of many plans the live view shows those that are being worked on, and counts the others")
{
    std::vector<PlannedPlan> plans;
    for (std::size_t i = 1; i <= 30; ++i)
    {
        plans.push_back(MakeSamplePlan("P" + std::to_string(i), "T" + std::to_string(i)));
    }
    PlanTracker tracker(plans);
    std::vector<std::string> lines;
    SendAll(tracker);
    tracker.OnRequest(MakePlanReport("P29", EPlanStatus::InProgress), {}, lines);
    tracker.OnRequest(MakePlanReport("P30", EPlanStatus::InProgress), {}, lines);
    tracker.OnRequest(MakePlanReport("P1", EPlanStatus::Cancelled), {}, lines);
    const std::string text = Join(LiveView(100, 50).Render(tracker, RobotBoard(), MakeHeading()), 99);
    CHECK(text.find(" P29 ") != std::string::npos);
    CHECK(text.find(" P30 ") != std::string::npos);
    CHECK(text.find(" P1 ") != std::string::npos);
    CHECK(text.find(" P10 ") != std::string::npos);
    CHECK(text.find(" P11 ") == std::string::npos);
    CHECK(text.find(" 12 of 30 plans shown: 0 completed, 1 failed, 29 to go\n") != std::string::npos);
}

TEST_CASE("The live view never has more lines than the terminal")
{
    std::vector<PlannedPlan> plans;
    RobotBoard board;
    std::vector<std::string> lines;
    for (std::size_t i = 10; i < 40; ++i)
    {
        plans.push_back(MakeSamplePlan("P" + std::to_string(i), "T" + std::to_string(i)));
        board.OnPosition({{{"R" + std::to_string(i), 0.0, 0.0, 0.0, 50.0}}}, lines);
    }
    const PlanTracker tracker(plans);
    for (const std::size_t rows : {8U, 12U, 24U, 40U})
    {
        CHECK(LiveView(100, rows).Render(tracker, board, MakeHeading()).size() < rows);
    }
}

TEST_CASE("A progress bar is full only at the end")
{
    CHECK(ACS::McsSim::MakeBar(0.0, 4) == "░░░░");
    CHECK(ACS::McsSim::MakeBar(0.5, 4) == "██░░");
    CHECK(ACS::McsSim::MakeBar(0.99, 4) == "███░");
    CHECK(ACS::McsSim::MakeBar(1.0, 4) == "████");
    CHECK(ACS::McsSim::MakeBar(7.0, 2) == "██");
}

TEST_CASE("Positions make no lines, and a status only when something changed")
{
    RobotBoard board;
    std::vector<std::string> lines;
    ACS::Protocol::RobotStatusUpdate status{
        "LR01",
        ERobotType::Logistics,
        ERobotStatus::Moving,
        "A01.CP01",
        {std::nullopt},
        std::nullopt,
        std::nullopt,
        std::nullopt,
        ""};
    board.OnStatus(status, lines);
    board.OnStatus(status, lines);
    board.OnPosition({{{"LR01", 1.0, 2.0, 3.0, 4.0}}}, lines);
    status.carrierIDs = {"CASSETTE_01"};
    board.OnStatus(status, lines);
    CHECK(
        lines
        == std::vector<std::string>{
            "LR01 RobotStatusUpdate Moving at A01.CP01 [–]",
            "LR01 RobotStatusUpdate Moving at A01.CP01 [CASSETTE_01]"});
}
