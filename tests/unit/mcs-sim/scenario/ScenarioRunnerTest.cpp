#include "scenario/ScenarioRunner.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "plans/SamplePlans.hpp"
#include "scenario/ScenarioFile.hpp"
#include "scenario/ScenarioSequence.hpp"
#include "scenario/ScenarioSummary.hpp"
#include "SeededRandom.hpp"
#include "wire/RawPeer.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <variant>
#include <vector>

using namespace ACS::McsSim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

Scenario MakeScenario(const std::string& steps)
{
    const auto scenario =
        ParseScenario(R"({"name":"test","within":"10s","steps":[)" + steps + "]}", [](const std::string& /*path*/) {
            return tl::expected<PlannedPlan, std::string>(ACS::Testing::MakeSamplePlan("P", "T"));
        });
    INFO((scenario.has_value() ? std::string() : Describe(scenario.error())));
    REQUIRE(scenario.has_value());
    return *scenario;
}

const std::string SEND = R"({"send":"ExecutionPlan","file":"p","as":"A","freshIds":false},)";

std::string MakeReport(const std::string& status, const std::string& planID = "P")
{
    return R"({"command":"PlanReport","transactionId":"t","timestamp":"2025-07-02T21:00:00.123+09:00","payload":)"
           R"({"planId":")"
        + planID + R"(","status":")" + status + R"(","message":""}})";
}

/// A scenario and its clock.
struct RunnerFixture
{
    ACS::Testing::ManualClock clock;
    ACS::Testing::SeededRandom random;
    PlanRefresher refresher{random, "20250702", ECarrierNames::Fresh};
    ScenarioRunner runner;
    ScenarioActions out;

    explicit RunnerFixture(const std::string& steps, bool bRegistered = true)
        : runner(MakeScenario(steps), refresher, random)
    {
        runner.Start(bRegistered, clock.GetNow(), out);
    }

    void Receive(const std::string& text)
    {
        runner.OnMessage(text, clock.GetNow(), out);
    }

    void Pass(std::chrono::milliseconds span)
    {
        clock.Advance(span);
        runner.OnTimer(clock.GetNow(), out);
    }

    template <typename TAction>
    [[nodiscard]] std::vector<TAction> GetAll() const
    {
        std::vector<TAction> found;
        for (const ScenarioAction& action : out)
        {
            if (const TAction* const actionOrNull = std::get_if<TAction>(&action))
            {
                found.push_back(*actionOrNull);
            }
        }
        return found;
    }

    [[nodiscard]] const StepVerdict& GetVerdict(std::size_t number) const
    {
        return runner.GetVerdicts().at(number - 1);
    }
};

} // namespace

TEST_CASE("A scenario sends its plan as soon as an ACS is registered")
{
    RunnerFixture fixture(SEND + R"({"expect":"PlanReport"})", false);
    CHECK(fixture.GetAll<SendPlannedPlan>().empty());
    CHECK(fixture.GetAll<StartScenarioTimer>().back().delay == 10s);
    SECTION("in time")
    {
        fixture.clock.Advance(9s);
        fixture.runner.OnRegistered(fixture.clock.GetNow(), fixture.out);
        REQUIRE(fixture.GetAll<SendPlannedPlan>().size() == 1);
        CHECK(fixture.GetAll<SendPlannedPlan>()[0].planned == ACS::Testing::MakeSamplePlan("P", "T"));
        CHECK_FALSE(fixture.runner.IsFinished());
    }
    SECTION("too late")
    {
        fixture.Pass(10s);
        CHECK(fixture.runner.IsFinished());
        CHECK(fixture.GetVerdict(1).reason == "no ACS has registered within 10s");
        CHECK(fixture.GetVerdict(2).verdict == EVerdict::NotReached);
        CHECK_FALSE(fixture.runner.HasHeld());
    }
}

