#include "http/ApiConnection.hpp"

#include "api/ApiCodec.hpp"
#include "common/config/DurationText.hpp"
#include "common/config/Endpoint.hpp"
#include "common/config/Url.hpp"
#include "common/Version.hpp"
#include "http/ClientTls.hpp"

#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/verb.hpp>
#include <boost/beast/http/write.hpp>
#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

namespace Http = boost::beast::http;
using ErrorCode = boost::system::error_code;
using Tcp = boost::asio::ip::tcp;

constexpr std::uint32_t LONGEST_HEADER = 64U * 1024U;
constexpr std::chrono::milliseconds LONGEST_SILENCE{45'000}; // acsd sends a comment every 15 s
constexpr std::size_t PART_BYTES = 16U * 1024U;
constexpr std::uint64_t LONGEST_ERROR_BODY = 64U * 1024U;
constexpr std::size_t MOST_INTERIM_ANSWERS = 100;

template <typename TMessage>
ApiAnswer MakeAnswer(const TMessage& message, std::string body)
{
    const auto get = [&message](Http::field field) {
        const auto value = message[field];
        return std::string(value.data(), value.size());
    };
    return {message.result_int(), get(Http::field::content_type), std::move(body), get(Http::field::retry_after)};
}

/// Whether another answer follows, as after "100 Continue".
bool IsInterim(unsigned status)
{
    constexpr unsigned FIRST_FINAL = 200;
    constexpr unsigned SWITCHING_PROTOCOLS = 101;
    return status < FIRST_FINAL && status != SWITCHING_PROTOCOLS;
}

} // namespace

ApiConnection::ApiConnection(
    EventLoop& loop,
    const Connection& target,
    std::shared_ptr<boost::asio::ssl::context> tlsOrNull,
    std::chrono::milliseconds timeout)
    : _loop(loop),
      _target(target),
      _timeout(timeout),
      _stream(Tcp::socket(loop.GetContext()), std::move(tlsOrNull))
{
}

tl::expected<void, ApiFailure> ApiConnection::Open(HostResolver& resolver)
{
    const Apps::Endpoint& peer = _target.url.peer;
    const tl::expected<HostResolver::Addresses, ErrorCode> found = resolver.Resolve(_timeout);
    if (!found.has_value())
    {
        return tl::make_unexpected(MakeOpenFailure(found.error()));
    }
    ErrorCode error = Await([this, &found](const auto& handler) {
        _stream.GetTCP().async_connect(*found, [handler](const ErrorCode& code, const Tcp::endpoint& /*peer*/) {
            handler(code);
        });
    });
    if (error.failed())
    {
        return tl::make_unexpected(MakeOpenFailure(error));
    }
    if (Apps::HttpStream::TlsStream* const tlsOrNull = _stream.GetTlsOrNull(); tlsOrNull != nullptr)
    {
        const std::string name = GetRequestedName(peer.host);
        if (!name.empty())
        {
            static_cast<void>(SSL_ctrl(
                tlsOrNull->native_handle(),
                SSL_CTRL_SET_TLSEXT_HOSTNAME,
                TLSEXT_NAMETYPE_host_name,
                const_cast<char*>(name.c_str()))); // NOLINT(cppcoreguidelines-pro-type-const-cast): it is copied
        }
        error = Await([tlsOrNull](const auto& handler) {
            tlsOrNull->async_handshake(boost::asio::ssl::stream_base::client, [handler](const ErrorCode& code) {
                handler(code);
            });
        });
        if (error.failed())
        {
            return tl::make_unexpected(MakeOpenFailure(error));
        }
    }
    return {};
}

tl::expected<void, ApiFailure> ApiConnection::Write(const ApiRequest& request)
{
    const Message message = MakeMessage(request);
    _bSent = true;
    const ErrorCode error =
        AwaitTransfer([&message](auto& stream, const auto& handler) { Http::async_write(stream, message, handler); });
    if (error.failed())
    {
        return tl::make_unexpected(MakeFailure(error));
    }
    return {};
}

tl::expected<ApiAnswer, ApiFailure> ApiConnection::Read()
{
    std::optional<Http::response_parser<Http::string_body>> parser;
    for (std::size_t interim = 0; interim <= MOST_INTERIM_ANSWERS; ++interim)
    {
        parser.emplace();
        parser->body_limit(MAX_ANSWER_BYTES);
        parser->header_limit(LONGEST_HEADER);
        const ErrorCode error = AwaitTransfer([this, &parser](auto& stream, const auto& handler) {
            Http::async_read(stream, _buffer, *parser, handler);
        });
        if (error.failed())
        {
            return tl::make_unexpected(MakeFailure(error));
        }
        if (!IsInterim(parser->get().result_int()))
        {
            std::string body = std::move(parser->get().body());
            return MakeAnswer(parser->get(), std::move(body));
        }
    }
    return tl::make_unexpected(MakeFailure(Http::error::unexpected_body));
}

