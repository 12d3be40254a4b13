#include "common/http/HttpServer.hpp"

#include "common/http/HttpPeer.hpp"
#include "common/http/HttpStream.hpp"
#include "common/http/HttpTls.hpp"
#include "common/log/LogRateLimiter.hpp"
#include <acs/net/TcpListener.hpp>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/socket_base.hpp>
#include <boost/asio/ssl/stream_base.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>

#include <algorithm>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Apps
{

namespace
{

namespace Asio = boost::asio;
namespace Beast = boost::beast;
namespace Http = boost::beast::http;
using Tcp = boost::asio::ip::tcp;
using ErrorCode = boost::system::error_code;

/// Maximum time to read from a refused peer before the connection is closed. If it were closed with unread bytes, the system
/// would drop the response too.
constexpr std::chrono::seconds DRAIN_TIME{2};
constexpr std::size_t DRAIN_BYTES = 16U * 1024U;

/// Limit of bytes that were read but not parsed. Beast itself has no limit for the extension after the size of a chunk.
constexpr std::size_t BUFFER_BYTES = 64U * 1024U;

/// Limit of what the system keeps for a peer that does not read. By default it may be some megabytes: then a peer that sends
/// requests without a pause and reads nothing would have hundreds of them answered.
constexpr int SEND_BUFFER_BYTES = 16 * 1024;

constexpr std::string_view CONTINUE = "HTTP/1.1 100 Continue\r\n\r\n";

HttpResponse MakeRefusal(Http::status status, std::string reason)
{
    HttpResponse response;
    response.status = static_cast<unsigned>(status);
    response.body = std::move(reason) + "\n";
    return response;
}

/// The response to a request that Beast could not read; nullopt if the peer disconnected or the time limit expired.
std::optional<HttpResponse> MakeRefusalOrNull(const ErrorCode& error, const HttpLimits& limits)
{
    if (error == Http::error::body_limit)
    {
        return MakeRefusal(
            Http::status::payload_too_large,
            "the body is longer than " + std::to_string(limits.maxBodyBytes) + " bytes");
    }
    if (error == Http::error::header_limit)
    {
        return MakeRefusal(
            Http::status::request_header_fields_too_large,
            "the header is longer than " + std::to_string(limits.maxHeaderBytes) + " bytes");
    }
    const bool bHttpError = error.category() == Http::make_error_code(Http::error::bad_method).category();
    if (bHttpError && error != Http::error::end_of_stream && error != Http::error::partial_message)
    {
        return MakeRefusal(Http::status::bad_request, "not an HTTP/1.1 request");
    }
    return std::nullopt;
}

} // namespace

namespace
{

/// What a connection does; in the order in which a further one replaces it, Answering never.
enum class EConnectionState : std::uint8_t
{
    Reading,   ///< Waits for a complete request.
    Writing,   ///< Waits until the peer has read the response.
    Answering, ///< The handler has delayed the response.
    Closed,
};

} // namespace

struct HttpServer::Impl : std::enable_shared_from_this<Impl>
{
    class Connection;
    using ConnectionList = std::list<std::shared_ptr<Connection>>;

    Handler handler;
    Core::Logger logger;
    LogRateLimiter refusals; ///< Rate-limited, because any peer can cause these lines.
    HttpLimits limits;
    std::optional<HttpGuard> guardOrNull;
    std::shared_ptr<Asio::ssl::context> tlsContextOrNull; ///< Of further connections.
    std::shared_ptr<Net::TcpListener> listener;
    ConnectionList connections;
    std::optional<Tcp::socket> nextOrNull; ///< Accepted while all connections were being answered.

    Impl(
        const Asio::any_io_executor& executor,
        Handler handlerToCall,
        Core::Logger serverLogger,
        HttpLimits serverLimits,
        std::optional<HttpGuard> serverGuardOrNull)
        : handler(std::move(handlerToCall)),
          logger(std::move(serverLogger)),
          refusals(logger),
          limits(serverLimits),
          guardOrNull(std::move(serverGuardOrNull)),
          listener(std::make_shared<Net::TcpListener>(executor, logger, [this](Tcp::socket socket) {
              OnAccepted(std::move(socket));
              return !nextOrNull.has_value();
          }))
    {
    }

    Core::Result<Endpoint> Listen(const Endpoint& endpoint);
    void LogRefusal(std::string_view kind, std::string_view reason);
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(
        const HttpRequest& request,
        const Http::fields& header) const;
    [[nodiscard]] bool IsFull(const Asio::ip::address& peer) const;
    [[nodiscard]] std::shared_ptr<Connection> FindReplaceableOrNull(const Asio::ip::address& peer) const;
    void OnAccepted(Tcp::socket socket);
    void TakeNext();
    void OnClosed(ConnectionList::iterator place);
    void Stop();
};

/// The connection of a peer: reads a request, answers it, reads the next one. Owned by the server's list and by its pending
/// operation.
class HttpServer::Impl::Connection : public std::enable_shared_from_this<Connection>
{
    std::weak_ptr<Impl> _server;
    HttpLimits _limits;
    HttpStream _stream;
    Beast::flat_buffer _buffer{BUFFER_BYTES};
    std::optional<Http::request_parser<Http::string_body>> _parserOrNull;
    std::optional<Http::response<Http::string_body>> _responseOrNull;
    std::optional<Http::response_serializer<Http::string_body>> _serializerOrNull;
    Asio::steady_timer _delay;
    const Asio::ip::address _group;
    const Endpoint _peer;
    std::string _certificateName; ///< Of the client; empty without a certificate.
    EConnectionState _state = EConnectionState::Reading;

public:
    ConnectionList::iterator
        place; ///< In the server's list, whose first connection has had its state for the longest time.

    Connection(const std::shared_ptr<Impl>& server, Tcp::socket socket)
        : _server(server),
          _limits(server->limits),
          _stream(std::move(socket), server->tlsContextOrNull),
          _delay(_stream.GetTCP().get_executor()),
          _group(GetPeerGroup(_stream.GetTCP().socket())),
          _peer(GetPeer(_stream.GetTCP().socket()))
    {
    }

    /// Call once.
    void StartAsync()
    {
        HttpStream::TlsStream* const tlsOrNull = _stream.GetTlsOrNull();
        if (tlsOrNull == nullptr)
        {
            return ReadAsync();
        }
        Enter(EConnectionState::Reading);
        _stream.GetTCP().expires_after(_limits.timeout);
        tlsOrNull->async_handshake(
            Asio::ssl::stream_base::server,
            Beast::bind_front_handler(&Connection::OnHandshake, shared_from_this()));
    }

    void ReadAsync()
    {
        Enter(EConnectionState::Reading);
        _parserOrNull.emplace();
        _parserOrNull->header_limit(_limits.maxHeaderBytes);
        _parserOrNull->body_limit(_limits.maxBodyBytes);
        _stream.GetTCP().expires_after(_limits.timeout);
        _stream.Use([this](auto& stream) {
            Http::async_read_header(
                stream,
                _buffer,
                *_parserOrNull,
                Beast::bind_front_handler(&Connection::OnHeader, shared_from_this()));
        });
    }

    [[nodiscard]] EConnectionState GetState() const noexcept
    {
        return _state;
    }

    [[nodiscard]] const Asio::ip::address& GetGroup() const noexcept
    {
        return _group;
    }

    void Close()
    {
        _state = EConnectionState::Closed;
        ErrorCode ignored;
        _delay.cancel(ignored);
        _stream.GetTCP().socket().shutdown(Tcp::socket::shutdown_both, ignored);
        _stream.GetTCP().close();
    }

private:
    /// A state in which it can be replaced.
    void Enter(EConnectionState state)
    {
        _state = state;
        const std::shared_ptr<Impl> server = _server.lock();
        if (server == nullptr || place == server->connections.end())
        {
            return;
        }
        server->connections.splice(server->connections.end(), server->connections, place);
        if (server->nextOrNull.has_value())
        {
            // Posted, because it may close this connection.
            Asio::post(_stream.GetTCP().get_executor(), [weak = _server]() {
                if (const std::shared_ptr<Impl> owner = weak.lock(); owner != nullptr)
                {
                    owner->TakeNext();
                }
            });
        }
    }

    void OnHandshake(const ErrorCode& error)
    {
        const std::shared_ptr<Impl> server = _server.lock();
        if (server == nullptr || !IsOpen())
        {
            return Leave();
        }
        if (error.failed())
        {
            const std::string reason = DescribeHandshakeError(error);
            server->LogRefusal("handshake " + reason, reason);
            return EndAsync(); // the peer reads the alert of TLS
        }
        _certificateName = GetClientName(_stream.GetTlsOrNull()->native_handle());
        ReadAsync();
    }

    [[nodiscard]] std::string DescribeHandshakeError(const ErrorCode& error)
    {
        const long verified = SSL_get_verify_result(_stream.GetTlsOrNull()->native_handle());
        return verified == X509_V_OK ? "TLS handshake: " + error.message()
                                     : std::string("client certificate: ") + X509_verify_cert_error_string(verified);
    }

    void OnHeader(const ErrorCode& error, std::size_t count)
    {
        if (error.failed() || _parserOrNull->is_done())
        {
            return OnRead(error, count);
        }
        if (!Beast::iequals(_parserOrNull->get()[Http::field::expect], "100-continue"))
        {
            return ReadBodyAsync();
        }
        // The client sends the body only after this answer.
        _stream.Use([this](auto& stream) {
            Asio::async_write(
                stream,
                Asio::buffer(CONTINUE),
                [self = shared_from_this()](const ErrorCode& writeError, std::size_t written) {
                    if (writeError.failed())
                    {
                        return self->OnRead(writeError, written);
                    }
                    self->ReadBodyAsync();
                });
        });
    }

    void ReadBodyAsync()
    {
        _stream.Use([this](auto& stream) {
            Http::async_read(
                stream,
                _buffer,
                *_parserOrNull,
                Beast::bind_front_handler(&Connection::OnRead, shared_from_this()));
        });
    }

    void OnRead(const ErrorCode& error, std::size_t /*count*/)
    {
        const std::shared_ptr<Impl> server = _server.lock();
        if (server == nullptr || !IsOpen())
        {
            return Leave();
        }
        _state = EConnectionState::Answering;
        if (error.failed())
        {
            const std::optional<HttpResponse> refusal = MakeRefusalOrNull(error, _limits);
            if (!refusal.has_value())
            {
                return Leave();
            }
            const std::string reason = error.message();
            server->LogRefusal(reason, reason);
            return WriteAsync(*refusal, false, false);
        }
        const auto& request = _parserOrNull->get();
        const std::string_view target(request.target().data(), request.target().size());
        Core::Result<HttpRequest> parsed = ParseHttpTarget(target);
        const bool bHead = request.method() == Http::verb::head;
        if (!parsed.has_value())
        {
            const HttpResponse refusal = MakeRefusal(Http::status::bad_request, Core::Describe(parsed.error()));
            return WriteAsync(refusal, request.keep_alive(), bHead);
        }
        parsed->method = std::string(request.method_string());
        parsed->body = request.body();
        parsed->sender = MakeSender(request);
        if (const std::optional<std::string> rejection = server->GetRejectionReasonOrNull(*parsed, request))
        {
            server->LogRefusal("forbidden", *rejection);
            return WriteAsync(MakeRefusal(Http::status::forbidden, *rejection), request.keep_alive(), bHead);
        }
        // Copied, because the handler may stop and destroy the server.
        const Handler makeResponse = server->handler;
        const HttpResponse response = makeResponse(*parsed);
        PrepareResponse(response, request.keep_alive());
        if (response.delay <= Core::Duration::zero())
        {
            return WritePreparedAsync(request.keep_alive(), bHead);
        }
        _delay.expires_after(response.delay);
        _delay.async_wait([self = shared_from_this(), bKeepAlive = request.keep_alive(), bHead](const ErrorCode&) {
            self->WritePreparedAsync(bKeepAlive, bHead);
        });
    }

    [[nodiscard]] HttpSender MakeSender(const Http::fields& header) const
    {
        const auto authorization = header[Http::field::authorization];
        return {_peer, std::string(authorization.data(), authorization.size()), _certificateName};
    }

    void WriteAsync(const HttpResponse& response, bool bKeepAlive, bool bHead)
    {
        PrepareResponse(response, bKeepAlive);
        WritePreparedAsync(bKeepAlive, bHead);
    }

    void PrepareResponse(const HttpResponse& response, bool bKeepAlive)
    {
        _responseOrNull.emplace(Http::int_to_status(response.status), 11U);
        _responseOrNull->result(response.status);
        _responseOrNull->set(Http::field::content_type, response.contentType);
        if (!response.allow.empty())
        {
            _responseOrNull->set(Http::field::allow, response.allow);
        }
        if (response.retryAfter.count() > 0)
        {
            _responseOrNull->set(Http::field::retry_after, std::to_string(response.retryAfter.count()));
        }
        if (!response.challenge.empty())
        {
            _responseOrNull->set(Http::field::www_authenticate, response.challenge);
        }
        _responseOrNull->body() = response.body;
        _responseOrNull->keep_alive(bKeepAlive);
        _responseOrNull->prepare_payload();
        _serializerOrNull.emplace(*_responseOrNull);
    }

    void WritePreparedAsync(bool bKeepAlive, bool bHead)
    {
        if (_state == EConnectionState::Closed)
        {
            return Leave();
        }
        Enter(EConnectionState::Writing);
        _stream.GetTCP().expires_after(_limits.timeout);
        _stream.Use([this, bKeepAlive, bHead](auto& stream) {
            auto onWritten = Beast::bind_front_handler(&Connection::OnWritten, shared_from_this(), bKeepAlive);
            if (bHead)
            {
                Http::async_write_header(stream, *_serializerOrNull, std::move(onWritten));
            }
            else
            {
                Http::async_write(stream, *_serializerOrNull, std::move(onWritten));
            }
        });
    }

    void OnWritten(bool bKeepAlive, const ErrorCode& error, std::size_t /*count*/)
    {
        if (error.failed() || !IsOpen())
        {
            return Leave();
        }
        if (bKeepAlive && !_server.expired())
        {
            return ReadAsync();
        }
        HttpStream::TlsStream* const tlsOrNull = _stream.GetTlsOrNull();
        if (tlsOrNull == nullptr)
        {
            return EndAsync();
        }
        // Without this message of TLS the peer would take the end for an interruption.
        _stream.GetTCP().expires_after(DRAIN_TIME);
        tlsOrNull->async_shutdown([self = shared_from_this()](const ErrorCode&) { self->EndAsync(); });
    }

    [[nodiscard]] bool IsOpen() noexcept
    {
        return _stream.GetTCP().socket().is_open();
    }

    void EndAsync()
    {
        if (!IsOpen())
        {
            return Leave();
        }
        ErrorCode ignored;
        _stream.GetTCP().socket().shutdown(Tcp::socket::shutdown_send, ignored);
        _stream.GetTCP().expires_after(DRAIN_TIME);
        DrainAsync();
    }

    /// Reads and drops data until the peer closes or DRAIN_TIME, which is not restarted, expires.
    void DrainAsync()
    {
        _buffer.clear();
        _stream.GetTCP().async_read_some(
            _buffer.prepare(DRAIN_BYTES),
            Beast::bind_front_handler(&Connection::OnDrained, shared_from_this()));
    }

    void OnDrained(const ErrorCode& error, std::size_t /*count*/)
    {
        if (error.failed())
        {
            Leave();
        }
        else
        {
            DrainAsync();
        }
    }

    /// Closes the connection and removes it from the list of the server, if the server still exists.
    void Leave()
    {
        Close();
        if (const std::shared_ptr<Impl> server = _server.lock())
        {
            server->OnClosed(std::exchange(place, server->connections.end()));
        }
    }
};

Core::Result<Endpoint> HttpServer::Impl::Listen(const Endpoint& endpoint)
{
    const Core::Result<std::uint16_t> port = listener->Listen(endpoint.host, endpoint.port);
    if (!port.has_value())
    {
        return tl::make_unexpected(port.error());
    }
    return Endpoint{endpoint.host, *port};
}

void HttpServer::Impl::LogRefusal(std::string_view kind, std::string_view reason)
{
    refusals.Write(
        std::chrono::steady_clock::now(),
        Core::ELogLevel::Warning,
        kind,
        "Refused an HTTP request",
        {{"reason", reason}});
}

std::optional<std::string> HttpServer::Impl::GetRejectionReasonOrNull(
    const HttpRequest& request,
    const Http::fields& header) const
{
    const auto get = [&header](std::string_view name) {
        const auto value = header[name];
        return std::string_view(value.data(), value.size());
    };
    return guardOrNull.has_value()
        ? guardOrNull->GetRejectionReasonOrNull(request, {get("Host"), get("Origin"), get("Sec-Fetch-Site")})
        : std::nullopt;
}

/// Whether the peer has as many connections as it may have.
bool HttpServer::Impl::IsFull(const Asio::ip::address& peer) const
{
    const auto isOpenToPeer = [&peer](const std::shared_ptr<Connection>& connection) {
        return connection->GetState() != EConnectionState::Closed && connection->GetGroup() == peer;
    };
    return static_cast<std::size_t>(std::ranges::count_if(connections, isOpenToPeer)) >= limits.maxPerPeer;
}

/// Of the peer if it has as many as it may have; null if all are being answered.
std::shared_ptr<HttpServer::Impl::Connection> HttpServer::Impl::FindReplaceableOrNull(
    const Asio::ip::address& peer) const
{
    const bool bOfPeer = IsFull(peer);
    for (const EConnectionState state : {EConnectionState::Reading, EConnectionState::Writing})
    {
        const auto found = std::ranges::find_if(connections, [&](const std::shared_ptr<Connection>& connection) {
            return connection->GetState() == state && (!bOfPeer || connection->GetGroup() == peer);
        });
        if (found != connections.end())
        {
            return *found;
        }
    }
    return nullptr;
}

/// Closes a connection if a limit is reached, so that peers that send or read nothing cannot block requests of others.
void HttpServer::Impl::OnAccepted(Tcp::socket socket)
{
    const Asio::ip::address peer = GetPeerGroup(socket);
    if (connections.size() >= limits.maxConnections || IsFull(peer))
    {
        const std::shared_ptr<Connection> replaced = FindReplaceableOrNull(peer);
        if (replaced == nullptr)
        {
            nextOrNull = std::move(socket);
            return;
        }
        replaced->Close();
    }
    ErrorCode ignored;
    static_cast<void>(socket.set_option(Asio::socket_base::send_buffer_size(SEND_BUFFER_BYTES), ignored));
    const auto connection = std::make_shared<Connection>(shared_from_this(), std::move(socket));
    connections.push_back(connection);
    connection->place = std::prev(connections.end());
    connection->StartAsync();
}

void HttpServer::Impl::TakeNext()
{
    if (nextOrNull.has_value())
    {
        Tcp::socket socket = std::move(*nextOrNull);
        nextOrNull.reset();
        OnAccepted(std::move(socket));
        listener->AcceptAsync();
    }
}

void HttpServer::Impl::OnClosed(ConnectionList::iterator place)
{
    if (place != connections.end())
    {
        connections.erase(place);
        TakeNext();
    }
}

void HttpServer::Impl::Stop()
{
    listener->Stop();
    nextOrNull.reset();
    for (const std::shared_ptr<Connection>& connection : connections)
    {
        connection->place = connections.end();
        connection->Close();
    }
    connections.clear();
}

HttpServer::HttpServer(
    const Asio::any_io_executor& executor,
    Handler handler,
    Core::Logger logger,
    HttpLimits limits,
    std::optional<HttpGuard> guardOrNull)
    : _impl(std::make_shared<Impl>(executor, std::move(handler), std::move(logger), limits, std::move(guardOrNull)))
{
}

HttpServer::~HttpServer()
{
    _impl->Stop();
}

void HttpServer::UseTLS(std::shared_ptr<Asio::ssl::context> context)
{
    _impl->tlsContextOrNull = std::move(context);
}

Core::Result<Endpoint> HttpServer::Listen(const Endpoint& endpoint)
{
    return _impl->Listen(endpoint);
}

void HttpServer::Stop()
{
    _impl->Stop();
}

} // namespace ACS::Apps
