#include "replay/InputCodec.hpp"

#include "Catch.hpp"
#include "replay/RobotEventCodec.hpp"
#include "replay/SessionEventCodec.hpp"
#include "replay/StateCodec.hpp"
#include "replay/TimerText.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

std::vector<Planning::RobotEvent> MakeEvents()
{
    using namespace Planning; // NOLINT(google-build-using-namespace): all alternatives of a variant
    StateChanged state;
    state.x = 1.25;
    state.y = -0.000'123'456'789;
    state.theta = 3.141'592'653'589'793;
    state.bPoseKnown = true;
    state.batteryPercent = 81.5;
    state.lastNodeID = "N1";
    state.bDriving = true;
    state.bCharging = true;
    state.bPaused = true;
    state.bAutomatic = false;
    state.bSafetyStop = true;
    state.bOccupied = true;
    state.errors = {{"AGV-1", EAlarmLevel::Heavy, "stopped"}, {"AGV-2", EAlarmLevel::Light, "\"warm\"\n"}};
    state.omittedErrors = 3;
    state.heldNodeIDs = {"N2", "N3"};
    state.restartEvidence = {"C-1", "17/3"};
    state.loads = {{"LR01.CP01", true, "C_01"}, {"LR01.CP02", false, {}}};
    StateChanged withoutEvidence;
    withoutEvidence.restartEvidence.commandID = std::string();
    return {
        LinkChanged{true},
        state,
        withoutEvidence,
        StateChanged(),
        NodePassed{"D", "N1"},
        Arrived{"D"},
        DriveRejected{"D", "lost"},
        DriveCancelled{"D", "N1"},
        JobStarted{"J"},
        JobFinished{"J"},
        JobFailed{"J", "r"},
        JobRejected{"J", "r"},
        JobInterrupted{"J", "r"},
        JobUnknown{"J"},
        JobUnresolved{"J", "r"},
        JobCheckChanged{},
        CompatibilityChanged{"too large"}};
}

std::vector<Planning::PlanCommand> MakeCommands()
{
    using namespace Planning; // NOLINT(google-build-using-namespace): all alternatives of a variant
    Plan plan;
    plan.planID = "P1";
    plan.priority = 4;
    plan.steps = {{1, "CassetteLoad", "A01.CP01", {"C_01"}, {{"J", "A01.CP01", "AMR.CP01"}}}};
    return {
        SubmitPlan{plan, 7, "T1"},
        ControlPlan{EPlanControl::Pause, "P1", "why", 8, "T2", EControlOrigin::Operator},
        ControlPlan{EPlanControl::Abort, "P1", {}, 8, "T3", EControlOrigin::MCS},
        MessageAcknowledged{12},
        ControlTSC{true, 3},
        ResolveJob{"P1", "J", EJobResolution::Again, 4},
        SetMaintenance{"LR01", true, 5},
        ClearAlarms{"LR01", "AGV-1", "P1", std::nullopt, 6},
        SetCarriers{"LR01", {"C_01", std::nullopt}, 7},
        SkipStep{"P1", 2, 8},
        SetPlanPriority{"P1", -3, 9},
        BlockPlace{EBlockKind::Edge, "N1-N2", "wet", 10},
        UnblockPlace{EBlockKind::Station, "A01.CP01", 11}};
}

std::vector<Protocol::SessionEvent> MakeSessionEvents()
{
    using namespace Protocol; // NOLINT(google-build-using-namespace): all alternatives of a variant
    ExecutionPlan plan;
    plan.planID = "P1";
    plan.steps = {{1, "CassetteLoad", "A01.CP01", {"C_01"}, {{"J", "A01.CP01", "AMR.CP01"}}}};
    return {
        Registered{},
        RequestReceived{{"T1", {}, plan}},
        Acked{EAcsCommand::JobReport, "T2", EAckResult::Fail, "no"},
        RequestUnanswered{EAcsCommand::PlanReport, "T3", EUnansweredReason::Timeout, 4},
        LinkLost{"connection reset", true},
        WindowOpened{},
        PositionDue{},
        Stopped{}};
}

