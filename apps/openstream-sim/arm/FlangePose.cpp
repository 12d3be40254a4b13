#include "arm/FlangePose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ACS::OpenStreamSim
{

namespace
{

using Matrix = std::array<std::array<double, 3>, 3>;

constexpr double DEGREES = 180.0 / std::numbers::pi;
constexpr double SHOULDER_REACH = 150.0; ///< mm
constexpr double SHOULDER_HEIGHT = 450.0;
constexpr double UPPER_ARM = 870.0;
constexpr double FOREARM = 800.0;
constexpr double FLANGE = 120.0;

Matrix Multiply(const Matrix& left, const Matrix& right)
{
    Matrix product{};
    for (std::size_t row = 0; row < 3; ++row)
    {
        for (std::size_t column = 0; column < 3; ++column)
        {
            for (std::size_t inner = 0; inner < 3; ++inner)
            {
                product[row][column] += left[row][inner] * right[inner][column];
            }
        }
    }
    return product;
}

Matrix TurnAboutX(double angle)
{
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {{{1.0, 0.0, 0.0}, {0.0, cosine, -sine}, {0.0, sine, cosine}}};
}

Matrix TurnAboutY(double angle)
{
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {{{cosine, 0.0, sine}, {0.0, 1.0, 0.0}, {-sine, 0.0, cosine}}};
}

Matrix TurnAboutZ(double angle)
{
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {{{cosine, -sine, 0.0}, {sine, cosine, 0.0}, {0.0, 0.0, 1.0}}};
}

} // namespace

FlangePose ComputeFlangePose(const JointVector& position)
{
    JointVector angles{};
    std::ranges::transform(position, angles.begin(), [](double degrees) { return degrees / DEGREES; });
    const double upper = angles[1];
    const double forearm = angles[1] - HOME[1] / DEGREES + angles[2];
    const Matrix arm = Multiply(TurnAboutZ(angles[0]), TurnAboutY(-forearm));
    const Matrix wrist = Multiply(TurnAboutX(angles[3]), TurnAboutY(-angles[4]));
    const Matrix turn = Multiply(Multiply(arm, wrist), TurnAboutX(angles[5]));
    const double reach = SHOULDER_REACH + UPPER_ARM * std::cos(upper) + FOREARM * std::cos(forearm);
    const double height = SHOULDER_HEIGHT + UPPER_ARM * std::sin(upper) + FOREARM * std::sin(forearm);

    FlangePose pose;
    pose.x = reach * std::cos(angles[0]) + FLANGE * turn[0][0];
    pose.y = reach * std::sin(angles[0]) + FLANGE * turn[1][0];
    pose.z = height + FLANGE * turn[2][0];
    pose.rx = std::atan2(turn[2][1], turn[2][2]) * DEGREES;
    pose.ry = std::asin(std::clamp(0.0 - turn[2][0], -1.0, 1.0)) * DEGREES;
    pose.rz = std::atan2(turn[1][0], turn[0][0]) * DEGREES;
    return pose;
}

} // namespace ACS::OpenStreamSim
