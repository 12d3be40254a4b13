#include "console/CleanText.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view ELLIPSIS = "…";
constexpr char32_t FIRST_PRINTABLE = 0x20;
constexpr char32_t DELETE = 0x7F;
constexpr char32_t LAST_CONTROL = 0x9F;

/// One character of a text, as code point and bytes; zero bytes at its end. Invalid UTF-8 is '?' of one byte.
struct Character
{
    char32_t code = 0;
    std::size_t bytes = 0;
    bool bValid = true;
};

std::size_t GetSequenceLength(unsigned char lead)
{
    if (lead < 0x80U)
    {
        return 1;
    }
    if (lead >= 0xC2U && lead < 0xE0U)
    {
        return 2;
    }
    if (lead >= 0xE0U && lead < 0xF0U)
    {
        return 3;
    }
    return lead >= 0xF0U && lead < 0xF5U ? 4 : 0;
}

Character ReadCharacter(std::string_view text)
{
    if (text.empty())
    {
        return {};
    }
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = GetSequenceLength(lead);
    if (length == 0 || length > text.size())
    {
        return {U'?', 1, false};
    }
    constexpr std::array<unsigned char, 5> LEAD_MASKS{0, 0x7F, 0x1F, 0x0F, 0x07};
    constexpr std::array<char32_t, 5> SMALLEST{0, 0, 0x80, 0x800, 0x10000};
    char32_t code = lead & LEAD_MASKS[length];
    for (std::size_t i = 1; i < length; ++i)
    {
        const auto next = static_cast<unsigned char>(text[i]);
        if ((next & 0xC0U) != 0x80U)
        {
            return {U'?', 1, false};
        }
        code = (code << 6U) | (next & 0x3FU);
    }
    const bool bSurrogate = code >= 0xD800 && code < 0xE000;
    if (code < SMALLEST[length] || bSurrogate || code > 0x10FFFF)
    {
        return {U'?', 1, false};
    }
    return {code, length, true};
}

bool IsControl(char32_t code)
{
    // Also the marks that turn the direction of writing, and line separators.
    return code < FIRST_PRINTABLE || (code >= DELETE && code <= LAST_CONTROL) || (code >= 0x2028 && code <= 0x202E)
        || (code >= 0x2066 && code <= 0x2069);
}

bool IsWide(char32_t code)
{
    return (code >= 0x1100 && code <= 0x115F) || (code >= 0x2E80 && code <= 0xA4CF)
        || (code >= 0xAC00 && code <= 0xD7A3) || (code >= 0xF900 && code <= 0xFAFF)
        || (code >= 0xFE30 && code <= 0xFE6F) || (code >= 0xFF00 && code <= 0xFF60)
        || (code >= 0xFFE0 && code <= 0xFFE6) || (code >= 0x1F300 && code <= 0x1FAFF)
        || (code >= 0x20000 && code <= 0x3FFFD);
}

} // namespace

std::string CleanText(std::string_view text)
{
    std::string clean;
    clean.reserve(text.size());
    while (!text.empty())
    {
        const Character character = ReadCharacter(text);
        if (!character.bValid || IsControl(character.code))
        {
            clean += '?';
        }
        else
        {
            clean += text.substr(0, character.bytes);
        }
        text.remove_prefix(character.bytes);
    }
    return clean;
}

std::string MakeTail(std::string_view text)
{
    return text.empty() ? std::string() : ": " + CleanText(text);
}

std::size_t GetColumns(std::string_view text)
{
    std::size_t columns = 0;
    while (!text.empty())
    {
        const Character character = ReadCharacter(text);
        columns += IsWide(character.code) ? 2U : 1U;
        text.remove_prefix(character.bytes);
    }
    return columns;
}

std::string CutText(std::string_view text, std::size_t columns)
{
    if (GetColumns(text) <= columns)
    {
        return std::string(text);
    }
    std::string cut;
    std::size_t used = 1; // the ellipsis
    while (columns > 0)
    {
        const Character character = ReadCharacter(text);
        used += IsWide(character.code) ? 2U : 1U;
        if (used > columns)
        {
            return cut + std::string(ELLIPSIS);
        }
        cut += text.substr(0, character.bytes);
        text.remove_prefix(character.bytes);
    }
    return cut;
}

std::string FitText(std::string_view text, std::size_t columns)
{
    std::string fitted = CutText(text, columns);
    fitted.append(columns - std::min(columns, GetColumns(fitted)), ' ');
    return fitted;
}

std::string FitRight(std::string_view text, std::size_t columns)
{
    const std::string fitted = CutText(text, columns);
    return std::string(columns - std::min(columns, GetColumns(fitted)), ' ') + fitted;
}

} // namespace ACS::McsSim
