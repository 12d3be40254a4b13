#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/openstream/IOpenApiService.hpp>
#include <acs/openstream/ServerSessionActions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::OpenStreamAsio
{

/// Where an OpenStreamServer listens, and the options of its sessions.
struct OpenStreamServerOptions
{
    std::string host = "127.0.0.1"; ///< An address, or a name that resolves to one.
    std::uint16_t port = 49'000;    ///< 0: a free port, see GetPort.
    /// Maximum number of connections. One more replaces the oldest connection without a HANDSHAKE, or is rejected with
    /// handshake_rejected if there is none.
    std::size_t maximumSessions = 8;
    OpenStream::ServerSessionOptions session; ///< Times and limits of each ServerSession.
    /// Called with the number of the connection (from 1, in the order of connecting) and all bytes that are received on it. May be
    /// empty. The view is valid during the call, which is made on the executor and must not call the server.
    std::function<void(std::uint64_t connection, std::string_view bytes)> onReceived;
    /// See onReceived: all bytes that are passed to the socket, before they are.
    std::function<void(std::uint64_t connection, std::string_view bytes)> onSent;
    /// See onReceived: the connection is closed. Called once for each connection that was accepted.
    std::function<void(std::uint64_t connection)> onClosed;
};

/// Serves the Open Stream over TCP on a single-threaded executor: a ServerSession for each connection, and one service for
/// all. After destruction or Stop no handler is called. Clock and service must outlive the server.
class ACS_API OpenStreamServer
{
    class ACS_HIDDEN Impl;

    std::shared_ptr<Impl> _impl;

public:
    /// Does not listen before Start.
    OpenStreamServer(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        Core::Logger logger,
        OpenStreamServerOptions options,
        OpenStream::IOpenApiService& service);
    OpenStreamServer(const OpenStreamServer&) = delete;
    OpenStreamServer& operator=(const OpenStreamServer&) = delete;
    ~OpenStreamServer();

    /// Listens; no effect if it listens already. The error names the address and the remedy.
    [[nodiscard]] Core::Result<void> Start();

    /// Closes the port and all connections without a last line. Start may follow.
    void Stop();

    /// Closes all connections without a last line, like a controller that fails; continues to listen.
    void DropSessions();

    /// The port that the server listens on; 0 if it does not listen.
    [[nodiscard]] std::uint16_t GetPort() const noexcept;
    /// Number of open connections.
    [[nodiscard]] std::size_t GetSessionCount() const noexcept;

    /// Counters of all sessions since the server was created, including ended ones.
    [[nodiscard]] OpenStream::ServerSessionStats GetStats() const noexcept;
};

} // namespace ACS::OpenStreamAsio
