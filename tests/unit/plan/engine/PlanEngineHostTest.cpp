#include "Catch.hpp"
#include "fixtures/HostTest.hpp"
#include "fixtures/PlanWorld.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;

namespace
{

using Texts = std::vector<std::string>;
using Replies = std::vector<std::pair<ReplyToken, bool>>;

const Core::Error DISK_FULL{make_error_code(EPlanningError::StoreFailed), "acsd.db", "room", "disk full"};

} // namespace

TEST_CASE_METHOD(
    HostTest,
    "4.1 Plans that arrive while the disk works share the next commit, and each is acknowledged after it")
{
    Submit("P1", 1);
    REQUIRE(_batches.size() == 1);
    CHECK(_host.IsStoring());
    Submit("P2", 2);
    Submit("P3", 3);
    Submit("P2", 4);
    CHECK(_batches.size() == 1);
    CHECK(_replies.empty());
    _host.OnStored({});
    CHECK(ListReplies() == Replies{{1, true}});
    REQUIRE(_batches.size() == 2);
    CHECK(ListAdded(_batches[1]) == Texts{"P2", "P3"});
    _host.OnStored({});
    CHECK(ListReplies() == Replies{{1, true}, {2, true}, {3, true}, {4, false}});
    CHECK_FALSE(_host.IsStoring());
}

TEST_CASE_METHOD(
    HostTest,
    "4.1 Plans that arrive together and cannot be stored are all refused with the reason, and none is kept")
{
    Submit("P0", 10);
    Submit("P1", 1);
    Submit("P2", 2);
    Submit("P1", 3);
    _host.OnStored({});
    REQUIRE(ListAdded(_batches.back()) == Texts{"P1", "P2"});
    _host.OnStored(tl::unexpected(DISK_FULL));
    CHECK(ListReplies() == Replies{{10, true}, {1, false}, {2, false}, {3, false}});
    CHECK(_replies[1].message.find("disk full") != std::string::npos);
    CHECK(_replies[3].message.find("Duplicated Plan") != std::string::npos); // refused before it, for its own reason
    CHECK_FALSE(_engine.GetPlanOrNull("P1").has_value());
    CHECK_FALSE(_engine.GetPlanOrNull("P2").has_value());
    CHECK(_engine.GetPlanOrNull("P0").has_value());
}

TEST_CASE_METHOD(
    HostTest,
    "A store that is lost without a write raises an alarm, refuses plans and is retried until it works")
{
    Submit("P0", 10);
    _host.OnStoreLost(DISK_FULL); // A batch that is being written fails by itself if the store is lost.
    CHECK(_engine.GetActiveAlarms().empty());
    _host.OnStored({});
    const std::size_t stored = _batches.size();
    _host.OnStoreLost(DISK_FULL);
    _host.OnStoreLost(DISK_FULL);
    REQUIRE(_engine.GetActiveAlarms().size() == 1);
    CHECK(_engine.GetActiveAlarms()[0].errorCode == "ACS-1005");
    CHECK(_engine.GetActiveAlarms()[0].message == "Plans cannot be stored: " + Core::Describe(DISK_FULL));
    CHECK(_engine.GetPlanOrNull("P0").has_value());
    CHECK(_batches.size() == stored);
    const EngineTimer retry{EEngineTimer::StoreRetry, {}};
    CHECK(std::ranges::count(_timers, retry) == 1);
    Submit("P1", 1);
    REQUIRE(_host.IsStoring());
    _host.OnStored(tl::unexpected(DISK_FULL));
    CHECK(ListReplies() == Replies{{10, true}, {1, false}});
    _host.Push(retry);
    REQUIRE(_host.IsStoring());
    REQUIRE(TryStoreAll());
    _host.Push(retry);
    REQUIRE(TryStoreAll());
    CHECK(_engine.GetActiveAlarms().empty());
    Submit("P2", 2);
    REQUIRE(TryStoreAll());
    CHECK(ListReplies() == Replies{{10, true}, {1, false}, {2, true}});
}

