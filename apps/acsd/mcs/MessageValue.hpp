#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Why a message cannot have the text as a value: it contains U+0000, where many JSON readers end a string.
[[nodiscard]] std::optional<std::string> FindTextFaultOrNull(std::string_view text);

/// Why a message cannot have the number as a value: JSON has no NaN and no infinity.
[[nodiscard]] std::optional<std::string> FindNumberFaultOrNull(double number);

/// Why a message cannot have the text as the name of a value: it is empty or has control characters.
[[nodiscard]] std::optional<std::string> FindNameFaultOrNull(std::string_view name);

} // namespace ACS::Acsd
