#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"

#include <algorithm>
#include <utility>

namespace ACS::VDA5050::Test
{

namespace
{

using Names = std::vector<std::string>;

constexpr EBlockingType NONE = EBlockingType::None;
constexpr EBlockingType SOFT = EBlockingType::Soft;
constexpr EBlockingType HARD = EBlockingType::Hard;

Core::JsonText Text(std::string_view text)
{
    return Core::JsonText::FromString(text);
}

} // namespace

TEST_CASE("5.2 Which actions of a node run in parallel, by their blocking types")
{
    struct Case
    {
        std::vector<EBlockingType> types; ///< Of a, b, c, … at the first node.
        std::vector<std::string> groups;  ///< Started together, each when the group before has ended.
        std::size_t drivesAfter;          ///< Groups that have ended when the vehicle may drive.
    };
    const std::vector<Case> cases{
        {{NONE}, {"a"}, 0},
        {{SOFT}, {"a"}, 1},
        {{HARD}, {"a"}, 1},
        {{NONE, NONE}, {"ab"}, 0},
        {{NONE, SOFT}, {"ab"}, 1},
        {{SOFT, NONE}, {"ab"}, 1},
        {{SOFT, SOFT}, {"ab"}, 1},
        {{NONE, HARD}, {"a", "b"}, 2},
        {{HARD, NONE}, {"a", "b"}, 1},
        {{SOFT, HARD}, {"a", "b"}, 2},
        {{HARD, SOFT}, {"a", "b"}, 2},
        {{HARD, HARD}, {"a", "b"}, 2},
        {{NONE, SOFT, HARD, NONE, SOFT}, {"ab", "c", "de"}, 3},
        {{HARD, NONE, HARD, NONE}, {"a", "b", "c", "d"}, 3},
        {{NONE, HARD, HARD, SOFT, NONE}, {"a", "b", "c", "de"}, 4},
    };
    for (std::size_t index = 0; index < cases.size(); ++index)
    {
        const Case& scheduling = cases[index];
        CAPTURE(index);
        VehicleSessionFixture bench;
        OrderMessage order = MakeOrder(2, 2);
        for (std::size_t action = 0; action < scheduling.types.size(); ++action)
        {
            const std::string name(1, static_cast<char>('a' + action));
            order.nodes[0].actions.push_back(MakeAction(name, scheduling.types[action]));
        }
        bench.Order(order);
        for (std::size_t group = 0; group < scheduling.groups.size(); ++group)
        {
            CAPTURE(group);
            CHECK(Pick<DriveTo>(bench.GetOutput()).empty() == (group < scheduling.drivesAfter));
            std::string started;
            for (const std::string& name : bench.GetStartedActions())
            {
                started += name;
            }
            std::string expected;
            for (std::size_t before = 0; before <= group; ++before)
            {
                expected += scheduling.groups[before];
            }
            CHECK(started == expected);
            for (const char name : scheduling.groups[group])
            {
                bench.Status(std::string(1, name), EActionStatus::Running);
                // A failed one counts as done.
                bench.Status(std::string(1, name), group % 2 == 0 ? EActionStatus::Finished : EActionStatus::Failed);
            }
        }
        CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    }
}

TEST_CASE("5.2 A HARD action waits for one that still runs from the node before, and the vehicle stops there")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[0].actions.push_back(MakeAction("long", NONE));
    order.nodes[1].actions.push_back(MakeAction("alone", HARD));
    bench.Order(order);
    bench.Status("long", EActionStatus::Running);
    REQUIRE(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].bStopAtNode);
    bench.Reach(2);
    CHECK(bench.GetStartedActions() == Names{"long"});
    CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    bench.Status("long", EActionStatus::Finished);
    CHECK(bench.GetStartedActions() == Names{"long", "alone"});
}

