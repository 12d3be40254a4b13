#pragma once

#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/socket_base.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace ACS::Net
{

/// Listens on a TCP port and passes the connections to a handler. Only its owner holds it, so that the handler, which may
/// destroy the owner, is not called afterwards, nor after Stop. Runs on the single thread of the executor.
class TcpListener final : public std::enable_shared_from_this<TcpListener>
{
public:
    using Tcp = boost::asio::ip::tcp;
    /// Returns whether to accept the next connection at once; otherwise after AcceptAsync.
    using Handler = std::function<bool(Tcp::socket socket)>;

private:
    using ErrorCode = boost::system::error_code;

    /// Delay after a failed accept, for example without a free descriptor.
    static constexpr std::chrono::milliseconds PAUSE{100};

    Core::Logger _logger;
    Handler _handler;
    Tcp::acceptor _acceptor;
    boost::asio::steady_timer _pause;
    std::uint64_t _run = 0; ///< Handlers from before a Stop do nothing.
    std::uint16_t _port = 0;
    bool _bAccepting = false;

public:
    TcpListener(const boost::asio::any_io_executor& executor, Core::Logger logger, Handler handler)
        : _logger(std::move(logger)),
          _handler(std::move(handler)),
          _acceptor(executor),
          _pause(executor)
    {
    }

    /// Listens on a name or an address (IPv6 without brackets), with port 0 on any free port, and accepts. Looks a name
    /// up, which may block: for the start of a program. The port that it got, or an error that names the address and
    /// what to do.
    [[nodiscard]] Core::Result<std::uint16_t> Listen(const std::string& host, std::uint16_t port)
    {
        ErrorCode error;
        Tcp::resolver resolver(_acceptor.get_executor());
        const auto addresses = resolver.resolve(host, std::to_string(port), Tcp::resolver::passive, error);
        if (!error && addresses.empty())
        {
            error = boost::asio::error::host_not_found;
        }
        if (!error)
        {
            Open(addresses.begin()->endpoint(), error);
        }
        if (error)
        {
            Stop();
            return Fail(host, port, error);
        }
        _port = _acceptor.local_endpoint(error).port();
        AcceptAsync();
        return _port;
    }

    /// No effect while already accepting.
    void AcceptAsync()
    {
        if (_bAccepting || !_acceptor.is_open())
        {
            return;
        }
        _bAccepting = true;
        _acceptor.async_accept([weak = weak_from_this(), run = _run](const ErrorCode& error, Tcp::socket socket) {
            const std::shared_ptr<TcpListener> self = weak.lock();
            if (self != nullptr && self->_run == run)
            {
                self->OnAccepted(error, std::move(socket));
            }
        });
    }

    /// Listen may follow.
    void Stop()
    {
        ++_run;
        _bAccepting = false;
        _port = 0;
        ErrorCode ignored;
        static_cast<void>(_acceptor.close(ignored));
        static_cast<void>(_pause.cancel(ignored));
    }

    /// 0 if it does not listen.
    [[nodiscard]] std::uint16_t GetPort() const noexcept
    {
        return _port;
    }

private:
    void Open(const Tcp::endpoint& endpoint, ErrorCode& error)
    {
        static_cast<void>(_acceptor.open(endpoint.protocol(), error));
        if (!error)
        {
            static_cast<void>(_acceptor.set_option(boost::asio::socket_base::reuse_address(true), error));
        }
        if (!error)
        {
            static_cast<void>(_acceptor.bind(endpoint, error));
        }
        if (!error)
        {
            static_cast<void>(_acceptor.listen(boost::asio::socket_base::max_listen_connections, error));
        }
    }

    static tl::unexpected<Core::Error> Fail(const std::string& host, std::uint16_t port, const ErrorCode& error)
    {
        const bool bNeedsBrackets = host.find(':') != std::string::npos;
        const bool bInUse = error == boost::asio::error::address_in_use;
        return Core::Fail(
            static_cast<std::error_code>(error),
            bNeedsBrackets ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port),
            bInUse ? "a free port (stop the program that uses this one, or choose another; 0 takes any free port)"
                   : "an address and port of this machine that this user may listen on",
            fmt::format("'{}'", error.message()));
    }

    void OnAccepted(const ErrorCode& error, Tcp::socket socket)
    {
        _bAccepting = false;
        if (error)
        {
            PauseAsync(error);
            return;
        }
        const std::uint64_t run = _run;
        if (_handler(std::move(socket)) && _run == run)
        {
            AcceptAsync();
        }
    }

    /// Retrying at once would keep the processor busy.
    void PauseAsync(const ErrorCode& error)
    {
        _logger.Warning("cannot accept a connection", {{"reason", error.message()}});
        _pause.expires_after(PAUSE);
        _pause.async_wait([weak = weak_from_this(), run = _run](const ErrorCode& /*error*/) {
            const std::shared_ptr<TcpListener> self = weak.lock();
            if (self != nullptr && self->_run == run)
            {
                self->AcceptAsync();
            }
        });
    }
};

} // namespace ACS::Net