TEST_CASE_METHOD(
    HostTest,
    "Waiting events of robots and controls are handled before plans, and plans before commands of the operator")
{
    Submit("P1", 1);
    _host.Push(PlanCommand(SetMaintenance{"CR01", false, 2}));
    Submit("P2", 3);
    _host.Push(PlanCommand(ControlPlan{EPlanControl::Cancel, "P1", {}, 4}));
    Submit("P3", 5);
    _host.Push(RobotInput{"LR01", LinkChanged{true}});
    _host.OnStored({});
    while (_host.IsStoring() && _replies.size() < 2)
    {
        _host.OnStored({});
    }
    CHECK(ListReplies() == Replies{{1, true}, {4, true}});
    CHECK(ListAdded(_batches.back()) == Texts{"P2", "P3"});
    CHECK(_engine.GetRobotStatuses().front().status != ERobotStatus::Disconnected);
    REQUIRE(TryStoreAll());
    CHECK(ListReplies() == Replies{{1, true}, {4, true}, {3, true}, {5, true}, {2, true}});
}

TEST_CASE_METHOD(HostTest, "6.5 Controls of a plan that waits are handled in the order of their arrival")
{
    Submit("P1", 1);
    Submit("P2", 2);
    _host.Push(ControlPlan{EPlanControl::Pause, "P2", {}, 3});
    _host.OnStored({}); // now P2 is being stored
    _host.Push(ControlPlan{EPlanControl::Resume, "P2", {}, 4});
    REQUIRE(TryStoreAll());
    CHECK(ListReplies() == std::vector<std::pair<ReplyToken, bool>>{{1, true}, {2, true}, {3, true}, {4, true}});
    CHECK(_engine.GetPlanOrNull("P2")->state == EPlanState::Pending);
}

TEST_CASE_METHOD(HostTest, "6.5 A control of a plan that still waits is handled after the plan")
{
    Submit("P1", 1);
    Submit("P2", 2);
    _host.Push(PlanCommand(ControlPlan{EPlanControl::Cancel, "P2", {}, 3}));
    Submit("P3", 4);
    _host.OnStored({});
    CHECK(ListAdded(_batches.back()) == Texts{"P2"});
    REQUIRE(TryStoreAll());
    CHECK(ListReplies() == Replies{{1, true}, {2, true}, {3, true}, {4, true}});
    CHECK(_engine.GetPlanOrNull("P2")->state == EPlanState::Cancelled);
    CHECK(_engine.GetPlanOrNull("P3")->state == EPlanState::Pending);
}

TEST_CASE_METHOD(
    HostTest,
    "Commands of the operator that wait together share one commit, and each is answered after it")
{
    constexpr ReplyToken COMMANDS = 500;
    Submit("P1", 0);
    for (ReplyToken token = 1; token <= COMMANDS; ++token)
    {
        _host.Push(PlanCommand(SetMaintenance{token % 3 == 0 ? "LR01" : "CR01", token % 2 == 0, token}));
    }
    _host.OnStored({});
    REQUIRE(_batches.size() == 2);
    CHECK(
        std::ranges::count_if(
            _batches[1].changes,
            [](const StoreChange& change) { return std::holds_alternative<MaintenanceChanged>(change); })
        > 300);
    CHECK(_replies.size() == 1);
    _host.OnStored({});
    CHECK(_replies.size() == COMMANDS + 1);
    CHECK(std::ranges::all_of(_replies, &ReplyCommand::bAccepted));
}

