#include "engine/InputQueue.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"

#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

/// A queue in which the events of LR01 have reached their limit.
class InputQueueTest
{
protected:
    InputQueue _queue{{2, 1'000'000, 1, 2, 4}};

    InputQueueTest()
    {
        Push(LinkChanged{false});
        Push(LinkChanged{true});
        Push(NodePassed{"D1", "N1"});
        Push(MakeState("N1"));
    }

    [[nodiscard]] static StateChanged MakeState(const std::string& nodeID)
    {
        StateChanged state;
        state.lastNodeID = nodeID;
        return state;
    }

    void Push(RobotEvent event)
    {
        EngineInput input = RobotInput{"LR01", std::move(event)};
        REQUIRE(_queue.TryPush(input));
    }

    [[nodiscard]] bool TryPush(PlanCommand command)
    {
        EngineInput input = std::move(command);
        return _queue.TryPush(input);
    }

    [[nodiscard]] std::vector<RobotEvent> PopEvents()
    {
        std::vector<RobotEvent> events;
        while (!_queue.IsEmpty())
        {
            InputQueue::Next next = _queue.Pop();
            events.push_back(std::get<RobotInput>(next).event);
        }
        return events;
    }
};

using Events = std::vector<RobotEvent>;

} // namespace

TEST_CASE_METHOD(InputQueueTest, "Beyond the limit of a robot, its latest state replaces the one before it")
{
    Push(MakeState("N2"));
    Push(NodePassed{"D1", "N3"});
    Push(MakeState("N3"));
    Push(MakeState("N4"));
    CHECK(
        PopEvents()
        == Events{
            LinkChanged{false},
            LinkChanged{true},
            NodePassed{"D1", "N1"},
            MakeState("N2"),
            NodePassed{"D1", "N3"},
            MakeState("N4")});
}

TEST_CASE_METHOD(
    InputQueueTest,
    "Beyond the limit of a robot, connections that have ended are dropped, disconnections stay")
{
    for (int i = 0; i < 100; ++i)
    {
        Push(LinkChanged{false});
        Push(LinkChanged{true});
        Push(LinkChanged{true});
        Push(MakeState("N5"));
        Push(MakeState("N6"));
    }
    CHECK(
        PopEvents()
        == Events{
            LinkChanged{false},
            LinkChanged{true},
            NodePassed{"D1", "N1"},
            LinkChanged{false},
            LinkChanged{true},
            MakeState("N6")});
}

TEST_CASE_METHOD(InputQueueTest, "Of the jobs that a robot can do and of its compatibility, only the latest waits")
{
    Push(CompatibilityChanged{"a"});
    Push(JobCheckChanged{});
    Push(CompatibilityChanged{"b"});
    Push(JobCheckChanged{});
    CHECK(_queue.GetCount() == 6);
    CHECK(PopEvents()[4] == RobotEvent(CompatibilityChanged{"b"}));
}

TEST_CASE_METHOD(InputQueueTest, "Other robots, timers and acknowledgements are not limited by one robot and wait once")
{
    for (int i = 0; i < 3; ++i)
    {
        EngineInput timer = EngineTimer{EEngineTimer::JobTimeout, "LR01"};
        EngineInput other = RobotInput{"CR01", MakeState("N" + std::to_string(i))};
        REQUIRE(_queue.TryPush(timer));
        REQUIRE(_queue.TryPush(other));
        REQUIRE(TryPush(MessageAcknowledged{7}));
    }
    CHECK(_queue.GetCount() == 9);
    const InputQueue::Next next = _queue.Pop();
    const auto& commands = std::get<InputQueue::Commands>(next);
    REQUIRE(commands.size() == 1);
    CHECK(commands.front().command == PlanCommand(MessageAcknowledged{7}));
}

