#pragma once

#include "common/config/Endpoint.hpp"
#include "common/http/HttpBodyStream.hpp"
#include "common/http/HttpLimits.hpp"
#include "common/http/HttpMessage.hpp"
#include "common/http/HttpStream.hpp"
#include "common/http/HttpWire.hpp"
#include "common/http/IHttpConnectionOwner.hpp"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace ACS::Apps
{

/// The connection of a peer: reads a request, answers it, reads the next one. A response with a stream is its last one. Owned
/// by its server and by its pending operations.
class HttpConnection final : public std::enable_shared_from_this<HttpConnection>
{
public:
    /// What it does; in the order in which a further connection replaces it, Answering and Streaming never.
    enum class EState : std::uint8_t
    {
        Reading,   ///< Waits for a complete request.
        Writing,   ///< Waits until the peer has read the response.
        Answering, ///< The handler has delayed the response.
        Streaming, ///< Writes the pieces of a stream until it ends.
        Closed,
    };

private:
    using ErrorCode = boost::system::error_code;
    using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
    using Serializer = boost::beast::http::response_serializer<boost::beast::http::string_body>;

    std::weak_ptr<IHttpConnectionOwner> _owner;
    HttpLimits _limits;
    HttpStream _stream;
    boost::beast::flat_buffer _buffer;
    std::optional<Parser> _parserOrNull;
    std::optional<BeastResponse> _responseOrNull;
    std::optional<Serializer> _serializerOrNull;
    std::shared_ptr<HttpBodyStream> _bodyOrNull;
    std::string _piece; ///< Of the body, while it is written.
    bool _bPieceWriting = false;
    boost::asio::steady_timer _timer; ///< Of a delayed response, and of a piece that is not read.
    const boost::asio::ip::address _group;
    const Endpoint _peer;
    std::string _certificateName; ///< Of the client; empty without a certificate.
    EState _state = EState::Reading;

public:
    /// Without a context: no TLS.
    HttpConnection(
        std::weak_ptr<IHttpConnectionOwner> owner,
        const HttpLimits& limits,
        boost::asio::ip::tcp::socket socket,
        std::shared_ptr<boost::asio::ssl::context> contextOrNull);

    /// Call once.
    void StartAsync();

    [[nodiscard]] EState GetState() const noexcept;
    [[nodiscard]] const boost::asio::ip::address& GetGroup() const noexcept;
    void Close();

private:
    void Enter(EState state);
    void OnHandshake(const ErrorCode& error);
    [[nodiscard]] std::string DescribeHandshakeError(const ErrorCode& error);
    void ReadAsync();
    void OnHeader(const ErrorCode& error, std::size_t count);
    void ReadBodyAsync();
    void OnRead(const ErrorCode& error, std::size_t count);
    void Refuse(const HttpResponse& refusal, const std::string& reason);
    void Answer(IHttpConnectionOwner& owner, const BeastRequest& message);
    void WriteAsync(const HttpResponse& response, bool bKeepAlive, bool bHead);
    void WritePreparedAsync(bool bKeepAlive, bool bHead);
    void OnWritten(bool bKeepAlive, const ErrorCode& error, std::size_t count);

    void StartStream(std::shared_ptr<HttpBodyStream> body);
    void WatchPeerAsync();
    void OnPeerRead(const ErrorCode& error, std::size_t count);
    void WritePieceAsync();
    void BeginPiece();
    void OnPieceWritten(const ErrorCode& error, std::size_t count);

    [[nodiscard]] bool IsOpen() noexcept;
    void EndAsync();
    void DrainAsync();
    void OnDrained(const ErrorCode& error, std::size_t count);
    void Leave();
};

} // namespace ACS::Apps
