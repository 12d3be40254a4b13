#include <acs/core/JsonText.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace ACS::Core
{

namespace
{

constexpr unsigned FIRST_PRINTABLE = 0x20;
constexpr std::size_t HEX_DIGITS = 4;
constexpr std::uint32_t HIGH_SURROGATE = 0xD800;
constexpr std::uint32_t LOW_SURROGATE = 0xDC00;
constexpr std::uint32_t SURROGATE_SPAN = 0x400;
constexpr std::uint32_t SURROGATE_OFFSET = 0x10000;
constexpr std::uint32_t REPLACEMENT_CHARACTER = 0xFFFD;
constexpr unsigned SIX_BITS = 0x3F;

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

/// Takes what stands behind \u. Half a surrogate pair has no UTF-8 and is replaced: parsers let a low one pass.
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

JsonText JsonText::FromString(std::string_view value)
{
    std::string text = "\"";
    for (const char character : value)
    {
        if (character == '"' || character == '\\')
        {
            text += '\\';
            text += character;
        }
        else if (static_cast<unsigned char>(character) < FIRST_PRINTABLE)
        {
            text += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(character)));
        }
        else
        {
            text += character;
        }
    }
    text += '"';
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
    double value = 0.0;
    const auto [end, error] = std::from_chars(_text.data(), _text.data() + _text.size(), value);
    if (error != std::errc() || end != _text.data() + _text.size() || !std::isfinite(value))
    {
        return std::nullopt;
    }
    return value;
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
