#pragma once

#include <cstddef>

namespace ACS::ProtocolBeast
{

/// Bytes that were written to a TCP socket and are not acknowledged yet; 0 if unknown.
[[nodiscard]] std::size_t CountUntaken(int socket) noexcept;

} // namespace ACS::ProtocolBeast
