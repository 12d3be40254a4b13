#include "arm/TrajectoryFollower.hpp"

#include "Catch.hpp"

#include <chrono>
#include <cmath>

using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Core::Duration;

namespace
{

JointVector MakePosition(double first)
{
    JointVector position = HOME;
    position[0] = first;
    return position;
}

/// Appends `count` points of 2 ms, each a step further on axis 1.
void AppendRamp(TrajectoryFollower& follower, int count, double step, Duration lookAhead, Duration now)
{
    const double from = follower.GetHeld()[0];
    for (int number = 1; number <= count; ++number)
    {
        const double time = 0.002 * number;
        follower.Append(TrajectoryPoint{MakePosition(from + step * number), 2ms}, time, lookAhead, now);
    }
}

} // namespace

TEST_CASE("C.2 The motion starts when the points last for the look-ahead time, one point per interval")
{
    TrajectoryFollower follower;
    AppendRamp(follower, 19, 0.1, 40ms, 0ms);
    REQUIRE(follower.TryAdvance(20ms));
    REQUIRE(follower.GetFree() == 2048 - 19);
    REQUIRE(follower.GetStates(20ms).position == HOME);
    follower.Append(TrajectoryPoint{MakePosition(2.0), 2ms}, 0.04, 40ms, 20ms); // the twentieth
    REQUIRE(follower.TryAdvance(20ms));
    for (int done = 0; done < 20; ++done)
    {
        REQUIRE(follower.TryAdvance(20ms + done * 2ms));
        REQUIRE(follower.GetFree() == static_cast<std::size_t>(2048 - 20 + done));
    }
    REQUIRE(follower.TryAdvance(60ms));
    REQUIRE(follower.GetFree() == 2048);
    REQUIRE(follower.IsResting());
}

TEST_CASE("C.2 Fewer points start when the first of them has waited for the look-ahead time")
{
    TrajectoryFollower follower;
    AppendRamp(follower, 2, 0.1, 40ms, 5ms);
    REQUIRE(follower.TryAdvance(44ms));
    REQUIRE(follower.GetStates(44ms).position == HOME);
    REQUIRE(follower.GetFree() == 2046);
    REQUIRE(follower.TryAdvance(49ms));
    REQUIRE(follower.GetFree() == 2048);
    REQUIRE(follower.GetStates(49ms).position[0] > 0.0);
}

TEST_CASE("C.2 After the buffer has run empty, the next points are buffered again")
{
    TrajectoryFollower follower;
    AppendRamp(follower, 20, 0.1, 40ms, 0ms);
    REQUIRE(follower.TryAdvance(1s));
    REQUIRE(follower.GetHeld() == MakePosition(2.0));
    AppendRamp(follower, 19, 0.1, 40ms, 1s);
    REQUIRE(follower.TryAdvance(1s + 39ms));
    REQUIRE(follower.GetFree() == 2048 - 19);
    REQUIRE(follower.TryAdvance(1s + 78ms));
    REQUIRE(follower.GetFree() == 2048);
}

TEST_CASE("C.2 Five points of 2 ms to 0.10 deg: the arm lags, is near 0.07 deg 50 ms later, and ends at the last point")
{
    TrajectoryFollower follower;
    AppendRamp(follower, 5, 0.02, 10ms, 0ms);
    REQUIRE(follower.TryAdvance(60ms));
    const JointStates later = follower.GetStates(60ms);
    REQUIRE(later.position[0] == Approx(0.072).margin(0.005));
    REQUIRE(later.velocity[0] > 0.0);
    REQUIRE(follower.IsActive(60ms));
    REQUIRE(follower.TryAdvance(1s));
    REQUIRE(follower.GetStates(1s).position[0] == Approx(0.1).margin(1e-6));
    REQUIRE(follower.GetStates(1s).velocity[0] == Approx(0.0).margin(1e-6));
    REQUIRE_FALSE(follower.IsActive(1s));
    REQUIRE(follower.GetHeld() == MakePosition(0.1)); // held
}

