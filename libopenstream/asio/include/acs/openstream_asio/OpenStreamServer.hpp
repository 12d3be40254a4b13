#pragma once

#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/openstream/IOpenApiService.hpp>
#include <acs/openstream/ServerSessionActions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace ACS::OpenStreamAsio
{

struct OpenStreamServerOptions
{
    std::string host = "127.0.0.1"; ///< An address, or a name that resolves to one.
    std::uint16_t port = 49'000;    ///< 0 picks a free one: see GetPort.
    /// One more takes the place of the oldest connection without a HANDSHAKE. Where there is none, it gets
    /// handshake_rejected and is closed.
    std::size_t maximumSessions = 8;
    OpenStream::ServerSessionOptions session;
};

/// Serves the Open Stream over TCP: a ServerSession for each connection, one service behind all. Everything happens on the
/// executor's one thread; destroying or stopping it lets no handler touch it later. Clock and service must outlive it.
class OpenStreamServer
{
    class Impl;

    std::shared_ptr<Impl> _impl;

public:
    OpenStreamServer(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        Core::Logger logger,
        OpenStreamServerOptions options,
        OpenStream::IOpenApiService& service);
    OpenStreamServer(const OpenStreamServer&) = delete;
    OpenStreamServer& operator=(const OpenStreamServer&) = delete;
    ~OpenStreamServer();

    /// Binds and listens; nothing where it listens already. The error names the address and what to do.
    [[nodiscard]] Core::Result<void> Start();

    /// Closes the port and every connection, without a last line. Start may follow.
    void Stop();

    /// Closes every connection without a last line, as a controller that breaks down does; goes on listening.
    void DropSessions();

    /// The port that it listens on; 0 where it does not.
    [[nodiscard]] std::uint16_t GetPort() const noexcept;
    [[nodiscard]] std::size_t GetSessionCount() const noexcept;

    /// What all sessions did since the server was made, those that have ended too.
    [[nodiscard]] OpenStream::ServerSessionStats GetStats() const noexcept;
};

} // namespace ACS::OpenStreamAsio
