#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

/// Both robots wait for one another: LR01 with plan P1 at A01.CP02, CR01 with plan P2 at A01.CP03.
void MakeBothWait(EngineParts& parts)
{
    parts.PutOn(parts.lr, "D-A01.CP02");
    parts.PutOn(parts.cr, "D-A01.CP03");
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    parts.assignment.Offer(parts.Add(MakeControlPlan("P2")), parts.cr);
    parts.lr.search.blockers = {parts.cr.index};
    parts.cr.search.blockers = {parts.lr.index};
}

} // namespace

TEST_CASE("WaitingRobots: the target is the retreat, then the place of the step, then the parking position")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    CHECK(parts.waiting.GetTargetOrNull(parts.lr) == parts.FindNode("D-CHG01"));
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    CHECK(parts.waiting.GetTargetOrNull(parts.lr) == parts.FindNode("D-A01.CP01"));
    CHECK_FALSE(parts.waiting.IsAtPlace(parts.lr));
    parts.PutOn(parts.lr, "D-A01.CP01");
    CHECK(parts.waiting.IsAtPlace(parts.lr));
    parts.lr.parking.retreatNode = parts.FindNode("D-CHG03");
    CHECK(parts.waiting.GetTargetOrNull(parts.lr) == parts.FindNode("D-CHG03"));
}

TEST_CASE("WaitingRobots: a target is held by the robot on it and by the robot on its way to it")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    parts.PutOn(parts.cr, "D-A01.CP01");
    const std::size_t target = parts.FindNode("D-A01.CP01");
    CHECK(parts.waiting.GetTargetHolders(parts.lr, target) == std::vector<std::size_t>{1});
    CHECK(parts.waiting.GetTargetHolders(parts.cr, target).empty());
    const std::size_t other = parts.FindNode("D-A01.CP06");
    CHECK(parts.waiting.GetTargetHolders(parts.lr, other).empty());
    parts.BeginDrive(parts.cr, "D-A01.CP06");
    CHECK(parts.waiting.GetTargetHolders(parts.lr, other) == std::vector<std::size_t>{1});
}

TEST_CASE("WaitingRobots: robots wait in the order of their plans, then idle ones outside their parking position")
{
    EngineParts parts;
    MakeBothWait(parts);
    CHECK(parts.waiting.GetWaiting() == std::vector<Robot*>{&parts.lr, &parts.cr});
    parts.lr.planOrNull->key.rank = parts.cr.planOrNull->key.rank + 1;
    CHECK(parts.waiting.GetWaiting() == std::vector<Robot*>{&parts.cr, &parts.lr});
    parts.lr.view.state->bAutomatic = false;
    CHECK(parts.waiting.GetWaiting() == std::vector<Robot*>{&parts.cr});
    CHECK(parts.waiting.ListAwayFromHome().empty());
    parts.work.EndPlan(*parts.cr.planOrNull, EPlanState::Aborted, {});
    CHECK(parts.waiting.ListAwayFromHome() == std::vector<Robot*>{&parts.cr});
    parts.cr.parking.bRefused = true;
    CHECK(parts.waiting.ListAwayFromHome().empty());
}

TEST_CASE("WaitingRobots: a deadlock is a cycle in which no robot moves")
{
    EngineParts parts;
    MakeBothWait(parts);
    CHECK(parts.waiting.ListDeadlocked() == std::vector<Robot*>{&parts.lr, &parts.cr});
    CHECK(parts.waiting.GetBlockersOf(parts.lr) == std::vector<Robot*>{&parts.cr, &parts.lr});
    parts.cr.activity = EActivity::Works;
    CHECK(parts.waiting.ListDeadlocked().empty());
    parts.cr.activity = EActivity::Waits;
    parts.lr.search.blockers.clear();
    parts.BeginDrive(parts.lr, "D-A01.CP06");
    CHECK(parts.waiting.ListDeadlocked().empty());
}

TEST_CASE("WaitingRobots: a robot yields until its leader has another step or cannot be helped")
{
    EngineParts parts;
    MakeBothWait(parts);
    WaitingRobots::YieldTo(parts.cr, parts.lr);
    CHECK(parts.waiting.IsYielding(parts.cr));
    CHECK_FALSE(parts.waiting.IsYielding(parts.lr));
    SECTION("the leader works at its step")
    {
        parts.lr.activity = EActivity::Works;
        CHECK_FALSE(parts.waiting.IsYielding(parts.cr));
    }
    SECTION("the leader has another step")
    {
        parts.lr.planOrNull->step = 1;
        CHECK_FALSE(parts.waiting.IsYielding(parts.cr));
    }
    SECTION("the leader waits for robots that cannot move")
    {
        parts.cr.view.bOnline = false;
        parts.places.NoteMovable(parts.cr);
        CHECK_FALSE(parts.waiting.IsYielding(parts.cr));
    }
    SECTION("the leader cannot move")
    {
        parts.lr.view.bOnline = false;
        parts.places.NoteMovable(parts.lr);
        CHECK_FALSE(parts.waiting.IsYielding(parts.cr));
    }
}
