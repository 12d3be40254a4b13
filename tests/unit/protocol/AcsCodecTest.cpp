#include "Catch.hpp"
#include "Fixture.hpp"
#include <acs/json/JsonDocument.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Protocol::AcsAck;
using Protocol::AcsCodec;
using Protocol::AcsMessage;
using Protocol::AcsRequest;
using Protocol::DecodeFailure;
using Protocol::DecodeOutcome;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Testing::MakeAckText;
using Testing::MakeRequestText;
using Testing::ReadFixture;

namespace
{

/// The two whose spelling is not the one that is sent.
const std::vector<std::string>& GetOddFixtures()
{
    static const std::vector<std::string> NAMES{"JobReport", "RequestAcsPlansAck"};
    return NAMES;
}

const std::vector<std::string>& GetExactFixtures()
{
    static const std::vector<std::string> NAMES{
        "AbortPlan",
        "AbortPlanAck",
        "AbortResultReport",
        "AbortResultReportAck",
        "AcsCommStateUpdate",
        "AcsCommStateUpdateAck",
        "CancelPlan",
        "CancelPlanAck",
        "CancelResultReport",
        "CancelResultReportAck",
        "ErrorReport",
        "ErrorReportAck",
        "ExecutionPlanAck",
        "ExecutionPlanCR",
        "ExecutionPlanLR",
        "JobReportAck",
        "PausePlan",
        "PausePlanAck",
        "PauseResultReport",
        "PauseResultReportAck",
        "PlanReport",
        "PlanReportAck",
        "Registration",
        "RegistrationAck",
        "RequestAcsErrorList",
        "RequestAcsErrorListAck",
        "RequestAcsPlanHistory",
        "RequestAcsPlanHistoryAck",
        "RequestAcsPlans",
        "ResumePlan",
        "ResumePlanAck",
        "ResumeResultReport",
        "ResumeResultReportAck",
        "RobotPositionUpdate",
        "RobotStatusUpdateAck",
        "RobotStatusUpdateCR",
        "RobotStatusUpdateEmptyPort",
        "RobotStatusUpdateLR",
        "StepReport",
        "StepReportAck",
        "SyncConfigAck",
        "TscStateUpdate",
        "TscStateUpdateAck",
    };
    return NAMES;
}

bool IsSameJSON(const std::string& left, const std::string& right)
{
    Json::JsonDocument leftDocument;
    Json::JsonDocument rightDocument;
    const auto leftRoot = leftDocument.Parse(left, {});
    const auto rightRoot = rightDocument.Parse(right, {});
    REQUIRE(leftRoot.has_value());
    REQUIRE(rightRoot.has_value());
    return **leftRoot == **rightRoot;
}

AcsMessage DecodeOrFail(AcsCodec& codec, const std::string& text)
{
    DecodeOutcome outcome = codec.Decode(text);
    INFO(text);
    if (!outcome.message.has_value())
    {
        FAIL(Core::Describe(outcome.message.error().error));
    }
    return *outcome.message;
}

DecodeFailure FailOrDecode(AcsCodec& codec, const std::string& text)
{
    DecodeOutcome outcome = codec.Decode(text);
    INFO(text);
    REQUIRE_FALSE(outcome.message.has_value());
    return outcome.message.error();
}

const Protocol::ExecutionPlan& GetPlan(const AcsMessage& message)
{
    return std::get<Protocol::ExecutionPlan>(std::get<AcsRequest>(message).payload);
}

} // namespace

TEST_CASE("6.2-6.21 Every example decodes, and encodes to the same JSON")
{
    AcsCodec codec;
    for (const std::string& name : GetExactFixtures())
    {
        INFO(name);
        const std::string text = ReadFixture(name);
        const AcsMessage message = DecodeOrFail(codec, text);
        std::string encoded;
        AcsCodec::Encode(message, encoded);
        INFO(encoded);
        CHECK(IsSameJSON(encoded, text));
        CHECK(DecodeOrFail(codec, encoded) == message);
        CHECK(encoded.find('\n') == std::string::npos);
    }
}

