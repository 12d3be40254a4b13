#include "McsSimulator.hpp"

#include "Catch.hpp"
#include "common/process/SystemClock.hpp"
#include "console/Screen.hpp"
#include "plans/SamplePlans.hpp"
#include "scenario/ScenarioFile.hpp"
#include "SeededRandom.hpp"
#include "TinyACS.hpp"
#include "wire/RawPeer.hpp"
#include "world/MemoryWorld.hpp"
#include <acs/protocol_beast/AcsClient.hpp>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using ACS::McsSim::McsSimulator;
using ACS::McsSim::PlannedPlan;
using ACS::Protocol::EPlanStatus;
using ACS::Testing::MakePlanReport;
using ACS::Testing::MakeSamplePlan;
using ACS::Testing::SeededRandom;
using ACS::Testing::TinyACS;

namespace
{

constexpr std::chrono::seconds LONGEST{20};

/// The simulator with some sample plans, and an ACS at its other end.
struct McsSimulatorFixture
{
    boost::asio::io_context context{1};
    ACS::Apps::SystemClock clock;
    SeededRandom random;
    std::ostringstream out;
    ACS::McsSim::Screen screen{out, 100};
    std::optional<int> exitCode;
    ACS::Apps::Endpoint endpoint;
    std::unique_ptr<McsSimulator> simulator;
    std::unique_ptr<TinyACS> acs;

    explicit McsSimulatorFixture(
        std::size_t plans,
        bool bLive = false,
        const ACS::McsSim::SimulatorOptions& options = {})
    {
        std::vector<PlannedPlan> planned;
        for (std::size_t i = 1; i <= plans; ++i)
        {
            planned.push_back(MakeSamplePlan("P" + std::to_string(i), "T" + std::to_string(i)));
        }
        simulator = std::make_unique<McsSimulator>(
            context.get_executor(),
            clock,
            random,
            ACS::Core::Logger(),
            options,
            std::move(planned),
            out,
            bLive ? &screen : nullptr,
            [this](int code) {
                exitCode = code;
                context.stop();
            });
        const auto started = simulator->Start();
        REQUIRE(started.has_value());
        endpoint = *started;
        acs = std::make_unique<TinyACS>(context, clock, "ws://" + MakeText(endpoint) + "/acs/");
    }

    /// Runs until the simulator ends or the time limit is over. Returns its output.
    std::string Run()
    {
        acs->Connect();
        context.run_for(LONGEST);
        REQUIRE(exitCode.has_value());
        return out.str();
    }
};

bool Contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

std::string GetLastLine(const std::string& text)
{
    const std::string trimmed = text.substr(0, text.size() - 1);
    return trimmed.substr(trimmed.rfind('\n') + 1);
}

} // namespace

TEST_CASE("Plans go to the ACS, its reports come back, and all end completed")
{
    McsSimulatorFixture fixture(3);
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(fixture.exitCode == 0);
    CHECK(GetLastLine(output) == "3 plans completed, 0 failed");
    CHECK(fixture.acs->transactions == std::vector<std::string>{"T1", "T2", "T3"});
    CHECK(Contains(output, " ACS registered\n"));
    CHECK(Contains(output, " P2 JobReport step 2 job 2/2 Completed (LR01)\n"));
    CHECK(Contains(output, " JobReport                          27           27            0            0\n"));
}

TEST_CASE("Nothing is sent before the plans are released")
{
    McsSimulatorFixture fixture(1);
    fixture.acs->Connect();
    while (!Contains(fixture.out.str(), "ACS registered"))
    {
        REQUIRE(fixture.context.run_one_for(LONGEST) > 0);
    }
    CHECK_FALSE(Contains(fixture.out.str(), "P1"));
    fixture.simulator->Release();
    fixture.context.run_for(LONGEST);
    CHECK(fixture.exitCode == 0);
}

TEST_CASE("6.4 A refused plan makes the run fail, and the reason is shown")
{
    McsSimulatorFixture fixture(1);
    fixture.acs->refusal = "no such place as A09.CP01";
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    CHECK(fixture.exitCode == 1);
    CHECK(GetLastLine(output) == "0 plans completed, 1 failed");
    CHECK(Contains(output, " P1 refused: no such place as A09.CP01\n"));
}

TEST_CASE("6.4 A planId that the ACS knows already is refused with what to do about it")
{
    McsSimulatorFixture fixture(1);
    fixture.acs->refusal = "Duplicated Plan";
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(Contains(output, "\n The ACS knows a planId already: with --fresh-ids plans go under new ids.\n"));
}