TEST_CASE_METHOD(
    HostTest,
    "Robots whose events never end do not keep plans and commands of the operator from being handled")
{
    Submit("P1", 1);
    _host.Push(RobotInput{"LR01", LinkChanged{true}});
    Submit("P2", 2);
    _host.Push(PlanCommand(SetMaintenance{"CR01", false, 3}));
    bool bOnline = true;
    int commits = 0;
    while (_replies.size() < 3 && commits < 100)
    {
        bOnline = !bOnline;
        _host.Push(RobotInput{"LR01", LinkChanged{bOnline}}); // each is stored: it sets or clears an alarm
        REQUIRE(_host.IsStoring());
        _host.OnStored({});
        ++commits;
    }
    CHECK(ListReplies() == Replies{{1, true}, {2, true}, {3, true}});
    CHECK(commits < 50);
}

TEST_CASE_METHOD(
    HostTest,
    "A million inputs during an hour in which the disk hangs wait in limited number; every request is answered")
{
    constexpr int ROUNDS = 100'000;
    constexpr std::size_t LIMIT = 3'000;
    Submit("P", 0);
    REQUIRE(_host.IsStoring());
    ReplyToken token = 0;
    std::size_t longest = 0;
    StateChanged state;
    state.lastNodeID = "D-CHG01";
    for (int i = 0; i < ROUNDS; ++i)
    {
        _clock.Advance(36ms);
        const std::string number = std::to_string(i);
        for (const std::string robotID : {"LR01", "CR01"})
        {
            _host.Push(RobotInput{robotID, LinkChanged{i % 2 == 0}});
            state.errors = {{"AGV-" + number, EAlarmLevel::Light, "changes each time"}};
            state.x = i;
            _host.Push(RobotInput{robotID, state});
            _host.Push(RobotInput{robotID, CompatibilityChanged{i % 2 == 0 ? "" : number}});
            _host.Push(EngineTimer{EEngineTimer::HomeRetry, robotID});
        }
        _host.Push(PlanCommand(MessageAcknowledged{1}));
        Submit("P" + number, ++token);
        _host.Push(PlanCommand(ControlPlan{EPlanControl::Cancel, "unknown", {}, ++token, "T" + number}));
        _host.Push(PlanCommand(ClearAlarms{"LR01", "AGV-1", {}, {}, ++token}));
        longest = std::max(longest, _host.GetWaitingCount());
    }
    CHECK(longest < LIMIT);
    REQUIRE(_replies.size() > token - LIMIT);
    CHECK(
        _replies.front().message
        == "The ACS has not stored earlier requests yet. Send the request again later, with a new transactionId.");
    CHECK(std::ranges::none_of(_replies, &ReplyCommand::bAccepted));

    for (std::size_t i = 0; i < LIMIT && _host.IsStoring(); ++i)
    {
        _host.OnStored({});
    }
    REQUIRE_FALSE(_host.IsStoring());
    CHECK(_replies.size() == token + 1);
    std::ranges::sort(_replies, {}, &ReplyCommand::replyToken);
    CHECK(std::ranges::adjacent_find(_replies, {}, &ReplyCommand::replyToken) == _replies.end());
    // The latest of the robots: offline, in the last round.
    CHECK(_engine.GetRobotStatuses().front().status == ERobotStatus::Disconnected);
    CHECK(_host.GetWaitingCount() == 0);
}

