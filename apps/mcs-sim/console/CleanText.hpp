#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// Text from outside made fit for a terminal: control characters and what is not UTF-8 become '?'.
[[nodiscard]] std::string CleanText(std::string_view text);

/// ": text" with clean text, or nothing for an empty one.
[[nodiscard]] std::string MakeTail(std::string_view text);

/// Columns that clean text takes on a terminal: 2 for East Asian wide characters, else 1 each.
[[nodiscard]] std::size_t GetColumns(std::string_view text);

/// Clean text in exactly this number of columns: filled with spaces, or truncated with an ellipsis between characters.
[[nodiscard]] std::string FitText(std::string_view text, std::size_t columns);

/// Clean text in at most this number of columns.
[[nodiscard]] std::string CutText(std::string_view text, std::size_t columns);

/// As FitText, but filled in front: for numbers.
[[nodiscard]] std::string FitRight(std::string_view text, std::size_t columns);

} // namespace ACS::McsSim
