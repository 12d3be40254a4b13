#include "wire/MemberJudge.hpp"

#include "Catch.hpp"
#include "RunJudge.hpp"

#include <string>
#include <vector>

using ACS::McsSim::MemberJudge;

namespace
{

std::string MakeMessageText(const std::string& command, const std::string& payload, const std::string& more = {})
{
    return R"({"command":")" + command + R"(","transactionId":"x","timestamp":"2025-07-02T21:00:00.123+09:00",)" + more
        + R"("payload":)" + payload + "}";
}

const char* const IDLE_ROBOT = R"({"robotId":"LR01","robotType":"LR","robotStatus":"Idle")";
const char* const SUCCESS = R"("result":"Success","message":"",)";

} // namespace

TEST_CASE("2, 5 A required member that is left out is reported once; null states that nothing applies")
{
    MemberJudge judge;
    CHECK(judge
              .OnText(MakeMessageText(
                  "RobotStatusUpdate",
                  std::string(IDLE_ROBOT)
                      + R"(,"position":null,"carrierIds":[],"planId":null,"stepNo":null,"jobId":null,"message":""})"))
              .empty());
    CHECK(judge.GetCount() == 0);
    const std::string text = MakeMessageText(
        "RobotStatusUpdate",
        std::string(IDLE_ROBOT) + R"(,"carrierIds":[],"planId":null,"stepNo":null,"message":""})");
    CHECK(
        judge.OnText(text)
        == std::vector<std::string>{
            "ACS required member left out: RobotStatusUpdate payload.position (reported once)",
            "ACS required member left out: RobotStatusUpdate payload.jobId (reported once)"});
    CHECK(judge.OnText(text).empty());
    CHECK(judge.GetCount() == 4);
}

TEST_CASE(
    "2, 4.3 An Ack has result, message and payload, and the entries of its list their members; a refusal needs no planId")
{
    MemberJudge judge;
    CHECK(judge.OnText(MakeMessageText("ExecutionPlanAck", R"({"planId":"P"})", SUCCESS)).empty());
    CHECK(judge.OnText(MakeMessageText("ExecutionPlanAck", "{}", R"("result":"Fail","message":"no",)")).empty());
    CHECK(judge.OnText(MakeMessageText("ExecutionPlanAck", "{}", SUCCESS)).size() == 1);
    CHECK(judge.OnText(R"({"command":"SyncConfigAck","transactionId":"x"})").size() == 3);
    CHECK(judge.OnText(MakeMessageText("RequestAcsErrorListAck", R"({"errors":[]})", SUCCESS)).empty());
    CHECK(judge.OnText(MakeMessageText("RequestAcsErrorListAck", "{}", SUCCESS)).size() == 1);
    CHECK(
        judge.OnText(MakeMessageText(
            "RequestAcsPlansAck",
            R"({"plans":[{"planId":"P","robotId":null,"status":"Pending","stepNo":1,"jobId":null,"currentAction":null,)"
            R"("startTime":"2025-07-02T21:00:00.123+09:00"}]})",
            SUCCESS))
        == std::vector<std::string>{
            "ACS required member left out: RequestAcsPlansAck payload.plans[].endTime (reported once)"});
}

TEST_CASE("5.8 Optional members, other commands and texts that are no message have no deviation")
{
    MemberJudge judge;
    for (const std::string& text :
         {MakeMessageText(
              "ErrorReport",
              R"({"robotId":"LR01","state":true,"errorCode":"E","level":"light","message":""})"),
          MakeMessageText("Registration", "{}"),
          MakeMessageText("DanceAck", "{}"),
          MakeMessageText("PlanReport", "[]"),
          std::string("this is no JSON"),
          std::string("[]")})
    {
        CHECK(judge.OnText(text).empty());
    }
}

TEST_CASE("A required member that is left out is a deviation of the run, and no violation")
{
    ACS::McsSim::PlanTracker::Lines lines;
    ACS::McsSim::RunJudge judge{ACS::McsSim::SimulatorOptions{}, {}, lines};
    judge.OnTextReceived(MakeMessageText("PlanReport", R"({"planId":"P","status":"Completed"})"));
    CHECK(lines.size() == 1);
    CHECK(judge.GetTracker().CountViolations() == 0);
    CHECK(judge.GetMembers().GetCount() == 1);
}