Planning::StoredState MakeStoredState()
{
    Planning::StoredState state;
    Planning::PlanRecord record;
    record.sequence = 3;
    record.acceptedAt = Core::WallTime(std::chrono::milliseconds(1'751'457'600'123));
    record.plan.planID = "P1";
    record.plan.steps = {{1, "CassetteLoad", "A01.CP01", {}, {{"J", "A01.CP01", "AMR.CP01"}}}};
    record.progress.steps = {{Planning::EStepState::Dispatched, {Planning::EJobState::Pending}}};
    record.transactionID = "T1";
    state.plans.push_back(record);
    state.outbox.push_back(
        {7, "T7", record.acceptedAt, Planning::PlanReport{"P0", Planning::EPlanState::Completed, "done"}});
    state.lastReportSequence = 7;
    state.carriers.push_back({"LR01", {"C_01", std::nullopt}});
    state.alarms.push_back({"LR01", "ACS-1008", Planning::EAlarmLevel::Heavy, "unknown", "P1", 1, "J"});
    state.robotsInMaintenance = {"CR01"};
    state.tscState = Planning::ETscState::Paused;
    state.holdReason = "restored";
    Planning::RobotWorkChanged work;
    work.robotID = "LR01";
    work.commandID = "C-1";
    work.job.emplace();
    work.job->planID = "P1";
    work.nodeIDs = {"N1"};
    work.resolvedJob = work.job;
    state.robotWorks.push_back(work);
    state.receipts.push_back({"token lee", "k", "{\"status\":202}", record.acceptedAt});
    return state;
}

CoreInput Repeat(const CoreInput& input)
{
    const Core::Result<CoreInput> read = DecodeInput(EncodeInput(input));
    INFO((read.has_value() ? std::string() : Core::Describe(read.error())));
    REQUIRE(read.has_value());
    return *read;
}

} // namespace

TEST_CASE("A recorded event of a robot is read as it was")
{
    for (const Planning::RobotEvent& event : MakeEvents())
    {
        const CoreInput input = Repeat(Planning::RobotInput{"LR01", event});
        const auto& robot = std::get<Planning::RobotInput>(input);
        CAPTURE(EncodeRobotEvent(event));
        CHECK(robot.robotID == "LR01");
        CHECK(robot.event == event);
    }
}

TEST_CASE("A recorded pose that is not finite stays unknown")
{
    Planning::StateChanged state;
    state.x = std::numeric_limits<double>::infinity();
    state.batteryPercent = std::numeric_limits<double>::quiet_NaN();
    const CoreInput input = Repeat(Planning::RobotInput{"LR01", state});
    const auto& read = std::get<Planning::StateChanged>(std::get<Planning::RobotInput>(input).event);
    CHECK_FALSE(std::isfinite(read.x));
    CHECK_FALSE(std::isfinite(read.batteryPercent));
    CHECK(read.y == 0);
}

