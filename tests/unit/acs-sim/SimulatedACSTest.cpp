#include "SimulatedACS.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS::AcsSim;   // NOLINT(google-build-using-namespace)
using namespace ACS::Protocol; // NOLINT(google-build-using-namespace)

namespace
{

/// Records what is sent, and shows it to the judge.
class RecordingLink final : public IAcsLink
{
    ACS::Testing::ManualClock& _clock;
    McsJudge& _judge;

public:
    std::vector<AcsRequest> reports;
    std::vector<AcsPayload> states;
    std::vector<std::string> texts;
    std::vector<EAckResult> answers;
    std::vector<EAcsCommand> answered; ///< The command of each answer.
    std::size_t cuts = 0;

    RecordingLink(ACS::Testing::ManualClock& clock, McsJudge& judge)
        : _clock(clock),
          _judge(judge)
    {
    }

    [[nodiscard]] bool TrySendDurable(const AcsRequest& request) override
    {
        reports.push_back(request);
        std::string text;
        AcsCodec::EncodeRequest(request, text);
        _judge.OnSent(text, _clock.GetNow().steady);
        return true;
    }

    void ReplayDone() override
    {
    }

    void SendStatus(const AcsPayload& status) override
    {
        states.push_back(status);
    }

    void SendPosition(const RobotPositionUpdate& /*positions*/) override
    {
    }

    void Answer(
        EAcsCommand command,
        std::string_view /*transactionID*/,
        EAckResult result,
        std::string_view /*message*/,
        const AckPayload& /*payload*/) override
    {
        answers.push_back(result);
        answered.push_back(command);
    }

    void SendText(const std::string& text) override
    {
        texts.push_back(text);
    }

    void Cut() override
    {
        ++cuts;
    }

    void Stop() override
    {
    }
};

class AcsFixture
{
    std::size_t _acknowledged = 0;

public:
    ACS::Testing::ManualClock clock;
    ACS::Testing::SeededRandom random;
    McsJudge judge;
    RecordingLink link{clock, judge};
    std::vector<std::string> lines;
    SimulatedACS acs;

    explicit AcsFixture(std::vector<FaultOrder> faults = {})
        : acs(MakeOptions(std::move(faults)), link, judge, random, [this](const std::string& line) {
              lines.push_back(line);
          })
    {
        acs.Start();
        acs.OnEvent(Registered{}, clock.GetNow());
    }

    void SendPlan(const std::string& planID, const std::string& transactionID)
    {
        ExecutionPlan plan;
        plan.planID = planID;
        plan.steps = {{1, "CassetteLoad", "A01.CP01", {"C"}, {{"J1", "A01.CP01", "AMR.CP01"}}}};
        acs.OnEvent(RequestReceived{{transactionID, {}, plan}}, clock.GetNow());
    }

    /// Acknowledges everything that was sent since the last call, except the newest ones.
    void Acknowledge(std::size_t newest = 0)
    {
        while (_acknowledged + newest < link.reports.size())
        {
            const AcsRequest request = link.reports[_acknowledged++];
            AcsAck ack;
            ack.command = GetCommand(request);
            ack.transactionID = request.transactionID;
            ack.timestamp = request.timestamp;
            std::string text;
            AcsCodec::EncodeAck(ack, text);
            judge.OnReceived(text, clock.GetNow().steady);
            acs.OnEvent(Acked{GetCommand(request), request.transactionID, EAckResult::Success, ""}, clock.GetNow());
        }
    }

    void Advance(std::chrono::milliseconds time)
    {
        for (const auto end = clock.GetNow().steady + time; clock.GetNow().steady < end;)
        {
            clock.Advance(std::chrono::milliseconds(100));
            acs.OnTimer(clock.GetNow());
            Acknowledge();
        }
    }

private:
    static SimulatedACS::Options MakeOptions(std::vector<FaultOrder> faults)
    {
        SimulatedACS::Options options;
        options.faults = std::move(faults);
        options.plans = 1;
        return options;
    }
};

std::size_t Count(const std::vector<AcsRequest>& reports, const std::string& transactionID)
{
    return static_cast<std::size_t>(std::ranges::count(reports, transactionID, &AcsRequest::transactionID));
}

constexpr std::chrono::seconds A_PLAN{4};

} // namespace

TEST_CASE("A simulated ACS without faults executes a plan and is done")
{
    AcsFixture fixture;
    CHECK(fixture.acs.WasRegistered());
    fixture.SendPlan("P", "T");
    CHECK_FALSE(fixture.acs.IsDone());
    fixture.Advance(A_PLAN);
    CHECK(fixture.acs.CountEndedPlans() == 1);
    CHECK(fixture.acs.ListArmedFaults().empty());
    CHECK(std::get<PlanReport>(fixture.link.reports.back().payload).status == EPlanStatus::Completed);
}

