#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/tcp_stream.hpp>

#include <memory>
#include <optional>
#include <utility>

namespace ACS::Apps
{

/// The transport of an HTTP connection: TCP, or TLS over it.
class HttpStream final
{
public:
    using TcpStream = boost::beast::tcp_stream;
    using TlsStream = boost::asio::ssl::stream<TcpStream&>;

private:
    std::shared_ptr<boost::asio::ssl::context> _contextOrNull;
    TcpStream _tcp;
    std::optional<TlsStream> _tlsOrNull;

public:
    /// The context of a server; null: no TLS.
    HttpStream(boost::asio::ip::tcp::socket socket, std::shared_ptr<boost::asio::ssl::context> contextOrNull)
        : _contextOrNull(std::move(contextOrNull)),
          _tcp(std::move(socket))
    {
        if (_contextOrNull != nullptr)
        {
            _tlsOrNull.emplace(_tcp, *_contextOrNull);
        }
    }

    [[nodiscard]] TcpStream& GetTCP() noexcept
    {
        return _tcp;
    }

    /// nullptr: no TLS.
    [[nodiscard]] TlsStream* GetTlsOrNull() noexcept
    {
        return _tlsOrNull.has_value() ? &*_tlsOrNull : nullptr;
    }

    /// Calls the function with the stream of the plain text.
    template <typename TUse>
    void Use(TUse use)
    {
        if (_tlsOrNull.has_value())
        {
            use(*_tlsOrNull);
        }
        else
        {
            use(_tcp);
        }
    }
};

} // namespace ACS::Apps
