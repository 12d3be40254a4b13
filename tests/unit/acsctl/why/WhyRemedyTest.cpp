#include "Catch.hpp"
#include "WhyFixture.hpp"

#include <string>

namespace Acsctl = ACS::Acsctl;
using namespace ACS::Acsctl::Test; // NOLINT(google-build-using-namespace): its fixture

TEST_CASE("The end of a maintenance is the remedy after the alarms of the robot")
{
    WhyFixture line;
    line.snapshot.robots[0].bMaintenance = true;
    line.snapshot.robots[0].reason = "In maintenance.";
    Acsctl::AlarmInfo alarm;
    alarm.robotID = "LR01";
    alarm.errorCode = "ACS-1003";
    alarm.remedy = "Push it";
    line.snapshot.alarms.push_back(alarm);
    line.AddWaitingPlan("P1", "No suitable robot is free.", {{"LR01", "in maintenance"}});
    for (const std::string& text :
         {PrintText(line.Make().ExplainPlan(line.snapshot.plans[0])),
          PrintText(line.Make().ExplainRobot(line.snapshot.robots[0]))})
    {
        CAPTURE(text);
        REQUIRE(text.find("acsctl maintenance LR01 off") != std::string::npos);
        CHECK(text.find("ACS-1003") < text.find("acsctl maintenance LR01 off"));
    }
    line.snapshot.alarms.clear();
    CHECK_THAT(
        PrintText(line.Make().ExplainPlan(line.snapshot.plans[0])),
        Catch::Contains("  Robot LR01: in maintenance.\n    Remedy: When it may move: acsctl maintenance LR01 off\n"));
}

TEST_CASE("A robot that is in maintenance is not to be taken out of service")
{
    WhyFixture line;
    Acsctl::AlarmInfo alarm = MakeAlarm("LR01", "ACS-1002", "Robot disconnected");
    alarm.remedy = "Check the robot. If it has left the floor, run `acsctl maintenance ROBOT on`.";
    line.snapshot.alarms.push_back(alarm);
    CHECK_THAT(PrintText(line.Make().ExplainRobot(line.snapshot.robots[0])), Catch::Contains("maintenance ROBOT on"));
    line.snapshot.robots[0].bMaintenance = true;
    const std::string text = PrintText(line.Make().ExplainRobot(line.snapshot.robots[0]));
    CHECK_THAT(text, Catch::Contains("Remedy: Check the robot.\n") && !Catch::Contains("maintenance ROBOT on"));

    line.snapshot.alarms[0].remedy = "Run `acsctl maintenance ROBOT on`.";
    CHECK_THAT(PrintText(line.Make().ExplainRobot(line.snapshot.robots[0])), !Catch::Contains("maintenance ROBOT on"));
}

TEST_CASE("A refused report is final or sent again, and may be of no plan")
{
    WhyFixture line;
    line.AddPlan("P1", "Paused");
    Acsctl::RefusedReport& last = line.snapshot.status.refusedReports.last.emplace();
    line.snapshot.status.refusedReports.count = 1;
    last.command = "ErrorReport";
    last.message = "unknown code";
    std::string text = PrintText(line.Make().ExplainAll());
    CHECK_THAT(text, Catch::Contains("Refused reports are not sent again.") && !Catch::Contains("Correct the plan"));
    CHECK_THAT(text, Catch::Contains("Remedy: Correct the cause in the MCS; its log has the reason.\n"));

    last.command = "JobReport";
    last.planID = "P1";
    last.bRetried = true;
    text = PrintText(line.Make().ExplainAll());
    CHECK_THAT(text, Catch::Contains("Refused reports are sent again after the next registration."));
    CHECK_THAT(
        text,
        Catch::Contains("Correct the plan in the MCS; its log has the reason.") && !Catch::Contains("not sent again"));
}

TEST_CASE("The ids in the commands of remedies are quoted for a shell")
{
    WhyFixture line;
    Acsctl::RobotInfo& robot = line.snapshot.robots[0];
    robot.robotID = "-R;id";
    robot.bMaintenance = true;
    line.AddPlan("$(touch X);x y", "Paused").robotID = robot.robotID;
    Acsctl::BlockInfo& block = line.site.blocked.emplace_back();
    block.kind = "edge";
    block.id = "`id`";
    Acsctl::AlarmInfo alarm;
    alarm.errorCode = "ACS-1008";
    alarm.planID = line.snapshot.plans[0].planID;
    alarm.jobID = "it's";
    line.snapshot.alarms.push_back(alarm);
    const std::string text = PrintText(line.Make().ExplainAll());
    for (const char* command :
         {"acsctl resume '$(touch X);x y'\n",
          "acsctl maintenance -- '-R;id' off\n",
          "acsctl unblock edge '`id`'\n",
          "acsctl resolve '$(touch X);x y' 'it'\\''s' again\n"})
    {
        CHECK_THAT(text, Catch::Contains(command));
    }
}