TEST_CASE("5.2 SOFT and HARD actions of an edge run before the edge is entered, NONE while it is driven")
{
    for (const EBlockingType blocking : {NONE, SOFT, HARD})
    {
        CAPTURE(static_cast<int>(blocking));
        VehicleSessionFixture bench;
        OrderMessage order = MakeOrder(3, 3);
        order.edges[1].actions.push_back(MakeAction("e", blocking));
        bench.Order(order);
        CHECK(Pick<DriveTo>(bench.GetOutput())[0].bStopAtNode == (blocking != NONE));
        bench.Reach(2);
        CHECK(bench.GetStartedActions() == Names{"e"});
        CHECK(bench.GetSession().GetState().edgeStates.size() == 1);
        CHECK(Pick<DriveTo>(bench.GetOutput()).size() == (blocking == NONE ? 2 : 1));
        bench.Status("e", EActionStatus::Running);
        bench.Status("e", EActionStatus::Finished);
        CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 2);
    }
}

TEST_CASE("5.2 Edge actions end with the edge: FINISHED if the arrival states so, else FAILED with a warning")
{
    struct Case
    {
        std::vector<EdgeActionEnd> ends;
        EActionStatus status;
        bool bStopRequested;
    };
    const std::vector<Case> cases{
        {{{"e", EActionStatus::Finished}}, EActionStatus::Finished, false},
        {{{"e", EActionStatus::Failed}}, EActionStatus::Failed, false},
        {{{"e", EActionStatus::Running}}, EActionStatus::Failed, true},
        {{}, EActionStatus::Failed, true},
    };
    for (const Case& end : cases)
    {
        VehicleSessionFixture bench;
        OrderMessage order = MakeOrder(2, 2);
        order.edges[0].actions.push_back(MakeAction("e", NONE, "detectObject"));
        bench.Order(order);
        bench.Status("e", EActionStatus::Running);
        bench.Clear();
        bench.Reach(2, true, end.ends);
        CHECK(bench.GetStatus("e") == end.status);
        CHECK(Pick<StopAction>(bench.GetOutput()).size() == (end.bStopRequested ? 1 : 0));
        CHECK(bench.HasError(ErrorTypes::ACTION_ERROR) == (end.status == EActionStatus::Failed));
        CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
    }
}

TEST_CASE("5.1 An action that has not begun cannot be set to RUNNING, and a terminal status never changes")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 2);
    order.nodes[1].actions.push_back(MakeAction("later", NONE));
    bench.Order(order);
    VehicleActions out;
    CHECK_FALSE(bench.GetSession().TrySetActionStatus("later", EActionStatus::Running, {}, bench.GetNow(), out));
    CHECK(bench.GetStatus("later") == EActionStatus::Waiting);
    bench.Reach(2);
    bench.Status("later", EActionStatus::Running);
    bench.Status("later", EActionStatus::Finished);
    CHECK_FALSE(bench.GetSession().TrySetActionStatus("later", EActionStatus::Failed, {}, bench.GetNow(), out));
    CHECK_FALSE(bench.GetSession().TrySetActionStatus("unknown", EActionStatus::Running, {}, bench.GetNow(), out));
    bench.Instant("startPause", "p1");
    CHECK_FALSE(bench.GetSession().TrySetActionStatus("p1", EActionStatus::Failed, {}, bench.GetNow(), out));
}

