#include "plans/PlanTurns.hpp"

#include "Catch.hpp"

#include <cstddef>
#include <vector>

using ACS::McsSim::PlanTurns;

TEST_CASE("Plans that claim one thing go in their order, others at once")
{
    PlanTurns turns;
    turns.Add(0, {"A01.CP01", "A02.CP03"});
    turns.Add(1, {"A01.CP02"});
    turns.Add(2, {"A01.CP02", "A02.CP03"});
    turns.Add(3, {"A02.CP03"});
    CHECK(turns.IsFirst(0));
    CHECK(turns.IsFirst(1));
    CHECK_FALSE(turns.IsFirst(2));
    CHECK_FALSE(turns.IsFirst(3));
    CHECK(turns.End(1).empty()); // 2 waits for 0, too
    CHECK(turns.End(0) == std::vector<std::size_t>{2});
    CHECK(turns.End(2) == std::vector<std::size_t>{3});
    CHECK(turns.End(3).empty());
}

TEST_CASE("The end of one plan can let several go, and a plan without claims waits for none")
{
    PlanTurns turns;
    turns.Add(0, {"A", "B"});
    turns.Add(1, {});
    turns.Add(2, {"B"});
    turns.Add(3, {"A"});
    CHECK(turns.IsFirst(1));
    CHECK(turns.IsFirst(4)); // was never added
    CHECK(turns.End(4).empty());
    CHECK(turns.End(0) == std::vector<std::size_t>{2, 3});
    CHECK(turns.End(0).empty());
}
