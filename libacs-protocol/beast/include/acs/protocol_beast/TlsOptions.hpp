#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// Whom a side trusts over TLS (1.2 or newer), and what it shows of itself. Files in PEM form, read once, by Create; an
/// empty name: none.
struct TlsOptions
{
    /// `mcs.tls.ca`. Client: who has signed the server's certificate; none: the CAs that the system trusts. Server: who
    /// has signed the certificates that clients must show; none: clients show none.
    std::string caFile;
    /// `mcs.tls.certificate`: the own certificate, then those between it and its CA. A server needs one.
    std::string certificateFile;
    std::string keyFile; ///< `mcs.tls.key`: the private key of the certificate, without a passphrase.
    std::string
        serverName; ///< `mcs.tls.server_name`: whom the server's certificate must be for; empty: the URL's host.

    bool operator==(const TlsOptions&) const = default;
};

/// Whether AcsClient::Create would take them for a server of that host: reads the files. The error's path is the
/// key ("tls.ca", "tls.certificate", "tls.key", "tls.server_name"); it names the file and what is wrong with it.
[[nodiscard]] Core::Result<void> CheckClientTls(const TlsOptions& options, std::string_view host);

} // namespace ACS::ProtocolBeast
