#pragma once

#include <cstdint>

namespace ACS::VDA5050
{

/// How the parameters of an action are checked against the factsheet. A missing mandatory parameter is always refused.
enum class EParameterCheck : std::uint8_t
{
    Tolerant, ///< Like Strict, but numbers and booleans may be strings, and an action without listed parameters accepts any.
    Strict, ///< Unlisted parameters and values of another type are refused.
    Lenient, ///< Like Tolerant, but unlisted parameters are accepted and reported (ErrorTypes::UNLISTED_PARAMETER, WARNING).
};

} // namespace ACS::VDA5050