TEST_CASE("6.10, 6.14, D-2, D-3 The document's deviating spellings are accepted, counted, and not sent")
{
    AcsCodec codec;
    for (const std::string& name : GetOddFixtures())
    {
        INFO(name);
        const std::string text = ReadFixture(name);
        CHECK(codec.Decode(text).notes.lenientWords == 1);
        const AcsMessage message = DecodeOrFail(codec, text);
        std::string encoded;
        AcsCodec::Encode(message, encoded);
        CHECK(DecodeOrFail(codec, encoded) == message);
        CHECK(codec.Decode(encoded).notes == Protocol::DecodeNotes{});
        CHECK_FALSE(IsSameJSON(encoded, text));
    }
}

TEST_CASE("6.4 The control robot's example has the values of the document")
{
    AcsCodec codec;
    const AcsMessage message = DecodeOrFail(codec, ReadFixture("ExecutionPlanCR"));
    const Protocol::ExecutionPlan& plan = GetPlan(message);
    CHECK(plan.planID == "PLAN-20250702-001");
    CHECK(plan.priority == 10);
    REQUIRE(plan.steps.size() == 3);
    CHECK(plan.steps[0].carrierIDs == std::vector<std::string>{"TRAY_01", "TRAY_02"});
    CHECK(plan.steps[1].action == "MemoryPickAndPlace");
    CHECK(plan.steps[2].jobs[1].from == "AMR.TP02");
    CHECK(std::get<AcsRequest>(message).timestamp.offset == std::chrono::hours(9));
}

TEST_CASE("R18 carrierIds of MemoryPickAndPlace is written, and empty")
{
    AcsCodec codec;
    AcsMessage message = DecodeOrFail(codec, ReadFixture("ExecutionPlanCR"));
    CHECK(GetPlan(message).steps[1].carrierIDs.empty());
    std::string encoded;
    AcsCodec::Encode(message, encoded);
    CHECK(encoded.find(R"("carrierIds":[],"jobs")") != std::string::npos);
}

TEST_CASE("R13 An empty port is null in carrierIds, in both directions")
{
    AcsCodec codec;
    const AcsMessage message = DecodeOrFail(codec, ReadFixture("RobotStatusUpdateEmptyPort"));
    const auto& status = std::get<Protocol::RobotStatusUpdate>(std::get<AcsRequest>(message).payload);
    REQUIRE(status.carrierIDs.size() == 3);
    CHECK_FALSE(status.carrierIDs[0].has_value());
    std::string encoded;
    AcsCodec::Encode(message, encoded);
    CHECK(encoded.find(R"("carrierIds":[null,"TRAY_02","TRAY_03"])") != std::string::npos);
}

TEST_CASE("R19 Timestamps are written as local time with offset, and read in any form")
{
    AcsCodec codec;
    for (const std::string time :
         {"2025-07-02T21:00:00.1234567+09:00", "2025-07-02T12:00:00.123Z", "2025-07-02T21:00:00.123+0900"})
    {
        const AcsMessage message = DecodeOrFail(
            codec,
            R"({"command":"RequestAcsPlans","transactionId":"t","timestamp":")" + time + R"(","payload":{}})");
        const auto since = std::get<AcsRequest>(message).timestamp.time.time_since_epoch();
        CHECK(since == std::chrono::milliseconds(1'751'457'600'123));
    }
    Protocol::CodecOptions options;
    options.siteOffset = std::chrono::hours(9);
    AcsCodec local(options);
    const AcsMessage message = DecodeOrFail(
        local,
        R"({"command":"RequestAcsPlans","transactionId":"t","timestamp":"2025-07-02T21:00:00.123","payload":{}})");
    std::string encoded;
    AcsCodec::Encode(message, encoded);
    CHECK(encoded.find(R"("timestamp":"2025-07-02T21:00:00.123+09:00")") != std::string::npos);
}

TEST_CASE("2 A missing or bad timestamp is accepted and counted")
{
    AcsCodec codec;
    const DecodeOutcome missing = codec.Decode(R"({"command":"RequestAcsPlans","transactionId":"t","payload":{}})");
    CHECK(missing.message.has_value());
    CHECK(missing.notes.badTimestamps == 1);
    const DecodeOutcome bad =
        codec.Decode(R"({"command":"RequestAcsPlans","transactionId":"t","timestamp":"yesterday","payload":{}})");
    CHECK(bad.message.has_value());
    CHECK(bad.notes.badTimestamps == 1);
}

