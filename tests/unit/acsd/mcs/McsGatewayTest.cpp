#include "mcs/McsGateway.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"
#include "RecordingLogSink.hpp"
#include <acs/plan/PlanEngineHost.hpp>

#include <algorithm>

namespace ACS::Testing
{
namespace
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

/// The gateway with an engine and its host, a session that accepts everything, and a disk that answers when the test lets it.
class GatewayTest : private Acsd::IMcsOutput
{
protected:
    ManualClock _clock;
    RecordingLogSink _log;
    SeededRandom _random{1};
    PlanEngine _engine{MakeTestOptions(false), MakeTestSite(), _random};
    Acsd::McsGateway _gateway{
        _clock,
        _random,
        Core::Logger(_log, "mcs"),
        Apps::LocalOffset(std::chrono::minutes(0)),
        _engine,
        *this,
        [this](PlanCommand command) {
            _host.Push(std::move(command));
        }};
    Planning::PlanEngineHost _host{
        _engine,
        _clock,
        [this](const EngineAction& action) {
            if (const auto* const reportOrNull = std::get_if<SendReport>(&action))
            {
                _gateway.Report(*reportOrNull);
            }
            if (const auto* const replyOrNull = std::get_if<ReplyCommand>(&action))
            {
                _gateway.Reply(*replyOrNull);
            }
        },
        [this](const StoreBatch& batch) {
            _batches.push_back(batch);
        }};
    std::vector<StoreBatch> _batches;
    std::vector<Protocol::AcsRequest> _sent;
    bool _bRegistered = false;
    std::size_t _replays = 0;

    /// As AcsClient does it: the session is registered before the event comes.
    void Register()
    {
        _bRegistered = true;
        _gateway.OnSessionEvent(Protocol::Registered{});
    }

    void BeginPlan(const std::string& planID)
    {
        _host.Push(SubmitPlan{MakeLogisticsPlan(planID), 1});
        _host.OnStored({});
        _host.Push(Planning::RobotInput{"LR01", LinkChanged{true}});
        StateChanged state;
        state.lastNodeID = "D-A01.CP01"; // where the plan begins: it starts without a drive
        _host.Push(Planning::RobotInput{"LR01", state});
    }

private:
    [[nodiscard]] bool IsRegistered() const override
    {
        return _bRegistered;
    }

    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request) override
    {
        _sent.push_back(request);
        return true;
    }

    void ReplayDone() override
    {
        ++_replays;
    }

    void SendStatus(const Protocol::AcsPayload& /*status*/) override
    {
    }

    void SendPosition(const Protocol::RobotPositionUpdate& /*positions*/) override
    {
    }

    void Answer(
        Protocol::EAcsCommand /*command*/,
        std::string_view /*transactionID*/,
        Protocol::EAckResult /*result*/,
        std::string_view /*message*/,
        const Protocol::AckPayload& /*payload*/) override
    {
    }

    void SetSiteOffset(std::chrono::minutes /*offset*/) override
    {
    }
};

} // namespace

TEST_CASE_METHOD(
    GatewayTest,
    "A refused command is logged with planId, transactionId, reason and field; repetitions are rate-limited per reason")
{
    Register();
    const auto submit = [this](const std::string& action, int number) {
        Protocol::ExecutionPlan plan;
        plan.planID = "P" + std::to_string(number);
        plan.steps = {{1, action, "A01.CP01", {}, {{"J", "A01.CP01", "AMR.CP01"}}}};
        _gateway.OnSessionEvent(Protocol::RequestReceived{{"T" + std::to_string(number), {}, std::move(plan)}, false});
    };
    submit("Fly", 0);
    REQUIRE(_log.GetLines().size() == 1);
    const RecordedLine& line = _log.GetLines().front();
    CHECK(line.message == "command refused");
    CHECK(line.HasField("command", "ExecutionPlan"));
    CHECK(line.HasField("planId", "P0"));
    CHECK(line.HasField("transactionId", "T0"));
    CHECK(line.HasField("field", "steps[0].action"));
    CHECK(std::ranges::any_of(line.fields, [](const auto& field) {
        return field.first == "reason" && field.second.starts_with("steps[0].action: expected one of");
    }));
    for (int number = 1; number < 100; ++number)
    {
        submit("Fly", number);
    }
    CHECK(_log.GetLines().size() == Apps::LogRateLimiter::BURST);
    _gateway.OnSessionEvent(Protocol::RequestReceived{{"T", {}, Protocol::CancelPlan{"P9", {}}}, false});
    while (_host.IsStoring())
    {
        _host.OnStored({});
    }
    CHECK(_log.GetLines().back().HasField("command", "CancelPlan"));
    CHECK(_log.GetLines().size() == Apps::LogRateLimiter::BURST + 1);
    _clock.Advance(Apps::LogRateLimiter::INTERVAL);
    submit("Fly", 100);
    CHECK(_log.GetLines().back().message == "command refused (95 similar lines suppressed)");
    CHECK(_log.GetLines().back().HasField("planId", "P100"));
}

