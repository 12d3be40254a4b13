#pragma once

#include <acs/core/Result.hpp>
#include <acs/protocol_beast/TlsOptions.hpp>

#include <boost/asio/ssl/context.hpp>

#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// Trusts the CA file or the system, and accepts a server's certificate only if it is for the server name or, without
/// one, for the host.
[[nodiscard]] Core::Result<boost::asio::ssl::context> MakeClientContext(
    const TlsOptions& options,
    std::string_view host);

/// With a CA file a client must show a certificate.
[[nodiscard]] Core::Result<boost::asio::ssl::context> MakeServerContext(const TlsOptions& options);

/// The name that a client asks for in the handshake (SNI); empty where there is only an address.
[[nodiscard]] std::string GetRequestedName(const TlsOptions& options, std::string_view host);

/// Before the handshake; nothing where the name is empty.
void SetRequestedName(SSL* stream, const std::string& name);

/// After the handshake: the subject of the other side's verified certificate (RFC 2253); empty: it has shown none.
[[nodiscard]] std::string GetPeerSubject(SSL* stream);

} // namespace ACS::ProtocolBeast
