#include "view/DisplayText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::string_view ELLIPSIS = "…";
constexpr std::string_view REPLACEMENT = "\xEF\xBF\xBD"; // U+FFFD
constexpr char32_t FIRST_PRINTABLE = 0x20;
constexpr char32_t DELETE_CHARACTER = 0x7F;
constexpr char32_t LAST_CONTROL = 0x9F;
constexpr char32_t LARGEST_BYTE = 0xFF;

struct Range
{
    char32_t first;
    char32_t last;
};

/// Characters that occupy two columns (East Asian Width W and F, and the emoji that terminals show wide).
constexpr std::array<Range, 27> WIDE{{
    {0x1100, 0x115F}, // Hangul Jamo, leading consonants
    {0x231A, 0x231B},   {0x2329, 0x232A}, {0x23E9, 0x23EC}, {0x23F0, 0x23F3}, {0x25FD, 0x25FE},
    {0x2614, 0x2615},   {0x2648, 0x2653}, {0x26A1, 0x26A1}, {0x2705, 0x2705}, {0x274C, 0x274C},
    {0x2753, 0x2757},   {0x2795, 0x2797}, {0x2B50, 0x2B50}, {0x2E80, 0x303E}, // CJK radicals and punctuation
    {0x3041, 0x33FF}, // Kana, Hangul compatibility Jamo, enclosed
    {0x3400, 0x4DBF},   {0x4E00, 0x9FFF}, {0xA000, 0xA4CF}, {0xA960, 0xA97F}, // Hangul Jamo extended A
    {0xAC00, 0xD7A3},                                                         // Hangul syllables
    {0xF900, 0xFAFF},   {0xFE30, 0xFE6F}, {0xFF00, 0xFF60}, {0xFFE0, 0xFFE6}, {0x1F300, 0x1FAFF}, // emoji
    {0x20000, 0x3FFFD},
}};

/// Marks that are written above or below the character before them, and vowels of a Hangul syllable.
constexpr std::array<Range, 9> COMBINING{{
    {0x0300, 0x036F},
    {0x0483, 0x0489},
    {0x0591, 0x05BD},
    {0x1160, 0x11FF},
    {0x1AB0, 0x1AFF},
    {0x1DC0, 0x1DFF},
    {0x20D0, 0x20FF},
    {0xFE00, 0xFE0F},
    {0xFE20, 0xFE2F},
}};

/// Characters without a shape that change how others are shown: the direction of writing, joiners, separators of lines.
constexpr std::array<Range, 9> HIDDEN{{
    {0x00AD, 0x00AD},
    {0x061C, 0x061C},
    {0x180E, 0x180E},
    {0x200B, 0x200F},
    {0x2028, 0x202E},
    {0x2060, 0x206F},
    {0xFEFF, 0xFEFF},
    {0xFFF9, 0xFFFB},
    {0xE0000, 0xE007F},
}};

template <std::size_t COUNT>
bool IsIn(const std::array<Range, COUNT>& ranges, char32_t point)
{
    return std::any_of(ranges.begin(), ranges.end(), [point](const Range& range) {
        return point >= range.first && point <= range.last;
    });
}

/// One character of a text: its code point and bytes. Bytes that are not UTF-8 are characters of one byte, U+FFFD.
struct Character
{
    char32_t point;
    std::string_view bytes;
};

constexpr char32_t REPLACEMENT_POINT = 0xFFFD;

bool IsControl(char32_t point)
{
    return point < FIRST_PRINTABLE || (point >= DELETE_CHARACTER && point <= LAST_CONTROL);
}

/// The character in a JSON string: "\u009b", above U+FFFF a surrogate pair.
std::string EscapeForJSON(char32_t point)
{
    constexpr char32_t LAST_BASIC = 0xFFFF;
    constexpr char32_t FIRST_HIGH = 0xD800;
    constexpr char32_t FIRST_LOW = 0xDC00;
    constexpr unsigned LOW_BITS = 10;
    constexpr char32_t LOW_MASK = 0x3FF;
    if (point <= LAST_BASIC)
    {
        return fmt::format("\\u{:04x}", static_cast<std::uint32_t>(point));
    }
    const char32_t rest = point - LAST_BASIC - 1;
    return fmt::format("\\u{:04x}\\u{:04x}", FIRST_HIGH + (rest >> LOW_BITS), FIRST_LOW + (rest & LOW_MASK));
}

