#include "Catch.hpp"
#include "config/AcsdConfig.hpp"
#include "ManualClock.hpp"
#include "mcs/McsGateway.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A session with the MCS that the test controls.
class RecordedOutput final : public IMcsOutput
{
public:
    bool bRegistered = true;
    bool bReplayDone = false;
    std::vector<Protocol::AcsRequest> durable;
    std::vector<Protocol::AcsPayload> statuses;
    std::vector<Protocol::AcsAck> answers;

    [[nodiscard]] bool IsRegistered() const override
    {
        return bRegistered;
    }

    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request) override
    {
        durable.push_back(request);
        return true;
    }

    void ReplayDone() override
    {
        bReplayDone = true;
    }

    void SendStatus(const Protocol::AcsPayload& status) override
    {
        statuses.push_back(status);
    }

    void SendPosition(const Protocol::RobotPositionUpdate& /*positions*/) override
    {
    }

    void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload) override
    {
        answers.push_back({command, std::string(transactionID), {}, result, std::string(message), payload, false});
    }

    void SetSiteOffset(std::chrono::minutes /*offset*/) override
    {
    }
};

/// An engine that has restored these reports and alarms, and its gateway.
struct GatewayFixture
{
    AcsdConfig config = ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", {});
    Testing::ManualClock clock;
    Testing::SeededRandom random{1};
    Testing::RecordingLogSink sink;
    Planning::PlanEngine engine{config.engine, *config.site, random};
    RecordedOutput output;
    std::vector<Planning::PlanCommand> commands;
    McsGateway gateway{
        clock,
        random,
        Core::Logger(sink, "mcs"),
        config.localOffset,
        engine,
        output,
        [this](Planning::PlanCommand command) {
            commands.push_back(std::move(command));
        }};

    void Restore(Planning::StoredState state)
    {
        Planning::EngineActions ignored;
        gateway.Restore(state.outbox);
        engine.Restore(std::move(state), clock.GetNow(), ignored);
    }

    void Restore(const std::vector<Planning::Report>& reports)
    {
        Planning::StoredState state;
        for (const Planning::Report& report : reports)
        {
            const std::uint64_t sequence = state.outbox.size() + 1;
            state.outbox.push_back({sequence, "T" + std::to_string(sequence), clock.GetNow().wall, report});
        }
        Restore(std::move(state));
    }

    void Ask(Protocol::AcsPayload payload)
    {
        gateway.OnSessionEvent(Protocol::RequestReceived{{"R", {}, std::move(payload)}, false});
    }

    void Ack(const std::string& transactionID, Protocol::EAckResult result)
    {
        gateway.OnSessionEvent(Protocol::Acked{Protocol::EAcsCommand::PlanReport, transactionID, result, "no"});
    }

    [[nodiscard]] std::vector<std::uint64_t> GetForgotten() const
    {
        std::vector<std::uint64_t> sequences;
        for (const Planning::PlanCommand& command : commands)
        {
            sequences.push_back(std::get<Planning::MessageAcknowledged>(command).sequence);
        }
        return sequences;
    }

    [[nodiscard]] std::vector<std::string> GetSentIDs() const
    {
        std::vector<std::string> ids;
        for (const Protocol::AcsRequest& request : output.durable)
        {
            ids.push_back(request.transactionID);
        }
        return ids;
    }
};

Planning::Alarm MakeAlarm(int number)
{
    Planning::Alarm alarm;
    alarm.robotID = "LR01";
    alarm.errorCode = "AGV-" + std::to_string(number);
    alarm.message = std::string(100, 'm');
    return alarm;
}

const std::vector<Planning::Report> OUTAGE{
    Planning::PlanReport{"P", Planning::EPlanState::InProgress, {}},
    Planning::StepReport{"P", "LR01", 1, Planning::EStepState::Dispatched, {}},
    Planning::PlanReport{"P", Planning::EPlanState::Completed, {}},
    Planning::ControlResultReport{Planning::EPlanControl::Cancel, "P", false, {}}};

} // namespace

TEST_CASE_METHOD(
    GatewayFixture,
    "outbox.replay: all reports of an outage are sent, or the final ones, or none; the others are dropped")
{
    Restore(OUTAGE);
    MessageStyle style;
    SECTION("all")
    {
        gateway.OnSessionEvent(Protocol::Registered{});
        CHECK(GetSentIDs() == std::vector<std::string>{"T1", "T2", "T3", "T4"});
        CHECK(commands.empty());
    }
    SECTION("final_only")
    {
        style.replay = EOutboxReplay::FinalOnly;
        gateway.SetStyle(style);
        gateway.OnSessionEvent(Protocol::Registered{});
        CHECK(GetSentIDs() == std::vector<std::string>{"T3", "T4"});
        CHECK(GetForgotten() == std::vector<std::uint64_t>{1, 2});
        CHECK(sink.ContainsField("count", "2"));
    }
    SECTION("none")
    {
        style.replay = EOutboxReplay::None;
        gateway.SetStyle(style);
        gateway.OnSessionEvent(Protocol::Registered{});
        CHECK(output.durable.empty());
        CHECK(GetForgotten() == std::vector<std::uint64_t>{1, 2, 3, 4});
    }
    CHECK(output.bReplayDone);
}