TEST_CASE("A plan that was not acknowledged before the link was lost is sent again, with its transactionId")
{
    McsSimulatorFixture fixture(2);
    fixture.acs->cutAfter = 1;
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(fixture.exitCode == 0);
    CHECK(GetLastLine(output) == "2 plans completed, 0 failed");
    REQUIRE(fixture.acs->transactions.size() >= 3);
    CHECK(fixture.acs->transactions.front() == "T1");
    CHECK(Contains(output, " P1 ExecutionPlan sent again\n"));
    CHECK(Contains(output, " reconnects              1\n"));
}

TEST_CASE("6.3 A plan that is reported without an Ack makes the run fail, though the plan was completed")
{
    McsSimulatorFixture fixture(1);
    fixture.acs->bAcknowledging = false;
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(fixture.exitCode == 1);
    CHECK(GetLastLine(output) == "1 plans completed, 0 failed");
    CHECK(Contains(output, " violation: P1 reported without ExecutionPlanAck\n"));
}

TEST_CASE("A report after the final one makes the run fail, though the plan was completed")
{
    McsSimulatorFixture fixture(1);
    fixture.acs->moreReports = {MakePlanReport("P1", EPlanStatus::InProgress)};
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    CHECK(fixture.exitCode == 1);
    CHECK(GetLastLine(output) == "1 plans completed, 0 failed");
    CHECK(Contains(output, " violation: P1 PlanReport after it was completed\n"));
}

TEST_CASE("R1, R2 A message that an ACS may not send makes the run fail, and is reported")
{
    ACS::McsSim::SimulatorOptions options;
    options.bConsole = true;
    McsSimulatorFixture fixture(0, false, options);
    fixture.simulator->Release();
    const std::string strayAck = R"({"command":"CancelPlanAck","transactionId":"T4",)"
                                 R"("timestamp":"2025-07-02T21:00:00.123+09:00","result":"Success","message":"",)"
                                 R"("payload":{"planId":"P1"}})";
    ACS::Testing::RawPeer peer(
        fixture.context,
        {ACS::Testing::MakeText("TscStateUpdate", "T0", R"({"state":"Auto"})"),
         ACS::Testing::MakeText("Registration", "T1", "{}"),
         "no JSON",
         ACS::Testing::MakeText("PlanReport", "T2", R"({"planId":"P1","status":"Dancing","message":""})"),
         ACS::Testing::MakeText("ResumePlan", "T3", R"({"planId":"P1"})"),
         strayAck,
         ACS::Testing::MakeText("TscStateUpdate", "T5", R"({"state":"auto","mood":"fine"})")});
    peer.ConnectAsync(fixture.endpoint.port);
    while (!Contains(fixture.out.str(), "ACS TscStateUpdate Auto"))
    {
        REQUIRE(fixture.context.run_one_for(LONGEST) > 0);
    }
    fixture.simulator->Execute("quit");
    fixture.context.run_for(LONGEST);
    const std::string output = fixture.out.str();
    INFO(output);
    CHECK(fixture.exitCode == 1);
    CHECK(Contains(output, " VIOLATION ACS message before the registration: TscStateUpdate\n"));
    CHECK(Contains(output, " VIOLATION ACS unreadable message: expected JSON"));
    CHECK(Contains(output, " VIOLATION ACS unreadable message: payload.status: expected "));
    CHECK(Contains(output, " VIOLATION ACS command that an ACS does not send: ResumePlan\n"));
    CHECK(Contains(output, " VIOLATION ACS Ack of nothing that was asked: CancelPlan\n"));
    CHECK(Contains(output, " ACS word in another case than the document's (reported once)\n"));
    CHECK(Contains(output, " ACS member that the document does not have (reported once)\n"));
    CHECK(Contains(output, "\n violations              5\n"));
    CHECK(Contains(output, "\n PlanReport                          0            0            0            1\n"));
    CHECK(Contains(output, "\n      2 unreadable message\n"));
}

TEST_CASE("An interruption before the end prints the table and fails")
{
    McsSimulatorFixture fixture(1);
    fixture.simulator->Release();
    fixture.simulator->Interrupt();
    fixture.context.run_for(LONGEST);
    CHECK(fixture.exitCode == 1);
    CHECK(Contains(fixture.out.str(), "1 unfinished"));
    CHECK(GetLastLine(fixture.out.str()) == "0 plans completed, 0 failed");
}

TEST_CASE("The live view is drawn in place, with the table below it")
{
    McsSimulatorFixture fixture(1, true);
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    CHECK(fixture.exitCode == 0);
    CHECK(Contains(output, "\x1b[?25l\r\x1b["));
    CHECK_FALSE(Contains(output, "JobReport step"));
    CHECK(output.rfind("\x1b[?25h") > output.rfind("\x1b[?25l"));
    CHECK(GetLastLine(output) == "1 plans completed, 0 failed");
}

