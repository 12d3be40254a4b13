#include "AcsSessionFixture.hpp"
#include "ActionRecorder.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/McsSession.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

// Invalid texts of a peer. Each is answered with Fail and a reason or, if it cannot be answered, counted as a note.
// Nothing is delivered, and the session continues.

using namespace ACS; // NOLINT(google-build-using-namespace)
using Protocol::EAckResult;
using Protocol::EProtocolNote;
using Testing::MakeRequestText;

namespace
{

/// A text, and what its rejection must contain; empty: the text cannot be answered, only counted.
struct BadInput
{
    std::string name;
    std::string text;
    std::string reason;
    EProtocolNote note = EProtocolNote::Undecodable;
};

std::string MakePlanText(const std::string& members)
{
    return MakeRequestText("ExecutionPlan", R"({"planId":"P",)" + members + "}");
}

std::string MakeStepText(const std::string& members)
{
    return MakePlanText(R"("steps":[{"stepNo":1,"action":"TrayLoad",)" + members + "}]");
}

/// Texts for both sides; `command` is one that the side knows, with `payload`.
std::vector<BadInput> ListCommon(const std::string& command, const std::string& payload)
{
    const std::string head = R"({"command":")" + command + R"(","transactionId":"t-1",)";
    const std::string deep(5U * 1024U * 1024U, '[');
    return {
        {"nothing", "", ""},
        {"not JSON", "hello", ""},
        {"half a message", head, ""},
        {"two messages in one", MakeRequestText(command, payload) + MakeRequestText(command, payload), ""},
        {"an array", "[" + MakeRequestText(command, payload) + "]", ""},
        {"a string", R"("x")", ""},
        {"a number", "7", ""},
        {"null", "null", ""},
        {"no command", R"({"transactionId":"t-1","payload":)" + payload + "}", ""},
        {"command null", R"({"command":null,"transactionId":"t-1","payload":{}})", ""},
        {"command a number", R"({"command":7,"transactionId":"t-1","payload":{}})", ""},
        {"command empty", R"({"command":"","transactionId":"t-1","payload":{}})", ""},
        {"command too long", MakeRequestText(std::string(513, 'x'), "{}"), "", EProtocolNote::Undecodable},
        {"unknown command", MakeRequestText("Dance", "{}"), "unsupported command", EProtocolNote::UnknownCommand},
        {"unknown Ack", MakeRequestText("DanceAck", "{}"), ""},
        {"missing payload", head + R"("timestamp":"2025-07-02T21:00:00.123+09:00"})", "payload: expected an object"},
        {"null payload", MakeRequestText(command, "null"), "payload: expected an object"},
        {"payload a list", MakeRequestText(command, "[]"), "payload: expected an object"},
        {"no transactionId",
         R"({"command":")" + command + R"(","payload":)" + payload + "}",
         "transactionId: expected an identifier"},
        {"empty transactionId", MakeRequestText(command, payload, ""), "transactionId: expected an identifier"},
        {"a transactionId without end",
         MakeRequestText(command, payload, std::string(513, 't')),
         "transactionId: expected an identifier"},
        {"a line break in the transactionId",
         MakeRequestText(command, payload, R"(t\n1)"),
         "transactionId: expected an identifier"},
        {"5 MB of [", deep, ""},
        {"3 MB of [", deep.substr(0, 3U * 1024U * 1024U), ""},
        {"deep inside a payload",
         head + R"("payload":{"x":)" + deep.substr(0, 1000) + std::string(1000, ']') + "}}",
         ""},
        {"invalid UTF-8", MakeRequestText(command, "{\"x\":\"\xC3\x28\"}"), ""},
        {"the first half of a surrogate pair", MakeRequestText(command, R"({"x":"\uD800"})"), ""},
        {"the second half of one", MakeRequestText(command, R"({"x":"\uDDDD"})"), ""},
        {"a NUL", MakeRequestText(command, payload) + std::string(1, '\0') + "x", ""},
        {"a number beyond double", MakeRequestText(command, R"({"x":1e999})"), ""},
        {"a name twice in the envelope",
         head + R"("transactionId":"t-2","payload":)" + payload + "}",
         "transactionId: expected each member once"},
        {"a name twice in the payload",
         MakeRequestText(command, R"({"x":1,"x":1})"),
         "payload.x: expected each member once"},
        {"a long name twice",
         MakeRequestText(command, R"({")" + std::string(5000, 'x') + R"(":1,")" + std::string(5000, 'x') + R"(":1})"),
         "payload." + std::string(64, 'x') + "...: expected each member once"},
    };
}

/// Errors of an MCS.
std::vector<BadInput> ListForACS()
{
    const std::string control = R"("position":"A01.CP01","jobs":[{"jobId":"J",)";
    return {
        {"a report", MakeRequestText("StepReport", "{}"), "unsupported command", EProtocolNote::UnknownCommand},
        {"planId missing", MakeRequestText("CancelPlan", "{}"), "payload.planId: expected a value"},
        {"planId null", MakeRequestText("CancelPlan", R"({"planId":null})"), "payload.planId: expected a string"},
        {"planId a number", MakeRequestText("CancelPlan", R"({"planId":7})"), "payload.planId: expected a string"},
        {"planId empty", MakeRequestText("CancelPlan", R"({"planId":""})"), "payload.planId: expected a string of 1"},
        {"a planId in a list empty",
         MakeRequestText("RequestAcsPlanHistory", R"({"planIds":["P",""]})"),
         "payload.planIds[1]: expected a string of 1"},
        {"a planId in a list null",
         MakeRequestText("RequestAcsPlanHistory", R"({"planIds":[null]})"),
         "payload.planIds[0]: expected a string"},
        {"a tab in a planId of a list",
         MakeRequestText("RequestAcsPlanHistory", R"({"planIds":["P","P\t1"]})"),
         R"(payload.planIds[1]: expected an identifier without control characters, found \"P?1\")"},
        {"a line break in the planId of a control",
         MakeRequestText("CancelPlan", R"({"planId":"P\n1"})"),
         R"(payload.planId: expected an identifier without control characters, found \"P?1\")"},
        {"a NUL in the planId",
         MakeRequestText("ExecutionPlan", R"({"planId":"P\u0000","steps":[]})"),
         "payload.planId: expected an identifier without control characters"},
        {"an escape in the lotId",
         MakePlanText(R"("lotId":"\u001b[2J","steps":[])"),
         "payload.lotId: expected an identifier without control characters"},
        {"U+007F in a carrierId",
         MakeStepText(R"("position":"A01.CP01","carrierIds":["C","\u007f"])"),
         "payload.steps[0].carrierIds[1]: expected an identifier without control characters"},
        {"U+001F in a jobId",
         MakeStepText(R"("position":"A01.CP01","jobs":[{"jobId":"J\u001f"}])"),
         "payload.steps[0].jobs[0].jobId: expected an identifier without control characters"},
        {"planIds a string",
         MakeRequestText("RequestAcsPlanHistory", R"({"planIds":"P"})"),
         "payload.planIds: expected"},
        {"no steps", MakePlanText(R"("steps":[])"), "payload.steps: expected an array of 1"},
        {"steps an object", MakePlanText(R"("steps":{})"), "payload.steps: expected an array"},
        {"a step null", MakePlanText(R"("steps":[null])"), "payload.steps[0]: expected an object"},
        {"too many steps",
         MakePlanText(
             R"("steps":[0)" +
             [] {
                 std::string list;
                 for (int count = 0; count < 10'000; ++count)
                 {
                     list += ",0";
                 }
                 return list;
             }()
             + "]"),
         "payload.steps: expected an array of 1 to 10000"},
        {"priority a word", MakePlanText(R"("priority":"high","steps":[])"), "payload.priority: expected an integer"},
        {"stepNo a word",
         MakePlanText(R"("steps":[{"stepNo":"one"}])"),
         "payload.steps[0].stepNo: expected an integer from 1"},
        {"stepNo 0", MakePlanText(R"("steps":[{"stepNo":0}])"), "payload.steps[0].stepNo: expected an integer from 1"},
        {"stepNo beyond int64",
         MakePlanText(R"("steps":[{"stepNo":9223372036854775808}])"),
         "payload.steps[0].stepNo: expected an integer from 1"},
        {"stepNo beyond uint64",
         MakePlanText(R"("steps":[{"stepNo":99999999999999999999}])"),
         "payload.steps[0].stepNo: expected an integer from 1"},
        {"priority below int64",
         MakePlanText(R"("priority":-9223372036854775809,"steps":[])"),
         "payload.priority: expected an integer"},
        {"priority beyond int64 in a string",
         MakePlanText(R"("priority":"9223372036854775808","steps":[])"),
         "payload.priority: expected an integer"},
        {"carrierIds a string",
         MakeStepText(R"("position":"A01.CP01","carrierIds":"C")"),
         "payload.steps[0].carrierIds: expected an array"},
        {"jobId empty",
         MakeStepText(R"("position":"A01.CP01","jobs":[{"jobId":""}])"),
         "payload.steps[0].jobs[0].jobId: expected a string of 1"},
        {"position empty", MakeStepText(R"("position":"")"), "payload.steps[0].position: expected a string of 1"},
        {"position no location",
         MakeStepText(R"("position":"Room 7")"),
         "payload.steps[0].position: expected a location"},
        {"from no location",
         MakeStepText(control + R"("from":"A01.XX01","to":"AMR.TP01"}])"),
         "payload.steps[0].jobs[0].from: expected a location"},
        {"to no location",
         MakeStepText(control + R"("from":"A01.CP01.TP01","to":"AMR"}])"),
         "payload.steps[0].jobs[0].to: expected a location"},
        {"from a number", MakeStepText(control + R"("from":7}])"), "payload.steps[0].jobs[0].from: expected a string"},
        {"SyncConfig with a name twice",
         MakeRequestText("SyncConfig", R"({"a":{"b":[{"x":1,"x":2}]}})"),
         "payload: expected each member once"},
    };
}

/// Errors of an ACS.
std::vector<BadInput> ListForMCS()
{
    const auto status = [](const std::string& type, const std::string& word) {
        return MakeRequestText(
            "RobotStatusUpdate",
            R"({"robotId":"LR01","robotType":")" + type + R"(","robotStatus":")" + word + R"("})");
    };
    return {
        {"a request", MakeRequestText("RequestAcsPlans", "{}"), "unsupported command", EProtocolNote::UnknownCommand},
        {"an unknown plan status",
         MakeRequestText("PlanReport", R"({"planId":"P","status":"Canceled"})"),
         "payload.status: expected one of Pending"},
        {"an unknown step status",
         MakeRequestText("StepReport", R"({"planId":"P","robotId":"R","stepNo":1,"status":"Instructed"})"),
         "payload.status: expected one of Pending"},
        {"a deleted job status",
         MakeRequestText("JobReport", R"({"planId":"P","robotId":"R","stepNo":1,"jobId":"J","status":"Retrying"})"),
         "payload.status: expected one of Pending"},
        {"an unknown robot type", status("AMR", "Idle"), "payload.robotType: expected one of LR, CR"},
        {"an unknown robot status", status("LR", "Alarm"), "payload.robotStatus: expected one of Init"},
        {"an unknown TSC state",
         MakeRequestText("TscStateUpdate", R"({"state":"Stopped"})"),
         "payload.state: expected one of Auto"},
        {"isConnected a word",
         MakeRequestText("AcsCommStateUpdate", R"({"isConnected":"yes"})"),
         "payload.isConnected: expected true or false"},
        {"an unknown error level",
         MakeRequestText("ErrorReport", R"({"robotId":"R","state":true,"errorCode":"E","level":"medium"})"),
         "payload.level: expected one of heavy, light"},
        {"robotId empty",
         MakeRequestText("RobotStatusUpdate", R"({"robotId":"","robotType":"LR","robotStatus":"Idle"})"),
         "payload.robotId: expected a string of 1"},
        {"a line break in a robotId",
         MakeRequestText("StepReport", R"({"planId":"P","robotId":"R\n","stepNo":1,"status":"Failed"})"),
         "payload.robotId: expected an identifier without control characters"},
        {"a line break in a carrierId",
         MakeRequestText(
             "RobotStatusUpdate",
             R"({"robotId":"R","robotType":"LR","robotStatus":"Idle","carrierIds":["C\n"]})"),
         "payload.carrierIds[0]: expected an identifier without control characters"},
        {"invalid positions", MakeRequestText("RobotPositionUpdate", R"({"robots":[{"robotId":"R","x":"here"}]})"), ""},
    };
}

/// Feeds one bad text to either session.
template <typename TFeed>
void CheckInput(const BadInput& bad, TFeed feed, const Protocol::SessionStatistics& statistics)
{
    INFO(bad.name);
    const std::uint64_t before = statistics.CountOf(bad.note);
    Testing::ActionRecorder& recorder = feed(bad.text);
    CHECK(recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(recorder.GetEvents<Protocol::Acked>().empty());
    CHECK(recorder.GetAll<Protocol::Close>().empty());
    CHECK(statistics.CountOf(bad.note) == before + 1);
    const auto sent = recorder.GetAll<Protocol::SendText>();
    if (bad.reason.empty())
    {
        CHECK(sent.empty());
        return;
    }
    REQUIRE(sent.size() == 1);
    INFO(sent[0].text);
    CHECK(sent[0].text.size() < 1500);
    CHECK(sent[0].text.find(R"("result":"Fail","message":")" + bad.reason) != std::string::npos);
    const bool bNamed = bad.reason.find("transactionId: expected an") == std::string::npos;
    CHECK((sent[0].text.find(R"(Ack","transactionId":"t-1",)") != std::string::npos) == bNamed);
}

void Append(std::vector<BadInput>& inputs, std::vector<BadInput> more)
{
    std::move(more.begin(), more.end(), std::back_inserter(inputs));
}

} // namespace

TEST_CASE("R1, R3 Whatever an MCS sends, the ACS rejects or counts it, executes nothing and continues")
{
    Testing::AcsSessionFixture bench;
    bench.StartAndReplay();
    std::vector<BadInput> inputs = ListCommon("CancelPlan", R"({"planId":"P"})");
    Append(inputs, ListForACS());
    const auto feed = [&bench](const std::string& text) -> Testing::ActionRecorder& {
        bench.Text(text);
        return bench.recorder;
    };
    int good = 0;
    for (const BadInput& bad : inputs)
    {
        CheckInput(bad, feed, bench.session.GetStatistics());
        bench.Text(MakeRequestText("CancelPlan", R"({"planId":"P"})", "good-" + std::to_string(++good)));
        REQUIRE(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    }
}

TEST_CASE("R1, R3 Whatever an ACS sends, the MCS rejects or counts it, delivers nothing and continues")
{
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    Protocol::McsSession session({}, random);
    Testing::ActionRecorder recorder;
    const auto feed = [&](const std::string& text) -> Testing::ActionRecorder& {
        recorder.Clear();
        session.OnText(1, text, clock.GetNow(), recorder.out);
        return recorder;
    };
    session.OnConnected(1, clock.GetNow(), recorder.out);
    feed(MakeRequestText("Registration", "{}", "r"));
    REQUIRE(session.IsRegistered());
    const std::string report = R"({"planId":"P","status":"Failed","message":""})";
    std::vector<BadInput> inputs = ListCommon("PlanReport", report);
    Append(inputs, ListForMCS());
    int good = 0;
    for (const BadInput& bad : inputs)
    {
        CheckInput(bad, feed, session.GetStatistics());
        feed(MakeRequestText("PlanReport", report, "good-" + std::to_string(++good)));
        REQUIRE(recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    }
}

TEST_CASE("R3 An undecodable request is reported to the ACS with its decoded ids, the member and the reason")
{
    Testing::AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.Text(MakePlanText(R"("steps":[{"stepNo":0}])"));
    const auto refused = bench.recorder.GetEvents<Protocol::RequestRefused>();
    REQUIRE(refused.size() == 1);
    CHECK(refused[0].commandName == "ExecutionPlan");
    CHECK(refused[0].transactionID == "t-1");
    CHECK(refused[0].planID == "P");
    CHECK(refused[0].path == "payload.steps[0].stepNo");
    CHECK(refused[0].reason == "payload.steps[0].stepNo: expected an integer from 1 to 2147483647, found 0");
    bench.Text(MakeRequestText("Dance", R"({"planId":"P"})"));
    REQUIRE(bench.recorder.GetEvents<Protocol::RequestRefused>().size() == 1);
    CHECK(bench.recorder.GetEvents<Protocol::RequestRefused>()[0].reason == "unsupported command");
    for (const std::string& text : {std::string("hello"), MakeRequestText("PlanReportAck", "7")})
    {
        bench.Text(text); // not answered
        CHECK(bench.recorder.GetEvents<Protocol::RequestRefused>().empty());
    }
}

TEST_CASE("R1, 4.1 The rejection of a planId with a control character repeats it, and the MCS can decode that")
{
    Testing::AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.Text(MakeRequestText("CancelPlan", R"({"planId":"P\n1"})"));
    const auto sent = bench.recorder.GetAll<Protocol::SendText>();
    REQUIRE(sent.size() == 1);
    const Protocol::DecodeOutcome read = Protocol::AcsCodec().Decode(sent[0].text);
    REQUIRE(read.message.has_value());
    const auto& ack = std::get<Protocol::AcsAck>(*read.message);
    CHECK(ack.result == Protocol::EAckResult::Fail);
    CHECK(std::get<Protocol::PlanAck>(ack.payload).planID == "P\n1");
}

TEST_CASE("1 Either side counts and drops a frame of 100 MB without parsing it")
{
    std::string frame(100U * 1024U * 1024U, ' ');
    frame.replace(0, 2, "{}");
    Testing::AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.recorder.Clear();
    bench.session.OnText(frame, bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::Undecodable});
    CHECK(bench.recorder.out.size() == 1);
    CHECK(bench.session.IsRegistered());

    Protocol::McsSession session({}, bench.random);
    session.OnConnected(1, bench.clock.GetNow(), bench.recorder.out);
    bench.recorder.Clear();
    session.OnText(1, frame, bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::Undecodable});
    CHECK(bench.recorder.out.size() == 1);
}

TEST_CASE("4.1 from and to of actions on a set are not checked")
{
    Testing::AcsSessionFixture bench;
    bench.StartAndReplay();
    for (const std::string action : {"CloseSetCover", "OpenSetCover", "Start", "start"})
    {
        INFO(action);
        bench.Text(MakeRequestText(
            "ExecutionPlan",
            R"({"planId":"P","steps":[{"stepNo":1,"action":")" + action
                + R"(","position":"A01.SET01","jobs":[{"jobId":"J","from":"-","to":"?"}]}]})",
            action));
        CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    }
}

TEST_CASE("10 By option a location that cannot be parsed is accepted")
{
    Protocol::SessionOptions options = Testing::MakeOptions();
    options.codec.bLocationsChecked = false;
    Testing::AcsSessionFixture bench(options);
    bench.StartAndReplay();
    bench.Text(MakeStepText(R"("position":"Room 7")"));
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
}
