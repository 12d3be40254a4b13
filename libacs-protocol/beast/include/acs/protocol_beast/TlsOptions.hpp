#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// TLS 1.2 or newer. All files are PEM files, read by Create and AcsClient::ReloadTLS; an empty name means
/// none.
struct TlsOptions
{
    /// Client: the CA of the server's certificate; none: the system's CAs. Server: the CA of the certificates that clients
    /// must present; none: clients need none.
    std::string caFile;
    /// The own certificate, followed by the intermediate certificates up to its CA. Required for a server.
    std::string certificateFile;
    std::string keyFile;    ///< Private key of the certificate, without a passphrase.
    std::string serverName; ///< Name that the server's certificate must be issued for; empty: the URL's host.

    bool operator==(const TlsOptions&) const = default;
};

/// Checks what AcsClient::Create would reject for a server of that host; reads the files. The error's path is "tls.ca",
/// "tls.certificate", "tls.key" or "tls.server_name"; the error names the file and what is wrong with it.
[[nodiscard]] ACS_API Core::Result<void> CheckClientTLS(const TlsOptions& options, std::string_view host);

} // namespace ACS::ProtocolBeast