TEST_CASE_METHOD(InputQueueTest, "A timer that was cancelled after it expired is removed, and can expire again")
{
    static_cast<void>(PopEvents());
    const EngineTimer timer{EEngineTimer::JobTimeout, "LR01"};
    EngineInput expired = timer;
    _queue.Remove(timer);
    REQUIRE(_queue.TryPush(expired));
    Push(LinkChanged{false});
    _queue.Remove({EEngineTimer::JobTimeout, "CR01"});
    CHECK(_queue.GetCount() == 2);
    _queue.Remove(timer);
    CHECK(PopEvents() == std::vector<RobotEvent>{LinkChanged{false}});
    REQUIRE(_queue.TryPush(expired));
    CHECK(_queue.GetCount() == 1);
}

TEST_CASE_METHOD(InputQueueTest, "Of the states of the store's log, only the latest waits")
{
    static_cast<void>(PopEvents());
    for (std::uint64_t bytes = 1; bytes <= 3; ++bytes)
    {
        EngineInput input = StoreLog{"acsd.db", bytes, 0, {}};
        REQUIRE(_queue.TryPush(input));
    }
    CHECK(_queue.GetCount() == 1);
    CHECK(std::get<StoreLog>(_queue.Pop()).bytes == 3);
    EngineInput input = StoreLog{"acsd.db", 4, 0, {}};
    REQUIRE(_queue.TryPush(input));
    CHECK(std::get<StoreLog>(_queue.Pop()).bytes == 4);
    REQUIRE(_queue.IsEmpty());
}

TEST_CASE_METHOD(
    InputQueueTest,
    "Each class of commands has its own limit, which is free again when they have been handled")
{
    const auto submit = [](const std::string& planID) {
        return SubmitPlan{MakeLogisticsPlan(planID), 1};
    };
    static_cast<void>(PopEvents());
    for (int i = 0; i < 3; ++i)
    {
        INFO(i);
        REQUIRE(TryPush(submit("P1")));
        REQUIRE(TryPush(submit("P2")));
        REQUIRE_FALSE(TryPush(submit("P3")));
        REQUIRE(TryPush(ControlPlan{EPlanControl::Pause, i == 0 ? "P2" : "P9", {}, 0}));
        REQUIRE_FALSE(TryPush(ControlPlan{EPlanControl::Pause, "P2", {}, 0}));
        REQUIRE(TryPush(ControlTSC{true}));
        REQUIRE(TryPush(SkipStep{"P1", 1}));
        REQUIRE_FALSE(TryPush(ControlTSC{false}));
        while (!_queue.IsEmpty())
        {
            static_cast<void>(_queue.Pop());
        }
    }
}

TEST_CASE_METHOD(
    InputQueueTest,
    "Commands of the operator that stop work are next, with those before them, but not twice in a row")
{
    const auto pop = [this] {
        const InputQueue::Next next = _queue.Pop();
        const auto* const commandsOrNull = std::get_if<InputQueue::Commands>(&next);
        return commandsOrNull == nullptr ? 0 : commandsOrNull->size();
    };
    const PlanCommand stop = GENERATE(
        PlanCommand(BlockPlace{EBlockKind::Node, "N2", "spill", 2}),
        PlanCommand(ControlTSC{true, 2}),
        PlanCommand(SetMaintenance{"LR01", true, 2}));
    const PlanCommand other =
        GENERATE(PlanCommand(UnblockPlace{EBlockKind::Node, "N2", 1}), PlanCommand(ControlTSC{false, 1}));
    REQUIRE(TryPush(other));
    CHECK(pop() == 0);
    REQUIRE(TryPush(stop));
    CHECK(pop() == 2);
    REQUIRE(TryPush(stop));
    CHECK(pop() == 0);
    CHECK(pop() == 1);
    CHECK(pop() == 0);
}

TEST_CASE_METHOD(InputQueueTest, "Plans are limited in bytes too; a longer one waits alone")
{
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.front().jobs.resize(100'000);
    REQUIRE(TryPush(SubmitPlan{plan}));
    CHECK_FALSE(TryPush(SubmitPlan{MakeLogisticsPlan("P2")}));
    CHECK(_queue.Clear() == std::vector<PlanCommand>{SubmitPlan{plan}});
    CHECK(_queue.IsEmpty());
    CHECK(TryPush(SubmitPlan{MakeLogisticsPlan("P2")}));
}

} // namespace ACS::Testing