TEST_CASE("13.1 A request with result and message null and escapes in the time is a request")
{
    AcsCodec codec;
    const std::string text =
        "{\"command\":\"CancelPlan\",\"transactionId\":\"t\",\"timestamp\":\"2025-07-02T21:00:00.1234567\\u002B09:00\","
        "\"result\":null,\"message\":null,\"payload\":{\"planId\":\"P\",\"reason\":null}}";
    const DecodeOutcome outcome = codec.Decode(text);
    REQUIRE(outcome.message.has_value());
    const AcsRequest* requestOrNull = std::get_if<AcsRequest>(&*outcome.message);
    REQUIRE(requestOrNull != nullptr);
    CHECK(requestOrNull->timestamp.offset == std::chrono::hours(9));
    CHECK(outcome.notes.nullOptionals == 3);
    CHECK(outcome.notes.badTimestamps == 0);
}

TEST_CASE("13.2 Actions on a set need no jobs, and their locations may be null or empty")
{
    AcsCodec codec;
    const AcsMessage message = DecodeOrFail(
        codec,
        MakeRequestText(
            "ExecutionPlan",
            R"({"planId":"P","lotId":null,"steps":[
                {"stepNo":1,"action":"OpenSetCover","position":"A01.SET01","carrierIds":null},
                {"stepNo":"2","action":"Start","position":"A01.SET01","jobs":[{"jobId":"J","from":null,"to":""}]}]})"));
    const Protocol::ExecutionPlan& plan = GetPlan(message);
    CHECK_FALSE(plan.priority.has_value());
    CHECK(plan.steps[0].jobs.empty());
    CHECK(plan.steps[1].stepNo == 2);
    std::string encoded;
    AcsCodec::Encode(message, encoded);
    CHECK(encoded.find(R"("jobs":[{"jobId":"J"}])") != std::string::npos);
    CHECK(encoded.find("priority") == std::string::npos);
}

TEST_CASE("R17 Locations keep the sender's spelling on the wire")
{
    AcsCodec codec;
    const AcsMessage message = DecodeOrFail(
        codec,
        MakeRequestText(
            "ExecutionPlan",
            R"({"planId":"P","steps":[{"stepNo":1,"action":"TrayLoad","position":"a01.cp1","jobs":[]}]})"));
    CHECK(GetPlan(message).steps[0].position == "a01.cp1");
}

TEST_CASE("D-1 Success is success or ok in any case; everything else is a failure")
{
    AcsCodec codec;
    for (const std::string result : {"Success", "success", "SUCCESS", "ok", "OK"})
    {
        CHECK(
            std::get<AcsAck>(DecodeOrFail(codec, MakeAckText("PlanReport", "t", result))).result
            == EAckResult::Success);
    }
    for (const std::string result : {"Fail", "fail", "Failed", "", "no"})
    {
        CHECK(std::get<AcsAck>(DecodeOrFail(codec, MakeAckText("PlanReport", "t", result))).result == EAckResult::Fail);
    }
    const AcsMessage report =
        DecodeOrFail(codec, MakeRequestText("CancelResultReport", R"({"planId":"P","result":"fail","message":""})"));
    std::string encoded;
    AcsCodec::Encode(report, encoded);
    CHECK(encoded.find(R"("result":"Failed")") != std::string::npos);
}

TEST_CASE("D-5 The old name of RequestAcsPlans is an alias, answered under the old name")
{
    AcsCodec codec;
    const DecodeOutcome outcome = codec.Decode(MakeRequestText("RequestAcsStatus", "{}"));
    REQUIRE(outcome.message.has_value());
    CHECK(outcome.bLegacyName);
    CHECK(GetCommand(std::get<AcsRequest>(*outcome.message)) == EAcsCommand::RequestAcsPlans);
    AcsAck ack;
    ack.command = EAcsCommand::RequestAcsPlans;
    ack.payload = Protocol::PlanListAck{};
    ack.bLegacyName = true;
    std::string encoded;
    AcsCodec::EncodeAck(ack, encoded);
    CHECK(encoded.find(R"("command":"RequestAcsStatusAck")") != std::string::npos);

    Protocol::CodecOptions options;
    options.bLegacyNames = false;
    AcsCodec strict(options);
    CHECK_FALSE(FailOrDecode(strict, MakeRequestText("RequestAcsStatus", "{}")).command.has_value());
}