TEST_CASE("A plan is sent with fresh ids the requested number of times, and is addressed by its name")
{
    RunnerFixture fixture(
        R"({"send":"ExecutionPlan","file":"p","as":"A","times":3},{"cancel":"A"},
           {"send":"RequestAcsPlanHistory","payload":{"planIds":["{A}","{A.transactionId}","{A.2.1}","{A.1.carrier.1}"]}},
           {"sendAgain":"A"},{"sendAgain":"A","freshTransaction":true},{"sendText":"{A} { {} { A } {\"A\"}"})");
    const std::vector<SendPlannedPlan> plans = fixture.GetAll<SendPlannedPlan>();
    REQUIRE(plans.size() == 5);
    CHECK(plans[0].planned.plan.planID != plans[1].planned.plan.planID);
    const PlannedPlan& last = plans[2].planned;
    CHECK(last.plan.planID.find("PLAN-20250702-0003-") == 0);
    CHECK(plans[3].planned == last);
    CHECK(plans[4].planned.plan == last.plan);
    CHECK(plans[4].planned.transactionID != last.transactionID);
    const std::vector<SendPayload> requests = fixture.GetAll<SendPayload>();
    REQUIRE(requests.size() == 2);
    CHECK(std::get<ACS::Protocol::CancelPlan>(requests[0].payload).planID == last.plan.planID);
    CHECK(
        std::get<ACS::Protocol::RequestAcsPlanHistory>(requests[1].payload).planIDs
        == std::vector<std::string>{
            last.plan.planID,
            last.transactionID,
            last.plan.steps[0].jobs[0].jobID,
            last.plan.steps[1].carrierIDs[0]});
    CHECK(fixture.GetAll<SendRawText>().at(0).text == last.plan.planID + R"( { {} { A } {"A"})");
    CHECK(fixture.runner.HasHeld());
}

TEST_CASE("An expectation is fulfilled by the first message that matches, within its time limit")
{
    RunnerFixture fixture(
        SEND + R"({"expect":"PlanReport","payload":{"planId":"{A}","status":"InProgress"},"within":"5s"})");
    fixture.Receive(MakeReport("InProgress", "other"));
    CHECK_FALSE(fixture.runner.IsFinished());
    SECTION("held")
    {
        fixture.clock.Advance(2s);
        fixture.Receive(MakeReport("InProgress"));
        CHECK(fixture.runner.HasHeld());
        CHECK(fixture.GetVerdict(2).duration == 2s);
        CHECK(
            fixture.GetAll<PrintLine>().back().text == "step 2 expect PlanReport planId={A}, status=InProgress: held");
    }
    SECTION("failed with the last message that nearly matched")
    {
        fixture.Receive(MakeReport("Failed"));
        fixture.Pass(5s);
        CHECK(fixture.runner.IsFinished());
        CHECK(
            fixture.GetVerdict(2).reason
            == R"(2 PlanReport came within 5s, none that matches; the last: payload.status: expected "InProgress", found "Failed")");
    }
}

