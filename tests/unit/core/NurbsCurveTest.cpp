#include "Catch.hpp"
#include <acs/core/NurbsCurve.hpp>

#include <limits>
#include <vector>

using ACS::Core::MapPoint;
using ACS::Core::Nurbs;
using ACS::Core::NurbsCurve;

TEST_CASE("A spacing that is not above 0 gives as many points of a curve as the limit allows")
{
    const double spacing = GENERATE(0.0, -1.0, std::numeric_limits<double>::quiet_NaN());
    Nurbs parabola;
    parabola.degree = 2;
    parabola.knots = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
    parabola.points = {{0.0, 0.0, {}}, {1.0, 1.0, {}}, {2.0, 0.0, {}}};
    const std::vector<MapPoint> samples = NurbsCurve(parabola).Sample(spacing, 50);
    CHECK(samples.size() == 50);
    CHECK(samples.front() == MapPoint{0.0, 0.0});
    CHECK(samples.back() == MapPoint{2.0, 0.0});

    Nurbs line;
    line.degree = 1;
    line.knots = {0.0, 0.0, 1.0, 1.0};
    line.points = {{0.0, 0.0, {}}, {3.0, 0.0, {}}};
    CHECK(NurbsCurve(line).Sample(spacing, 50) == std::vector<MapPoint>{{0.0, 0.0}, {3.0, 0.0}});
}
