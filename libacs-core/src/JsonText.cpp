#include <acs/core/JsonText.hpp>

#include <fmt/format.h>

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

/// Reads the four hexadecimal digits at position; the text is JSON, so they are there.
std::uint32_t ReadHex(std::string_view text, std::size_t position)
{
    std::uint32_t value = 0;
    const std::string_view digits = text.substr(position, HEX_DIGITS);
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
}

/// Appends the character that the escape at position (behind the backslash) means; returns the position behind it.
std::size_t AppendEscaped(std::string& out, std::string_view text, std::size_t position)
{
    switch (text[position])
    {
        case 'b':
            out += '\b';
            break;
        case 'f':
            out += '\f';
            break;
        case 'n':
            out += '\n';
            break;
        case 'r':
            out += '\r';
            break;
        case 't':
            out += '\t';
            break;
        case 'u':
        {
            std::uint32_t codePoint = ReadHex(text, position + 1);
            std::size_t end = position + 1 + HEX_DIGITS;
            if (codePoint >= HIGH_SURROGATE && codePoint < LOW_SURROGATE)
            {
                const std::uint32_t low = ReadHex(text, end + 2);
                codePoint = SURROGATE_OFFSET + (codePoint - HIGH_SURROGATE) * SURROGATE_SPAN + (low - LOW_SURROGATE);
                end += 2 + HEX_DIGITS;
            }
            AppendUtf8(out, codePoint);
            return end;
        }
        default:
            out += text[position];
            break;
    }
    return position + 1;
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
    if (_text.size() < 2 || _text.front() != '"')
    {
        return std::nullopt;
    }
    const std::string_view inner = std::string_view(_text).substr(1, _text.size() - 2);
    std::string value;
    value.reserve(inner.size());
    for (std::size_t position = 0; position < inner.size();)
    {
        if (inner[position] == '\\')
        {
            position = AppendEscaped(value, inner, position + 1);
        }
        else
        {
            value += inner[position];
            ++position;
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
