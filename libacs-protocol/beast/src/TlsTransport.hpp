#pragma once

#include "ITransport.hpp"
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/TlsOptions.hpp>

#include <memory>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// wss, for a client of that host. Reads the files.
[[nodiscard]] Core::Result<std::unique_ptr<ITransport>> MakeTlsClientTransport(
    const TlsOptions& options,
    std::string_view host);

/// wss, for a server. Reads the files.
[[nodiscard]] Core::Result<std::unique_ptr<ITransport>> MakeTlsServerTransport(const TlsOptions& options);

} // namespace ACS::ProtocolBeast
