#include "CutText.hpp"

#include <acs/core/ControlCharacter.hpp>
#include <acs/core/JsonText.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace ACS::ProtocolBeast
{

namespace
{

bool IsContinuation(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

} // namespace

std::string MakeUTF8(std::string_view text)
{
    std::string made(text);
    if (!Core::JsonText::IsUtf8(text))
    {
        std::ranges::replace_if(
            made,
            [](char byte) { return static_cast<unsigned char>(byte) >= 0x80U; },
            '?');
    }
    return made;
}

std::string_view CutAtCharacter(std::string_view text, std::size_t maximum)
{
    if (text.size() <= maximum)
    {
        return text;
    }
    std::size_t size = maximum;
    while (size > 0 && IsContinuation(text[size]))
    {
        --size;
    }
    return text.substr(0, size);
}

std::string QuoteReason(std::string_view text)
{
    constexpr std::size_t MOST = 200;
    std::string reason = MakeUTF8(text);
    std::ranges::replace_if(reason, Core::IsControlCharacter, ' ');
    const std::string_view shown = CutAtCharacter(reason, MOST);
    return fmt::format("\"{}\"{}", shown, shown.size() < reason.size() ? "..." : "");
}

} // namespace ACS::ProtocolBeast
