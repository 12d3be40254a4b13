#pragma once

#include <chrono>
#include <cstddef>

namespace ACS::Protocol
{

/// What is accepted from the other side. A text beyond a limit is rejected.
struct CodecOptions
{
    std::size_t maximumBytes = 4U * 1024U * 1024U; ///< Of a text; a plan of 75 jobs has about 7.5 KB.
    std::size_t maximumDepth = 64;                 ///< Of nested objects and arrays.
    std::size_t maximumString = 64U * 1024U;       ///< Bytes of a string that is not an identifier.
    std::size_t maximumArray = 10'000;             ///< Elements of one array.
    bool bUnknownMembersRefused = false;           ///< Otherwise unknown members are ignored and counted.
    bool bLegacyNames = true;                      ///< Accept RequestAcsStatus as RequestAcsPlans (D-5).
    bool bLenientJSON = false;                     ///< Accept comments and trailing commas (D-11).
    bool bLocationsChecked = true;                 ///< Reject a plan with an invalid location.
    std::chrono::minutes siteOffset{0};            ///< Assumed for a timestamp without an offset.
};

} // namespace ACS::Protocol