TEST_CASE("A repeated request gets its answer and is not executed twice")
{
    AcsFixture fixture;
    fixture.SendPlan("P", "T");
    fixture.SendPlan("P", "T");
    CHECK(fixture.link.answers == std::vector<EAckResult>{EAckResult::Success, EAckResult::Success});
}

TEST_CASE("Requests of different commands with one transactionId are each answered and executed")
{
    AcsFixture fixture;
    fixture.SendPlan("P", "T");
    fixture.acs.OnEvent(RequestReceived{{"T", {}, PausePlan{"P", ""}}}, fixture.clock.GetNow());
    fixture.acs.OnEvent(RequestReceived{{"T", {}, ResumePlan{"P", ""}}}, fixture.clock.GetNow());
    CHECK(
        fixture.link.answered
        == std::vector<EAcsCommand>{EAcsCommand::ExecutionPlan, EAcsCommand::PausePlan, EAcsCommand::ResumePlan});
    fixture.Advance(A_PLAN);
    CHECK(fixture.acs.CountEndedPlans() == 1);
    CHECK(std::ranges::any_of(fixture.link.reports, [](const AcsRequest& report) {
        return std::holds_alternative<ResumeResultReport>(report.payload);
    }));
}

TEST_CASE("late-report: reports are held and then sent in their order")
{
    AcsFixture fixture({{EFault::LateReport, 1}});
    fixture.Advance(std::chrono::seconds(1));
    fixture.SendPlan("P", "T");
    CHECK(fixture.link.reports.empty());
    fixture.Advance(std::chrono::seconds(2));
    CHECK(fixture.link.reports.empty());
    fixture.Advance(std::chrono::seconds(2));
    REQUIRE_FALSE(fixture.link.reports.empty());
    CHECK(std::get<PlanReport>(fixture.link.reports.front().payload).status == EPlanStatus::InProgress);
}

TEST_CASE("duplicate-report: one report is sent again after its Ack")
{
    AcsFixture fixture({{EFault::DuplicateReport, 1}});
    fixture.Advance(std::chrono::seconds(1));
    fixture.SendPlan("P", "T");
    const std::string first = fixture.link.reports.front().transactionID;
    fixture.Advance(A_PLAN);
    CHECK(Count(fixture.link.reports, first) == 2);
    CHECK(fixture.acs.CountEndedPlans() == 1);
}

TEST_CASE("out-of-order: two reports change places")
{
    AcsFixture fixture({{EFault::OutOfOrder, 1}});
    fixture.Advance(std::chrono::seconds(1));
    fixture.SendPlan("P", "T");
    REQUIRE(fixture.link.reports.size() == 3);
    CHECK(std::get<StepReport>(fixture.link.reports[1].payload).status == EStepStatus::InProgress);
    CHECK(std::get<StepReport>(fixture.link.reports[2].payload).status == EStepStatus::Dispatched);
}

TEST_CASE("reconnect: the connection is cut, and a report whose Ack came is sent again")
{
    AcsFixture fixture({{EFault::Reconnect, 1}});
    fixture.Advance(std::chrono::seconds(1));
    fixture.SendPlan("P", "T");
    fixture.Acknowledge();
    const std::string first = fixture.link.reports.front().transactionID;
    CHECK(fixture.acs.GetNextDueOrNull() == fixture.clock.GetNow().steady);
    fixture.acs.OnTimer(fixture.clock.GetNow());
    CHECK(fixture.link.cuts == 1);
    CHECK(Count(fixture.link.reports, first) == 1);
    fixture.acs.OnEvent(Registered{}, fixture.clock.GetNow());
    CHECK(Count(fixture.link.reports, first) == 2);
    fixture.Advance(A_PLAN);
    CHECK(fixture.acs.CountEndedPlans() == 1);
}

TEST_CASE("not-connected: isConnected is false, and later true")
{
    AcsFixture fixture({{EFault::NotConnected, 1}});
    fixture.Advance(std::chrono::seconds(1));
    CHECK(std::get<AcsCommStateUpdate>(fixture.link.states.back()) == AcsCommStateUpdate{false});
    fixture.Advance(std::chrono::seconds(3));
    CHECK(std::get<AcsCommStateUpdate>(fixture.link.states.back()) == AcsCommStateUpdate{true});
}

