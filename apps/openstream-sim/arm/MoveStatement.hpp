#pragma once

#include "arm/AxisLimits.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::OpenStreamSim
{

/// Unit of the `spd` of a move.
enum class EMoveSpeed : std::uint8_t
{
    Seconds,     ///< sec: its duration.
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

/// "move SP,spd=1sec,accu=0,tool=1 [0 90 0 0 0 0]": P, L, C, SP, SL or SC; spd in sec, % or mm/sec; optionally accu 0 to 7
/// and tool 0 to 31; six angles separated by blanks or commas. Nullopt if invalid or if an axis is out of its range.
[[nodiscard]] std::optional<MoveStatement> ParseMoveOrNull(std::string_view text);

/// The duration of the move from this position, in seconds, within the limits of the axes.
[[nodiscard]] double ComputeMoveSeconds(const MoveStatement& move, const JointVector& from);

} // namespace ACS::OpenStreamSim
