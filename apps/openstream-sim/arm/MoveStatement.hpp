#pragma once

#include "arm/AxisLimits.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::OpenStreamSim
{

/// What the `spd` of a move counts.
enum class EMoveSpeed : std::uint8_t
{
    Seconds,     ///< sec: how long it takes.
    Percent,     ///< %: of the axes' speed.
    Millimetres, ///< mm/sec, of the flange.
};

/// The robot language's move to a position of the axes.
struct MoveStatement
{
    EMoveSpeed unit = EMoveSpeed::Seconds;
    double speed = 0.0;
    JointVector target{}; ///< deg

    bool operator==(const MoveStatement&) const = default;
};

/// "move SP,spd=1sec,accu=0,tool=1 [0 90 0 0 0 0]": P, L, C, SP, SL or SC; spd in sec, % or mm/sec; accu 0 to 7 and tool 0 to
/// 31 at will; six angles with blanks or commas between. Nothing where it is none, or where an axis cannot be there.
[[nodiscard]] std::optional<MoveStatement> ParseMoveOrNull(std::string_view text);

/// How long it takes from there, in seconds, as far as the axes let it.
[[nodiscard]] double ComputeMoveSeconds(const MoveStatement& move, const JointVector& from);

} // namespace ACS::OpenStreamSim
