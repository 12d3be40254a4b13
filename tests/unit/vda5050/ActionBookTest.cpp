#include "ActionBook.hpp"

#include "Catch.hpp"
#include "Vda5050Sample.hpp"

#include <string>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

/// Adds and queues the actions as those of one node.
void AddQueued(ActionBook& book, const std::vector<Action>& actions)
{
    for (const Action& action : actions)
    {
        book.AddOrderAction(action, EActionScope::Node, "N1", 2);
    }
    book.Enqueue(actions);
}

/// The actions that may start now.
std::vector<std::string> StartAll(ActionBook& book)
{
    std::vector<std::string> started;
    VehicleActions out;
    while (ReportedAction* const next = book.TakeStartableOrNull())
    {
        book.Start(*next, out);
        started.push_back(next->action.actionID);
    }
    return started;
}

} // namespace

TEST_CASE("6.11 A hard action waits for all that run, and holds up all that follow")
{
    const FactsheetMessage factsheet;
    ActionBook book(factsheet);
    AddQueued(
        book,
        {MakeAction("none", EBlockingType::None),
         MakeAction("soft", EBlockingType::Soft),
         MakeAction("hard", EBlockingType::Hard),
         MakeAction("last", EBlockingType::None)});
    CHECK(StartAll(book) == std::vector<std::string>{"none", "soft"});
    CHECK_FALSE(book.CanDrive());
    book.SetStatus({"none", "soft"}, EActionStatus::Finished);
    CHECK(StartAll(book) == std::vector<std::string>{"hard"});
    book.SetStatus({"hard"}, EActionStatus::Finished);
    CHECK(StartAll(book) == std::vector<std::string>{"last"});
    CHECK(book.CanDrive());
    CHECK(book.HasOpen());
}

TEST_CASE("6.6.3 Of a stopped order waiting actions fail at once, and running ones are asked to stop")
{
    const FactsheetMessage factsheet;
    ActionBook book(factsheet);
    AddQueued(book, {MakeAction("hard", EBlockingType::Hard), MakeAction("waiting", EBlockingType::None)});
    REQUIRE(StartAll(book) == std::vector<std::string>{"hard"});
    VehicleActions out;
    book.StopOrder("cancelled", out);
    CHECK(Pick<StopAction>(out) == std::vector{StopAction{"hard", false}});
    CHECK(book.FindOrNull("waiting")->machine.GetStatus() == EActionStatus::Failed);
    CHECK(book.HasOpen());
    CHECK(StartAll(book).empty());
    book.FailOrder("manual");
    CHECK_FALSE(book.HasOpen());
}

TEST_CASE("6.6 A new order removes all but the instant actions whose end was not shown")
{
    const FactsheetMessage factsheet;
    ActionBook book(factsheet);
    AddQueued(book, {MakeAction("of order", EBlockingType::None)});
    book.AddInstant(MakeAction("seen", EBlockingType::None), EActionStatus::Finished);
    book.MarkShown();
    book.AddInstant(MakeAction("unseen", EBlockingType::None), EActionStatus::Finished);
    book.BeginOrder();
    StateMessage state;
    book.Fill(state);
    REQUIRE(state.actionStates.size() == 1);
    CHECK(state.actionStates.front().actionID == "unseen");
}

TEST_CASE("6.8 An instant action that was evicted is not performed again")
{
    FactsheetMessage factsheet;
    factsheet.protocolLimits.maxArrayLengths.stateActionStates = 1;
    ActionBook book(factsheet);
    const Action first = MakeAction("first", EBlockingType::None);
    const Action second = MakeAction("second", EBlockingType::None);
    book.AddInstant(first, EActionStatus::Finished);
    CHECK_FALSE(book.TryMakeRoomFor(second));
    book.MarkShown();
    REQUIRE(book.TryMakeRoomFor(second));
    CHECK(book.FindOrNull("first") == nullptr);
    CHECK(book.IsRepeated(first));
    CHECK_FALSE(book.IsRepeated(second));
    CHECK_FALSE(book.FindClash(MakeAction("first", EBlockingType::None, "drop")).empty());
}

} // namespace ACS::VDA5050::Test