TEST_CASE_METHOD(
    HostTest,
    "A job whose robot disconnects while its command waits for the disk is sent once more, not before the reconnect")
{
    StateChanged state;
    state.lastNodeID = "D-A01.CP01"; // where the plan begins
    Submit("P1", 1);
    _host.Push(RobotInput{"LR01", LinkChanged{true}});
    _host.Push(RobotInput{"LR01", state});
    const auto hasJob = [](const StoreChange& change) {
        const auto* const workOrNull = std::get_if<RobotWorkChanged>(&change);
        return workOrNull != nullptr && workOrNull->job.has_value();
    };
    while (_host.IsStoring() && std::ranges::none_of(_batches.back().changes, hasJob))
    {
        _host.OnStored({});
    }
    REQUIRE(_host.IsStoring());
    REQUIRE(_jobs.empty());
    _host.Push(RobotInput{"LR01", LinkChanged{false}});
    REQUIRE(TryStoreAll());
    REQUIRE(_jobs.size() == 1);
    _host.Push(RobotInput{"LR01", JobUnknown{"P1-a4"}}); // The adapter reports this because it had not sent the job.
    REQUIRE(TryStoreAll());
    CHECK(_jobs.size() == 1);
    CHECK(_engine.GetPlanOrNull("P1")->state == EPlanState::InProgress);

    _host.Push(RobotInput{"LR01", LinkChanged{true}});
    _host.Push(RobotInput{"LR01", state});
    REQUIRE(TryStoreAll());
    REQUIRE(_jobs.size() == 2);
    CHECK(_jobs[1].commandID == _jobs[0].commandID);
}

