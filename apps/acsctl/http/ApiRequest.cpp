#include "http/ApiRequest.hpp"

#include <fmt/format.h>

namespace ACS::Acsctl
{

std::string EncodePercent(std::string_view text)
{
    constexpr std::string_view SAFE = "-._~";
    std::string out;
    for (const char letter : text)
    {
        const bool bLetter = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
        if (bLetter || (letter >= '0' && letter <= '9') || SAFE.find(letter) != std::string_view::npos)
        {
            out += letter;
        }
        else
        {
            out += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(letter)));
        }
    }
    return out;
}

} // namespace ACS::Acsctl
