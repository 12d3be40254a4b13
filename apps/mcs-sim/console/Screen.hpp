#pragma once

#include "console/StyledLine.hpp"

#include <cstddef>
#include <ostream>

namespace ACS::McsSim
{

struct TerminalSize
{
    std::size_t columns = 100;
    std::size_t rows = 24;
};

/// COLUMNS and LINES if set, otherwise the size of the terminal on standard output, otherwise the defaults.
[[nodiscard]] TerminalSize ReadTerminalSize();

/// Draws lines over those that it drew before. The cursor is hidden within a frame only, and is below it
/// afterwards, so that nothing has to be put right however the program ends.
class Screen
{
    std::ostream& _out;
    std::size_t _columns;
    std::size_t _drawn = 0;

public:
    /// The stream outlives the screen.
    Screen(std::ostream& out, std::size_t columns);

    void Draw(const StyledLines& lines);

    /// Removes the last frame, so that other output can be printed in its place.
    void Erase();

    /// The last frame stays; what is drawn next comes below.
    void Leave() noexcept;
};

} // namespace ACS::McsSim
