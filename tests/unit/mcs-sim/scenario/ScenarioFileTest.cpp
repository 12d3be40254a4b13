#include "scenario/ScenarioFile.hpp"

#include "Catch.hpp"
#include "plans/SamplePlans.hpp"
#include "TemporaryFolder.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <variant>

using namespace ACS::McsSim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Protocol::EAcsCommand;

namespace
{

tl::expected<PlannedPlan, std::string> ReadSample(const std::string& path)
{
    if (path != "plan.json")
    {
        return tl::make_unexpected("the plan file " + path + " cannot be read: No such file or directory");
    }
    return ACS::Testing::MakeSamplePlan("P", "T");
}

ACS::Core::Result<Scenario> Parse(const std::string& steps)
{
    return ParseScenario(R"({"name":"test","within":"7s","steps":[)" + steps + "]}", ReadSample);
}

template <typename TStep>
TStep ParseOne(const std::string& steps)
{
    const auto scenario = Parse(steps);
    INFO((scenario.has_value() ? std::string() : Describe(scenario.error())));
    REQUIRE(scenario.has_value());
    REQUIRE(std::holds_alternative<TStep>(scenario->steps.back().kind));
    return std::get<TStep>(scenario->steps.back().kind);
}

std::string FindError(const std::string& steps)
{
    const auto scenario = Parse(steps);
    REQUIRE_FALSE(scenario.has_value());
    return Describe(scenario.error());
}

const std::string SEND_PLAN = R"({"send":"ExecutionPlan","file":"plan.json","as":"A"})";

} // namespace

TEST_CASE("A plan is sent from a file or from the scenario itself, by default with fresh ids")
{
    const auto fromFile = ParseOne<SendPlanStep>(SEND_PLAN);
    CHECK(fromFile.name == "A");
    CHECK(fromFile.bFreshIDs);
    CHECK(fromFile.times == 1);
    CHECK(fromFile.plan.plan.planID == "P");
    const auto inlined = ParseOne<SendPlanStep>(
        R"({"send":"ExecutionPlan","freshIds":false,"payload":{"planId":"Q","lotId":"L","steps":[
            {"stepNo":1,"action":"Start","position":"A01.SET01","carrierIds":[],"jobs":[]}]}})");
    CHECK(inlined.name == "plan");
    CHECK_FALSE(inlined.bFreshIDs);
    CHECK(inlined.plan.plan.planID == "Q");
    CHECK(ParseOne<SendPlanStep>(R"({"send":"ExecutionPlan","file":"plan.json","times":101})").times == 101);
}

TEST_CASE("Every other command of an MCS is sent with its payload, or an empty one")
{
    const auto history =
        ParseOne<SendRequestStep>(SEND_PLAN + R"(,{"send":"RequestAcsPlanHistory","payload":{"planIds":["{A}","x"]}})");
    CHECK(history.command == EAcsCommand::RequestAcsPlanHistory);
    CHECK(history.payload.GetText() == R"({"planIds":["{A}","x"]})");
    CHECK(ParseOne<SendRequestStep>(R"({"send":"SyncConfig"})").payload.GetText() == "{}");
}

TEST_CASE("Plans are cancelled, aborted, paused and resumed by the name that the scenario gave them")
{
    const auto cancel = ParseOne<SendRequestStep>(SEND_PLAN + R"(,{"cancel":"A","reason":"late"})");
    CHECK(cancel.command == EAcsCommand::CancelPlan);
    CHECK(cancel.payload.GetText() == R"({"planId":"{A}","reason":"late"})");
    CHECK(ParseOne<SendRequestStep>(SEND_PLAN + R"(,{"abort":"A"})").command == EAcsCommand::AbortPlan);
    CHECK(ParseOne<SendRequestStep>(SEND_PLAN + R"(,{"pause":"A"})").command == EAcsCommand::PausePlan);
    CHECK(ParseOne<SendRequestStep>(SEND_PLAN + R"(,{"resume":"A"})").payload.GetText() == R"({"planId":"{A}"})");
    CHECK(ParseOne<SendAgainStep>(SEND_PLAN + R"(,{"sendAgain":"A","freshTransaction":true})").bFreshTransaction);
}

TEST_CASE("An expectation takes its members from the message, and the time limit of the scenario by default")
{
    const auto expect =
        ParseOne<ExpectStep>(R"({"expect":"CancelPlanAck","result":"Fail","payload":{"planId":"x"},"message":"*no*"})");
    CHECK(expect.pattern.command == "CancelPlanAck");
    CHECK(expect.pattern.members.GetText() == R"({"result":"Fail","message":"*no*","payload":{"planId":"x"}})");
    CHECK(expect.within == 7s);
    CHECK(ParseOne<ExpectStep>(R"({"expect":"*","within":"200ms"})").within == 200ms);
    CHECK(ParseOne<ExpectStep>(R"({"expect":"*ResultReport"})").pattern.command == "*ResultReport");
    CHECK(ParseOne<ExpectNothingStep>(R"({"expectNothing":"StepReport","for":"2s"})").duration == 2s);
    const auto wait = ParseOne<WaitForPlanStep>(SEND_PLAN + R"(,{"waitFor":"A","status":"Cancelled"})");
    CHECK(wait.status == ACS::Protocol::EPlanStatus::Cancelled);
    CHECK(wait.within == 7s);
}

