#include "ServerConnection.hpp"
#include <acs/net/TcpListener.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/ip/tcp.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace ACS::OpenStreamAsio
{

namespace
{

/// Connections that end but have not closed yet: their last lines leave. More are closed without a line.
constexpr std::size_t MAX_ENDING = 8;

} // namespace

class OpenStreamServer::Impl final : public std::enable_shared_from_this<OpenStreamServer::Impl>
{
    Core::IClock& _clock;
    Core::Logger _logger;
    OpenStreamServerOptions _options;
    OpenStream::IOpenApiService& _service;
    std::shared_ptr<Net::TcpListener> _listener;
    std::vector<std::shared_ptr<ServerConnection>> _connections;
    OpenStream::ServerSessionStats _endedStats;
    std::uint64_t _accepted = 0; ///< The number of the latest connection.

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        Core::Logger logger,
        OpenStreamServerOptions options,
        OpenStream::IOpenApiService& service)
        : _clock(clock),
          _logger(std::move(logger)),
          _options(std::move(options)),
          _service(service),
          _listener(std::make_shared<Net::TcpListener>(executor, _logger, [this](boost::asio::ip::tcp::socket socket) {
              OnAccepted(std::move(socket));
              return true;
          }))
    {
    }

    [[nodiscard]] Core::Result<void> Start()
    {
        if (_listener->GetPort() != 0)
        {
            return {}; // Another attempt would close the port that it has.
        }
        const Core::Result<std::uint16_t> port = _listener->Listen(_options.host, _options.port);
        if (!port.has_value())
        {
            return tl::make_unexpected(port.error());
        }
        return {};
    }

    void Stop()
    {
        _listener->Stop();
        DropSessions();
    }

    void DropSessions()
    {
        for (const std::shared_ptr<ServerConnection>& connection : std::exchange(_connections, {}))
        {
            _endedStats += connection->GetStats();
            connection->Abort();
        }
    }

    [[nodiscard]] std::uint16_t GetPort() const noexcept
    {
        return _listener->GetPort();
    }

    [[nodiscard]] std::size_t GetSessionCount() const noexcept
    {
        return _connections.size();
    }

    [[nodiscard]] OpenStream::ServerSessionStats GetStats() const noexcept
    {
        OpenStream::ServerSessionStats total = _endedStats;
        for (const std::shared_ptr<ServerConnection>& connection : _connections)
        {
            total += connection->GetStats();
        }
        return total;
    }

private:
    void OnAccepted(boost::asio::ip::tcp::socket socket)
    {
        const bool bRoom = CountSessions() < _options.maximumSessions || TryEvictSilent();
        if (_connections.size() >= _options.maximumSessions + MAX_ENDING)
        {
            return;
        }
        auto connection = std::make_shared<ServerConnection>(
            std::move(socket),
            _clock,
            _logger,
            _options,
            ++_accepted,
            _service,
            MakeHandlers());
        _connections.push_back(connection);
        if (bRoom)
        {
            connection->Start();
        }
        else
        {
            connection->Reject("this controller serves no more sessions at once");
        }
    }

    [[nodiscard]] ServerConnection::Handlers MakeHandlers()
    {
        ServerConnection::Handlers handlers;
        handlers.onClosed = [weak = weak_from_this()](ServerConnection& closed) {
            if (const std::shared_ptr<Impl> self = weak.lock())
            {
                self->Forget(closed);
            }
        };
        handlers.isOtherInControl = [weak = weak_from_this()](const ServerConnection& asking) {
            const std::shared_ptr<Impl> self = weak.lock();
            return self != nullptr && self->IsOtherInControl(asking);
        };
        return handlers;
    }

    [[nodiscard]] bool IsOtherInControl(const ServerConnection& asking) const
    {
        return std::ranges::any_of(_connections, [&asking](const auto& connection) {
            return connection.get() != &asking && connection->HasControl();
        });
    }

    /// Those that end do not count: they are served no more.
    [[nodiscard]] std::size_t CountSessions() const
    {
        return static_cast<std::size_t>(std::ranges::count_if(_connections, [](const auto& connection) {
            return connection->GetState() < OpenStream::EServerState::Closing;
        }));
    }

    /// Ends the oldest connection that has sent no HANDSHAKE yet. False where there is none.
    [[nodiscard]] bool TryEvictSilent()
    {
        const auto oldest = std::ranges::find_if(_connections, [](const auto& connection) {
            return connection->GetState() == OpenStream::EServerState::Connected;
        });
        if (oldest == _connections.end())
        {
            return false;
        }
        const std::shared_ptr<ServerConnection> connection = *oldest;
        if (_connections.size() < _options.maximumSessions + MAX_ENDING)
        {
            connection->Reject("no HANDSHAKE came, and another client needs the session");
            return true;
        }
        connection->Abort();
        Forget(*connection);
        return true;
    }

    void Forget(const ServerConnection& closed)
    {
        _endedStats += closed.GetStats();
        std::erase_if(_connections, [&closed](const auto& connection) { return connection.get() == &closed; });
    }
};

OpenStreamServer::OpenStreamServer(
    const boost::asio::any_io_executor& executor,
    Core::IClock& clock,
    Core::Logger logger,
    OpenStreamServerOptions options,
    OpenStream::IOpenApiService& service)
    : _impl(std::make_shared<Impl>(executor, clock, std::move(logger), std::move(options), service))
{
}

OpenStreamServer::~OpenStreamServer()
{
    _impl->Stop();
}

Core::Result<void> OpenStreamServer::Start()
{
    return _impl->Start();
}

void OpenStreamServer::Stop()
{
    _impl->Stop();
}

void OpenStreamServer::DropSessions()
{
    _impl->DropSessions();
}

std::uint16_t OpenStreamServer::GetPort() const noexcept
{
    return _impl->GetPort();
}

std::size_t OpenStreamServer::GetSessionCount() const noexcept
{
    return _impl->GetSessionCount();
}

OpenStream::ServerSessionStats OpenStreamServer::GetStats() const noexcept
{
    return _impl->GetStats();
}

} // namespace ACS::OpenStreamAsio