TEST_CASE_METHOD(
    GatewayTest,
    "isConnected is the value that the MCS was sent last, not one that waits for a connection")
{
    _gateway.PublishWorking(true);
    CHECK(_gateway.GetPublishedWorkingOrNull() == std::nullopt);
    Register();
    CHECK(_gateway.GetPublishedWorkingOrNull() == true);
    _gateway.PublishWorking(false);
    CHECK(_gateway.GetPublishedWorkingOrNull() == false);

    _bRegistered = false;
    _gateway.OnSessionEvent(Protocol::LinkLost{"gone", true});
    _gateway.PublishWorking(true);
    CHECK(_gateway.GetPublishedWorkingOrNull() == false);
    Register();
    CHECK(_gateway.GetPublishedWorkingOrNull() == true);
}

TEST_CASE_METHOD(GatewayTest, "The log line of a refusal that is not about a field has no field")
{
    Register();
    Protocol::ExecutionPlan plan;
    plan.planID = "P1";
    plan.steps = {{1, "CassetteLoad", "A01.CP01", {}, {{"J", "A01.CP01", "AMR.CP01"}}}};
    _gateway.OnSessionEvent(Protocol::RequestReceived{{"T1", {}, std::move(plan)}, false});
    REQUIRE(_host.IsStoring());
    _host.OnStored(Core::Fail(Core::ECoreError::OutOfRange, "acsd.db", "room on the disk", "none"));
    const auto refused = std::ranges::find(_log.GetLines(), "command refused", &RecordedLine::message);
    REQUIRE(refused != _log.GetLines().end());
    CHECK(refused->HasField("planId", "P1"));
    CHECK(refused->HasField("field", ""));
    CHECK(std::ranges::any_of(refused->fields, [](const auto& field) {
        return field.first == "reason" && field.second.find(": expected ") != std::string::npos;
    }));
}

TEST_CASE_METHOD(GatewayTest, "A report that is being stored during a registration is not sent before it is stored")
{
    BeginPlan("P1");
    REQUIRE(_host.IsStoring());
    REQUIRE_FALSE(_engine.GetUnacknowledged().empty());

    Register();
    CHECK(_sent.empty());
    CHECK(_replays == 1);

    const std::size_t waiting = _engine.GetUnacknowledged().size();
    _host.OnStored({});
    CHECK(_sent.size() >= waiting);
    CHECK(_sent.front().transactionID == _engine.GetUnacknowledged().front().transactionID);
}

TEST_CASE_METHOD(GatewayTest, "A report between the registration and its event does not overtake the replay")
{
    BeginPlan("P1");
    _host.OnStored({});
    REQUIRE(_sent.empty());
    const std::size_t before = _engine.GetUnacknowledged().size();

    _bRegistered = true; // the event is on its way
    _host.Push(ControlPlan{EPlanControl::Resume, "P1", {}, 2});
    while (_host.IsStoring())
    {
        _host.OnStored({});
    }
    CHECK(_sent.empty());

    _gateway.OnSessionEvent(Protocol::Registered{});
    REQUIRE(_sent.size() > before);
    const std::vector<OutboxEntry> entries = _engine.GetUnacknowledged();
    CHECK(std::ranges::equal(_sent, entries, {}, &Protocol::AcsRequest::transactionID, &OutboxEntry::transactionID));
}

TEST_CASE_METHOD(
    GatewayTest,
    "A report that was acknowledged while the disk was busy is not replayed on the next connection")
{
    Register();
    BeginPlan("P1");
    while (_host.IsStoring())
    {
        _host.OnStored({});
    }
    REQUIRE(_sent.size() >= 2);
    const std::string first = _sent[0].transactionID;
    const std::string second = _sent[1].transactionID;

    _host.Push(SubmitPlan{MakeLogisticsPlan("P2"), 2});
    REQUIRE(_host.IsStoring());
    _gateway.OnSessionEvent(
        Protocol::Acked{Protocol::EAcsCommand::PlanReport, first, Protocol::EAckResult::Success, {}});
    REQUIRE(_engine.GetUnacknowledged().front().transactionID == first);
    _gateway.OnSessionEvent(Protocol::LinkLost{"reset", true});
    _sent.clear();
    Register();
    REQUIRE_FALSE(_sent.empty());
    CHECK(_sent.front().transactionID == second);

    _host.OnStored({});
    CHECK(_engine.GetUnacknowledged().front().transactionID == second);
}

TEST_CASE_METHOD(GatewayTest, "A report that another one replaces is not sent")
{
    const Planning::Alarm alarm{"LR01", "AGV-1", EAlarmLevel::Light, "blocked", {}, {}, {}};
    _gateway.Report(SendReport{{7, "T7", _clock.GetNow().wall, ErrorReport{alarm, true}}, std::nullopt});
    _gateway.Report(SendReport{{8, "T8", _clock.GetNow().wall, ErrorReport{alarm, false}}, 7});
    Register();
    REQUIRE(_sent.size() == 1);
    CHECK(_sent.front().transactionID == "T8");
}

TEST_CASE_METHOD(GatewayTest, "The reports in the store are replayed after a restart")
{
    OutboxEntry entry{7, "T7", _clock.GetNow().wall, PlanReport{"P0", EPlanState::Completed, {}}};
    StoredState state;
    state.outbox.push_back(entry);
    state.lastReportSequence = 7;
    _gateway.Restore(state.outbox);
    _host.Restore(std::move(state));

    Register();
    REQUIRE(_sent.size() == 1);
    CHECK(_sent.front().transactionID == "T7");
}

} // namespace ACS::Testing
