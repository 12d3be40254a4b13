#include "vda-sim/VehicleMotion.hpp"

#include "Catch.hpp"
#include <acs/vda5050/TrajectoryCurve.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace ACS::Testing
{
namespace
{

using VdaSim::EBrake;
using VdaSim::LegPath;
using VdaSim::MapPoint;
using VdaSim::MotionLeg;
using VdaSim::VehicleMotion;

constexpr double SLICE = 0.02;
constexpr double EXACT = 1e-9;
constexpr double QUARTER = std::numbers::pi / 2;

/// A quarter of a circle round the origin, exactly: from (r, 0) to (0, r).
VDA5050::Trajectory MakeQuarterCircle(double radius)
{
    VDA5050::Trajectory curve;
    curve.degree = 2;
    curve.knotVector = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
    curve.controlPoints = {{radius, 0.0, 1.0}, {radius, radius, std::numbers::sqrt2 / 2}, {0.0, radius, 1.0}};
    return curve;
}

Core::NurbsCurve MakeNurbsCurve(const VDA5050::Trajectory& trajectory)
{
    return Core::NurbsCurve(VDA5050::MakeNurbs(trajectory));
}

MotionLeg MakeStraight(double length)
{
    MotionLeg leg;
    leg.path = LegPath({{0.0, 0.0}, {length, 0.0}});
    leg.maxSpeed = 1.2;
    return leg;
}

/// Seconds until the leg ends; the watcher sees each slice.
double RunLeg(VehicleMotion& motion, const std::function<void()>& watch = {}, double limit = 200.0)
{
    double seconds = 0.0;
    while (seconds < limit)
    {
        const bool bDone = motion.TryFinishLeg(SLICE);
        seconds += SLICE;
        if (watch)
        {
            watch();
        }
        if (bDone)
        {
            break;
        }
    }
    return seconds;
}

} // namespace

TEST_CASE("7 A NURBS of degree 2 with the right weights is a circle")
{
    const Core::NurbsCurve curve = MakeNurbsCurve(MakeQuarterCircle(2.0));
    for (int i = 0; i <= 100; ++i)
    {
        const MapPoint point = curve.GetPoint(i / 100.0);
        CHECK(std::hypot(point.x, point.y) == Approx(2.0).margin(EXACT));
    }
    CHECK(curve.GetPoint(0.0) == MapPoint{2.0, 0.0});
    CHECK(curve.GetPoint(1.0).x == Approx(0.0).margin(EXACT));
    CHECK(curve.GetPoint(7.0) == curve.GetPoint(1.0));
}

TEST_CASE("7 A NURBS without weights and with inner knots goes where the recursion of its basis functions goes")
{
    VDA5050::Trajectory curve;
    curve.degree = 3;
    curve.knotVector = {0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 1.0, 1.0, 1.0, 1.0};
    curve.controlPoints = {{0, 0, {}}, {1, 2, {}}, {3, 3, {}}, {4, 0, {}}, {6, 1, {}}, {7, 7, {}}};
    // The definition by Cox and de Boor, as slow as it is.
    const auto& knots = curve.knotVector;
    const std::function<double(std::size_t, std::size_t, double)> getBasis =
        [&](std::size_t index, std::size_t degree, double place) -> double {
        if (degree == 0)
        {
            return knots[index] <= place && place < knots[index + 1] ? 1.0 : 0.0;
        }
        const double left = knots[index + degree] - knots[index];
        const double right = knots[index + degree + 1] - knots[index + 1];
        return (left > 0.0 ? (place - knots[index]) / left * getBasis(index, degree - 1, place) : 0.0)
            + (right > 0.0 ? (knots[index + degree + 1] - place) / right * getBasis(index + 1, degree - 1, place)
                           : 0.0);
    };
    const Core::NurbsCurve nurbs = MakeNurbsCurve(curve);
    for (int step = 0; step < 50; ++step)
    {
        const double place = step / 50.0;
        MapPoint expected;
        for (std::size_t i = 0; i < curve.controlPoints.size(); ++i)
        {
            expected.x += curve.controlPoints[i].x * getBasis(i, 3, place);
            expected.y += curve.controlPoints[i].y * getBasis(i, 3, place);
        }
        CHECK(nurbs.GetPoint(place).x == Approx(expected.x).margin(EXACT));
        CHECK(nurbs.GetPoint(place).y == Approx(expected.y).margin(EXACT));
    }
    CHECK(nurbs.GetPoint(1.0) == MapPoint{7.0, 7.0});
}

TEST_CASE("7 A curve of degree 1 is its corners, and knots that all are one place are a point")
{
    VDA5050::Trajectory corners;
    corners.knotVector = {0.0, 0.0, 0.5, 1.0, 1.0};
    corners.controlPoints = {{0, 0, {}}, {3, 0, {}}, {3, 4, {}}};
    CHECK(MakeNurbsCurve(corners).Sample(0.05, 400) == std::vector<MapPoint>{{0, 0}, {3, 0}, {3, 4}});
    VDA5050::Trajectory point = MakeQuarterCircle(1.0);
    point.knotVector = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    CHECK(MakeNurbsCurve(point).Sample(0.05, 400).size() == 1);
}

TEST_CASE("However long a curve is, it has no more than some hundred samples")
{
    const LegPath path = LegPath::Create({1e5, 0.0}, {0.0, 1e5}, MakeQuarterCircle(1e5));
    CHECK(path.CountSamples() <= 402);
    CHECK(path.GetLength() == Approx(1e5 * QUARTER).epsilon(1e-4));
    // The numbers of an order are any numbers.
    VDA5050::Trajectory endless = MakeQuarterCircle(1.0);
    endless.controlPoints[1].x = 1e308;
    endless.controlPoints[1].weight = 1e308;
    CHECK(LegPath::Create({1.0, 0.0}, {0.0, 1.0}, endless).CountSamples() <= 402);
}

TEST_CASE("7 A curve has no more samples than asked for, also where it has more knots; its ends are among them")
{
    VDA5050::Trajectory curve;
    curve.degree = 2;
    curve.knotVector = {0.0, 0.0, 0.0};
    for (int i = 0; i <= 1000; ++i)
    {
        curve.controlPoints.push_back({1.0 * i, i % 2 == 0 ? 0.0 : 1.0, {}});
    }
    for (int i = 1; i <= 998; ++i)
    {
        curve.knotVector.push_back(i / 999.0);
    }
    curve.knotVector.insert(curve.knotVector.end(), 3, 1.0);
    for (const std::size_t most : {std::size_t{2}, std::size_t{100}, std::size_t{400}})
    {
        const std::vector<MapPoint> samples = MakeNurbsCurve(curve).Sample(0.05, most);
        CHECK(samples.size() == most);
        CHECK(samples.front() == MapPoint{0.0, 0.0});
        CHECK(samples.back() == MapPoint{1000.0, 0.0});
    }
}

TEST_CASE("A vehicle that has left the beginning of the curve joins it at the nearest place")
{
    const MapPoint middle{std::numbers::sqrt2, std::numbers::sqrt2};
    const LegPath path = LegPath::Create(middle, {0.0, 2.0}, MakeQuarterCircle(2.0));
    CHECK(path.GetLength() == Approx(QUARTER).margin(0.05));
}

TEST_CASE("A straight leg is a trapezoid of speed: the acceleration, the edge's speed, the deceleration")
{
    VdaSim::MotionLimits limits;
    limits.acceleration = 0.5;
    limits.deceleration = 1.0;
    VehicleMotion motion(limits, {});
    motion.Begin(MakeStraight(10.0));
    double fastest = 0.0;
    double last = 0.0;
    const double seconds = RunLeg(motion, [&]() {
        CHECK(motion.GetSpeed() - last <= 0.5 * SLICE + EXACT);
        if (motion.HasLeg() && motion.GetDriven() < 9.99)
        {
            CHECK(last - motion.GetSpeed() <= 1.0 * SLICE + 0.005); // the last slices cannot be exact
        }
        last = motion.GetSpeed();
        fastest = std::max(fastest, last);
    });
    CHECK(fastest == Approx(1.2));
    // 2.4 s and 1.44 m to 1.2 m/s, 1.2 s and 0.72 m to a stop, 7.84 m between them.
    CHECK(seconds == Approx(2.4 + 1.2 + 7.84 / 1.2).margin(0.2));
    CHECK(motion.GetPose() == VdaSim::Pose{10.0, 0.0, 0.0});
    CHECK(motion.GetSpeed() == 0.0);
}

TEST_CASE("A short leg is a triangle of speed")
{
    VehicleMotion motion({}, {});
    motion.Begin(MakeStraight(1.0));
    double fastest = 0.0;
    RunLeg(motion, [&]() { fastest = std::max(fastest, motion.GetSpeed()); });
    CHECK(fastest == Approx(std::sqrt(0.6)).margin(0.03)); // v² = 2 a s, half the way
}

TEST_CASE("On a curve the vehicle stays on it, looks along it and keeps to its turn speed and its lateral acceleration")
{
    const double radius = 2.0;
    VdaSim::MotionLimits limits;
    const double lateral = std::sqrt(limits.lateralAcceleration * radius); // 1 m/s
    for (const double maxTurnSpeed : {1.2, 0.2})
    {
        VehicleMotion motion(limits, {radius, 0.0, QUARTER});
        MotionLeg leg;
        leg.path = LegPath::Create({radius, 0.0}, {0.0, radius}, MakeQuarterCircle(radius));
        leg.maxSpeed = 1.4;
        leg.maxTurnSpeed = maxTurnSpeed;
        motion.Begin(leg);
        double fastest = 0.0;
        RunLeg(motion, [&]() {
            const VdaSim::Pose& pose = motion.GetPose();
            CHECK(std::hypot(pose.x, pose.y) == Approx(radius).margin(0.001));
            CHECK(std::abs(motion.GetTurnSpeed()) <= maxTurnSpeed + EXACT);
            const double tangent = std::atan2(pose.y, pose.x) + QUARTER;
            CHECK(std::abs(VdaSim::NormaliseAngle(pose.theta - tangent)) < 0.06);
            fastest = std::max(fastest, motion.GetSpeed());
        });
        const double expected = std::max(std::min(lateral, maxTurnSpeed * radius), limits.cornerSpeed);
        CHECK(fastest == Approx(expected).epsilon(0.05));
        CHECK(motion.GetPose().x == 0.0);
        CHECK(motion.GetPose().y == radius);
    }
}

TEST_CASE("Before a corner within a trajectory the vehicle brakes in time")
{
    VehicleMotion motion({}, {});
    MotionLeg leg;
    leg.path = LegPath({{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}});
    leg.maxSpeed = 1.2;
    motion.Begin(leg);
    double atCorner = 9.0;
    double before = 0.0;
    RunLeg(motion, [&]() {
        if (std::abs(motion.GetDriven() - 5.0) < 0.03)
        {
            atCorner = std::min(atCorner, motion.GetSpeed());
        }
        before = motion.GetDriven() < 5.0 ? std::max(before, motion.GetSpeed()) : before;
    });
    CHECK(before == Approx(1.2));
    CHECK(atCorner == Approx(0.3).margin(0.08));
    CHECK(motion.GetPose().y == 5.0);
}

TEST_CASE("Each brake has its own stopping distance, and the leg continues when it is released")
{
    for (const auto& [brake, way] : std::vector<std::pair<EBrake, double>>{
             {EBrake::Service, 1.2},
             {EBrake::Emergency, 0.24},
             {EBrake::Block, 0.0}})
    {
        VehicleMotion motion({}, {});
        motion.Begin(MakeStraight(20.0));
        RunLeg(motion, {}, 5.0);
        REQUIRE(motion.GetSpeed() == Approx(1.2));
        const double before = motion.GetPose().x;
        motion.SetBrake(brake);
        RunLeg(motion, {}, 5.0);
        CHECK(motion.IsStanding());
        CHECK(motion.GetPose().x - before == Approx(way).margin(0.03));
        motion.SetBrake(EBrake::None);
        CHECK_FALSE(motion.IsStanding());
        RunLeg(motion);
        CHECK(motion.GetPose().x == 20.0);
    }
}

TEST_CASE("A turn on the spot is a trapezoid of turn speed, there and at the end of a way")
{
    const VdaSim::MotionLimits limits;
    for (const bool bBefore : {true, false})
    {
        VehicleMotion motion(limits, {});
        MotionLeg leg = MakeStraight(bBefore ? 1.0 : 0.0);
        leg.bTurnBefore = bBefore;
        leg.heading = bBefore ? std::optional(2.0 * QUARTER) : std::optional(0.0);
        leg.finalTheta = 2.0 * QUARTER;
        motion.Begin(std::move(leg));
        double last = 0.0;
        double fastest = 0.0;
        double turning = 0.0;
        RunLeg(motion, [&]() {
            const double turnSpeed = std::abs(motion.GetTurnSpeed());
            CHECK(std::abs(turnSpeed - last) <= limits.turnAcceleration * SLICE * 1.5);
            turning += turnSpeed > 0.0 ? SLICE : 0.0;
            fastest = std::max(fastest, turnSpeed);
            last = turnSpeed;
        });
        CHECK(fastest == Approx(limits.maxTurnSpeed));
        // pi rad: 0.6 s to 1.2 rad/s (0.36 rad), the same to a stop, the rest at 1.2 rad/s.
        CHECK(turning == Approx(1.2 + (2.0 * QUARTER - 0.72) / 1.2).margin(0.1));
        CHECK(std::abs(motion.GetPose().theta) == Approx(2.0 * QUARTER).margin(EXACT));
    }
}

TEST_CASE("A vehicle that brakes while it turns also ends its turn smoothly, and is stationary only then")
{
    const VdaSim::MotionLimits limits;
    VehicleMotion motion(limits, {});
    MotionLeg leg = MakeStraight(1.0);
    leg.bTurnBefore = true;
    leg.heading = 2.0 * QUARTER;
    motion.Begin(std::move(leg));
    RunLeg(motion, {}, 1.0);
    const double before = motion.GetPose().theta;
    REQUIRE(motion.GetTurnSpeed() == Approx(limits.maxTurnSpeed));
    motion.SetBrake(EBrake::Service);
    CHECK_FALSE(motion.IsStanding());
    RunLeg(motion, {}, 1.0);
    CHECK(motion.IsStanding());
    CHECK(motion.GetTurnSpeed() == 0.0);
    CHECK(motion.GetPose().theta - before == Approx(0.36).margin(0.03)); // 1.2² / (2 * 2)
    motion.SetBrake(EBrake::None);
    RunLeg(motion);
    CHECK(motion.GetPose().theta == Approx(2.0 * QUARTER).margin(EXACT));
}

TEST_CASE("A vehicle swerves gently, by the given distance, and is back on its path at the end")
{
    VehicleMotion motion({}, {});
    motion.Begin(MakeStraight(10.0));
    motion.SetOffset(-0.6);
    double farthest = 0.0;
    VdaSim::Pose last = motion.GetPose();
    RunLeg(motion, [&]() {
        const VdaSim::Pose& pose = motion.GetPose();
        farthest = std::min(farthest, pose.y);
        CHECK(std::abs(pose.y - last.y) <= VehicleMotion::SWERVE_SLOPE * (pose.x - last.x) + 1e-4);
        last = pose;
    });
    CHECK(farthest == Approx(-0.6));
    CHECK(motion.GetPose().y == 0.0);
}

} // namespace ACS::Testing