TEST_CASE("A port in use is named")
{
    McsSimulatorFixture first(1);
    ACS::McsSim::SimulatorOptions options;
    options.listen = first.endpoint;
    McsSimulator second(
        first.context.get_executor(),
        first.clock,
        first.random,
        ACS::Core::Logger(),
        options,
        {},
        first.out,
        nullptr,
        [](int /*code*/) {});
    const auto refused = second.Start();
    REQUIRE_FALSE(refused.has_value());
    CHECK(Contains(Describe(refused.error()), MakeText(first.endpoint)));
}

TEST_CASE("A scenario sends its plan and checks what the ACS does; its verdicts are in the table")
{
    const std::string wanted = GENERATE("Success", "Fail");
    ACS::McsSim::SimulatorOptions options;
    options.date = "20250702";
    const auto scenario = ACS::McsSim::ParseScenario(
        R"({"name":"test","steps":[{"send":"ExecutionPlan","file":"p","as":"A"},
            {"expect":"ExecutionPlanAck","result":")"
            + wanted + R"(","payload":{"planId":"{A}"},"within":"1s"},{"waitFor":"A","status":"Completed"}]})",
        [](const std::string& /*path*/) { return tl::expected<PlannedPlan, std::string>(MakeSamplePlan("P", "T")); });
    REQUIRE(scenario.has_value());
    options.scenarios = {*scenario};
    McsSimulatorFixture fixture(0, false, options);
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    const bool bHeld = wanted == "Success";
    CHECK(fixture.exitCode == (bHeld ? 0 : 1));
    CHECK(Contains(output, bHeld ? " scenario test: passed\n" : " scenario test: FAILED\n"));
    CHECK(
        GetLastLine(output)
        == (bHeld ? "1 of 1 scenarios passed, 2 of 2 expectations held, 0 violations"
                  : "0 of 1 scenarios passed, 0 of 2 expectations held, 0 violations"));
}

TEST_CASE("A scenario sends the plan again that it names, not the last one")
{
    ACS::McsSim::SimulatorOptions options;
    const auto scenario = ACS::McsSim::ParseScenario(
        R"({"name":"test","steps":[{"send":"ExecutionPlan","file":"PA","as":"A","freshIds":false},
            {"send":"ExecutionPlan","file":"PB","as":"B","freshIds":false},
            {"waitFor":"B","status":"Completed"},{"sendAgain":"A"}]})",
        [](const std::string& path) {
            return tl::expected<PlannedPlan, std::string>(MakeSamplePlan(path.substr(path.size() - 2), "T-" + path));
        });
    REQUIRE(scenario.has_value());
    options.scenarios = {*scenario};
    McsSimulatorFixture fixture(0, false, options);
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(Contains(output, " PA ExecutionPlan sent again\n"));
    CHECK_FALSE(Contains(output, " PB ExecutionPlan sent again\n"));
}

TEST_CASE("A scenario sends a plan again before its Ack, with the same transactionId")
{
    ACS::McsSim::SimulatorOptions options;
    const auto scenario = ACS::McsSim::ParseScenario(
        R"({"name":"test","steps":[{"send":"ExecutionPlan","file":"p","as":"A"},{"sendAgain":"A"},
            {"expect":"ExecutionPlanAck","within":"5s"},{"expect":"ExecutionPlanAck","within":"5s"},
            {"waitFor":"A","status":"Completed"}]})",
        [](const std::string& /*path*/) { return tl::expected<PlannedPlan, std::string>(MakeSamplePlan("P", "T")); });
    REQUIRE(scenario.has_value());
    options.scenarios = {*scenario};
    McsSimulatorFixture fixture(0, false, options);
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(fixture.exitCode == 0);
    CHECK(GetLastLine(output) == "1 of 1 scenarios passed, 3 of 3 expectations held, 0 violations");
}

TEST_CASE("With a world plans that share a place wait for each other, and reports without a move make the run fail")
{
    ACS::Sim::MemoryWorld world;
    ACS::McsSim::SimulatorOptions options;
    options.worldOrNull = &world;
    options.stocking = ACS::McsSim::EStocking::Restock;
    McsSimulatorFixture fixture(2, false, options);
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(fixture.exitCode == 1);
    CHECK(output.find("P2 ExecutionPlan sent") > output.find("P1 PlanReport Completed"));
    CHECK(world.GetPlaceOrNull("C1") == "A01.CP01");
    CHECK(Contains(
        output,
        "\n violation: P1 JobReport step 1 Completed, but not moved: LR01: C1 from A01.CP01 to LR01.CP01\n"));
    CHECK(Contains(output, "\n0 carriers delivered, 4 misplaced\n2 plans completed, 0 failed\n"));
}