TEST_CASE("A recorded command of the operator is read as it was")
{
    for (const Planning::PlanCommand& command : MakeCommands())
    {
        const Planning::CommandReceipt receipt{
            "token lee",
            "k",
            "{}",
            Core::WallTime(std::chrono::milliseconds(1'000))};
        const CoreInput input = Repeat(OfferInput{command, receipt});
        CHECK(std::get<OfferInput>(input).command == command);
        CHECK(std::get<OfferInput>(input).receipt == receipt);
        CHECK_FALSE(std::get<OfferInput>(Repeat(OfferInput{command, std::nullopt})).receipt.has_value());
    }
}

TEST_CASE("The record of a command names its plan and its robot")
{
    const auto describe = [](const Planning::PlanCommand& command) {
        const CoreRecord record = EncodeInput(OfferInput{command, std::nullopt});
        return record.planID + "/" + record.robotID;
    };
    Planning::SubmitPlan submit;
    submit.plan.planID = "P1";
    CHECK(describe(submit) == "P1/");
    CHECK(describe(Planning::SkipStep{"P1", 2, 0}) == "P1/");
    CHECK(describe(Planning::SetMaintenance{"LR01", true, 0}) == "/LR01");
    CHECK(describe(Planning::ClearAlarms{"LR01", "AGV-1", "P1", std::nullopt, 0}) == "P1/LR01");
    CHECK(describe(Planning::ClearAlarms{"LR01", "AGV-1", std::nullopt, std::nullopt, 0}) == "/LR01");
    CHECK(describe(Planning::ControlTSC{true, 0}) == "/");
}

TEST_CASE("A recorded event of the session with the MCS is read as it was")
{
    for (const Protocol::SessionEvent& event : MakeSessionEvents())
    {
        CAPTURE(EncodeSessionEvent(event));
        CHECK(std::get<Protocol::SessionEvent>(Repeat(event)) == event);
    }
}

TEST_CASE("The recorded content of a store is read as it was")
{
    const Planning::StoredState state = MakeStoredState();
    CHECK(std::get<RestoreInput>(Repeat(RestoreInput{state})).state == state);
    CHECK(std::get<RestoreInput>(Repeat(RestoreInput{})).state == Planning::StoredState());
}

TEST_CASE("Every timer has a name of its own, and is read by it")
{
    std::vector<std::string> names;
    for (std::uint8_t number = 0; number <= static_cast<std::uint8_t>(Planning::EEngineTimer::AlarmQuiet); ++number)
    {
        const AcsdTimer timer = Planning::EngineTimer{static_cast<Planning::EEngineTimer>(number), "LR01"};
        CHECK(std::get<AcsdTimer>(Repeat(timer)) == timer);
        names.push_back(DescribeTimer(timer));
    }
    for (std::uint8_t number = 0; number <= static_cast<std::uint8_t>(EAcsdTimer::StoreCheck); ++number)
    {
        const AcsdTimer timer = static_cast<EAcsdTimer>(number);
        CHECK(std::get<AcsdTimer>(Repeat(timer)) == timer);
        names.push_back(DescribeTimer(timer));
    }
    std::ranges::sort(names);
    CHECK(std::ranges::adjacent_find(names) == names.end());
}

TEST_CASE("A recorded result of the store has the same description, and keeps that the store was taken")
{
    const Core::Error failed{Planning::EPlanningError::StoreFailed, "acsd.db", {}, "disk full"};
    const Core::Error taken{Planning::EPlanningError::StoreTaken, "acsd.db", "the store", "another program"};
    CHECK(std::get<StoredInput>(Repeat(StoredInput{failed})).errorOrNull == failed);
    CHECK(std::get<StoreLostInput>(Repeat(StoreLostInput{taken})).error == taken);
    CHECK_FALSE(std::get<StoredInput>(Repeat(StoredInput{})).errorOrNull.has_value());
    const Planning::StoreLog log{"acsd.db", 17, 18, "locked"};
    CHECK(std::get<Planning::StoreLog>(Repeat(log)) == log);
}

TEST_CASE("Any record is read or refused with a reason")
{
    for (const char* const kind :
         {"restore", "session", "robot", "timer", "not stored", "store log", "operator", "other"})
    {
        for (const char* const text :
             {"", "{", "[]", "{}", R"({"event":"X"})", R"({"command":"X"})", R"({"timer":"X"})"})
        {
            CoreRecord record;
            record.kind = kind;
            record.text = text;
            const Core::Result<CoreInput> read = DecodeInput(record);
            CHECK((read.has_value() || !Core::Describe(read.error()).empty()));
        }
    }
}

} // namespace ACS::Acsd::Test
