#include "CutText.hpp"

namespace ACS::ProtocolBeast
{

namespace
{

bool IsContinuation(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

} // namespace

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