TEST_CASE("A run ends although the MCS sends more plans")
{
    AcsFixture fixture;
    fixture.SendPlan("P0", "T0");
    fixture.Advance(A_PLAN);
    CHECK(fixture.acs.IsDone());
    const std::size_t before = fixture.link.reports.size();
    fixture.SendPlan("P1", "T1");
    REQUIRE(fixture.link.reports.size() > before); // which have no Ack
    CHECK(fixture.acs.IsDone());
}

TEST_CASE("A run ends although the MCS acknowledges nothing")
{
    AcsFixture fixture;
    fixture.SendPlan("P", "T");
    while (fixture.acs.CountEndedPlans() == 0)
    {
        fixture.clock.Advance(std::chrono::milliseconds(100));
        fixture.acs.OnTimer(fixture.clock.GetNow());
    }
    CHECK_FALSE(fixture.acs.IsDone());
    fixture.clock.Advance(std::chrono::seconds(6));
    fixture.judge.OnTick(fixture.clock.GetNow().steady);
    CHECK(fixture.acs.IsDone());
}

TEST_CASE("A run does not end before its last report is acknowledged")
{
    AcsFixture fixture;
    fixture.SendPlan("P", "T");
    while (fixture.acs.CountEndedPlans() == 0)
    {
        fixture.clock.Advance(std::chrono::milliseconds(100));
        fixture.acs.OnTimer(fixture.clock.GetNow());
        fixture.Acknowledge(1);
    }
    fixture.SendPlan("P1", "T1");
    CHECK_FALSE(fixture.acs.IsDone());
    fixture.Acknowledge();
    CHECK(fixture.acs.IsDone());
}

TEST_CASE("late-ack: an answer is late, refuse-plan: a plan is refused")
{
    AcsFixture fixture({{EFault::LateAck, 1}, {EFault::RefusePlan, 1}});
    fixture.Advance(std::chrono::seconds(2));
    CHECK(fixture.acs.ListArmedFaults() == std::vector<EFault>{EFault::LateAck, EFault::RefusePlan});
    fixture.SendPlan("P", "T");
    CHECK(fixture.link.answers.empty());
    CHECK_FALSE(fixture.acs.IsDone());
    fixture.Advance(std::chrono::seconds(4));
    CHECK(fixture.link.answers == std::vector<EAckResult>{EAckResult::Fail});
}

TEST_CASE("malformed, unknown-command, bad-payload, unknown-ack, unknown-report, fail-job: each is sent once")
{
    AcsFixture fixture(
        {{EFault::Malformed, 1},
         {EFault::UnknownCommand, 1},
         {EFault::BadPayload, 1},
         {EFault::UnknownAck, 1},
         {EFault::UnknownReport, 1},
         {EFault::FailJob, 1}});
    fixture.Advance(std::chrono::seconds(5));
    REQUIRE(fixture.link.texts.size() == 3);
    AcsCodec codec;
    CHECK(codec.Decode(fixture.link.texts[0]).message.error().commandName.empty());
    CHECK(codec.Decode(fixture.link.texts[1]).message.error().commandName == "InventedCommand");
    CHECK(codec.Decode(fixture.link.texts[2]).message.error().command == EAcsCommand::ErrorReport);
    CHECK(fixture.link.answers.size() == 1);
    CHECK(fixture.link.reports.size() == 1);
    fixture.SendPlan("P", "T");
    fixture.Advance(A_PLAN);
    CHECK(std::get<PlanReport>(fixture.link.reports.back().payload).status == EPlanStatus::Failed);
}

TEST_CASE("The reason of a lost connection is printed whole, without control characters")
{
    AcsFixture fixture;
    const std::string reason = "the server refused the connection: " + std::string(100, 'x') + " 등록";
    fixture.acs.OnEvent(LinkLost{reason + "\n", true}, fixture.clock.GetNow());
    REQUIRE_FALSE(fixture.lines.empty());
    CHECK(fixture.lines.back().find("connection lost: " + reason + "\\x0a") != std::string::npos);
}

TEST_CASE("After a lost connection no fault occurs until the next Registration")
{
    AcsFixture fixture({{EFault::Malformed, 1}});
    fixture.acs.OnEvent(LinkLost{"cut", true}, fixture.clock.GetNow());
    fixture.Advance(std::chrono::seconds(5));
    CHECK(fixture.link.texts.empty());
    fixture.acs.OnEvent(Registered{}, fixture.clock.GetNow());
    fixture.Advance(std::chrono::seconds(1));
    CHECK(fixture.link.texts.size() == 1);
}