TEST_CASE("A connection that is not the registered ACS fulfils no expectation")
{
    ACS::McsSim::SimulatorOptions options;
    const auto scenario = ACS::McsSim::ParseScenario(
        R"({"name":"test","steps":[{"expect":"ErrorReport","within":"300ms"}]})",
        [](const std::string& /*path*/) { return tl::expected<PlannedPlan, std::string>(PlannedPlan()); });
    REQUIRE(scenario.has_value());
    options.scenarios = {*scenario};
    McsSimulatorFixture fixture(0, false, options);
    fixture.simulator->Release();
    ACS::Testing::RawPeer peer(
        fixture.context,
        {ACS::Testing::MakeText(
            "ErrorReport",
            "T1",
            R"({"robotId":"LR01","state":true,"errorCode":"E","level":"heavy","message":""})")});
    peer.ConnectAsync(fixture.endpoint.port);
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(fixture.exitCode == 1);
    CHECK(Contains(output, " message before the registration: ErrorReport\n"));
    CHECK(Contains(output, "no ErrorReport came within 300ms"));
}

TEST_CASE("12.3 With the profile nexus a second client is rejected, with the profile spec it is accepted")
{
    const bool bNexus = GENERATE(false, true);
    CAPTURE(bNexus);
    ACS::McsSim::SimulatorOptions options;
    options.profile = bNexus ? ACS::McsSim::EProfile::Nexus : ACS::McsSim::EProfile::Spec;
    McsSimulatorFixture fixture(1, false, options);
    fixture.acs->Connect();
    while (!Contains(fixture.out.str(), "ACS registered"))
    {
        REQUIRE(fixture.context.run_one_for(LONGEST) > 0);
    }
    ACS::Testing::RawPeer peer(fixture.context, {});
    peer.ConnectAsync(fixture.endpoint.port);
    while (!peer.WasAnswered())
    {
        REQUIRE(fixture.context.run_one_for(LONGEST) > 0);
    }
    CHECK(peer.WasAccepted() != bNexus);
}

TEST_CASE("12.3 A message that the profile nexus loses fulfils no expectation, with the profile spec it does")
{
    const bool bNexus = GENERATE(false, true);
    CAPTURE(bNexus);
    ACS::McsSim::SimulatorOptions options;
    options.profile = bNexus ? ACS::McsSim::EProfile::Nexus : ACS::McsSim::EProfile::Spec;
    const auto scenario = ACS::McsSim::ParseScenario(
        R"({"name":"test","steps":[{"send":"ExecutionPlan","file":"p","as":"A","freshIds":false},
            {"expect":"ErrorReport","within":"1s"}]})",
        [](const std::string& /*path*/) { return tl::expected<PlannedPlan, std::string>(MakeSamplePlan("P", "T")); });
    REQUIRE(scenario.has_value());
    options.scenarios = {*scenario};
    McsSimulatorFixture fixture(0, false, options);
    ACS::Protocol::ErrorReport report;
    report.robotID = "LR01";
    report.message = std::string(5'000, 'x');
    fixture.acs->moreReports = {report};
    fixture.simulator->Release();
    const std::string output = fixture.Run();
    INFO(output);
    CHECK(fixture.exitCode == (bNexus ? 1 : 0));
    CHECK(Contains(GetLastLine(output), bNexus ? "0 of 1 scenarios passed" : "1 of 1 scenarios passed"));
}

TEST_CASE("The console executes its commands: sends, lists plans and ends the run")
{
    ACS::McsSim::SimulatorOptions options;
    options.bConsole = true;
    McsSimulatorFixture fixture(1, false, options);
    fixture.simulator->Release();
    fixture.acs->Connect();
    while (!Contains(fixture.out.str(), "P1 PlanReport Completed"))
    {
        REQUIRE(fixture.context.run_one_for(LONGEST) > 0);
    }
    CHECK_FALSE(fixture.exitCode.has_value());
    fixture.simulator->Execute("list");
    fixture.simulator->Execute("cancel P1");
    while (!Contains(fixture.out.str(), "CancelResultReport"))
    {
        REQUIRE(fixture.context.run_one_for(LONGEST) > 0);
    }
    fixture.simulator->Execute("plan nowhere.json");
    fixture.simulator->Execute("dance");
    fixture.simulator->Execute("quit");
    fixture.context.run_for(LONGEST);
    const std::string output = fixture.out.str();
    INFO(output);
    CHECK(fixture.exitCode == 0);
    CHECK(Contains(output, " P1 Completed (LR01)\n"));
    CHECK(Contains(output, " CancelPlan sent\n"));
    CHECK(Contains(output, " P1 CancelPlanAck Success: in progress\n"));
    CHECK(Contains(output, " P1 CancelResultReport Failed: the plan has ended\n"));
    CHECK(Contains(output, "\n CancelPlan                          1            1            –\n"));
    CHECK(Contains(output, " the plan file nowhere.json cannot be read: No such file or directory\n"));
    CHECK(Contains(output, " there is no 'dance': try help\n"));
}
