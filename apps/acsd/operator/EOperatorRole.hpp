#pragma once

#include <cstdint>

namespace ACS::Acsd
{

/// What a client of the operator interface may do.
enum class EOperatorRole : std::uint8_t
{
    Viewer,  ///< Read.
    Operator ///< Read and command.
};

} // namespace ACS::Acsd
