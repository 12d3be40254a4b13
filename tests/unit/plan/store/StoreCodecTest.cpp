#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"
#include <acs/plan/StoreCodec.hpp>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS;           // NOLINT(google-build-using-namespace)

TEST_CASE("Store texts: plans, states, carriers and alarms are decoded as they were encoded")
{
    const Plan plan = Testing::MakeControlPlan("PLAN-\"1\" ä");
    CHECK(DecodePlan(EncodePlan(plan)) == plan);

    PlanProgress progress;
    progress.state = EPlanState::InProgress;
    progress.robotID = "CR01";
    progress.startedAt = Testing::ManualClock().GetNow().wall + std::chrono::nanoseconds(1);
    progress.steps = {{EStepState::Completed, {EJobState::Completed}}, {EStepState::Dispatched, {}}};
    progress.queuedAt = std::chrono::milliseconds(7);
    progress.storedAt = std::chrono::hours(24 * 365);
    progress.control = EPlanControl::Pause;
    progress.controlOrigin = EControlOrigin::Operator;
    progress.priority = -3;
    CHECK(DecodeProgress(EncodeProgress(progress)) == progress);

    const Block block{EBlockKind::Station, "A01.CP01", "cleaning", Testing::ManualClock().GetNow().wall};
    CHECK(DecodeBlock(EncodeBlock(block)) == block);

    const CarriersChanged carriers{
        "CR01",
        {std::nullopt, "TRAY_02", std::nullopt},
        {"CR01.TP01", "CR01.TP02", "CR01.TP03"}};
    CHECK(DecodeCarriers(EncodeCarriers(carriers)) == carriers);

    const Alarm alarm{"CR01", "ACS-1001", EAlarmLevel::Heavy, "look", "P1", 2, std::nullopt, "E77"};
    CHECK(DecodeAlarm(EncodeAlarm(alarm)) == alarm);
}

TEST_CASE("Store texts: the work of a robot is decoded with its job, also from older versions")
{
    RobotWorkChanged work;
    work.robotID = "CR01";
    work.commandID = "command";
    work.job = StartJob{
        "P1",
        2,
        "J1",
        "TrayLoad",
        "A01.CP01",
        "A01.CP01.TP01",
        "CR01.TP01",
        "TRAY_01",
        "command",
        "m",
        4711,
        "N1"};
    work.jobNumber = 4711;
    work.resolvedJob = work.job;
    work.resolvedJob->jobID = "J0";
    CHECK(DecodeRobotWork(EncodeRobotWork(work)) == work);

    const Core::Result<RobotWorkChanged> old = DecodeRobotWork(
        R"({"robotId":"CR01","commandId":"command","job":{"planId":"P1","stepNo":2,"jobId":"J1","action":"TrayLoad",)"
        R"("position":"A01.CP01","from":"A01.CP01.TP01","to":"CR01.TP01","carrierId":"TRAY_01","commandId":"command",)"
        R"("mark":"m"}})");
    REQUIRE(old.has_value());
    work.resolvedJob.reset();
    work.jobNumber = 0;
    work.job->jobNumber = 0;
    work.job->nodeID.clear();
    CHECK(*old == work);
}

TEST_CASE("Store texts: an accepted text of any length is decoded")
{
    constexpr std::size_t LONGEST_MESSAGE_BY_DEFAULT = 4U * 1024 * 1024;
    constexpr std::size_t LONGEST_STRING_BY_DEFAULT = 64U * 1024;
    constexpr std::size_t MOST_JOBS = 1'000;
    Plan plan = Testing::MakeControlPlan("P1");
    Step step = plan.steps[1];
    step.jobs.resize(MOST_JOBS, step.jobs.front());
    plan.steps.resize(100, step);
    const std::string text = EncodePlan(plan);
    REQUIRE(text.size() > LONGEST_MESSAGE_BY_DEFAULT);
    const Core::Result<Plan> read = DecodePlan(text);
    REQUIRE(read.has_value());
    CHECK((*read == plan)); // double brackets: a failure does not print both texts

    // A vehicle's description of that length after a text of the engine.
    const Report report =
        PlanReport{"P1", EPlanState::Failed, "It failed: " + std::string(LONGEST_STRING_BY_DEFAULT, 'x')};
    const Core::Result<Report> readReport = DecodeReport(EncodeReport(report));
    REQUIRE(readReport.has_value());
    CHECK((*readReport == report));
}

