#include "restart/StartupBarrier.hpp"

#include "Catch.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

TEST_CASE("StartupBarrier: work from before the start is held back until the release")
{
    StartupBarrier barrier;
    barrier.Begin(true);
    CHECK(barrier.IsWaiting());
    CHECK(barrier.IsHoldingWork());
    CHECK(barrier.TryRelease());
    CHECK_FALSE(barrier.IsWaiting());
    CHECK_FALSE(barrier.IsHoldingWork());
    CHECK_FALSE(barrier.TryRelease());
}

TEST_CASE("StartupBarrier: without work it waits for the robots and holds nothing back")
{
    StartupBarrier barrier;
    CHECK_FALSE(barrier.IsWaiting());
    barrier.Begin(false);
    CHECK(barrier.IsWaiting());
    CHECK_FALSE(barrier.IsHoldingWork());
    CHECK_FALSE(barrier.TryRelease());
    CHECK_FALSE(barrier.IsWaiting());
}
