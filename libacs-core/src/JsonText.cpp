#include <acs/core/JsonText.hpp>
#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

namespace ACS::Core
{

namespace
{

constexpr std::string_view REPLACEMENT = "\xEF\xBF\xBD";
constexpr std::string_view HEX = "0123456789abcdef";
constexpr std::size_t HEX_DIGITS = 4;
constexpr std::uint32_t HIGH_SURROGATE = 0xD800;
constexpr std::uint32_t LOW_SURROGATE = 0xDC00;
constexpr std::uint32_t SURROGATE_SPAN = 0x400;
constexpr std::uint32_t SURROGATE_OFFSET = 0x10000;
constexpr std::uint32_t REPLACEMENT_CHARACTER = 0xFFFD;
constexpr unsigned SIX_BITS = 0x3F;

/// For each byte: 0 = stands for itself, 'u' = \u00XX, '8' = start of a UTF-8 sequence, else the letter behind '\'.
constexpr std::array<char, 256> MakeEscapes()
{
    std::array<char, 256> table{};
    for (std::size_t byte = 0; byte < 0x20; ++byte)
    {
        table[byte] = 'u';
    }
    for (std::size_t byte = 0x80; byte < table.size(); ++byte)
    {
        table[byte] = '8';
    }
    table['\b'] = 'b';
    table['\f'] = 'f';
    table['\n'] = 'n';
    table['\r'] = 'r';
    table['\t'] = 't';
    table['"'] = '"';
    table['\\'] = '\\';
    return table;
}

constexpr std::array<char, 256> ESCAPES = MakeEscapes();

/// Whether one of eight bytes does not stand for itself: a quote, a backslash, a control character, or no ASCII.
bool NeedsLook(std::uint64_t bytes)
{
    constexpr std::uint64_t ONES = 0x0101010101010101;
    constexpr std::uint64_t HIGHS = 0x8080808080808080;
    const std::uint64_t quotes = bytes ^ (ONES * '"');
    const std::uint64_t backslashes = bytes ^ (ONES * '\\');
    // A byte below n borrows in `- n`; one of 0x80 and more is caught by `bytes` itself.
    const std::uint64_t found = (quotes - ONES) | (backslashes - ONES) | (bytes - ONES * ' ') | bytes;
    return (found & HIGHS) != 0;
}

/// Where the first byte may be that does not stand for itself; all before it does.
std::size_t SkipPlain(std::string_view text, std::size_t position)
{
    std::uint64_t bytes = 0;
    while (position + sizeof bytes <= text.size())
    {
        std::memcpy(&bytes, text.data() + position, sizeof bytes);
        if (NeedsLook(bytes))
        {
            break;
        }
        position += sizeof bytes;
    }
    while (position < text.size() && ESCAPES[static_cast<unsigned char>(text[position])] == 0)
    {
        ++position;
    }
    return position;
}

bool IsInside(unsigned char byte, unsigned char lowest, unsigned char highest)
{
    return byte >= lowest && byte <= highest;
}

/// Length of the well-formed UTF-8 sequence at the front (Unicode 15, table 3-7), 0 where there is none.
std::size_t GetSequenceLength(std::string_view text)
{
    const auto byteAt = [text](std::size_t index) -> unsigned char {
        return index < text.size() ? static_cast<unsigned char>(text[index]) : 0;
    };
    const unsigned char first = byteAt(0);
    if (IsInside(first, 0xC2, 0xDF))
    {
        return IsInside(byteAt(1), 0x80, 0xBF) ? 2 : 0;
    }
    if (IsInside(first, 0xE0, 0xEF))
    {
        const unsigned char lowest = first == 0xE0 ? 0xA0 : 0x80;
        const unsigned char highest = first == 0xED ? 0x9F : 0xBF;
        return IsInside(byteAt(1), lowest, highest) && IsInside(byteAt(2), 0x80, 0xBF) ? 3 : 0;
    }
    if (IsInside(first, 0xF0, 0xF4))
    {
        const unsigned char lowest = first == 0xF0 ? 0x90 : 0x80;
        const unsigned char highest = first == 0xF4 ? 0x8F : 0xBF;
        const bool bTail = IsInside(byteAt(2), 0x80, 0xBF) && IsInside(byteAt(3), 0x80, 0xBF);
        return IsInside(byteAt(1), lowest, highest) && bTail ? 4 : 0;
    }
    return 0;
}

void AppendUtf8(std::string& out, std::uint32_t codePoint)
{
    const auto append = [&out](std::uint32_t byte) {
        out += static_cast<char>(static_cast<unsigned char>(byte));
    };
    const auto appendTail = [&append, codePoint](unsigned shift) {
        append(0x80U | ((codePoint >> shift) & SIX_BITS));
    };
    if (codePoint < 0x80)
    {
        append(codePoint);
    }
    else if (codePoint < 0x800)
    {
        append(0xC0U | (codePoint >> 6U));
        appendTail(0);
    }
    else if (codePoint < SURROGATE_OFFSET)
    {
        append(0xE0U | (codePoint >> 12U));
        appendTail(6);
        appendTail(0);
    }
    else
    {
        append(0xF0U | (codePoint >> 18U));
        appendTail(12);
        appendTail(6);
        appendTail(0);
    }
}

/// Takes four hexadecimal digits from the front; nullopt where they are not there.
std::optional<std::uint32_t> TakeHexOrNull(std::string_view& rest)
{
    std::uint32_t value = 0;
    const std::string_view digits = rest.substr(0, HEX_DIGITS);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() < HEX_DIGITS || error != std::errc() || end != digits.data() + digits.size())
    {
        return std::nullopt;
    }
    rest.remove_prefix(HEX_DIGITS);
    return value;
}

/// Takes the second half of a surrogate pair, with its \u, from the front, if it is one.
std::optional<std::uint32_t> TakeLowSurrogateOrNull(std::string_view& rest)
{
    std::string_view behind = rest.substr(std::min<std::size_t>(rest.size(), 2));
    const std::optional<std::uint32_t> lowOrNull = TakeHexOrNull(behind);
    if (!rest.starts_with("\\u") || !lowOrNull.has_value() || *lowOrNull < LOW_SURROGATE
        || *lowOrNull >= LOW_SURROGATE + SURROGATE_SPAN)
    {
        return std::nullopt;
    }
    rest = behind;
    return lowOrNull;
}

/// Reads the rest of a \u escape. A lone surrogate has no UTF-8 and is replaced: parsers accept a low one.
std::optional<std::uint32_t> TakeCodePointOrNull(std::string_view& rest)
{
    const std::optional<std::uint32_t> unitOrNull = TakeHexOrNull(rest);
    if (!unitOrNull.has_value() || *unitOrNull < HIGH_SURROGATE || *unitOrNull >= LOW_SURROGATE + SURROGATE_SPAN)
    {
        return unitOrNull;
    }
    const std::optional<std::uint32_t> lowOrNull =
        *unitOrNull < LOW_SURROGATE ? TakeLowSurrogateOrNull(rest) : std::nullopt;
    if (!lowOrNull.has_value())
    {
        return REPLACEMENT_CHARACTER;
    }
    return SURROGATE_OFFSET + (*unitOrNull - HIGH_SURROGATE) * SURROGATE_SPAN + (*lowOrNull - LOW_SURROGATE);
}

/// Takes the escape behind a backslash from the front and appends what it means. False where JSON has no such escape.
bool TryAppendEscaped(std::string& out, std::string_view& rest)
{
    constexpr std::string_view LETTERS = "\"\\/bfnrt";
    constexpr std::string_view MEANINGS = "\"\\/\b\f\n\r\t";
    if (rest.empty())
    {
        return false;
    }
    const char letter = rest.front();
    rest.remove_prefix(1);
    if (letter == 'u')
    {
        const std::optional<std::uint32_t> codePointOrNull = TakeCodePointOrNull(rest);
        if (codePointOrNull.has_value())
        {
            AppendUtf8(out, *codePointOrNull);
        }
        return codePointOrNull.has_value();
    }
    const std::size_t index = LETTERS.find(letter);
    if (index == std::string_view::npos)
    {
        return false;
    }
    out += MEANINGS[index];
    return true;
}

} // namespace

