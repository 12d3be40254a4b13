#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

enum class EStyle : std::uint8_t
{
    Plain,
    Bold,
    Dim,
    Active,
    Good,
    Bad,
};

/// A piece of a line in one style. The text is clean (CleanText).
struct Span
{
    std::string text;
    EStyle style = EStyle::Plain;
};

using StyledLine = std::vector<Span>;
using StyledLines = std::vector<StyledLine>;

/// The line in at most this number of columns, without spaces at its end; with the escape sequences of its styles or without.
[[nodiscard]] std::string MakeText(const StyledLine& line, std::size_t columns, bool bStyled);

} // namespace ACS::McsSim
