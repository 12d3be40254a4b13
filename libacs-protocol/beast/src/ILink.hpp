#pragma once

#include <boost/beast/core/tcp_stream.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::ProtocolBeast
{

/// The owner of a link. Called on the executor, never during a call of the owner, and not after onClosed or Kill.
struct LinkOwner
{
    std::function<void()> onOpen;
    std::function<void(std::string_view text)> onText;
    std::function<void(const std::string& reason)> onClosed; ///< Once.
};

/// The upgrade request of a client.
struct UpgradeOffer
{
    std::string host; ///< Of the Host header.
    std::string target;
    std::vector<std::pair<std::string, std::string>> headers;
};

/// A WebSocket connection over any stream. Runs on the single thread of the executor.
class ILink
{
public:
    ILink() = default;
    ILink(const ILink&) = delete;
    ILink& operator=(const ILink&) = delete;
    virtual ~ILink() = default;

    /// The socket that a client connects before HandshakeAsync.
    [[nodiscard]] virtual boost::beast::tcp_stream& GetTcpStream() = 0;

    /// As a client, over a connected TCP stream: TLS if configured, then the upgrade.
    virtual void HandshakeAsync(UpgradeOffer offer) = 0;

    /// A droppable text is dropped if it would be late. If too many bytes wait, the link is closed.
    virtual void Send(std::string text, bool bDroppable) = 0;

    /// Closes after the waiting texts; limited by the close timeout.
    virtual void Close(std::uint16_t code, const std::string& reason) = 0;

    /// Closes the socket without a closing handshake; onClosed follows. Sends a reset, so that the other side notices at once.
    virtual void Abort(std::string reason) = 0;

    /// Closes the socket; the owner is not called any more.
    virtual void Kill() = 0;
};

} // namespace ACS::ProtocolBeast