TEST_CASE("6.15 A member that does not apply is left out of an error; 6.16 in a status it is null")
{
    AcsCodec codec;
    std::string encoded;
    AcsCodec::EncodeRequest({"t", {}, Protocol::ErrorReport{}}, encoded);
    CHECK(encoded.find("null") == std::string::npos);
    CHECK(encoded.find("stepNo") == std::string::npos);
    AcsCodec::EncodeRequest({"t", {}, Protocol::RobotStatusUpdate{}}, encoded);
    CHECK(encoded.find(R"("planId":null,"stepNo":null,"jobId":null)") != std::string::npos);
}

TEST_CASE("R3 A decoding error names the place and the reason, and keeps what was decoded of the envelope")
{
    struct Case
    {
        std::string payload;
        std::string path;
    };
    AcsCodec codec;
    const std::vector<Case> cases{
        {"null", "payload"},
        {"[]", "payload"},
        {R"({"lotId":"L","steps":[]})", "payload.steps"},
        {R"({"planId":"P"})", "payload.steps"},
        {R"({"planId":"","steps":[]})", "payload.planId"},
        {R"({"planId":7,"steps":[]})", "payload.planId"},
        {R"({"planId":"P","steps":[{"stepNo":0,"action":"Start","position":"A01"}]})", "payload.steps[0].stepNo"},
        {R"({"planId":"P","steps":[{"stepNo":1.5,"action":"Start","position":"A01"}]})", "payload.steps[0].stepNo"},
        {R"({"planId":"P","steps":[{"stepNo":99999999999999999999,"action":"Start","position":"A01"}]})",
         "payload.steps[0].stepNo"},
        {R"({"planId":"P","steps":[{"stepNo":1,"action":"Start","position":"A01","jobs":[{"jobId":""}]}]})",
         "payload.steps[0].jobs[0].jobId"},
        {R"({"planId":"P","planId":"P","steps":[]})", "payload.planId"},
        {R"({"planId":"P","steps":[],"priority":"high"})", "payload.steps"},
    };
    for (const Case& bad : cases)
    {
        const DecodeFailure failure = FailOrDecode(codec, MakeRequestText("ExecutionPlan", bad.payload));
        INFO(bad.payload);
        INFO(Core::Describe(failure.error));
        CHECK(failure.error.path == bad.path);
        CHECK(failure.command == EAcsCommand::ExecutionPlan);
        CHECK(failure.transactionID == "t-1");
        CHECK_FALSE(failure.bAck);
    }
    const DecodeFailure named = FailOrDecode(codec, MakeRequestText("ExecutionPlan", R"({"planId":"P","steps":1})"));
    CHECK(named.planID == "P");
}

TEST_CASE("2 Text that is not a message has no command to answer")
{
    AcsCodec codec;
    const std::string deep(5U * 1024U * 1024U, '[');
    for (const std::string& text :
         {std::string(),
          std::string("hello"),
          std::string("[]"),
          std::string("{}"),
          deep,
          std::string(R"({"command":7})"),
          std::string("{\"command\":\"\xFF\"}"),
          deep.substr(0, 1000)})
    {
        const DecodeFailure failure = FailOrDecode(codec, text);
        CHECK(failure.commandName.empty());
        CHECK_FALSE(failure.command.has_value());
    }
}

TEST_CASE("2 An unknown command keeps its name; a command without a transactionId is rejected")
{
    AcsCodec codec;
    const DecodeFailure unknown = FailOrDecode(codec, MakeRequestText("Dance", "{}"));
    CHECK(unknown.commandName == "Dance");
    CHECK_FALSE(unknown.command.has_value());
    CHECK(unknown.transactionID == "t-1");
    CHECK(FailOrDecode(codec, MakeAckText("Dance", "t-1")).bAck);
    const DecodeFailure nameless = FailOrDecode(codec, MakeRequestText("CancelPlan", R"({"planId":"P"})", ""));
    CHECK(nameless.command == EAcsCommand::CancelPlan);
    CHECK(nameless.error.path == "transactionId");
}