JsonText::JsonText(std::string text)
    : _text(std::move(text))
{
}

void JsonText::AppendString(std::string_view value, std::string& out)
{
    out += '"';
    std::size_t begin = 0;
    for (std::size_t position = 0; position < value.size();)
    {
        position = SkipPlain(value, position);
        if (position == value.size())
        {
            break;
        }
        const auto byte = static_cast<unsigned char>(value[position]);
        const char escape = ESCAPES[byte];
        const std::size_t sequence = escape == '8' ? GetSequenceLength(value.substr(position)) : 0;
        if (sequence != 0)
        {
            position += sequence;
            continue;
        }
        out.append(value, begin, position - begin);
        if (escape == '8')
        {
            out += REPLACEMENT;
        }
        else if (escape == 'u')
        {
            out += "\\u00";
            out += HEX[byte >> 4U];
            out += HEX[byte & 0xFU];
        }
        else
        {
            out += '\\';
            out += escape;
        }
        ++position;
        begin = position;
    }
    out.append(value, begin, value.size() - begin);
    out += '"';
}

bool JsonText::IsUtf8(std::string_view text) noexcept
{
    constexpr std::uint64_t HIGHS = 0x8080808080808080;
    std::uint64_t bytes = 0;
    for (std::size_t position = 0; position < text.size();)
    {
        if (position + sizeof bytes <= text.size())
        {
            std::memcpy(&bytes, text.data() + position, sizeof bytes);
            if ((bytes & HIGHS) == 0)
            {
                position += sizeof bytes;
                continue;
            }
        }
        const bool bAscii = static_cast<unsigned char>(text[position]) < 0x80U;
        const std::size_t length = bAscii ? 1 : GetSequenceLength(text.substr(position));
        if (length == 0)
        {
            return false;
        }
        position += length;
    }
    return true;
}

