#pragma once

#include "scenario/Scenario.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// What a placeholder stands for; nullopt: there is no such one.
using PlaceholderReader = std::function<std::optional<std::string>(std::string_view name)>;

/// The text with "{name}" replaced; braces around anything that is no placeholder stay.
[[nodiscard]] std::string FillPlaceholders(std::string_view text, const PlaceholderReader& read);

/// The same in every string of a JSON text, member names excepted.
[[nodiscard]] Core::JsonText FillPlaceholders(const Core::JsonText& json, const PlaceholderReader& read);

/// Whether the text matches the pattern, in which '*' matches any characters.
[[nodiscard]] bool MatchesGlob(std::string_view text, std::string_view pattern);

/// Why a message is not what the pattern asks for, beginning with the place ("payload.status: …"); nullopt: it is.
/// Objects may have more members than the pattern; arrays have as many elements; null also stands for what is absent.
[[nodiscard]] std::optional<std::string> FindMismatchOrNull(
    std::string_view text,
    const MessagePattern& pattern,
    const PlaceholderReader& read);

} // namespace ACS::McsSim
