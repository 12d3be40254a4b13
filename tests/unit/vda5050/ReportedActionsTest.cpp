#include "ReportedActions.hpp"

#include "Catch.hpp"
#include "Vda5050Sample.hpp"

#include <string>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

ReportedAction MakeHeld(const std::string& actionID, EActionScope scope, EBlockingType blockingType)
{
    Action action = MakeAction(actionID, blockingType);
    ActionState state{actionID, action.actionType, {}, EActionStatus::Waiting, {}};
    return ReportedAction{std::move(action), ActionMachine(std::move(state)), scope, {}, 0, false, false};
}

std::vector<std::string> ListIDs(const ReportedActions& actions)
{
    std::vector<std::string> ids;
    for (const ReportedAction& held : actions)
    {
        ids.push_back(held.action.actionID);
    }
    return ids;
}

} // namespace

TEST_CASE("6.11 Actions are found by their id, wherever others were erased, and stay in the order of the report")
{
    ReportedActions actions;
    for (int i = 0; i < 100; ++i)
    {
        actions.Add(MakeHeld("a" + std::to_string(i), EActionScope::Node, EBlockingType::None));
    }
    actions.EraseIf([](const ReportedAction& held) { return held.action.actionID.size() == 3; });
    CHECK(actions.GetSize() == 10);
    CHECK(actions.CountOpen() == 10);
    CHECK(actions.FindOrNull("a42") == nullptr);
    REQUIRE(actions.FindOrNull("a7") != nullptr);
    CHECK(actions.FindOrNull("a7")->action.actionID == "a7");
    actions.Erase(actions.begin());
    ReportedActions moved = std::move(actions);
    CHECK(ListIDs(moved) == std::vector<std::string>{"a1", "a2", "a3", "a4", "a5", "a6", "a7", "a8", "a9"});
    CHECK(moved.FindOrNull("a9")->action.actionID == "a9");
    CHECK(moved.FindOrNull("a0") == nullptr);
}

TEST_CASE("6.11 Running actions are counted by what they block, from start to end; instant actions block nothing")
{
    struct Case
    {
        EActionScope scope;
        EBlockingType blockingType;
        std::size_t running;
        std::size_t blocking;
        std::size_t hard;
    };
    const std::vector<Case> cases{
        {EActionScope::Node, EBlockingType::None, 1, 0, 0},
        {EActionScope::Edge, EBlockingType::Soft, 1, 1, 0},
        {EActionScope::Node, EBlockingType::Hard, 1, 1, 1},
        {EActionScope::Instant, EBlockingType::Hard, 0, 0, 0},
    };
    for (const Case& row : cases)
    {
        for (const bool bErased : {false, true})
        {
            CAPTURE(row.scope, row.blockingType, bErased);
            ReportedActions actions;
            ReportedAction& held = actions.Add(MakeHeld("a", row.scope, row.blockingType));
            const bool bInstant = row.scope == EActionScope::Instant;
            CHECK(actions.CountInstant() == (bInstant ? 1 : 0));
            CHECK(actions.CountOpen() == (bInstant ? 0 : 1));
            CHECK(actions.CountRunning() == 0);
            actions.MarkStarted(held);
            CHECK(actions.TrySetStatus(held, EActionStatus::Running));
            CHECK(actions.CountRunning() == row.running);
            CHECK(actions.CountRunningBlocking() == row.blocking);
            CHECK(actions.CountRunningHard() == row.hard);
            if (bErased)
            {
                actions.Erase(actions.begin());
                CHECK(actions.CountInstant() == 0);
            }
            else
            {
                CHECK(actions.TrySetStatus(held, EActionStatus::Finished, "done"));
                CHECK_FALSE(actions.TrySetStatus(held, EActionStatus::Running));
                CHECK(held.machine.GetState().resultDescription == "done");
            }
            CHECK(actions.CountOpen() == 0);
            CHECK(actions.CountRunning() + actions.CountRunningBlocking() + actions.CountRunningHard() == 0);
        }
    }
}

} // namespace ACS::VDA5050::Test