TEST_CASE("C.2 Where the arm is does not depend on how often it was asked, and its velocity is its derivative")
{
    TrajectoryFollower often;
    TrajectoryFollower once;
    AppendRamp(often, 100, 0.3, 0ms, 0ms);
    AppendRamp(once, 100, 0.3, 0ms, 0ms);
    for (Duration now = 0us; now < 300ms; now += 300us)
    {
        REQUIRE(often.TryAdvance(now));
        const JointStates states = often.GetStates(now);
        const double before = often.GetStates(now - 1us).position[0];
        const double after = often.GetStates(now + 1us).position[0];
        REQUIRE(states.velocity[0] == Approx((after - before) / 2e-6).margin(0.01));
    }
    REQUIRE(once.TryAdvance(299'700us));
    REQUIRE(once.GetStates(299'700us).position == often.GetStates(299'700us).position);
    REQUIRE(once.GetStates(299'700us).position[0] > 28.0);
}

TEST_CASE("C.2 On a long line the arm goes as fast as the points do, one lag behind")
{
    TrajectoryFollower follower;
    follower.Append(TrajectoryPoint{MakePosition(100.0), 1s}, 1.0, 0ms, 0ms);
    REQUIRE(follower.TryAdvance(900ms));
    REQUIRE(follower.GetStates(900ms).velocity[0] == Approx(100.0));
    REQUIRE(follower.GetStates(900ms).position[0] == Approx(90.0 - 4.0).margin(0.001));
}

TEST_CASE("C.3 A line that is too fast for an axis stops the arm where it is; the points stay until Begin")
{
    TrajectoryFollower follower;
    AppendRamp(follower, 50, 0.4, 0ms, 0ms); // 200 deg/s, which is the limit
    follower.Append(TrajectoryPoint{MakePosition(20.5), 2ms}, 0.102, 0ms, 0ms);
    follower.Append(TrajectoryPoint{MakePosition(20.5), 2ms}, 0.104, 0ms, 0ms);
    REQUIRE(follower.TryAdvance(99ms));
    REQUIRE_FALSE(follower.TryAdvance(101ms));
    REQUIRE(follower.IsBlocked());
    const JointStates stopped = follower.GetStates(101ms);
    REQUIRE(stopped.velocity == JointVector{});
    REQUIRE(stopped.position[0] > 0.0);
    REQUIRE(stopped.position[0] < 20.0);
    REQUIRE(follower.TryAdvance(10s)); // reported once
    REQUIRE(follower.GetStates(10s).position == stopped.position);
    REQUIRE(follower.GetFree() == 2046);
    follower.Begin(stopped.position, 10s);
    REQUIRE(follower.GetFree() == 2048);
    REQUIRE(follower.IsResting());
}

TEST_CASE("C.3 The limit holds from the first point on, for each axis, in both directions")
{
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        for (const double sign : {-1.0, 1.0})
        {
            INFO("axis " << axis << " sign " << sign);
            JointVector target = HOME;
            target.at(axis) += sign * AXIS_LIMITS.at(axis).speed * 0.1;
            TrajectoryFollower atLimit;
            atLimit.Append(TrajectoryPoint{target, 100ms}, 0.1, 0ms, 0ms);
            REQUIRE(atLimit.TryAdvance(1s));
            target.at(axis) += sign * 0.01;
            TrajectoryFollower above;
            above.Append(TrajectoryPoint{target, 100ms}, 0.1, 0ms, 0ms);
            REQUIRE_FALSE(above.TryAdvance(1s));
            REQUIRE(above.GetStates(1s).position == HOME);
        }
    }
}

TEST_CASE("C.4 A stopped trajectory stops the arm at once; a finished one lets it settle at the current command")
{
    TrajectoryFollower stopped;
    AppendRamp(stopped, 100, 0.2, 0ms, 0ms);
    REQUIRE(stopped.TryAdvance(101ms));
    const JointVector there = stopped.GetStates(101ms).position;
    stopped.Stop(101ms);
    REQUIRE(stopped.GetStates(101ms).position == there);
    REQUIRE(stopped.GetStates(101ms).velocity == JointVector{});
    REQUIRE(stopped.GetStates(1h).position == there);
    REQUIRE(stopped.IsBlocked());

    TrajectoryFollower finished;
    AppendRamp(finished, 100, 0.2, 0ms, 0ms);
    REQUIRE(finished.TryAdvance(101ms));
    finished.Finish(101ms);
    REQUIRE(finished.GetStates(101ms).position == there);
    REQUIRE(finished.GetFree() == 2048);
    REQUIRE(finished.IsActive(101ms));
    REQUIRE(finished.GetStates(1h).position[0] == Approx(10.1)); // of 20 that the points would have gone
    REQUIRE_FALSE(finished.IsActive(1h));
}

TEST_CASE("A agility: the arm follows as fast as the bandwidth allows, and is cleaned up for half a second")
{
    TrajectoryFollower plain;
    TrajectoryFollower agile;
    agile.SetAgility(TrajectoryAgility{true, 50.0});
    TrajectoryFollower none;
    none.SetAgility(TrajectoryAgility{true, 0.0});
    for (TrajectoryFollower* follower : {&plain, &agile, &none})
    {
        AppendRamp(*follower, 5, 0.02, 0ms, 0ms);
        REQUIRE(follower->TryAdvance(12ms));
    }
    REQUIRE(agile.GetStates(12ms).position[0] > 2.0 * plain.GetStates(12ms).position[0]);
    REQUIRE(none.GetStates(12ms).position == plain.GetStates(12ms).position);
    REQUIRE(agile.IsActive(509ms)); // 500 ms after the last point
    REQUIRE_FALSE(agile.IsActive(510ms));
    REQUIRE_FALSE(plain.IsActive(400ms));
}

TEST_CASE("C.2 The buffer has room for 2048 points")
{
    TrajectoryFollower follower;
    AppendRamp(follower, 2048, 0.0, 10s, 0ms);
    REQUIRE(follower.GetFree() == 0);
    REQUIRE(follower.TryAdvance(3ms));
    REQUIRE(follower.GetFree() == 0); // buffering: 4.096 s of 10 s are there
    REQUIRE(follower.TryAdvance(10s + 2ms));
    REQUIRE(follower.GetFree() == 1);
}
