#include "common/log/LogText.hpp"

#include <acs/core/ControlCharacter.hpp>
#include <acs/core/JsonText.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace ACS::Apps
{

namespace
{

void AppendEscaped(std::string& out, std::string_view text, bool bQuoted)
{
    for (const char character : text)
    {
        if (character == '\n')
        {
            out += "\\n";
        }
        else
        {
            out += bQuoted && (character == '"' || character == '\\') ? "\\" : "";
            AppendPrintable(out, character);
        }
    }
}

void AppendEscaped(std::string& out, char character)
{
    out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(character)));
}

/// With every byte outside of ASCII escaped.
std::string MakeASCII(std::string_view text)
{
    std::string ascii;
    for (const char character : text)
    {
        if (static_cast<unsigned char>(character) < 0x80U)
        {
            ascii += character;
        }
        else
        {
            AppendEscaped(ascii, character);
        }
    }
    return ascii;
}

bool NeedsQuotes(std::string_view value)
{
    return value.empty() || std::any_of(value.begin(), value.end(), [](char character) {
               return Core::IsControlCharacter(character) || character == ' ' || character == '"' || character == '=';
           });
}

} // namespace

void AppendPrintable(std::string& out, char character)
{
    if (Core::IsControlCharacter(character))
    {
        AppendEscaped(out, character);
    }
    else
    {
        out += character;
    }
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
        if (NeedsQuotes(field.value))
        {
            text += '"';
            AppendEscaped(text, field.value, true);
            text += '"';
        }
        else
        {
            text += field.value;
        }
    }
    if (!Core::JsonText::IsUtf8(text))
    {
        text = MakeASCII(text);
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
