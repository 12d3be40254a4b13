#pragma once

#include <acs/core/Now.hpp>

#include <cstdint>
#include <string>

namespace ACS::VDA5050
{

/// The first members of each message (section 6.4), set by the sessions. Flat in the JSON object.
struct Header
{
    std::uint32_t headerID =
        0; ///< One counter per topic. Does not reflect the order of messages: wills carry old values.
    Core::WallTime timestamp{}; ///< Written with milliseconds and Z.
    std::string version;        ///< "2.0.0"
    std::string manufacturer;
    std::string serialNumber;

    bool operator==(const Header&) const = default;
};

} // namespace ACS::VDA5050
