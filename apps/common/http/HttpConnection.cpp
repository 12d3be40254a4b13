#include "common/http/HttpConnection.hpp"

#include "common/http/HttpPeer.hpp"
#include "common/http/HttpPendingResponse.hpp"
#include "common/http/HttpTls.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/detail/socket_option.hpp>
#include <boost/asio/ssl/stream_base.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>

#include <chrono>
#include <netinet/in.h>
#include <netinet/tcp.h>
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

/// Maximum time to read from a refused peer before the connection is closed. If it were closed with unread bytes, the system
/// would drop the response too.
constexpr std::chrono::seconds DRAIN_TIME{2};
constexpr std::size_t DRAIN_BYTES = 16U * 1024U;

/// Limit of bytes that were read but not parsed. Beast itself has no limit for the extension after the size of a chunk.
constexpr std::size_t BUFFER_BYTES = 64U * 1024U;

/// The system closes the connection of a stream whose peer acknowledges nothing for this time, such as a machine without power:
/// small pieces would otherwise fill its buffer for hours.
using UserTimeout = Asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;

constexpr std::string_view CONTINUE = "HTTP/1.1 100 Continue\r\n\r\n";

} // namespace

HttpConnection::HttpConnection(
    std::weak_ptr<IHttpConnectionOwner> owner,
    const HttpLimits& limits,
    Tcp::socket socket,
    std::shared_ptr<Asio::ssl::context> contextOrNull)
    : _owner(std::move(owner)),
      _limits(limits),
      _stream(std::move(socket), std::move(contextOrNull)),
      _buffer(BUFFER_BYTES),
      _timer(_stream.GetTCP().get_executor()),
      _group(GetPeerGroup(_stream.GetTCP().socket())),
      _peer(GetPeer(_stream.GetTCP().socket()))
{
}

void HttpConnection::StartAsync()
{
    HttpStream::TlsStream* const tlsOrNull = _stream.GetTlsOrNull();
    if (tlsOrNull == nullptr)
    {
        return ReadAsync();
    }
    Enter(EState::Reading);
    _stream.GetTCP().expires_after(_limits.timeout);
    tlsOrNull->async_handshake(
        Asio::ssl::stream_base::server,
        Beast::bind_front_handler(&HttpConnection::OnHandshake, shared_from_this()));
}

HttpConnection::EState HttpConnection::GetState() const noexcept
{
    return _state;
}

const Asio::ip::address& HttpConnection::GetGroup() const noexcept
{
    return _group;
}

void HttpConnection::Close()
{
    _state = EState::Closed;
    ErrorCode ignored;
    _timer.cancel(ignored);
    _stream.GetTCP().socket().shutdown(Tcp::socket::shutdown_both, ignored);
    _stream.GetTCP().close();
    if (_bodyOrNull != nullptr)
    {
        _bodyOrNull->End();
    }
}

/// A state in which it waits for the peer.
void HttpConnection::Enter(EState state)
{
    _state = state;
    if (const std::shared_ptr<IHttpConnectionOwner> owner = _owner.lock())
    {
        owner->OnWaiting(*this);
    }
}

void HttpConnection::OnHandshake(const ErrorCode& error)
{
    const std::shared_ptr<IHttpConnectionOwner> owner = _owner.lock();
    if (owner == nullptr || !IsOpen())
    {
        return Leave();
    }
    if (error.failed())
    {
        const std::string reason = DescribeHandshakeError(error);
        owner->LogRefusal("handshake " + reason, reason);
        return EndAsync(); // the peer reads the alert of TLS
    }
    _certificateName = GetClientName(_stream.GetTlsOrNull()->native_handle());
    ReadAsync();
}

std::string HttpConnection::DescribeHandshakeError(const ErrorCode& error)
{
    const long verified = SSL_get_verify_result(_stream.GetTlsOrNull()->native_handle());
    return verified == X509_V_OK ? "TLS handshake: " + error.message()
                                 : std::string("client certificate: ") + X509_verify_cert_error_string(verified);
}

void HttpConnection::ReadAsync()
{
    Enter(EState::Reading);
    _parserOrNull.emplace();
    _parserOrNull->header_limit(_limits.maxHeaderBytes);
    _parserOrNull->body_limit(_limits.maxBodyBytes);
    _stream.GetTCP().expires_after(_limits.timeout);
    _stream.Use([this](auto& stream) {
        Http::async_read_header(
            stream,
            _buffer,
            *_parserOrNull,
            Beast::bind_front_handler(&HttpConnection::OnHeader, shared_from_this()));
    });
}