Character ReadFirst(std::string_view text)
{
    struct Form
    {
        unsigned char mask;
        unsigned char lead;
        char32_t lowest;
    };
    constexpr std::array<Form, 4> FORMS{
        {{0x80, 0x00, 0x00}, {0xE0, 0xC0, 0x80}, {0xF0, 0xE0, 0x800}, {0xF8, 0xF0, 0x10000}}};
    constexpr unsigned TAIL_MASK = 0xC0;
    constexpr unsigned TAIL = 0x80;
    constexpr unsigned TAIL_BITS = 6;
    constexpr char32_t TAIL_VALUE = 0x3F;
    constexpr char32_t LAST_POINT = 0x10FFFF;
    constexpr Range SURROGATES{0xD800, 0xDFFF};
    const auto first = static_cast<unsigned char>(text.front());
    const auto* const form = std::find_if(FORMS.begin(), FORMS.end(), [first](const Form& candidate) {
        return (first & candidate.mask) == candidate.lead;
    });
    const Character invalid{REPLACEMENT_POINT, text.substr(0, 1)};
    if (form == FORMS.end())
    {
        return invalid;
    }
    const auto size = static_cast<std::size_t>(std::distance(FORMS.begin(), form)) + 1;
    if (text.size() < size)
    {
        return invalid;
    }
    char32_t point = first & static_cast<unsigned char>(~form->mask);
    for (const char byte : text.substr(1, size - 1))
    {
        const auto tail = static_cast<unsigned char>(byte);
        if ((tail & TAIL_MASK) != TAIL)
        {
            return invalid;
        }
        point = (point << TAIL_BITS) | (tail & TAIL_VALUE);
    }
    const bool bSurrogate = point >= SURROGATES.first && point <= SURROGATES.last;
    return point < form->lowest || point > LAST_POINT || bSurrogate ? invalid : Character{point, text.substr(0, size)};
}

std::size_t GetColumns(char32_t point)
{
    if (point < FIRST_PRINTABLE || IsIn(COMBINING, point))
    {
        return 0;
    }
    return IsIn(WIDE, point) ? 2 : 1;
}

/// The longest start of the text that fits.
std::string_view GetStart(std::string_view text, std::size_t columns)
{
    std::size_t size = 0;
    std::size_t used = 0;
    while (size < text.size())
    {
        const Character character = ReadFirst(text.substr(size));
        used += GetColumns(character.point);
        if (used > columns)
        {
            break;
        }
        size += character.bytes.size();
    }
    return text.substr(0, size);
}

} // namespace

std::string MakeDisplayable(std::string_view text)
{
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty())
    {
        const Character character = ReadFirst(text);
        const bool bControl = IsControl(character.point);
        if (character.point == '\n' || character.point == '\t')
        {
            shown += ' ';
        }
        else if (bControl || IsIn(HIDDEN, character.point))
        {
            const auto number = static_cast<std::uint32_t>(character.point);
            shown +=
                character.point <= LARGEST_BYTE ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{:04x}", number);
        }
        else if (character.point == REPLACEMENT_POINT)
        {
            shown += REPLACEMENT;
        }
        else
        {
            shown += character.bytes;
        }
        text.remove_prefix(character.bytes.size());
    }
    return shown;
}

std::string MakeDisplayableJSON(std::string_view text)
{
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty())
    {
        const Character character = ReadFirst(text);
        // Only strings have such characters; the ASCII control characters outside of strings are line ends and tabs.
        const bool bEscaped =
            (IsControl(character.point) && character.point >= DELETE_CHARACTER) || IsIn(HIDDEN, character.point);
        shown += bEscaped ? EscapeForJSON(character.point) : std::string(character.bytes);
        text.remove_prefix(character.bytes.size());
    }
    return shown;
}

std::size_t CountColumns(std::string_view text)
{
    std::size_t columns = 0;
    while (!text.empty())
    {
        const Character character = ReadFirst(text);
        columns += GetColumns(character.point);
        text.remove_prefix(character.bytes.size());
    }
    return columns;
}

std::string CutToColumns(std::string_view text, std::size_t columns)
{
    if (CountColumns(text) <= columns)
    {
        return std::string(text);
    }
    if (columns == 0)
    {
        return {};
    }
    return std::string(GetStart(text, columns - 1)).append(ELLIPSIS);
}

std::vector<std::string> WrapText(std::string_view text, std::size_t columns)
{
    const std::size_t width = std::max<std::size_t>(columns, 2); // a wide character must fit
    std::vector<std::string> lines;
    while (CountColumns(text) > width)
    {
        const std::string_view start = GetStart(text, width);
        // A space directly after the start ends the line too.
        const std::size_t space = text.substr(0, start.size() + 1).rfind(' ');
        const bool bAtSpace = space != std::string_view::npos && space != 0;
        lines.emplace_back(text.substr(0, bAtSpace ? space : start.size()));
        text.remove_prefix(bAtSpace ? space + 1 : start.size());
    }
    if (!text.empty() || lines.empty())
    {
        lines.emplace_back(text);
    }
    return lines;
}

} // namespace ACS::Acsctl
