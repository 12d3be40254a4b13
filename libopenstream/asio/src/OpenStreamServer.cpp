#include "ServerConnection.hpp"
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::OpenStreamAsio
{

namespace
{

constexpr std::chrono::milliseconds ACCEPT_RETRY{100};
constexpr std::size_t REJECTED_AT_ONCE = 8; ///< Connections that are told why they are closed; more are just closed.

using Acceptor = boost::asio::ip::tcp::acceptor;
using Endpoint = boost::asio::ip::tcp::endpoint;

tl::unexpected<Core::Error> FailListening(
    const OpenStreamServerOptions& options,
    const boost::system::error_code& error)
{
    const bool bInUse = error == boost::asio::error::address_in_use;
    const std::string_view advice = bInUse
        ? "another program uses the port: end it, or choose another port (0 picks a free one)"
        : "choose an address of this machine and a port that this user may open";
    return Core::Fail(
        static_cast<std::error_code>(error),
        {},
        fmt::format("to listen for Open Stream clients on {}:{}; {}", options.host, options.port, advice),
        error.message());
}

} // namespace

class OpenStreamServer::Impl final : public std::enable_shared_from_this<OpenStreamServer::Impl>
{
    boost::asio::any_io_executor _executor;
    Core::IClock& _clock;
    Core::Logger _logger;
    OpenStreamServerOptions _options;
    OpenStream::IOpenApiService& _service;
    Acceptor _acceptor;
    boost::asio::steady_timer _retryTimer;
    std::vector<std::shared_ptr<ServerConnection>> _connections;
    std::uint16_t _port = 0;

    void AcceptAsync()
    {
        _acceptor.async_accept(
            [weak = weak_from_this()](const boost::system::error_code& error, boost::asio::ip::tcp::socket socket) {
                const std::shared_ptr<Impl> self = weak.lock();
                if (self != nullptr && self->_acceptor.is_open())
                {
                    self->OnAccepted(error, std::move(socket));
                }
            });
    }

    void OnAccepted(const boost::system::error_code& error, boost::asio::ip::tcp::socket socket)
    {
        if (error)
        {
            RetryAsync(error);
            return;
        }
        const std::size_t count = _connections.size();
        if (count < _options.maximumSessions + REJECTED_AT_ONCE)
        {
            auto connection = std::make_shared<ServerConnection>(
                std::move(socket),
                _clock,
                _logger,
                _options.session,
                _service,
                [weak = weak_from_this()](ServerConnection& closed) {
                    if (const std::shared_ptr<Impl> self = weak.lock())
                    {
                        self->Forget(closed);
                    }
                });
            _connections.push_back(connection);
            if (count < _options.maximumSessions)
            {
                connection->Start();
            }
            else
            {
                connection->Reject("this controller serves no more sessions at once");
            }
        }
        AcceptAsync();
    }

    /// Out of file descriptors, or the client was gone already: not worth a busy loop.
    void RetryAsync(const boost::system::error_code& error)
    {
        _logger.Warning("an Open Stream client could not be accepted", {{"reason", error.message()}});
        _retryTimer.expires_after(ACCEPT_RETRY);
        _retryTimer.async_wait([weak = weak_from_this()](const boost::system::error_code& waitError) {
            const std::shared_ptr<Impl> self = weak.lock();
            if (!waitError && self != nullptr && self->_acceptor.is_open())
            {
                self->AcceptAsync();
            }
        });
    }

    void Forget(const ServerConnection& closed)
    {
        std::erase_if(_connections, [&closed](const auto& connection) { return connection.get() == &closed; });
    }

    [[nodiscard]] boost::system::error_code TryListen()
    {
        boost::system::error_code error;
        boost::asio::ip::tcp::resolver resolver(_executor);
        const auto found = resolver.resolve(
            _options.host,
            std::to_string(_options.port),
            boost::asio::ip::tcp::resolver::passive,
            error);
        if (error)
        {
            return error;
        }
        const Endpoint endpoint = found.begin()->endpoint();
        static_cast<void>(_acceptor.open(endpoint.protocol(), error));
        if (!error)
        {
            static_cast<void>(_acceptor.set_option(Acceptor::reuse_address(true), error));
        }
        if (!error)
        {
            static_cast<void>(_acceptor.bind(endpoint, error));
        }
        if (!error)
        {
            static_cast<void>(_acceptor.listen(Acceptor::max_listen_connections, error));
        }
        if (!error)
        {
            _port = _acceptor.local_endpoint(error).port();
        }
        return error;
    }

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        Core::Logger logger,
        OpenStreamServerOptions options,
        OpenStream::IOpenApiService& service)
        : _executor(executor),
          _clock(clock),
          _logger(std::move(logger)),
          _options(std::move(options)),
          _service(service),
          _acceptor(executor),
          _retryTimer(executor)
    {
    }

    [[nodiscard]] Core::Result<void> Start()
    {
        if (const boost::system::error_code error = TryListen())
        {
            Stop();
            return FailListening(_options, error);
        }
        AcceptAsync();
        return {};
    }

    void Stop()
    {
        _port = 0;
        boost::system::error_code ignored;
        static_cast<void>(_retryTimer.cancel(ignored));
        static_cast<void>(_acceptor.close(ignored));
        DropSessions();
    }

    void DropSessions()
    {
        for (const std::shared_ptr<ServerConnection>& connection : std::exchange(_connections, {}))
        {
            connection->Abort();
        }
    }

    [[nodiscard]] std::uint16_t GetPort() const noexcept
    {
        return _port;
    }

    [[nodiscard]] std::size_t GetSessionCount() const noexcept
    {
        return _connections.size();
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

} // namespace ACS::OpenStreamAsio