TEST_CASE("2 Commands and values in another case, unknown members and a byte order mark are accepted and counted")
{
    AcsCodec codec;
    const DecodeOutcome outcome =
        codec.Decode("\xEF\xBB\xBF " + MakeRequestText("tscstateupdate", R"({"state":"AUTO","colour":"red"})") + "\n");
    REQUIRE(outcome.message.has_value());
    CHECK(outcome.notes.lenientWords == 2);
    CHECK(outcome.notes.unknownMembers == 1);
    Protocol::CodecOptions options;
    options.bUnknownMembersRefused = true;
    AcsCodec strict(options);
    CHECK(
        FailOrDecode(strict, MakeRequestText("TscStateUpdate", R"({"state":"Auto","colour":"red"})")).error.path
        == "payload.colour");
}

TEST_CASE("6.9 SyncConfig carries any object")
{
    AcsCodec codec;
    const std::string text = MakeRequestText("SyncConfig", R"({"ports":[1,{"x":null}]})");
    const AcsMessage message = DecodeOrFail(codec, text);
    std::string encoded;
    AcsCodec::Encode(message, encoded);
    CHECK(encoded == text);
}

TEST_CASE("3 A deleted job status is rejected")
{
    AcsCodec codec;
    const std::string payload =
        R"({"planId":"P","robotId":"R","stepNo":1,"jobId":"J","status":"Timeout","message":""})";
    CHECK(FailOrDecode(codec, MakeRequestText("JobReport", payload)).error.path == "payload.status");
}

TEST_CASE("2 A plan's times are read like any time: without offset as the site's, and unreadable ones as none")
{
    Protocol::CodecOptions options;
    options.siteOffset = std::chrono::hours(9);
    AcsCodec codec(options);
    const auto decode = [&codec](const std::string& startTime) {
        return codec.Decode(
            R"({"command":"RequestAcsPlansAck","transactionId":"t","timestamp":"2025-07-02T21:00:00.123+09:00",)"
            R"("result":"Success","message":"","payload":{"plans":[{"planId":"P","robotId":null,"status":"Pending",)"
            R"("stepNo":1,"jobId":null,"currentAction":null,"startTime":)"
            + startTime + R"(,"endTime":null}]}})");
    };
    const auto getStart = [](const DecodeOutcome& outcome) {
        return std::get<Protocol::PlanListAck>(std::get<AcsAck>(outcome.message.value()).payload).plans.at(0).startTime;
    };
    const DecodeOutcome local = decode(R"("2025-07-02T21:00:00.1234567")");
    CHECK(getStart(local).value() == std::get<AcsAck>(local.message.value()).timestamp);
    CHECK(local.notes == Protocol::DecodeNotes{});
    for (const std::string bad : {R"("soon")", "7", "{}"})
    {
        INFO(bad);
        const DecodeOutcome outcome = decode(bad);
        CHECK_FALSE(getStart(outcome).has_value());
        CHECK(outcome.notes.badTimestamps == 1);
    }
}

TEST_CASE("2 The ids and the time of an undecodable message are returned")
{
    AcsCodec codec;
    const DecodeFailure failure = FailOrDecode(
        codec,
        MakeRequestText("JobReport", R"({"planId":"P","robotId":"R","stepNo":1,"jobId":"J","status":"Dancing"})"));
    CHECK(failure.error.path == "payload.status");
    CHECK(failure.command == EAcsCommand::JobReport);
    CHECK(failure.transactionID == "t-1");
    CHECK(failure.planID == "P");
    CHECK(failure.robotID == "R");
    CHECK(failure.jobID == "J");
    REQUIRE(failure.timestamp.has_value());
    CHECK(failure.timestamp->offset == std::chrono::hours(9));
}

TEST_CASE("2 A duplicate member of the envelope is an error, and the message can still be answered")
{
    AcsCodec codec;
    for (const std::string text :
         {R"({"command":"CancelPlan","command":"AbortPlan","transactionId":"t-1","payload":{"planId":"P"}})",
          R"({"payload":{"planId":"P"},"payload":{},"transactionId":"t-1","command":"CancelPlan"})",
          R"({"x":1,"x":1,"command":"CancelPlan","transactionId":"t-1","payload":{"planId":"P"}})"})
    {
        const DecodeFailure failure = FailOrDecode(codec, text);
        CHECK(failure.error.code == Core::ECoreError::InvalidJSON);
        CHECK(failure.command == EAcsCommand::CancelPlan);
        CHECK(failure.transactionID == "t-1");
        CHECK(failure.planID == "P");
    }
}