tl::expected<ApiAnswer, ApiFailure> ApiConnection::ReadStream(const std::function<bool(std::string_view)>& tryHandle)
{
    std::optional<Http::response_parser<Http::buffer_body>> answer;
    ErrorCode error;
    std::size_t interim = 0;
    do
    {
        answer.emplace();
        answer->body_limit(std::numeric_limits<std::uint64_t>::max());
        answer->header_limit(LONGEST_HEADER);
        error = AwaitTransfer([this, &answer](auto& stream, const auto& handler) {
            Http::async_read_header(stream, _buffer, *answer, handler);
        });
        ++interim;
    }
    while (!error.failed() && IsInterim(answer->get().result_int()) && interim <= MOST_INTERIM_ANSWERS);
    Http::response_parser<Http::buffer_body>& parser = *answer;
    constexpr unsigned HTTP_OK = 200;
    _timeout = std::max(_timeout, LONGEST_SILENCE);
    std::string other; // the body of an error
    std::array<char, PART_BYTES> part{};
    while (!error.failed() && !parser.is_done())
    {
        parser.get().body().data = part.data();
        parser.get().body().size = part.size();
        error = AwaitTransfer([this, &parser](auto& stream, const auto& handler) {
            Http::async_read_some(stream, _buffer, parser, handler);
        });
        if (error == Http::error::need_buffer)
        {
            error.clear();
        }
        const std::string_view text(part.data(), part.size() - parser.get().body().size);
        if (parser.get().result_int() != HTTP_OK)
        {
            other += text;
            if (other.size() > LONGEST_ERROR_BODY)
            {
                error = Http::error::body_limit;
            }
        }
        else if (!text.empty() && !tryHandle(text))
        {
            return MakeAnswer(parser.get(), {});
        }
    }
    if (error.failed())
    {
        ApiFailure failure = MakeFailure(error);
        failure.bStreaming = parser.is_header_done() && parser.get().result_int() == HTTP_OK;
        return tl::make_unexpected(std::move(failure));
    }
    return MakeAnswer(parser.get(), std::move(other));
}

ApiConnection::Message ApiConnection::MakeMessage(const ApiRequest& request) const
{
    constexpr unsigned HTTP_1_1 = 11;
    std::string path = _target.url.path;
    while (path.ends_with('/'))
    {
        path.pop_back();
    }
    Message message(Http::string_to_verb(request.method), path + request.target, HTTP_1_1);
    message.set(Http::field::host, Apps::MakeText(_target.url.peer));
    message.set(Http::field::user_agent, fmt::format("acsctl/{}", Apps::VERSION));
    message.set(Http::field::connection, "close");
    if (!_target.token.empty())
    {
        message.set(Http::field::authorization, "Bearer " + _target.token);
    }
    if (!request.idempotencyKey.empty())
    {
        message.set("Idempotency-Key", request.idempotencyKey);
    }
    if (!request.body.empty())
    {
        message.set(Http::field::content_type, "application/json");
        message.body() = request.body;
    }
    message.prepare_payload();
    return message;
}

ApiFailure ApiConnection::MakeFailure(const ErrorCode& error) const
{
    const std::string url = Apps::MakeText(_target.url);
    if (_loop.IsInterrupted())
    {
        return {EApiFailure::Interrupted, "interrupted", _bSent};
    }
    if (error == boost::beast::error::timeout)
    {
        return {
            EApiFailure::TimedOut,
            fmt::format("{}: no answer within {}", url, Apps::MakeDurationText(_timeout)),
            _bSent};
    }
    if (error.category() == Http::make_error_code(Http::error::bad_version).category()
        && error != Http::error::end_of_stream && error != Http::error::partial_message)
    {
        return {EApiFailure::BadAnswer, fmt::format("{}: not an answer of acsd: {}", url, error.message()), _bSent};
    }
    return {EApiFailure::ConnectionLost, fmt::format("{}: the connection was lost: {}", url, error.message()), _bSent};
}

ApiFailure ApiConnection::MakeOpenFailure(const ErrorCode& error)
{
    const std::string url = Apps::MakeText(_target.url);
    if (_loop.IsInterrupted())
    {
        return {EApiFailure::Interrupted, "interrupted", false};
    }
    if (error == boost::beast::error::timeout)
    {
        return {
            EApiFailure::TimedOut,
            fmt::format("{}: no connection within {}", url, Apps::MakeDurationText(_timeout)),
            false};
    }
    std::string reason = error.message();
    if (Apps::HttpStream::TlsStream* const tlsOrNull = _stream.GetTlsOrNull(); tlsOrNull != nullptr)
    {
        const long result = SSL_get_verify_result(tlsOrNull->native_handle());
        if (result != X509_V_OK)
        {
            reason = fmt::format("the certificate is not valid: {}", X509_verify_cert_error_string(result));
        }
    }
    return {EApiFailure::CannotConnect, fmt::format("{}: cannot connect: {}", url, reason), false};
}

template <typename TStart>
ErrorCode ApiConnection::Await(TStart start)
{
    bool bDone = false;
    ErrorCode error;
    _stream.GetTCP().expires_after(_timeout);
    start([&bDone, &error](const ErrorCode& code) {
        error = code;
        bDone = true;
    });
    _loop.Run(bDone, [this] { _stream.GetTCP().cancel(); });
    return error;
}

template <typename TStart>
ErrorCode ApiConnection::AwaitTransfer(TStart start)
{
    return Await([this, &start](const auto& handler) {
        _stream.Use([&start, &handler](auto& stream) {
            start(stream, [handler](const ErrorCode& code, std::size_t /*bytes*/) { handler(code); });
        });
    });
}

} // namespace ACS::Acsctl
