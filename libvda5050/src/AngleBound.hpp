#pragma once

namespace ACS::VDA5050
{

/// Pi with the room that a peer needs who computes in single precision.
inline constexpr double PI_BOUND = 3.1416;

} // namespace ACS::VDA5050