TEST_CASE_METHOD(
    GatewayFixture,
    "mcs.on_report_nack: a refused report is dropped, or is sent again after the next registration")
{
    Restore({OUTAGE.front()});
    const bool bRetried = GENERATE(false, true);
    MessageStyle style;
    style.bRefusedReportsRetried = bRetried;
    gateway.SetStyle(style);
    gateway.OnSessionEvent(Protocol::Registered{});
    Ack("T1", Protocol::EAckResult::Fail);
    CHECK(sink.Contains(Core::ELogLevel::Warning, "refuses a report"));
    CHECK(sink.GetLines().back().HasField("planId", "P"));
    CHECK(sink.GetLines().back().HasField("reason", "no"));
    CHECK(gateway.GetRefusedReports().count == 1);
    CHECK(gateway.GetRefusedReports().byCommand.at(static_cast<std::size_t>(Protocol::EAcsCommand::PlanReport)) == 1);
    CHECK(gateway.GetRefusedReports().command == "PlanReport");
    CHECK(gateway.GetRefusedReports().planID == "P");
    CHECK(gateway.GetRefusedReports().message == "no");
    CHECK(gateway.GetRefusedReports().bRetried == bRetried);
    CHECK(GetForgotten() == (bRetried ? std::vector<std::uint64_t>{} : std::vector<std::uint64_t>{1}));
    if (bRetried)
    {
        gateway.OnSessionEvent(Protocol::LinkLost{});
        gateway.OnSessionEvent(Protocol::Registered{});
        CHECK(GetSentIDs() == std::vector<std::string>{"T1", "T1"});
        Ack("T1", Protocol::EAckResult::Success);
        CHECK(GetForgotten() == std::vector<std::uint64_t>{1});
    }
}

TEST_CASE_METHOD(GatewayFixture, "The wait for an acknowledgement is observed once per report of this connection")
{
    Restore({OUTAGE.front()});
    std::vector<Core::Duration> waits;
    gateway.SetAckObserver([&waits](Core::Duration wait) { waits.push_back(wait); });
    gateway.OnSessionEvent(Protocol::Registered{});
    clock.Advance(std::chrono::milliseconds(30));
    Ack("T1", Protocol::EAckResult::Success);
    Ack("T1", Protocol::EAckResult::Success); // an MCS that acknowledges twice
    Ack("T9", Protocol::EAckResult::Success); // and a report that it never received
    CHECK(waits == std::vector<Core::Duration>{std::chrono::milliseconds(30)});
    CHECK(GetForgotten() == std::vector<std::uint64_t>{1});
}

TEST_CASE_METHOD(
    GatewayFixture,
    "While acsd drains, plans and controls are refused with the reason; queries are answered")
{
    gateway.BeginDraining();
    REQUIRE(output.statuses.size() == 1);
    CHECK(std::get<Protocol::AcsCommStateUpdate>(output.statuses[0]) == Protocol::AcsCommStateUpdate{false});
    Protocol::ExecutionPlan plan;
    plan.planID = "P";
    Ask(plan);
    Ask(Protocol::CancelPlan{"P", {}});
    Ask(Protocol::RequestAcsPlans{});
    CHECK(commands.empty());
    REQUIRE(output.answers.size() == 3);
    for (const std::size_t index : {std::size_t{0}, std::size_t{1}})
    {
        CHECK(output.answers[index].result == Protocol::EAckResult::Fail);
        CHECK(output.answers[index].message == "acsd draining for shutdown");
        CHECK(std::get<Protocol::PlanAck>(output.answers[index].payload).planID == "P");
    }
    CHECK(output.answers[2].result == Protocol::EAckResult::Success);
}

TEST_CASE_METHOD(
    GatewayFixture,
    "mcs.tx_max_bytes: a list that is too long is cut to fit, newest errors first, and the message states that")
{
    Planning::StoredState state;
    for (int i = 0; i < 40; ++i)
    {
        state.alarms.push_back(MakeAlarm(i));
    }
    Restore(std::move(state));
    Ask(Protocol::RequestAcsErrorList{});
    REQUIRE(output.answers.size() == 1);
    const std::size_t all = std::get<Protocol::ErrorListAck>(output.answers[0].payload).errors.size();
    CHECK(all >= 40);
    CHECK(output.answers[0].message.empty());

    MessageStyle style;
    style.longestText = 4096;
    gateway.SetStyle(style);
    Ask(Protocol::RequestAcsErrorList{});
    REQUIRE(output.answers.size() == 2);
    std::string text;
    Protocol::AcsCodec::EncodeAck(output.answers[1], text);
    CHECK(text.size() <= 4096);
    const auto& kept = std::get<Protocol::ErrorListAck>(output.answers[1].payload).errors;
    REQUIRE(kept.size() > 10);
    CHECK(kept.front().errorCode == engine.GetActiveAlarms().back().errorCode);
    CHECK(output.answers[1].message == std::to_string(all - kept.size()) + " more do not fit");

    // One more would not have fitted.
    Protocol::AcsAck longer = output.answers[1];
    auto& errors = std::get<Protocol::ErrorListAck>(longer.payload).errors;
    errors.push_back(errors.back());
    Protocol::AcsCodec::EncodeAck(longer, text);
    CHECK(text.size() > 4096);
}

} // namespace ACS::Acsd::Test
