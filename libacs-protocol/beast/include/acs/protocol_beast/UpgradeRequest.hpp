#pragma once

#include <acs/protocol/SessionEvent.hpp>
#include <acs/protocol_beast/HttpHeaders.hpp>

#include <cstdint>
#include <string>

namespace ACS::ProtocolBeast
{

/// The HTTP request with which a client of an McsServer asks for a WebSocket.
struct UpgradeRequest
{
    Protocol::ConnectionID connection = 0; ///< That of the events, if the request is accepted.
    std::string peerAddress;               ///< An IP address; empty: the client has disconnected.
    std::uint16_t peerPort = 0;            ///< 0: the client has disconnected.
    std::string target;                    ///< As sent: path and query, not decoded.
    HttpHeaders headers; ///< As sent, in their order. A value has any bytes except control characters.
    /// Subject of the client's certificate, which the CA of ServerOptions::tls has issued, in the format of RFC 2253:
    /// "CN=acs-1,O=Plant". Empty: no certificate is demanded, or it has no subject.
    std::string certificateSubject;
};

} // namespace ACS::ProtocolBeast