TEST_CASE("Faults are read with their command and duration")
{
    CHECK(
        ParseOne<HoldAcksStep>(R"({"withholdAcks":"PlanReport","for":"6s"})").hold
        == AckHold{EAcsCommand::PlanReport, std::nullopt, 6s});
    CHECK(ParseOne<HoldAcksStep>(R"({"delayAcks":"*","by":"1s","for":"6s"})").hold == AckHold{std::nullopt, 1s, 6s});
    CHECK(ParseOne<RefuseRegistrationStep>(R"({"refuseRegistration":2,"message":"no"})").times == 2);
    CHECK(ParseOne<DropStep>(R"({"drop":"cut"})").how == EDrop::Cut);
    CHECK(ParseOne<DropStep>(R"({"drop":"close","code":1008})").code == 1008);
    CHECK(ParseOne<WaitStep>(R"({"wait":"2s"})").duration == 2s);
    CHECK(ParseOne<AskStep>(R"({"ask":"open the door"})").text == "open the door");
    CHECK(ParseOne<SendTextStep>(R"({"sendText":"{"})").text == "{");
    CHECK(ParseOne<SendTextStep>(R"({"sendText":{"command":"Dance"}})").text == R"({"command":"Dance"})");
}

TEST_CASE("A step is described by its note, or by what it does")
{
    const auto scenario = Parse(
        SEND_PLAN
        + R"(,{"expect":"PlanReport","payload":{"planId":"{A}","status":"Failed"}},{"wait":"2s","note":"look"})");
    REQUIRE(scenario.has_value());
    CHECK(scenario->steps[0].title == "send ExecutionPlan A");
    CHECK(scenario->steps[1].title == "expect PlanReport planId={A}, status=Failed");
    CHECK(scenario->steps[2].title == "look");
}

TEST_CASE("An error in a scenario is reported with its position, the expected and the found value")
{
    using Row = std::pair<std::string, std::string>;
    const auto row = GENERATE(
        Row{R"({"expext":"PlanReport"})", "steps[0]: expected a step with one of the members send, "},
        Row{R"(3)", "steps[0]: expected an object, found 3"},
        Row{R"({"send":"PlanReport"})", R"(steps[0].send: expected one of ExecutionPlan, CancelPlan, )"},
        Row{R"({"send":"ExecutionPlan","file":"other.json"})",
            "steps[0].file: expected a plan file, found the plan file"},
        Row{R"({"send":"ExecutionPlan"})", "steps[0].file: expected a text, found nothing"},
        Row{R"({"send":"ExecutionPlan","payload":{"planId":"Q"}})", "steps[0].payload.steps: "},
        Row{R"({"send":"ExecutionPlan","file":"plan.json","freshIds":false,"times":2})", "steps[0].times: expected 1 "},
        Row{R"({"send":"ExecutionPlan","file":"plan.json","times":0})",
            "steps[0].times: expected a whole number from 1"},
        Row{R"({"send":"CancelPlan","payload":{"planId":3}})", "steps[0].payload.planId: "},
        Row{R"({"cancel":"A"})",
            R"(steps[0].cancel: expected the name that a send step before gave to a plan ("as"), )"},
        Row{R"({"expect":"ExecutionPlan"})", R"(steps[0].expect: expected the Ack of )"},
        Row{R"({"expect":"*Rapport"})", R"(steps[0].expect: expected the Ack of )"},
        Row{R"({"expect":"PlanReport","status":"Failed"})", "steps[0]: expected one of the members expect, "},
        Row{R"({"expect":"PlanReport","within":5})", "steps[0].within: expected a duration such as '200ms', "},
        Row{R"({"expectNothing":"PlanReport"})", "steps[0].for: expected a duration"},
        Row{R"({"withholdAcks":"RobotPositionUpdate","for":"1s"})",
            R"(steps[0].withholdAcks: expected "*" or one of )"},
        Row{R"({"delayAcks":"*","for":"1s"})", "steps[0].by: expected a duration"},
        Row{R"({"drop":"softly"})", R"(steps[0].drop: expected cut or close, found "softly")"},
        Row{R"({"drop":"close","code":99})", "steps[0].code: expected a whole number from 1000 to 4999, found 99"},
        Row{R"({"drop":"close","code":1005})", "steps[0].code: expected a code that may be sent, found 1005"},
        Row{R"({"drop":"close","code":1015})", "steps[0].code: expected a code that may be sent, found 1015"},
        Row{R"({"wait":"2s","wait":"3s"})", "expected each member once"},
        Row{R"({"wait":"2s","note":""})", R"(steps[0].note: expected a text, found "")"});
    const std::string mistake = FindError(row.first);
    CAPTURE(row.first, mistake);
    CHECK(mistake.find(row.second) == 0);
}

TEST_CASE("An unknown placeholder is an error of the file, other braces are text")
{
    using Row = std::pair<std::string, std::string>;
    const auto row = GENERATE(
        Row{R"({"expect":"PlanReport","payload":{"planId":"{a}"}})",
            R"(steps[1].payload.planId: expected a placeholder of )"},
        Row{R"({"expect":"JobReport","payload":{"jobId":"{A.9.9}"}})", "steps[1].payload.jobId: "},
        Row{R"({"expect":"JobReport","payload":{"jobId":"{A.1.0}"}})", "steps[1].payload.jobId: "},
        Row{R"({"expect":"JobReport","payload":{"jobId":"{A.job}"}})", "steps[1].payload.jobId: "},
        Row{R"({"expect":"RobotStatusUpdate","payload":{"carrierIds":["{A.1.carrier.9}"]}})",
            "steps[1].payload.carrierIds[0]: "},
        Row{R"({"expectNothing":"PlanReport","transactionId":"*{A.transaction}","for":"1s"})",
            "steps[1].transactionId: "},
        Row{R"({"send":"CancelPlan","payload":{"planId":"{B}"}})", "steps[1].payload.planId: "},
        Row{R"({"sendText":"{\"planId\":\"{B}\"}"})", R"(steps[1].sendText: )"},
        Row{R"({"cancel":"A","reason":"{reason}"})", "steps[1].reason: "},
        Row{R"({"expect":"StepReport","as":"S","transactionId":"{S.transactionId}"})", "steps[1].transactionId: "},
        Row{R"({"expect":"StepReport","as":"S"},{"expect":"StepReport","timestamp":"{S.payload}"})",
            "steps[2].timestamp: "},
        Row{R"({"expect":"StepReport","as":"S"},{"cancel":"S"})", "steps[2].cancel: expected the name that a send "},
        Row{R"({"expectNext":[{"command":"PlanReport","payload":{"planId":"{B}"}}]})",
            "steps[1].expectNext[0].payload.planId: "},
        Row{R"({"expectNext":[{"command":"PlanReport","for":"1s"}]})", "steps[1].expectNext[0]: expected one of "},
        Row{R"({"expectNext":[]})", "steps[1].expectNext: expected a text, found an array"},
        Row{R"({"expectNext":"PlanReport","besides":"ExecutionPlan"})", "steps[1].besides: "},
        Row{R"({"expectNext":"PlanReport","as":"S"})", "steps[1]: expected one of the members expectNext, "},
        Row{R"({"send":"ExecutionPlan","file":"plan.json","as":"the plan"})",
            "steps[1].as: expected a name of letters, "});
    const std::string mistake = FindError(SEND_PLAN + "," + row.first);
    CAPTURE(row.first, mistake);
    CHECK(mistake.find(row.second) == 0);
    CHECK(Parse(
        SEND_PLAN
        + R"(,{"expect":"PlanReport","message":"{} { A } {\"A\"} {A}{A.transactionId}{A.2.1}{A.1.carrier.1}"})"));
}

TEST_CASE("The head of a scenario is checked as its steps are")
{
    CHECK(
        Describe(ParseScenario(R"({"steps":[{"wait":"1s"}]})", ReadSample).error())
        == "name: expected a text, found nothing");
    const std::pair<std::string, std::string> row = GENERATE(
        std::pair<std::string, std::string>{R"({"name":"x","steps":[]})", "an empty array"},
        std::pair<std::string, std::string>{R"({"name":"x","steps":{}})", "an object"},
        std::pair<std::string, std::string>{R"({"name":"x","steps":3})", "3"},
        std::pair<std::string, std::string>{R"({"name":"x"})", "nothing"});
    CHECK(
        Describe(ParseScenario(row.first, ReadSample).error())
        == "steps: expected an array of one step or more, found " + row.second);
    CHECK(Describe(ParseScenario("[]", ReadSample).error()).find("expected an object") == 0);
    CHECK(
        Describe(ParseScenario(R"({"name":"x","stepps":[],"steps":[{"wait":"1s"}]})", ReadSample).error())
            .find("stepps")
        != std::string::npos);
}

TEST_CASE("An invalid scenario file is reported with name and line; plan files are relative to it")
{
    const ACS::Testing::TemporaryFolder folder;
    const std::string path = (folder.GetPath() / "scenario.json").string();
    CHECK(ReadScenarioFile(path).error() == "the scenario file " + path + " cannot be read: No such file or directory");
    std::ofstream(path) << "{\n\"name\": \"x\",\n\"steps\": [\n{\"wait\" \"1s\"}]}";
    CHECK(ReadScenarioFile(path).error().starts_with(
        "the scenario file " + path + ": expected JSON, found line 4, column "));
    std::ofstream(path) << R"({"name":"x","steps":[{"send":"ExecutionPlan","file":"plans/p.json"}]})";
    CHECK(ReadScenarioFile(path).error().find((folder.GetPath() / "plans/p.json").string()) != std::string::npos);
    std::filesystem::create_directory(folder.GetPath() / "plans");
    std::ofstream(folder.GetPath() / "plans/p.json")
        << R"({"planId":"Q","steps":[{"stepNo":1,"action":"Start","position":"A01.SET01","carrierIds":[],"jobs":[]}]})";
    CHECK(ReadScenarioFile(path).has_value());
}
