#pragma once

#include <chrono>
#include <cstddef>

namespace ACS::Protocol
{

/// What is accepted from the other side. A text beyond a limit is an error, never a crash.
struct CodecOptions
{
    std::size_t maximumBytes = 4U * 1024U * 1024U; ///< `mcs.max_rx_bytes`; a plan of 75 jobs has about 7.5 KB.
    std::size_t maximumDepth = 64;                 ///< Nested objects and arrays.
    std::size_t maximumString = 64U * 1024U;       ///< Bytes of a string that is no identifier.
    std::size_t maximumArray = 10'000;             ///< Elements of one array.
    bool bUnknownMembersRefused = false;           ///< `mcs.unknown_fields`: else they are ignored and counted.
    bool bLegacyNames = true;                      ///< `mcs.legacy_aliases`: RequestAcsStatus is RequestAcsPlans (D-5).
    bool bLenientJson = false;                     ///< `mcs.json_lenient`: read over comments and spare commas (D-11).
    bool bLocationsChecked = true;                 ///< Refuse a plan with a location that does not parse.
    std::chrono::minutes siteOffset{0};            ///< Assumed for a timestamp without an offset.
};

} // namespace ACS::Protocol
