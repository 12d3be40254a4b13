#include "vda-sim/SliceClock.hpp"

#include "Catch.hpp"

#include <chrono>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VdaSim::SliceClock;

constexpr Core::SteadyTime CLOCK_START{1h};

} // namespace

TEST_CASE("SliceClock: whole slices only; the rest counts towards the next")
{
    SliceClock clock(1.0);
    CHECK(clock.CountSlices(CLOCK_START) == 0);
    CHECK(clock.StartTick() == 50ms);
    CHECK(clock.CountSlices(CLOCK_START + 15ms) == 0);
    CHECK(clock.CountSlices(CLOCK_START + 50ms) == 2);
    CHECK(clock.CountSlices(CLOCK_START + 61ms) == 1);
}

TEST_CASE("SliceClock: no simulated time passes between OnTick and the next StartTick")
{
    SliceClock clock(1.0);
    static_cast<void>(clock.StartTick());
    CHECK(clock.CountSlices(CLOCK_START) == 0);
    clock.OnTick();
    CHECK_FALSE(clock.IsTicking());
    CHECK(clock.CountSlices(CLOCK_START + 1s) == 0);
    static_cast<void>(clock.StartTick());
    CHECK(clock.CountSlices(CLOCK_START + 1030ms) == 1);
}

TEST_CASE("SliceClock: the time scale gives more slices and shorter ticks, within limits")
{
    SliceClock fast(10.0);
    CHECK(fast.StartTick() == 10ms);
    CHECK(fast.CountSlices(CLOCK_START) == 0);
    CHECK(fast.CountSlices(CLOCK_START + 11ms) == 5);
    CHECK(SliceClock(0.1).StartTick() == 50ms);
}

TEST_CASE("SliceClock: a process that was suspended skips at most five seconds ahead")
{
    SliceClock clock(1.0);
    static_cast<void>(clock.StartTick());
    CHECK(clock.CountSlices(CLOCK_START) == 0);
    CHECK(clock.CountSlices(CLOCK_START + 1h) <= 250);
}

} // namespace ACS::Testing
