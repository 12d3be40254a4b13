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

/// Who owns a link. Called on the executor, never from within a call of the owner; nothing after onClosed or Kill.
struct LinkOwner
{
    std::function<void()> onOpen;
    std::function<void(std::string_view text)> onText;
    std::function<void(const std::string& reason)> onClosed; ///< Once.
};

/// What a client asks for.
struct UpgradeOffer
{
    std::string host; ///< Of the Host header.
    std::string target;
    std::vector<std::pair<std::string, std::string>> headers;
};

/// One WebSocket connection, over whatever stream. One thread: the executor's.
class ILink
{
public:
    ILink() = default;
    ILink(const ILink&) = delete;
    ILink& operator=(const ILink&) = delete;
    virtual ~ILink() = default;

    /// For a client to connect, before HandshakeAsync.
    [[nodiscard]] virtual boost::beast::tcp_stream& GetTcpStream() = 0;

    /// As a client, over a TCP stream that is connected: TLS where it has it, then the upgrade.
    virtual void HandshakeAsync(UpgradeOffer offer) = 0;

    /// A droppable text is left out where it would come late. Where too much waits, the link is dropped.
    virtual void Send(std::string text, bool bDroppable) = 0;

    /// After what waits to be written; bounded by the close timeout.
    virtual void Close(std::uint16_t code, const std::string& reason) = 0;

    /// Closes the socket without a handshake; onClosed follows. With a reset, so that the other side notices at once.
    virtual void Abort(std::string reason) = 0;

    /// Closes the socket; the owner hears nothing any more.
    virtual void Kill() = 0;
};

} // namespace ACS::ProtocolBeast
