#pragma once

#include <acs/core/Result.hpp>
#include <acs/protocol_beast/ClientOptions.hpp>

namespace ACS::ProtocolBeast
{

/// Whether the host and every extra header may stand in a request: a line end in one would smuggle in another.
[[nodiscard]] Core::Result<void> CheckHeaders(const ClientOptions& options);

} // namespace ACS::ProtocolBeast