JsonText JsonText::FromString(std::string_view value)
{
    std::string text;
    text.reserve(value.size() + 2);
    AppendString(value, text);
    return JsonText(std::move(text));
}

JsonText JsonText::FromNumber(double value)
{
    return std::isfinite(value) ? JsonText(fmt::format("{}", value)) : JsonText();
}

JsonText JsonText::FromInteger(std::int64_t value)
{
    return JsonText(fmt::format("{}", value));
}

JsonText JsonText::FromBoolean(bool bValue)
{
    return JsonText(bValue ? "true" : "false");
}

JsonText JsonText::FromTrusted(std::string text)
{
    return JsonText(std::move(text));
}

const std::string& JsonText::GetText() const noexcept
{
    return _text;
}

std::string JsonText::TakeText()
{
    return std::exchange(_text, "null");
}

std::optional<std::string> JsonText::GetStringOrNull() const
{
    if (_text.size() < 2 || _text.front() != '"' || _text.back() != '"')
    {
        return std::nullopt;
    }
    std::string_view rest = _text;
    rest = rest.substr(1, rest.size() - 2);
    std::string value;
    value.reserve(rest.size());
    while (!rest.empty())
    {
        const char character = rest.front();
        rest.remove_prefix(1);
        if (character == '"' || (character == '\\' && !TryAppendEscaped(value, rest)))
        {
            return std::nullopt;
        }
        if (character != '\\')
        {
            value += character;
        }
    }
    return value;
}

std::optional<double> JsonText::GetNumberOrNull() const
{
    const std::optional<double> value = ParseNumberOrNull<double>(_text);
    return value.has_value() && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<bool> JsonText::GetBooleanOrNull() const
{
    if (_text == "true" || _text == "false")
    {
        return _text == "true";
    }
    return std::nullopt;
}

} // namespace ACS::Core
