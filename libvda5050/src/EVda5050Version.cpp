#include <acs/vda5050/EVda5050Version.hpp>

#include <cassert>

namespace ACS::VDA5050
{

std::string_view GetVersionText(EVda5050Version version)
{
    switch (version)
    {
        case EVda5050Version::Version200:
            return "2.0.0";
        case EVda5050Version::Version210:
            return "2.1.0";
        default:
            assert(false && "a version has no text");
            return {};
    }
}

std::optional<EVda5050Version> ReadVersionOrNull(std::string_view text)
{
    constexpr std::string_view MAJOR = "2.";
    if (!text.starts_with(MAJOR))
    {
        return std::nullopt;
    }
    const std::string_view minor = text.substr(MAJOR.size());
    const bool bZero = minor == "0" || minor.starts_with("0.");
    return bZero ? EVda5050Version::Version200 : EVda5050Version::Version210;
}

} // namespace ACS::VDA5050
