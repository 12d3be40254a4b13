#include "arm/MoveStatement.hpp"

#include "arm/FlangePose.hpp"
#include "arm/PointMotion.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view WORD = "move";
constexpr std::string_view BLANKS = " \t";
constexpr std::string_view SEPARATORS = " \t,";
constexpr std::array<std::string_view, 6> INTERPOLATIONS{"P", "L", "C", "SP", "SL", "SC"};
constexpr std::array<std::pair<std::string_view, EMoveSpeed>, 3> UNITS{{
    {"sec", EMoveSpeed::Seconds},
    {"%", EMoveSpeed::Percent},
    {"mm/sec", EMoveSpeed::Millimetres},
}};
constexpr double PERCENT = 100.0;
constexpr double SLOWEST = 0.001; ///< % or mm/sec: bounds the duration of a move.
constexpr double FASTEST_MILLIMETRES = 10'000.0;
constexpr double LONGEST_SECONDS = 3'600.0;
constexpr double LAST_ACCURACY = 7.0;
constexpr double LAST_TOOL = 31.0;

std::string_view Trim(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(BLANKS);
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(BLANKS) - first + 1);
}

/// The number at the beginning and the text after it.
std::optional<double> TakeNumberOrNull(std::string_view& text)
{
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || !std::isfinite(number))
    {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

bool TryParseSpeed(std::string_view text, MoveStatement& move)
{
    const std::optional<double> speed = TakeNumberOrNull(text);
    const auto* const unit = std::ranges::find(UNITS, Trim(text), &std::pair<std::string_view, EMoveSpeed>::first);
    if (!speed.has_value() || unit == UNITS.end() || *speed <= 0.0)
    {
        return false;
    }
    move.unit = unit->second;
    move.speed = *speed;
    switch (move.unit)
    {
        case EMoveSpeed::Percent:
            return *speed >= SLOWEST && *speed <= PERCENT;
        case EMoveSpeed::Millimetres:
            return *speed >= SLOWEST && *speed <= FASTEST_MILLIMETRES;
        case EMoveSpeed::Seconds:
        default:
            return *speed <= LONGEST_SECONDS;
    }
}

bool IsWholeUpTo(std::string_view text, double highest)
{
    const std::optional<double> number = TakeNumberOrNull(text);
    return number.has_value() && text.empty() && *number >= 0.0 && *number <= highest && std::trunc(*number) == *number;
}

/// The text between `move` and the position.
bool TryParseHead(std::string_view text, MoveStatement& move)
{
    bool bFirst = true;
    bool bSpeed = false;
    while (bFirst || !text.empty())
    {
        const std::size_t comma = text.find(',');
        const std::string_view part = Trim(text.substr(0, comma));
        text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
        const std::size_t equals = part.find('=');
        const std::string_view name = Trim(part.substr(0, equals));
        const std::string_view value = equals == std::string_view::npos ? "" : Trim(part.substr(equals + 1));
        bool bGood = false;
        if (bFirst)
        {
            bGood = std::ranges::find(INTERPOLATIONS, part) != INTERPOLATIONS.end();
        }
        else if (name == "spd")
        {
            bGood = !bSpeed && TryParseSpeed(value, move);
            bSpeed = true;
        }
        else if (name == "accu" || name == "tool")
        {
            bGood = IsWholeUpTo(value, name == "accu" ? LAST_ACCURACY : LAST_TOOL);
        }
        if (!bGood)
        {
            return false;
        }
        bFirst = false;
    }
    return bSpeed;
}

/// Six numbers and nothing else.
bool TryParsePosition(std::string_view text, JointVector& position)
{
    for (double& angle : position)
    {
        text.remove_prefix(std::min(text.find_first_not_of(SEPARATORS), text.size()));
        const std::optional<double> number = TakeNumberOrNull(text);
        if (!number.has_value())
        {
            return false;
        }
        angle = *number;
        if (!text.empty() && SEPARATORS.find(text.front()) == std::string_view::npos)
        {
            return false;
        }
    }
    return Trim(text).empty() && FindAxisOutside(position) == AXES;
}

double ComputeDistance(const JointVector& from, const JointVector& to)
{
    const FlangePose first = ComputeFlangePose(from);
    const FlangePose last = ComputeFlangePose(to);
    return std::hypot(last.x - first.x, last.y - first.y, last.z - first.z);
}

} // namespace

std::optional<MoveStatement> ParseMoveOrNull(std::string_view text)
{
    text = Trim(text);
    const std::size_t open = text.find('[');
    if (!text.starts_with(WORD) || open == std::string_view::npos || !text.ends_with(']'))
    {
        return std::nullopt;
    }
    const std::string_view head = text.substr(WORD.size(), open - WORD.size());
    const std::string_view position = text.substr(open + 1, text.size() - open - 2);
    MoveStatement move;
    if (head.empty() || BLANKS.find(head.front()) == std::string_view::npos || !TryParseHead(Trim(head), move)
        || !TryParsePosition(position, move.target))
    {
        return std::nullopt;
    }
    return move;
}

double ComputeMoveSeconds(const MoveStatement& move, const JointVector& from)
{
    switch (move.unit)
    {
        case EMoveSpeed::Percent:
            return PointMotion::GetShortestSeconds(from, move.target) * PERCENT / move.speed;
        case EMoveSpeed::Millimetres:
            return ComputeDistance(from, move.target) / move.speed;
        case EMoveSpeed::Seconds:
        default:
            return move.speed;
    }
}

} // namespace ACS::OpenStreamSim
