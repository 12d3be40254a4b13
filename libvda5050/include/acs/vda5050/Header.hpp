#pragma once

#include <acs/core/Now.hpp>

#include <cstdint>
#include <string>

namespace ACS::VDA5050
{

/// The members with which each message begins (section 6.4). Sessions fill it; flat in the JSON object.
struct Header
{
    std::uint32_t headerID = 0; ///< One counter per topic. Never to be relied on for order: wills carry old ones.
    Core::WallTime timestamp{}; ///< Written with milliseconds and Z.
    std::string version;        ///< "2.0.0"
    std::string manufacturer;
    std::string serialNumber;

    bool operator==(const Header&) const = default;
};

} // namespace ACS::VDA5050
