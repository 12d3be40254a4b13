#include "view/LineViews.hpp"

#include "Catch.hpp"

namespace Acsctl = ACS::Acsctl;

namespace
{

Acsctl::TraceLine MakeLine(std::string text, std::optional<std::string> topicOrNull = std::nullopt)
{
    Acsctl::TraceLine line;
    line.time = "2026-11-27T23:10:00.000Z";
    line.link = topicOrNull.has_value() ? "mqtt" : "mcs";
    line.direction = "in";
    line.topic = std::move(topicOrNull);
    line.text = std::move(text);
    return line;
}

} // namespace

TEST_CASE("A message is summarised by what it is about")
{
    CHECK(
        Acsctl::Summarize(MakeLine(R"({"command":"PlanReport","payload":{"status":"Failed","planId":"P1","x":[1]}})"))
        == "PlanReport planId=P1 status=Failed");
    CHECK(
        Acsctl::Summarize(MakeLine(R"({"command":"ExecutionPlanAck","result":"Success","message":""})"))
        == "ExecutionPlanAck result=Success");
    CHECK(
        Acsctl::Summarize(
            MakeLine(R"({"command":"PlanReportAck","result":"Fail","message":"no such plan","payload":{}})"))
        == "PlanReportAck result=Fail message=no such plan");
    CHECK(
        Acsctl::Summarize(
            MakeLine(R"({"command":"ExecutionPlanAck","payload":{"planId":"P1"},"result":"Success","message":null})"))
        == "ExecutionPlanAck planId=P1 result=Success");
    CHECK(
        Acsctl::Summarize(MakeLine(R"({"orderId":"O","lastNodeId":"N1","driving":true})", "uagv/v2/A/1/state"))
        == "state orderId=O lastNodeId=N1 driving=true");
    CHECK(Acsctl::Summarize(MakeLine("not json", "uagv/v2/A/1/state")) == "state not json");
    CHECK(Acsctl::Summarize(MakeLine("MONITOR 1")) == "MONITOR 1");
    Acsctl::TraceLine lost = MakeLine("");
    lost.lost = 3;
    CHECK(Acsctl::Summarize(lost) == "3 messages are missing before this line");
}

TEST_CASE("An event is one line within the screen")
{
    const Acsctl::EntryEvent entry{"2026-11-27T23:10:00.123Z", "plan", "LR01", "P1", "plan P1:\nPending -> InProgress"};
    CHECK(Acsctl::PrintEntry(entry, {80, false}) == "23:10:00.123 plan    plan P1: Pending -> InProgress\n");
    CHECK(Acsctl::PrintEntry(entry, {20, false}) == "23:10:00.123 plan  …\n");
}
