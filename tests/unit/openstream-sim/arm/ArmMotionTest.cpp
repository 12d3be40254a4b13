#include "arm/ArmMotion.hpp"

#include "arm/FlangePose.hpp"
#include "Catch.hpp"

#include <chrono>
#include <cmath>

using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr double STEP_SECONDS = 0.001;
constexpr double FASTEST = 250.0; ///< deg/s

/// Checks one whole motion at every millisecond: continuous, its velocity its derivative.
void CheckMotion(const ArmMotion& motion, std::chrono::milliseconds duration, std::chrono::milliseconds until)
{
    for (auto now = 0ms; now + 2ms <= until; now += 1ms)
    {
        const JointStates before = motion.GetStates(now, true);
        const JointStates middle = motion.GetStates(now + 1ms, true);
        const JointStates after = motion.GetStates(now + 2ms, true);
        for (std::size_t axis = 0; axis < AXES; ++axis)
        {
            const double slope = (after.position.at(axis) - before.position.at(axis)) / (2.0 * STEP_SECONDS);
            INFO("axis " << axis << " at " << now.count() << " of " << duration.count() << " ms");
            REQUIRE(middle.velocity.at(axis) == Approx(slope).margin(0.1));
            REQUIRE(std::abs(slope) < FASTEST);
        }
    }
}

} // namespace

TEST_CASE("A motion begins and ends at home and at rest, and its velocity is its derivative")
{
    for (const auto duration : {200ms, 2'000ms, 10'000ms})
    {
        ArmMotion motion;
        motion.Begin(duration);
        CheckMotion(motion, duration, duration);
        for (const auto now : {0ms, std::chrono::milliseconds(duration)})
        {
            const JointStates states = motion.GetStates(now, true);
            for (std::size_t axis = 0; axis < AXES; ++axis)
            {
                REQUIRE(states.position.at(axis) == Approx(HOME.at(axis)).margin(1e-9));
                REQUIRE(states.velocity.at(axis) == Approx(0.0).margin(1e-9));
            }
        }
    }
}

TEST_CASE("An abandoned motion leaves the arm at its position; the next one moves it home without a jump")
{
    ArmMotion motion;
    motion.Begin(2s);
    const JointVector left = motion.GetStates(700ms, true).position;
    motion.End(700ms);
    REQUIRE(motion.GetStates(0ms, false).position == left);
    REQUIRE(left != HOME);
    motion.Begin(2s);
    REQUIRE(motion.GetStates(0ms, true).position == left);
    CheckMotion(motion, 2s, 2s);
    motion.End(2s);
    REQUIRE(motion.GetStates(0ms, false).position[0] == Approx(HOME[0]).margin(1e-9));
}

TEST_CASE("A halted arm has no velocity, gravity's effort is about 94 Nm on axes 2 and 3")
{
    ArmMotion motion;
    REQUIRE(motion.GetStates(0ms, false).effort[1] == Approx(94.0));
    REQUIRE(motion.GetStates(0ms, false).effort[2] == Approx(94.0));
    motion.Begin(2s);
    REQUIRE(motion.GetStates(500ms, false).velocity == JointVector{});
    REQUIRE(motion.GetStates(500ms, true).velocity != JointVector{});
}

TEST_CASE(
    "C From the ends of the axes' ranges no program drives an axis too fast or too far, and it comes nearer to home")
{
    for (const bool bHighest : {false, true})
    {
        for (const auto duration : {200ms, 2'000ms, 5'900ms, 6'100ms, 30'000ms, 600'000ms})
        {
            ArmMotion motion;
            JointVector start{};
            for (std::size_t axis = 0; axis < AXES; ++axis)
            {
                start.at(axis) = bHighest ? AXIS_LIMITS.at(axis).highest : AXIS_LIMITS.at(axis).lowest;
            }
            motion.Place(start);
            REQUIRE(motion.GetStates(1s, false).position == start);
            motion.Begin(duration);
            for (auto now = 0ms; now <= duration; now += 20ms)
            {
                const JointStates states = motion.GetStates(now, true);
                INFO(now.count() << " of " << duration.count() << " ms");
                REQUIRE(FindAxisOutside(states.position) == AXES);
                for (std::size_t axis = 0; axis < AXES; ++axis)
                {
                    REQUIRE(std::abs(states.velocity.at(axis)) <= AXIS_LIMITS.at(axis).speed);
                }
            }
            motion.End(duration);
            const JointVector end = motion.GetStates(0ms, false).position;
            REQUIRE(std::abs(end[0]) < std::abs(start[0]));
            REQUIRE((end[0] == Approx(0.0).margin(1e-9)) == (duration >= 5'900ms));
        }
    }
}

TEST_CASE("C From home no program drives an axis too fast, whatever its duration")
{
    for (auto duration = 100ms; duration <= 20'000ms; duration += 100ms)
    {
        ArmMotion motion;
        motion.Begin(duration);
        for (int part = 0; part <= 200; ++part)
        {
            const JointStates states = motion.GetStates(duration * part / 200, true);
            for (std::size_t axis = 0; axis < AXES; ++axis)
            {
                REQUIRE(std::abs(states.velocity.at(axis)) <= AXIS_LIMITS.at(axis).speed);
            }
        }
    }
}

TEST_CASE("The flange follows the axes: a turn of axis 1 turns it about the base, a level wrist keeps it level")
{
    const FlangePose home = ComputeFlangePose(HOME);
    REQUIRE(home.x == Approx(1070.0));
    REQUIRE(home.y == Approx(0.0).margin(1e-9));
    REQUIRE(home.z == Approx(1320.0));
    const FlangePose left = ComputeFlangePose({90.0, 90.0, 0.0, 0.0, 0.0, 0.0});
    REQUIRE(left.x == Approx(0.0).margin(1e-9));
    REQUIRE(left.y == Approx(1070.0));
    REQUIRE(left.rz == Approx(90.0));
    const FlangePose rolled = ComputeFlangePose({0.0, 90.0, 0.0, 0.0, 0.0, 30.0});
    REQUIRE(rolled.rx == Approx(30.0));
    REQUIRE(rolled.x == Approx(home.x));
    const FlangePose up = ComputeFlangePose({0.0, 90.0, 45.0, 0.0, 0.0, 0.0});
    REQUIRE(up.z > home.z);
    REQUIRE(up.ry == Approx(-45.0));
    const FlangePose level = ComputeFlangePose({0.0, 90.0, 45.0, 0.0, -45.0, 0.0});
    REQUIRE(level.ry == Approx(0.0).margin(1e-9));
}
