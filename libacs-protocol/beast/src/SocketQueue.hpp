#pragma once

#include <cstddef>

namespace ACS::ProtocolBeast
{

/// Bytes that were written to a TCP socket and that the other side's system has not taken yet; 0 where that cannot be
/// told.
[[nodiscard]] std::size_t CountUntaken(int socket) noexcept;

} // namespace ACS::ProtocolBeast
