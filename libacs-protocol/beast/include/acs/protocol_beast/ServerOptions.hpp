#pragma once

#include <acs/protocol_beast/ClientOptions.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::ProtocolBeast
{

/// Where an McsServer listens.
struct ServerOptions
{
    std::string address = "127.0.0.1"; ///< An address, or a name that resolves to one.
    std::uint16_t port = 0;            ///< 0: one that is free; GetPort tells.
    std::string path = "/acs/";        ///< With or without the last slash; every other path gets 404.
    std::size_t maximumClients = 16;   ///< Connections at a time, those without an upgrade included.
    std::optional<TlsOptions> tls{};   ///< There: wss and nothing else, with certificate and key.
    LinkOptions link{};
    Protocol::McsSessionOptions session{};
};

} // namespace ACS::ProtocolBeast