TEST_CASE("An expectation without a message fails when its time limit is over, not before")
{
    RunnerFixture fixture(R"({"expect":"TscStateUpdate","within":"5s"},{"wait":"1s"})");
    fixture.Receive(MakeReport("InProgress"));
    fixture.Pass(4'999ms);
    CHECK_FALSE(fixture.runner.IsFinished());
    fixture.Pass(1ms);
    CHECK(fixture.runner.IsFinished());
    CHECK(fixture.GetVerdict(1).reason == "no TscStateUpdate came within 5s");
    CHECK(fixture.GetVerdict(2).verdict == EVerdict::NotReached);
}

TEST_CASE("Expectations consider the messages after the previous one, those during a wait included")
{
    RunnerFixture fixture(
        R"({"wait":"1s"},{"expect":"PlanReport","payload":{"status":"Paused"}},
           {"expect":"PlanReport","payload":{"status":"InProgress"},"within":"1s"})");
    fixture.Receive(MakeReport("InProgress"));
    fixture.Receive(MakeReport("Paused"));
    fixture.Pass(1s);
    CHECK(fixture.GetVerdict(2).verdict == EVerdict::Held);
    fixture.Pass(1s);
    CHECK(fixture.GetVerdict(3).verdict == EVerdict::Failed);
}

TEST_CASE("A message before an action does not fulfil an expectation after it")
{
    RunnerFixture fixture(R"({"wait":"1s"},{"send":"RequestAcsPlans"},{"expect":"PlanReport","within":"1s"})");
    fixture.Receive(MakeReport("InProgress"));
    fixture.Pass(1s);
    fixture.Pass(1s);
    CHECK(fixture.GetVerdict(3).verdict == EVerdict::Failed);
}

TEST_CASE("Where no message is expected, one fails the scenario at once, also an earlier one")
{
    const std::string steps =
        R"({"expect":"TscStateUpdate"},{"expectNothing":"PlanReport","payload":{"status":"Failed"},"for":"2s"})";
    const std::string tsc =
        R"({"command":"TscStateUpdate","transactionId":"t","timestamp":"2025-07-02T21:00:00Z","payload":{"state":"Auto"}})";
    RunnerFixture fixture(steps);
    fixture.Receive(MakeReport("Failed"));
    fixture.Receive(tsc);
    fixture.Receive(MakeReport("Completed"));
    SECTION("nothing came")
    {
        fixture.Pass(1'999ms);
        CHECK_FALSE(fixture.runner.IsFinished());
        fixture.Pass(1ms);
        CHECK(fixture.runner.HasHeld());
    }
    SECTION("it came")
    {
        fixture.Receive(MakeReport("Failed"));
        CHECK(fixture.runner.IsFinished());
        CHECK(fixture.GetVerdict(2).reason == "it came: " + MakeReport("Failed"));
    }
}

TEST_CASE("An expectation may follow one of nothing and see the same messages")
{
    RunnerFixture fixture(R"({"expectNothing":"StepReport","for":"2s"},{"expect":"PlanReport","within":"1s"})");
    fixture.Receive(MakeReport("Failed"));
    fixture.Pass(2s);
    CHECK(fixture.runner.HasHeld());
}

TEST_CASE(
    "The next message must be the one that is expected, or one of a group, but for a command that may come between")
{
    const std::string tsc = ACS::Testing::MakeText("TscStateUpdate", "t1", R"({"state":"Auto"})");
    const std::string comm = ACS::Testing::MakeText("AcsCommStateUpdate", "t2", R"({"isConnected":true})");
    const std::string position = ACS::Testing::MakeText("RobotPositionUpdate", "t3", R"({"robots":[]})");
    RunnerFixture fixture(
        R"({"expectNext":"TscStateUpdate","besides":"RobotPositionUpdate","within":"5s"},
           {"expectNext":[{"command":"PlanReport","payload":{"planId":"1"}},
                          {"command":"PlanReport","payload":{"planId":"2"}}],"within":"5s"})");
    SECTION("in any order within the group")
    {
        fixture.Receive(position);
        fixture.Receive(tsc);
        fixture.Receive(MakeReport("InProgress", "2"));
        CHECK_FALSE(fixture.runner.IsFinished());
        fixture.Receive(MakeReport("InProgress", "1"));
        CHECK(fixture.runner.HasHeld());
    }
    SECTION("another command")
    {
        fixture.Receive(comm);
        CHECK(fixture.GetVerdict(1).reason.find("AcsCommStateUpdate came before TscStateUpdate: ") == 0);
    }
    SECTION("one of the group twice")
    {
        fixture.Receive(tsc);
        fixture.Receive(MakeReport("InProgress", "2"));
        fixture.Receive(MakeReport("InProgress", "2"));
        CHECK(fixture.GetVerdict(2).reason == R"(payload.planId: expected "1", found "2")");
    }
    SECTION("what may come between here may not there")
    {
        fixture.Receive(tsc);
        fixture.Receive(position);
        CHECK(fixture.GetVerdict(2).verdict == EVerdict::Failed);
    }
    SECTION("nothing in time")
    {
        fixture.Receive(tsc);
        fixture.Receive(MakeReport("InProgress", "1"));
        fixture.Pass(5s);
        CHECK(fixture.GetVerdict(2).reason == "no PlanReport came within 5s");
    }
}

TEST_CASE("A message is stored under its name, and a repeated message is distinguished from a new one")
{
    const auto make = [](const std::string& transactionID) {
        return ACS::Testing::MakeText(
            "PlanReport",
            transactionID,
            R"({"planId":"P","status":"InProgress","message":""})");
    };
    RunnerFixture fixture(
        R"({"expect":"PlanReport","as":"S"},
           {"expect":"PlanReport","repeated":true,"transactionId":"{S.transactionId}","timestamp":"{S.timestamp}"},
           {"expectNothing":"*","repeated":true,"for":"5s"})");
    fixture.Receive(make("t1"));
    fixture.Receive(make("t2"));
    CHECK(fixture.GetVerdict(2).verdict == EVerdict::NotReached);
    fixture.Receive(make("t1"));
    CHECK(fixture.GetVerdict(2).verdict == EVerdict::Held);
    fixture.Receive(make("t3"));
    SECTION("nothing more comes again")
    {
        fixture.Pass(5s);
        CHECK(fixture.runner.HasHeld());
    }
    SECTION("another one comes again")
    {
        fixture.Receive(make("t2"));
        CHECK(fixture.GetVerdict(3).reason == "it came: " + make("t2"));
    }
}

TEST_CASE("A plan is waited for until its final report, or until none can come")
{
    RunnerFixture fixture(SEND + R"({"waitFor":"A","status":"Completed","within":"20s"})");
    fixture.Receive(MakeReport("Completed", "other"));
    fixture.Receive(MakeReport("InProgress"));
    CHECK_FALSE(fixture.runner.IsFinished());
    SECTION("the report has come")
    {
        fixture.Receive(MakeReport("Completed"));
        CHECK(fixture.runner.HasHeld());
    }
    SECTION("it cannot any more")
    {
        fixture.Receive(MakeReport("Aborted"));
        CHECK(fixture.GetVerdict(2).reason == "the plan is Aborted");
    }
    SECTION("it did not in time")
    {
        fixture.Pass(20s);
        CHECK(fixture.GetVerdict(2).reason == "after 20s the plan is InProgress");
    }
}

TEST_CASE("Faults are executed as in the file, and a drop waits for the next registration")
{
    RunnerFixture fixture(
        R"({"withholdAcks":"PlanReport","for":"6s"},{"delayAcks":"*","by":"1s","for":"2s"},
           {"refuseRegistration":2},{"drop":"cut"},{"send":"SyncConfig"})");
    CHECK(fixture.GetAll<HoldAcksStep>().size() == 2);
    CHECK(fixture.GetAll<RefuseRegistrationStep>().at(0).times == 2);
    CHECK(fixture.GetAll<DropStep>().size() == 1);
    CHECK(fixture.GetAll<SendPayload>().empty());
    fixture.runner.OnLinkLost();
    fixture.runner.OnRegistered(fixture.clock.GetNow(), fixture.out);
    CHECK(fixture.GetAll<SendPayload>().size() == 1);
    CHECK(fixture.runner.HasHeld());
}

TEST_CASE("The operator is asked after an ACS has registered, and earlier messages do not fulfil the request")
{
    RunnerFixture fixture(R"({"drop":"cut"},{"ask":"open the door"},{"expect":"ErrorReport"})");
    fixture.runner.OnLinkLost();
    const auto count = [&fixture] {
        const auto lines = fixture.GetAll<PrintLine>();
        return std::count(lines.begin(), lines.end(), PrintLine{"asked for: open the door"});
    };
    CHECK(count() == 0);
    fixture.runner.OnRegistered(fixture.clock.GetNow(), fixture.out);
    CHECK(count() == 1);
    CHECK_FALSE(fixture.runner.IsFinished());
    fixture.Receive(R"({"command":"ErrorReport"})");
    CHECK(fixture.runner.HasHeld());
}

TEST_CASE("A message that could not be sent fails the scenario")
{
    RunnerFixture fixture(SEND + R"({"expect":"PlanReport"})");
    fixture.runner.OnSendFailed(fixture.clock.GetNow(), fixture.out);
    CHECK(fixture.runner.IsFinished());
    CHECK(fixture.GetVerdict(2).reason == "a message could not be sent: the link had just gone");
}

TEST_CASE("Messages that no expectation names are not kept, those that one names are kept up to a limit")
{
    RunnerFixture fixture(R"({"wait":"1s"},{"expect":"PlanReport","payload":{"planId":"first"},"within":"1s"})");
    fixture.Receive(MakeReport("InProgress", "first"));
    for (std::size_t i = 0; i < ScenarioRunner::MAX_KEPT; ++i)
    {
        fixture.Receive(MakeReport("InProgress"));
    }
    fixture.Pass(1s);
    fixture.Pass(1s);
    CHECK(fixture.GetVerdict(2).verdict == EVerdict::Failed);
}

TEST_CASE("After a drop at its end, the next scenario waits for the next registration")
{
    ACS::Testing::ManualClock clock;
    ACS::Testing::SeededRandom random;
    ScenarioSequence sequence(
        {MakeScenario(R"({"drop":"cut"})"), MakeScenario(R"({"send":"SyncConfig"})")},
        random,
        PlanRefresher(random, "20250702", ECarrierNames::Fresh));
    const auto countSent = [](const ScenarioActions& out) {
        return std::count_if(out.begin(), out.end(), [](const ScenarioAction& action) {
            return std::holds_alternative<SendPayload>(action);
        });
    };
    ScenarioActions out;
    sequence.OnRegistered(clock.GetNow(), out);
    sequence.Start(clock.GetNow(), out);
    CHECK(countSent(out) == 0);
    sequence.OnLinkLost();
    sequence.OnRegistered(clock.GetNow(), out);
    CHECK(countSent(out) == 1);
    CHECK(sequence.HasHeld());
}

TEST_CASE("Scenarios follow one another, the faults of one end with it, and the table has every verdict")
{
    ACS::Testing::ManualClock clock;
    ACS::Testing::SeededRandom random;
    ScenarioSequence sequence(
        {MakeScenario(R"({"withholdAcks":"*","for":"1h"},{"expect":"PlanReport"})"),
         MakeScenario(R"({"expect":"PlanReport","within":"1s"},{"expectNothing":"StepReport","for":"1s"})")},
        random,
        PlanRefresher(random, "20250702", ECarrierNames::Fresh));
    ScenarioActions out;
    sequence.Start(clock.GetNow(), out);
    sequence.OnMessage(MakeReport("InProgress"), clock.GetNow(), out);
    CHECK(
        std::count_if(
            out.begin(),
            out.end(),
            [](const ScenarioAction& action) { return std::holds_alternative<EndFaults>(action); })
        == 1);
    CHECK_FALSE(sequence.IsFinished());
    clock.Advance(1s);
    sequence.OnTimer(clock.GetNow(), out);
    CHECK(sequence.IsFinished());
    CHECK_FALSE(sequence.HasHeld());
    std::string table;
    for (const StyledLine& line : MakeScenarioTable(sequence.GetResults()))
    {
        table += MakeText(line, 200, false) + "\n";
    }
    CHECK(
        table
        == " scenario test: passed\n"
           "    2  held        expect PlanReport  0.00 s\n"
           " scenario test: FAILED\n"
           "    1  FAILED      expect PlanReport  1.00 s: no PlanReport came within 1s\n"
           "    2  not reached expect no StepReport for 1s\n");
    CHECK(
        MakeScenarioLastLine(sequence.GetResults(), 3)
        == "1 of 2 scenarios passed, 1 of 3 expectations held, 3 violations");
}