TEST_CASE("2 A non-empty payload of an Ack without members is counted, and rejected with a duplicate member")
{
    AcsCodec codec;
    const auto decode = [&codec](const std::string& payload) {
        return codec.Decode(
            R"({"command":"PlanReportAck","transactionId":"t","timestamp":"2025-07-02T21:00:00.123+09:00",)"
            R"("result":"Success","message":"","payload":)"
            + payload + "}");
    };
    CHECK(decode("{}").notes == Protocol::DecodeNotes{});
    CHECK(decode(R"({"planId":"P"})").notes.unknownMembers == 1);
    CHECK(decode("null").message.has_value());
    CHECK(decode("7").message.has_value());
    CHECK_FALSE(decode(R"({"planId":"P","planId":"Q"})").message.has_value());
}

TEST_CASE("2 Identifiers in lists have the limits of identifiers")
{
    AcsCodec codec;
    const auto decode = [&codec](const std::string& planIDs) {
        return codec.Decode(MakeRequestText("RequestAcsPlanHistory", R"({"planIds":)" + planIDs + "}"));
    };
    CHECK(decode("[]").message.has_value());
    CHECK(decode(R"(["P"])").message.has_value());
    for (const std::string& bad : {std::string(R"(["P",""])"), R"(["P",")" + std::string(513, 'x') + R"("])"})
    {
        const DecodeOutcome outcome = decode(bad);
        REQUIRE_FALSE(outcome.message.has_value());
        CHECK(outcome.message.error().error.path == "payload.planIds[1]");
    }
}

TEST_CASE("D-11 Comments and trailing commas are rejected, unless an option accepts them")
{
    const std::string text = R"({"command":"CancelPlan",// stops it
        "transactionId":"t","timestamp":"2025-07-02T21:00:00.123+09:00","payload":{"planId":"P","reason":"r",},})";
    AcsCodec codec;
    CHECK(FailOrDecode(codec, text).error.code == Core::ECoreError::InvalidJSON);
    Protocol::CodecOptions options;
    options.bLenientJSON = true;
    AcsCodec lenient(options);
    CHECK(
        std::get<AcsRequest>(DecodeOrFail(lenient, text)).payload
        == Protocol::AcsPayload(Protocol::CancelPlan{"P", "r"}));
}

namespace
{

struct LimitCase
{
    std::string within;
    std::string beyond;
    Protocol::CodecOptions options;
};

LimitCase MakeLimitCase(
    std::size_t Protocol::CodecOptions::*limit,
    std::size_t value,
    std::string within,
    std::string beyond)
{
    LimitCase limitCase{std::move(within), std::move(beyond), {}};
    limitCase.options.*limit = value;
    return limitCase;
}

} // namespace

TEST_CASE("1 Each limit is an option: message size, depth, strings, arrays")
{
    using Options = Protocol::CodecOptions;
    const std::string sized = MakeRequestText("SyncConfig", "{}");
    const auto message = [](const std::string& text) {
        return MakeRequestText("PlanReport", R"({"planId":"P","status":"Failed","message":")" + text + R"("})");
    };
    const auto nested = [](const std::string& text) {
        return MakeRequestText("SyncConfig", R"({"x":)" + text + "}");
    };
    const auto history = [](const std::string& text) {
        return MakeRequestText("RequestAcsPlanHistory", R"({"planIds":[)" + text + "]}");
    };
    const std::vector<LimitCase> cases{
        MakeLimitCase(&Options::maximumBytes, sized.size(), sized, sized + " "),
        MakeLimitCase(&Options::maximumDepth, 4, nested("[[]]"), nested("[[[]]]")),
        MakeLimitCase(&Options::maximumString, 8, message("12345678"), message("123456789")),
        MakeLimitCase(&Options::maximumArray, 2, history(R"("a","b")"), history(R"("a","b","c")")),
    };
    for (const LimitCase& limitCase : cases)
    {
        INFO(limitCase.beyond);
        AcsCodec codec(limitCase.options);
        CHECK(codec.Decode(limitCase.within).message.has_value());
        const std::error_code code = FailOrDecode(codec, limitCase.beyond).error.code;
        CHECK((code == Core::ECoreError::TooLarge || code == Core::ECoreError::OutOfRange));
        AcsCodec usual;
        CHECK(usual.Decode(limitCase.beyond).message.has_value());
    }
}
