#include "CutText.hpp"

#include <acs/core/JsonText.hpp>

#include <algorithm>

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

} // namespace ACS::ProtocolBeast
