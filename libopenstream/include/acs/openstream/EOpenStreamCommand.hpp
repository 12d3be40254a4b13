#pragma once

#include <cstdint>

namespace ACS::OpenStream
{

/// The commands of a client.
enum class EOpenStreamCommand : std::uint8_t
{
    Handshake,
    Monitor,
    Control,
    Stop,
};

} // namespace ACS::OpenStream