TEST_CASE("Store texts: every kind of report is decoded as it was encoded")
{
    const std::vector<Report> reports{
        PlanReport{"P1", EPlanState::Failed, "why"},
        StepReport{"P1", "LR01", 1, EStepState::InProgress, ""},
        JobReport{"P1", "LR01", 1, "J1", EJobState::Instructed, ""},
        ErrorReport{{"LR01", "AGV-x", EAlarmLevel::Light, "m", std::nullopt, std::nullopt, std::nullopt}, false},
        ControlResultReport{EPlanControl::Abort, "P1", false, "late"}};
    for (const Report& report : reports)
    {
        INFO(EncodeReport(report));
        CHECK(DecodeReport(EncodeReport(report)) == report);
    }
}

TEST_CASE("Store texts: the texts of stores that exist are written and read")
{
    const auto check = [](const std::string& written, const auto& read, std::string_view text, const auto& value) {
        CHECK(written == text);
        CHECK(read(text) == value);
    };
    const auto checkReport = [&check](const Report& report, std::string_view text) {
        check(EncodeReport(report), DecodeReport, text, report);
    };
    checkReport(
        PlanReport{"P1", EPlanState::Failed, "why"},
        R"({"kind":"Plan","planId":"P1","planState":"Failed","message":"why"})");
    checkReport(
        StepReport{"P1", "LR01", 1, EStepState::InProgress, ""},
        R"({"kind":"Step","planId":"P1","robotId":"LR01","stepNo":1,"stepState":"InProgress"})");
    checkReport(
        JobReport{"P1", "LR01", 1, "J1", EJobState::Instructed, "m"},
        R"({"kind":"Job","planId":"P1","robotId":"LR01","stepNo":1,"jobId":"J1","jobState":"Instructed","message":"m"})");
    const Alarm alarm{"LR01", "AGV-x", EAlarmLevel::Light, "m", "P1", 2, std::nullopt};
    checkReport(
        ErrorReport{alarm, false},
        R"({"kind":"Error","set":false,"alarm":{"robotId":"LR01","errorCode":"AGV-x","level":"light","message":"m",)"
        R"("planId":"P1","stepNo":2}})");
    checkReport(
        ControlResultReport{EPlanControl::Abort, "P1", true, "late"},
        R"({"kind":"Control","planId":"P1","control":"Abort","succeeded":true,"message":"late"})");
    check(
        EncodeAlarm(alarm),
        DecodeAlarm,
        R"({"robotId":"LR01","errorCode":"AGV-x","level":"light","message":"m","planId":"P1","stepNo":2})",
        alarm);

    const Core::WallTime time(std::chrono::nanoseconds(1'751'457'600'123'456'789));
    PlanProgress progress;
    progress.state = EPlanState::InProgress;
    progress.robotID = "CR01";
    progress.startedAt = time;
    progress.steps = {{EStepState::Completed, {EJobState::Completed}}, {EStepState::Dispatched, {}}};
    progress.queuedAt = std::chrono::milliseconds(7);
    progress.storedAt = std::chrono::milliseconds(8);
    progress.requestIDs = {"Pause 1"};
    check(
        EncodeProgress(progress),
        DecodeProgress,
        R"({"state":"InProgress","robotId":"CR01","startedAt":1751457600123456789,"steps":[{"state":"Completed",)"
        R"("jobs":["Completed"]},{"state":"Dispatched"}],"arrived":false,"controlCount":0,"controlOrigin":"MCS",)"
        R"("requestIds":["Pause 1"],"queuedAt":7,"storedAt":8})",
        progress);
    const Block block{EBlockKind::Station, "A01.CP01", "cleaning", time};
    check(
        EncodeBlock(block),
        DecodeBlock,
        R"({"kind":"station","id":"A01.CP01","reason":"cleaning","since":1751457600123456789})",
        block);
    const CarriersChanged carriers{"CR01", {std::nullopt, "TRAY_02"}, {"CR01.TP01", "CR01.TP02"}};
    check(
        EncodeCarriers(carriers),
        DecodeCarriers,
        R"({"robotId":"CR01","carrierIds":[null,"TRAY_02"],"ports":["CR01.TP01","CR01.TP02"]})",
        carriers);
    CHECK(
        DecodeCarriers(R"({"robotId":"CR01","carrierIds":[null,"TRAY_02"]})")
        == CarriersChanged{"CR01", {std::nullopt, "TRAY_02"}, {}}); // of a version without names
}

TEST_CASE("Store texts: a damaged text is refused")
{
    CHECK_FALSE(DecodePlan("").has_value());
    CHECK_FALSE(DecodePlan(R"({"steps":[]})").has_value());
    CHECK_FALSE(DecodeReport(R"({"kind":"Step","planId":"P1"})").has_value());
    CHECK_FALSE(DecodeReport(R"({"kind":"Nothing"})").has_value());
    CHECK_FALSE(DecodeProgress(R"({"state":"Lost","steps":[]})").has_value());
}