void HttpConnection::OnHeader(const ErrorCode& error, std::size_t count)
{
    if (error.failed())
    {
        return OnRead(error, count);
    }
    if (const std::optional<HttpResponse> refusal = MakeHeaderRefusalOrNull(_parserOrNull->get()))
    {
        return Refuse(*refusal, refusal->body.substr(0, refusal->body.size() - 1));
    }
    if (_parserOrNull->is_done())
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

void HttpConnection::ReadBodyAsync()
{
    _stream.Use([this](auto& stream) {
        Http::async_read(
            stream,
            _buffer,
            *_parserOrNull,
            Beast::bind_front_handler(&HttpConnection::OnRead, shared_from_this()));
    });
}

void HttpConnection::OnRead(const ErrorCode& error, std::size_t /*count*/)
{
    if (error.failed())
    {
        const std::optional<HttpResponse> refusal = MakeHttpRefusalOrNull(error, _limits);
        return refusal.has_value() ? Refuse(*refusal, error.message()) : Leave();
    }
    const std::shared_ptr<IHttpConnectionOwner> owner = _owner.lock();
    if (owner == nullptr || !IsOpen())
    {
        return Leave();
    }
    _state = EState::Answering;
    Answer(*owner, _parserOrNull->get());
}

/// What follows is not read: it need not be a request.
void HttpConnection::Refuse(const HttpResponse& refusal, const std::string& reason)
{
    const std::shared_ptr<IHttpConnectionOwner> owner = _owner.lock();
    if (owner == nullptr || !IsOpen())
    {
        return Leave();
    }
    _state = EState::Answering;
    owner->LogRefusal(reason, reason);
    WriteAsync(refusal, false, false);
}

void HttpConnection::Answer(IHttpConnectionOwner& owner, const BeastRequest& message)
{
    Core::Result<HttpRequest> request = MakeHttpRequest(message);
    const bool bHead = message.method() == Http::verb::head;
    const bool bKeepAlive = message.keep_alive();
    if (!request.has_value())
    {
        const HttpResponse refusal = MakeHttpRefusal(Http::status::bad_request, Core::Describe(request.error()));
        return WriteAsync(refusal, bKeepAlive, bHead);
    }
    const auto authorization = message[Http::field::authorization];
    request->sender = {
        _peer,
        std::string(authorization.data(), authorization.size()),
        _certificateName,
        _stream.GetTlsOrNull() != nullptr};
    const HttpResponse response = owner.Respond(*request, *this);
    if (response.pending != nullptr)
    {
        response.pending->Attach([weak = weak_from_this(), bKeepAlive, bHead](const HttpResponse& complete) {
            if (const std::shared_ptr<HttpConnection> self = weak.lock())
            {
                self->WriteAsync(complete, bKeepAlive, bHead);
            }
        });
        return;
    }
    if (response.stream != nullptr && bHead)
    {
        response.stream->End();
    }
    else if (response.stream != nullptr)
    {
        _responseOrNull.emplace(MakeBeastResponse(response, false));
        return StartStream(response.stream);
    }
    if (response.delay <= Core::Duration::zero())
    {
        return WriteAsync(response, bKeepAlive, bHead);
    }
    _responseOrNull.emplace(MakeBeastResponse(response, bKeepAlive));
    _timer.expires_after(response.delay);
    _timer.async_wait([self = shared_from_this(), bKeepAlive, bHead](const ErrorCode&) {
        self->WritePreparedAsync(bKeepAlive, bHead);
    });
}

void HttpConnection::WriteAsync(const HttpResponse& response, bool bKeepAlive, bool bHead)
{
    _responseOrNull.emplace(MakeBeastResponse(response, bKeepAlive));
    WritePreparedAsync(_responseOrNull->keep_alive(), bHead);
}

void HttpConnection::WritePreparedAsync(bool bKeepAlive, bool bHead)
{
    if (_state == EState::Closed)
    {
        return Leave();
    }
    Enter(EState::Writing);
    _serializerOrNull.emplace(*_responseOrNull);
    _stream.GetTCP().expires_after(_limits.timeout);
    _stream.Use([this, bKeepAlive, bHead](auto& stream) {
        auto onWritten = Beast::bind_front_handler(&HttpConnection::OnWritten, shared_from_this(), bKeepAlive);
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

void HttpConnection::OnWritten(bool bKeepAlive, const ErrorCode& error, std::size_t /*count*/)
{
    if (error.failed() || !IsOpen())
    {
        return Leave();
    }
    if (bKeepAlive && !_owner.expired())
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

/// Sends the header and then the pieces of the body. Has its own time limit, because it reads and writes at the same time.
void HttpConnection::StartStream(std::shared_ptr<HttpBodyStream> body)
{
    _bodyOrNull = std::move(body);
    if (_state == EState::Closed || !_bodyOrNull->IsOpen())
    {
        return Leave();
    }
    _state = EState::Streaming;
    _bodyOrNull->Attach([weak = weak_from_this()] {
        if (const std::shared_ptr<HttpConnection> self = weak.lock())
        {
            self->WritePieceAsync();
        }
    });
    _stream.GetTCP().expires_never();
    ErrorCode ignored;
    static_cast<void>(
        _stream.GetTCP().socket().set_option(UserTimeout(static_cast<int>(_limits.timeout.count())), ignored));
    BeginPiece();
    _serializerOrNull.emplace(*_responseOrNull);
    _stream.Use([this](auto& stream) {
        Http::async_write_header(
            stream,
            *_serializerOrNull,
            Beast::bind_front_handler(&HttpConnection::OnPieceWritten, shared_from_this()));
    });
    WatchPeerAsync();
}

/// Reads until the peer closes the connection. What it sends is ignored.
void HttpConnection::WatchPeerAsync()
{
    _buffer.clear();
    _stream.Use([this](auto& stream) {
        stream.async_read_some(
            _buffer.prepare(DRAIN_BYTES),
            Beast::bind_front_handler(&HttpConnection::OnPeerRead, shared_from_this()));
    });
}

void HttpConnection::OnPeerRead(const ErrorCode& error, std::size_t /*count*/)
{
    if (error.failed() || _state == EState::Closed)
    {
        Leave();
    }
    else
    {
        WatchPeerAsync();
    }
}

void HttpConnection::WritePieceAsync()
{
    if (_state == EState::Closed || _bPieceWriting)
    {
        return;
    }
    if (!_bodyOrNull->IsOpen())
    {
        return Leave();
    }
    _piece = _bodyOrNull->TakeNext();
    if (_piece.empty())
    {
        return;
    }
    BeginPiece();
    _stream.Use([this](auto& stream) {
        Asio::async_write(
            stream,
            Asio::buffer(_piece),
            Beast::bind_front_handler(&HttpConnection::OnPieceWritten, shared_from_this()));
    });
}

void HttpConnection::BeginPiece()
{
    _bPieceWriting = true;
    _timer.expires_after(_limits.timeout);
    _timer.async_wait([self = shared_from_this()](const ErrorCode& error) {
        // The next piece may have restarted the timer.
        if (!error.failed() && self->_bPieceWriting && self->_timer.expiry() <= std::chrono::steady_clock::now())
        {
            self->Leave();
        }
    });
}

void HttpConnection::OnPieceWritten(const ErrorCode& error, std::size_t /*count*/)
{
    _bPieceWriting = false;
    ErrorCode ignored;
    _timer.cancel(ignored);
    if (error.failed())
    {
        return Leave();
    }
    WritePieceAsync();
}

bool HttpConnection::IsOpen() noexcept
{
    return _stream.GetTCP().socket().is_open();
}

void HttpConnection::EndAsync()
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
void HttpConnection::DrainAsync()
{
    _buffer.clear();
    _stream.GetTCP().async_read_some(
        _buffer.prepare(DRAIN_BYTES),
        Beast::bind_front_handler(&HttpConnection::OnDrained, shared_from_this()));
}

void HttpConnection::OnDrained(const ErrorCode& error, std::size_t /*count*/)
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

/// Closes the connection and removes it from its server, if that still exists.
void HttpConnection::Leave()
{
    Close();
    if (const std::shared_ptr<IHttpConnectionOwner> owner = _owner.lock())
    {
        owner->OnClosed(*this);
    }
}

} // namespace ACS::Apps