TEST_CASE("5.5 What is removed from actionStates, and when")
{
    VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
    OrderMessage order = MakeOrder(3, 2);
    order.nodes[1].actions.push_back(MakeAction("base", NONE, "startCharging"));
    order.nodes[2].actions.push_back(MakeAction("horizon", NONE, "startCharging"));
    bench.Order(order);
    bench.Instant("stateRequest", "ended");
    bench.Instant("logReport", "runs", {{"reason", Text("test")}});
    bench.Status("runs", EActionStatus::Running);
    const auto list = [&bench] {
        Names ids;
        for (const ActionState& action : bench.GetSession().GetState().actionStates)
        {
            ids.push_back(action.actionID);
        }
        return ids;
    };
    CHECK(list() == Names{"base", "horizon", "ended", "runs"});
    OrderBuilder builder = MakeBuilder(3);
    REQUIRE(builder.MakeOrder(2).has_value());
    bench.Order(*builder.MakeUpdate(3)); // drops the horizon's action and nothing else
    CHECK(list() == Names{"base", "ended", "runs"});
    bench.Reach(2);
    bench.Status("base", EActionStatus::Running);
    bench.Status("base", EActionStatus::Finished);
    bench.Reach(4);
    CHECK(list() == Names{"base", "ended", "runs"});
    OrderMessage next = MakeOrder(1, 1, "order-2");
    next.nodes[0].nodeID = "N2";
    bench.Order(next); // all but the instant action that runs
    CHECK(list() == Names{"runs"});
}

TEST_CASE("5.6 Instant actions do not make the vehicle busy, and do not wait for the order's actions")
{
    VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
    bench.Instant("startCharging", "charge");
    bench.Status("charge", EActionStatus::Running);
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions.push_back(MakeAction("hard", HARD, "startCharging"));
    bench.Order(order);
    CHECK(bench.GetSession().GetState().orderID == "order-1");
    CHECK(bench.GetStartedActions() == Names{"charge", "hard"});
    bench.Status("hard", EActionStatus::Running);
    bench.Instant("logReport", "log", {{"reason", Text("test")}});
    CHECK(bench.GetStartedActions() == Names{"charge", "hard", "log"});
}

TEST_CASE("5.6 An invalid instant action fails alone, with a warning that names it")
{
    struct Case
    {
        const char* name;
        Action action;
    };
    Action unknown = MakeAction("bad", HARD, "makeCoffee");
    Action inOrder = MakeAction("bad", HARD, "drop");
    Action without = MakeAction("bad", HARD, "logReport");
    Action null = MakeAction("bad", HARD, "startCharging");
    null.actionParameters = {{"what", Core::JsonText()}};
    const std::vector<Case> cases{
        {"unknown", unknown},
        {"not instant", inOrder},
        {"a parameter missing", without},
        {"a parameter null", null}};
    for (const Case& instant : cases)
    {
        CAPTURE(instant.name);
        VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
        bench.Instant(
            {MakeAction("good1", NONE, "startCharging"), instant.action, MakeAction("good2", NONE, "stateRequest")});
        if (instant.action.actionParameters.empty())
        {
            CHECK(bench.GetStatus("good2") == EActionStatus::Finished);
            CHECK(bench.GetStartedActions() == Names{"good1"});
            CHECK(bench.GetStatus("bad") == EActionStatus::Failed);
            const StateMessage state = bench.GetPublishedState();
            REQUIRE(state.errors.size() == 1);
            CHECK(state.errors[0].errorType == ErrorTypes::INSTANT_ACTION_ERROR);
            CHECK(state.errors[0].errorLevel == EErrorLevel::Warning);
            CHECK(*FindReferenceOrNull(state.errors[0], "actionId") == "bad");
        }
        else
        {
            // null may be refused with the whole message; it is not performed.
            CHECK(bench.GetSession().GetState().errors.size() == 1);
        }
    }
}

TEST_CASE("5.6 More instant actions than the factsheet allows fail, an action without an id is a validationError")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptionsOfStandard();
    options.factsheet.protocolLimits.maxArrayLengths.instantActions = 1;
    VehicleSessionFixture bench(options);
    bench.Instant({MakeAction("i1", NONE, "stateRequest"), MakeAction("i2", NONE, "stateRequest")});
    CHECK(bench.GetStatus("i1") == EActionStatus::Finished);
    CHECK(bench.GetStatus("i2") == EActionStatus::Failed);
    bench.Instant({MakeAction("", NONE, "stateRequest")});
    CHECK(bench.HasError(ErrorTypes::VALIDATION_ERROR));
}

} // namespace ACS::VDA5050::Test