TEST_CASE_METHOD(
    HostTest,
    "While the disk hangs, states of a robot that differ only in pose and battery are merged; the order is kept")
{
    StateChanged state;
    state.lastNodeID = "D-CHG01";
    state.bPoseKnown = true;
    _host.Push(RobotInput{"LR01", LinkChanged{true}});
    Submit("P1", 1);
    REQUIRE(_host.IsStoring());
    for (int i = 0; i < 10'000; ++i)
    {
        state.x += 0.01;
        state.batteryPercent = 100 - i / 1'000.0;
        _host.Push(RobotInput{"LR01", state});
        _host.Push(RobotInput{"CR01", state}); // another robot's between them
    }
    CHECK(_host.GetWaitingCount() == 2);
    state.errors.push_back({"AGV-x", EAlarmLevel::Light, "temporary"});
    _host.Push(RobotInput{"LR01", state});
    state.errors.clear();
    _host.Push(RobotInput{"LR01", state});
    CHECK(_host.GetWaitingCount() == 4);
    _host.Push(RobotInput{"LR01", LinkChanged{false}});
    _host.Push(RobotInput{"LR01", LinkChanged{true}});
    state.x = 7;
    _host.Push(RobotInput{"LR01", state}); // After the new connection.
    CHECK(_host.GetWaitingCount() == 7);
    while (_host.IsStoring())
    {
        _host.OnStored({});
    }
    REQUIRE(_engine.GetRobotPoses().size() == 1);
    CHECK(_engine.GetRobotPoses().front().x == 7);
}

TEST_CASE_METHOD(
    HostTest,
    "The receipt of a command of the operator is in the transaction of the command, whether it waited or not")
{
    const auto makeReceipt = [](const std::string& key) {
        return CommandReceipt{"lee", key, "accepted", {}};
    };
    const auto listKeys = [](const StoreBatch& batch) {
        Texts keys;
        for (const StoreChange& change : batch.changes)
        {
            if (const auto* const addedOrNull = std::get_if<ReceiptAdded>(&change))
            {
                keys.push_back(addedOrNull->receipt.key);
            }
        }
        return keys;
    };
    const auto hasChange = [](const StoreBatch& batch, const StoreChange& wanted) {
        return std::ranges::find(batch.changes, wanted) != batch.changes.end();
    };
    REQUIRE(_host.Offer(ControlTSC{true, 0}, makeReceipt("pause")) == EInputAdmission::Accepted);
    REQUIRE(_batches.size() == 1);
    CHECK(listKeys(_batches.back()) == Texts{"pause"});
    CHECK(_batches.back().changes.size() > 1);

    Submit("P1", 1); // waits, as all after it
    const ControlPlan control{EPlanControl::Pause, "P1", {}, 0, {}, EControlOrigin::Operator};
    REQUIRE(_host.Offer(control, makeReceipt("control")) == EInputAdmission::Accepted);
    REQUIRE(_host.Offer(SetMaintenance{"LR01", true, 0}, makeReceipt("on")) == EInputAdmission::Accepted);
    REQUIRE(_host.Offer(SetMaintenance{"CR01", true, 0}) == EInputAdmission::Accepted);
    REQUIRE(_host.Offer(SetMaintenance{"LR01", true, 0}, makeReceipt("again")) == EInputAdmission::Accepted);
    REQUIRE(TryStoreAll());
    Texts keys;
    for (const StoreBatch& batch : _batches)
    {
        CAPTURE(listKeys(batch));
        const Texts found = listKeys(batch);
        keys.insert(keys.end(), found.begin(), found.end());
        CHECK(hasChange(batch, MaintenanceChanged{"LR01", true}) == (found == Texts{"on", "again"}));
        CHECK((std::ranges::count(found, "control") == 0 || batch.changes.size() > 1));
    }
    CHECK(keys == Texts{"pause", "on", "again", "control"}); // what stops work is handled first

    // Without any effect.
    REQUIRE(_host.Offer(SetMaintenance{"LR01", true, 0}, makeReceipt("none")) == EInputAdmission::Accepted);
    CHECK(_batches.back().changes == std::vector<StoreChange>{ReceiptAdded{makeReceipt("none")}});
}

TEST_CASE_METHOD(HostTest, "A command of the operator that is refused after it has waited for the store has no receipt")
{
    Submit("P1", 1);
    REQUIRE(TryStoreAll());
    _batches.clear();
    Submit("P2", 2); // is written
    const ControlPlan control{EPlanControl::Abort, "P1", {}, 9, {}, EControlOrigin::Operator};
    REQUIRE(_host.Offer(control, CommandReceipt{"lee", "abort", "accepted", {}}) == EInputAdmission::Accepted);
    _host.OnStored(Core::Fail(make_error_code(EPlanningError::StoreFailed), "store", "room", "disk full"));
    CHECK(ListReplies().back() == std::pair<ReplyToken, bool>{9, false});
    _batches.clear();
    _host.Push(EngineTimer{EEngineTimer::StoreRetry, {}}); // it writes all that was kept
    REQUIRE_FALSE(_batches.empty());
    REQUIRE(TryStoreAll());
    for (const StoreBatch& batch : _batches)
    {
        CHECK(std::ranges::none_of(batch.changes, [](const StoreChange& change) {
            return std::holds_alternative<ReceiptAdded>(change);
        }));
    }
}

TEST_CASE_METHOD(HostTest, "A plan is listed when it is stored, so that one that cannot be stored is never shown")
{
    Submit("P1", 1);
    CHECK(_engine.GetActivePlans().empty());
    _host.OnStored(Core::Fail(make_error_code(EPlanningError::StoreFailed), "store", "room", "disk full"));
    CHECK(_engine.GetActivePlans().empty());
    REQUIRE(TryStoreAll());
    Submit("P2", 2);
    _host.OnStored({});
    CHECK(_engine.GetActivePlans().size() == 1);
    REQUIRE(TryStoreAll());
    Submit("P3", 3);
    CHECK(_engine.GetActivePlans().size() == 1);
}

TEST_CASE_METHOD(
    HostTest,
    "4.1, R1 A closed loop still sends what waits for the batch that is being written, and refuses new requests")
{
    Submit("P1", 1);
    Submit("P2", 2);
    _host.Close();
    Submit("P3", 3);
    _host.Push(PlanCommand(ControlPlan{EPlanControl::Cancel, "P1", {}, 4}));
    _host.Push(PlanCommand(MessageAcknowledged{1}));
    CHECK(_host.Offer(ControlTSC{true, 9}) == EInputAdmission::Closed);
    _host.OnStored({});
    CHECK(ListReplies() == Replies{{2, false}, {3, false}, {4, false}, {1, true}});
    CHECK(_batches.size() == 1);
    CHECK(std::ranges::count(_timers, EngineTimer{EEngineTimer::Dispatch, {}}) == 1);
}

} // namespace ACS::Testing
