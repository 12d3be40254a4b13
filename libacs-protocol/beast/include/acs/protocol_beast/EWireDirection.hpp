#pragma once

#include <cstdint>

namespace ACS::ProtocolBeast
{

/// Which way a text goes, as the observing side sees it.
enum class EWireDirection : std::uint8_t
{
    In,
    Out,
};

} // namespace ACS::ProtocolBeast
