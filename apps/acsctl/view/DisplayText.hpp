#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

/// The text as a terminal may show it: control characters, also those of Unicode and those that change the direction of
/// writing, are escaped (\x1b, \u202e), and line ends become spaces. What is not UTF-8 becomes U+FFFD.
[[nodiscard]] std::string MakeDisplayable(std::string_view text);

/// JSON of which a terminal may show every character: those that MakeDisplayable escapes are written as \u009b. The text is valid JSON,
/// and has the same value afterwards.
[[nodiscard]] std::string MakeDisplayableJSON(std::string_view text);

/// Columns of a terminal that the text occupies: two for a wide character (Korean, Chinese, Japanese, emoji), none for a
/// combining mark. The text is displayable.
[[nodiscard]] std::size_t CountColumns(std::string_view text);

/// The text in at most this number of columns; where the rest is left out, it ends in "…".
[[nodiscard]] std::string CutToColumns(std::string_view text, std::size_t columns);

/// The text in lines of at most this number of columns, broken at spaces; a longer word is broken where the line ends. At
/// least one line.
[[nodiscard]] std::vector<std::string> WrapText(std::string_view text, std::size_t columns);

} // namespace ACS::Acsctl
