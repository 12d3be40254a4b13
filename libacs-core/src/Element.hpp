#pragma once

#include <acs/core/ESegmentKind.hpp>

#include <optional>
#include <string_view>

namespace ACS::Core::Detail
{

/// What looks like an element of a location: letters of a kind, in either case, and digits only ("cp7", "SET00").
struct Element
{
    ESegmentKind kind = ESegmentKind::Area;
    std::string_view digits; ///< One or more; whether their value is allowed is for the caller.
};

[[nodiscard]] std::optional<Element> SplitElementOrNull(std::string_view text);

/// "CP" for CassettePort; empty for a robot, which has a name instead.
[[nodiscard]] std::string_view GetPrefix(ESegmentKind kind);

/// Whether the text is the upper-case word, in either case. ASCII only, without locale.
[[nodiscard]] bool IsSameWord(std::string_view text, std::string_view upperWord);

} // namespace ACS::Core::Detail
