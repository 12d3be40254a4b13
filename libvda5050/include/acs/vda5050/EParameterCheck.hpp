#pragma once

#include <cstdint>

namespace ACS::VDA5050
{

/// How the parameters of an action are held against its row in the factsheet. A mandatory one that is missing is always refused.
enum class EParameterCheck : std::uint8_t
{
    Tolerant, ///< As Strict, but numbers and booleans may be written as text, and a row without parameters takes any.
    Strict,   ///< Unlisted parameters and values of another type are refused.
    Lenient, ///< As Tolerant, but unlisted parameters are accepted and reported (ErrorTypes::UNLISTED_PARAMETER, WARNING).
};

} // namespace ACS::VDA5050
