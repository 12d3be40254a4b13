#include "mcs/MessageValue.hpp"

#include <acs/core/ControlCharacter.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <cmath>

namespace ACS::Acsd
{

std::optional<std::string> FindTextFaultOrNull(std::string_view text)
{
    return text.find('\0') == std::string_view::npos
        ? std::nullopt
        : std::optional(fmt::format("expected text without the character U+0000, found {}", Core::QuoteForError(text)));
}

std::optional<std::string> FindNumberFaultOrNull(double number)
{
    return std::isfinite(number) ? std::nullopt
                                 : std::optional(fmt::format("expected a finite number, found {}", number));
}

std::optional<std::string> FindNameFaultOrNull(std::string_view name)
{
    return !name.empty() && !Core::HasControlCharacter(name)
        ? std::nullopt
        : std::optional(fmt::format(
            "expected a name of at least one character, without control characters, found {}",
            Core::QuoteForError(name)));
}

} // namespace ACS::Acsd
