#include "common/log/LogText.hpp"

#include <acs/core/ControlCharacter.hpp>
#include <acs/core/JsonText.hpp>

#include <fmt/format.h>

#include <cstddef>

namespace ACS::Apps
{

namespace
{

/// Removes and returns the first character; a byte that is not valid UTF-8 is a character of its own.
std::string_view TakeCharacter(std::string_view& text)
{
    constexpr unsigned TWO_BYTES = 0x80;
    constexpr unsigned THREE_BYTES = 0xE0;
    constexpr unsigned FOUR_BYTES = 0xF0;
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length =
        1U + (lead >= TWO_BYTES ? 1U : 0U) + (lead >= THREE_BYTES ? 1U : 0U) + (lead >= FOUR_BYTES ? 1U : 0U);
    const std::string_view character = text.substr(0, length);
    const std::string_view taken = Core::JsonText::IsUtf8(character) ? character : text.substr(0, 1);
    text.remove_prefix(taken.size());
    return taken;
}

/// Whether it controls a terminal (C0, C1), ends a line or changes the direction of the text that follows.
bool IsControl(std::string_view character)
{
    const auto isWithin = [character](std::string_view first, std::string_view last) {
        return character.size() == first.size() && character >= first && character <= last;
    };
    // NOLINTBEGIN(misc-misleading-bidirectional): the ends of ranges
    return (character.size() == 1 && Core::IsControlCharacter(character.front()))
        || isWithin("\xC2\x80", "\xC2\x9F")          // U+0080 to U+009F
        || isWithin("\xD8\x9C", "\xD8\x9C")          // U+061C
        || isWithin("\xE2\x80\x8E", "\xE2\x80\x8F")  // U+200E, U+200F
        || isWithin("\xE2\x80\xA8", "\xE2\x80\xAE")  // U+2028 to U+202E
        || isWithin("\xE2\x81\xA6", "\xE2\x81\xA9"); // U+2066 to U+2069
    // NOLINTEND(misc-misleading-bidirectional)
}

void AppendPrintable(std::string& out, std::string_view character)
{
    const bool bInvalid = character.size() == 1 && static_cast<signed char>(character.front()) < 0;
    if (!bInvalid && !IsControl(character))
    {
        out += character;
        return;
    }
    for (const char byte : character)
    {
        out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(byte)));
    }
}

void AppendEscaped(std::string& out, std::string_view text, bool bQuoted)
{
    while (!text.empty())
    {
        const std::string_view character = TakeCharacter(text);
        if (character == "\n")
        {
            out += "\\n";
        }
        else
        {
            out += bQuoted && (character == "\"" || character == "\\") ? "\\" : "";
            AppendPrintable(out, character);
        }
    }
}

bool NeedsQuotes(std::string_view value)
{
    if (value.empty() || value.find_first_of(" \"=") != std::string_view::npos)
    {
        return true;
    }
    while (!value.empty())
    {
        if (IsControl(TakeCharacter(value)))
        {
            return true;
        }
    }
    return false;
}

} // namespace

std::string MakePrintable(std::string_view text)
{
    std::string out;
    while (!text.empty())
    {
        AppendPrintable(out, TakeCharacter(text));
    }
    return out;
}

std::string MakeLogText(
    std::string_view component,
    std::string_view message,
    std::initializer_list<Core::LogField> fields)
{
    std::string text = fmt::format("{}: ", component);
    AppendEscaped(text, message, false);
    for (const Core::LogField& field : fields)
    {
        text += fmt::format(" {}=", field.key);
        const bool bQuoted = NeedsQuotes(field.value);
        text += bQuoted ? "\"" : "";
        AppendEscaped(text, field.value, bQuoted);
        text += bQuoted ? "\"" : "";
    }
    return text;
}

Core::Result<Core::ELogLevel> ParseLogLevel(std::string_view text)
{
    if (text == "debug")
    {
        return Core::ELogLevel::Debug;
    }
    if (text == "info")
    {
        return Core::ELogLevel::Info;
    }
    if (text == "warning")
    {
        return Core::ELogLevel::Warning;
    }
    if (text == "error")
    {
        return Core::ELogLevel::Error;
    }
    return Core::Fail(Core::ECoreError::UnknownWord, {}, "debug, info, warning or error", fmt::format("'{}'", text));
}

} // namespace ACS::Apps
