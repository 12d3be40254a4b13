#include "common/http/HttpServer.hpp"

#include "common/http/HttpBodyStream.hpp"
#include "common/http/HttpConnection.hpp"
#include "common/http/HttpPeer.hpp"
#include "common/http/HttpWire.hpp"
#include "common/http/IHttpConnectionOwner.hpp"
#include "common/log/LogRateLimiter.hpp"
#include <acs/net/TcpListener.hpp>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/socket_base.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/system/error_code.hpp>

#include <algorithm>
#include <list>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Apps
{

namespace
{

namespace Asio = boost::asio;
namespace Http = boost::beast::http;
using Tcp = boost::asio::ip::tcp;
using EState = HttpConnection::EState;

/// Limit of what the system keeps for a peer that does not read. By default it may be some megabytes: then a peer that sends
/// requests without a pause and reads nothing would have hundreds of them answered.
constexpr int SEND_BUFFER_BYTES = 16 * 1024;

} // namespace

struct HttpServer::Impl final : public IHttpConnectionOwner, public std::enable_shared_from_this<Impl>
{
    using ConnectionList = std::list<std::shared_ptr<HttpConnection>>;

    Asio::any_io_executor executor;
    Handler handler;
    Core::Logger logger;
    LogRateLimiter refusals; ///< Rate-limited, because any peer can cause these lines.
    HttpLimits limits;
    std::optional<HttpGuard> guardOrNull;
    std::shared_ptr<Asio::ssl::context> tlsContextOrNull; ///< Of further connections.
    std::shared_ptr<Net::TcpListener> listener;
    ConnectionList connections;            ///< The first has had its state for the longest time.
    std::optional<Tcp::socket> nextOrNull; ///< Accepted while all connections were being answered.

    Impl(
        const Asio::any_io_executor& serverExecutor,
        Handler handlerToCall,
        Core::Logger serverLogger,
        HttpLimits serverLimits,
        std::optional<HttpGuard> serverGuardOrNull)
        : executor(serverExecutor),
          handler(std::move(handlerToCall)),
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
    void OnWaiting(const HttpConnection& connection) override;
    [[nodiscard]] HttpResponse Respond(HttpRequest& request, const HttpConnection& connection) override;
    void LogRefusal(std::string_view kind, std::string_view reason) override;
    void OnClosed(const HttpConnection& connection) override;
    [[nodiscard]] ConnectionList::iterator Find(const HttpConnection& connection);
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const HttpRequest& request) const;
    [[nodiscard]] bool IsFull(const Asio::ip::address& peer) const;
    [[nodiscard]] bool CanStream(const Asio::ip::address& peer) const;
    [[nodiscard]] std::shared_ptr<HttpConnection> FindReplaceableOrNull(const Asio::ip::address& peer) const;
    void OnAccepted(Tcp::socket socket);
    void TakeNext();
    void SetHandler(Handler next);
    void Stop();
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

void HttpServer::Impl::OnWaiting(const HttpConnection& connection)
{
    const auto place = Find(connection);
    if (place == connections.end())
    {
        return;
    }
    connections.splice(connections.end(), connections, place);
    if (nextOrNull.has_value())
    {
        // Posted, because it may close this connection.
        Asio::post(executor, [weak = weak_from_this()] {
            if (const std::shared_ptr<Impl> self = weak.lock())
            {
                self->TakeNext();
            }
        });
    }
}

HttpResponse HttpServer::Impl::Respond(HttpRequest& request, const HttpConnection& connection)
{
    if (const std::optional<std::string> rejection = GetRejectionReasonOrNull(request))
    {
        LogRefusal("forbidden", *rejection);
        return MakeHttpRefusal(Http::status::forbidden, *rejection);
    }
    if (!handler)
    {
        return MakeHttpRefusal(Http::status::service_unavailable, "nothing is served here at present");
    }
    request.bCanStream = CanStream(connection.GetGroup());
    HttpResponse response = handler(request);
    if (response.stream == nullptr || request.bCanStream)
    {
        return response;
    }
    response.stream->End();
    return MakeHttpRefusal(Http::status::service_unavailable, "too many streams are open");
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

void HttpServer::Impl::OnClosed(const HttpConnection& connection)
{
    if (const auto place = Find(connection); place != connections.end())
    {
        connections.erase(place);
        TakeNext();
    }
}

HttpServer::Impl::ConnectionList::iterator HttpServer::Impl::Find(const HttpConnection& connection)
{
    return std::ranges::find_if(connections, [&connection](const std::shared_ptr<HttpConnection>& open) {
        return open.get() == &connection;
    });
}

std::optional<std::string> HttpServer::Impl::GetRejectionReasonOrNull(const HttpRequest& request) const
{
    if (!guardOrNull.has_value())
    {
        return std::nullopt;
    }
    const std::string host = request.GetHeaderOrNull("Host").value_or("");
    const std::string origin = request.GetHeaderOrNull("Origin").value_or("");
    const std::string fetchSite = request.GetHeaderOrNull("Sec-Fetch-Site").value_or("");
    const std::string fetchMode = request.GetHeaderOrNull("Sec-Fetch-Mode").value_or("");
    return guardOrNull->GetRejectionReasonOrNull(request, {host, origin, fetchSite, fetchMode});
}

/// Whether the peer has as many connections as it may have.
bool HttpServer::Impl::IsFull(const Asio::ip::address& peer) const
{
    const auto isOpenToPeer = [&peer](const std::shared_ptr<HttpConnection>& connection) {
        return connection->GetState() != EState::Closed && connection->GetGroup() == peer;
    };
    return static_cast<std::size_t>(std::ranges::count_if(connections, isOpenToPeer)) >= limits.maxPerPeer;
}

/// Whether a further stream of the peer is within the limits.
bool HttpServer::Impl::CanStream(const Asio::ip::address& peer) const
{
    std::size_t streams = 0;
    std::size_t ofPeer = 0;
    for (const std::shared_ptr<HttpConnection>& connection : connections)
    {
        if (connection->GetState() == EState::Streaming)
        {
            ++streams;
            ofPeer += connection->GetGroup() == peer ? 1U : 0U;
        }
    }
    return streams < limits.maxStreams && ofPeer < limits.maxStreamsPerPeer;
}

/// Of the peer if it has as many as it may have; null if all are being answered.
std::shared_ptr<HttpConnection> HttpServer::Impl::FindReplaceableOrNull(const Asio::ip::address& peer) const
{
    const bool bOfPeer = IsFull(peer);
    for (const EState state : {EState::Reading, EState::Writing})
    {
        const auto found = std::ranges::find_if(connections, [&](const std::shared_ptr<HttpConnection>& connection) {
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
        const std::shared_ptr<HttpConnection> replaced = FindReplaceableOrNull(peer);
        if (replaced == nullptr)
        {
            nextOrNull = std::move(socket);
            return;
        }
        replaced->Close();
    }
    boost::system::error_code ignored;
    static_cast<void>(socket.set_option(Asio::socket_base::send_buffer_size(SEND_BUFFER_BYTES), ignored));
    connections.push_back(
        std::make_shared<HttpConnection>(weak_from_this(), limits, std::move(socket), tlsContextOrNull));
    connections.back()->StartAsync();
}

void HttpServer::Impl::TakeNext()
{
    if (nextOrNull.has_value())
    {
        Tcp::socket socket = std::move(*nextOrNull);
        nextOrNull.reset();
        OnAccepted(std::move(socket));
        if (!nextOrNull.has_value())
        {
            listener->AcceptAsync();
        }
    }
}

void HttpServer::Impl::SetHandler(Handler next)
{
    handler = std::move(next);
    // Removed first: a stream that ends calls its owner, and a delayed response has no operation that would end.
    ConnectionList unanswered;
    for (auto place = connections.begin(); place != connections.end();)
    {
        const auto connection = place++;
        if (const EState state = (*connection)->GetState(); state == EState::Answering || state == EState::Streaming)
        {
            unanswered.splice(unanswered.end(), connections, connection);
        }
    }
    for (const std::shared_ptr<HttpConnection>& connection : unanswered)
    {
        connection->Close();
    }
    TakeNext();
}

void HttpServer::Impl::Stop()
{
    listener->Stop();
    nextOrNull.reset();
    // Emptied first: a stream that ends calls its owner.
    for (const std::shared_ptr<HttpConnection>& connection : std::exchange(connections, {}))
    {
        connection->Close();
    }
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

void HttpServer::SetHandler(Handler handler)
{
    _impl->SetHandler(std::move(handler));
}

void HttpServer::Stop()
{
    _impl->Stop();
}

} // namespace ACS::Apps
