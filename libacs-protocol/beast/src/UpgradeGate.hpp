#pragma once

#include "BeastLink.hpp"
#include "IGate.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace ACS::ProtocolBeast
{

/// Reads the HTTP request at the start of a connection and creates a link for a valid WebSocket upgrade; otherwise answers
/// and closes. Exists while it has work. TLayer: see BeastLink; it also defines GetPeerSubject(stream).
template <typename TLayer>
class UpgradeGate final : public IGate, public std::enable_shared_from_this<UpgradeGate<TLayer>>
{
    using Stream = typename TLayer::Stream;
    using ErrorCode = boost::beast::error_code;

    static constexpr std::uint32_t LONGEST_HEADER = 16U * 1024U;

    Stream _stream;
    LinkOptions _options;
    GateOwner _owner;
    boost::beast::flat_buffer _buffer;
    boost::beast::http::request_parser<boost::beast::http::empty_body> _parser;
    boost::beast::http::response<boost::beast::http::string_body> _response;
    std::array<char, 4096> _scrap{};

public:
    UpgradeGate(Stream&& stream, const LinkOptions& options, GateOwner owner)
        : _stream(std::move(stream)),
          _options(options),
          _owner(std::move(owner))
    {
        _parser.header_limit(LONGEST_HEADER);
    }

    void RunAsync() override
    {
        boost::beast::get_lowest_layer(_stream).expires_after(_options.handshakeTimeout);
        TLayer::HandshakeAsync(_stream, [self = this->shared_from_this()](ErrorCode error) { self->OnSecured(error); });
    }

    void Kill() override
    {
        _owner = {};
        boost::beast::get_lowest_layer(_stream).close();
    }

private:
    void OnSecured(ErrorCode error)
    {
        if (!_owner.decide)
        {
            return;
        }
        if (error)
        {
            LeaveAsync(IsSilence(error) ? "" : "the TLS handshake failed: " + TLayer::Describe(_stream, error));
            return;
        }
        boost::beast::http::async_read_header(
            _stream,
            _buffer,
            _parser,
            [self = this->shared_from_this()](ErrorCode readError, std::size_t /*count*/) { self->OnRead(readError); });
    }

    void OnRead(ErrorCode error)
    {
        namespace http = boost::beast::http;
        if (!_owner.decide)
        {
            return;
        }
        const bool bHTTP = error.category() == ErrorCode(http::error::bad_method).category();
        if (error && (!bHTTP || error == http::error::end_of_stream))
        {
            LeaveAsync(IsSilence(error) ? "" : "no request came: " + TLayer::Describe(_stream, error));
            return;
        }
        if (error)
        {
            RefuseAsync(
                {static_cast<unsigned>(http::status::bad_request),
                 "This is no HTTP request: " + error.message() + ".\n",
                 {}});
            return;
        }
        const auto& request = _parser.get();
        GateDecision decision = _owner.decide(MakeRequest(), boost::beast::websocket::is_upgrade(request));
        if (const auto* const refusalOrNull = std::get_if<UpgradeRefusal>(&decision); refusalOrNull != nullptr)
        {
            RefuseAsync(*refusalOrNull);
            return;
        }
        _owner = {};
        auto& accepted = std::get<GateAcceptance>(decision);
        const auto link =
            std::make_shared<BeastLink<TLayer>>(std::move(_stream), _options, std::move(accepted.linkOwner));
        accepted.onAccepted(link);
        link->AcceptAsync(request);
    }

    [[nodiscard]] UpgradeRequest MakeRequest()
    {
        const auto& message = _parser.get();
        UpgradeRequest request;
        request.target.assign(message.target().data(), message.target().size());
        for (const auto& field : message)
        {
            request.headers.emplace_back(field.name_string(), field.value());
        }
        request.certificateSubject = TLayer::GetPeerSubject(_stream);
        return request;
    }

    void RefuseAsync(const UpgradeRefusal& refusal)
    {
        namespace http = boost::beast::http;
        constexpr unsigned LAST_STATUS = 599;
        const bool bRefusal =
            refusal.status >= static_cast<unsigned>(http::status::bad_request) && refusal.status <= LAST_STATUS;
        _response.result(bRefusal ? refusal.status : static_cast<unsigned>(http::status::forbidden));
        if (CheckHttpHeaders(refusal.headers).has_value())
        {
            for (const auto& [name, value] : refusal.headers)
            {
                _response.insert(name, value);
            }
        }
        _response.set(http::field::content_type, "text/plain");
        if (refusal.status == static_cast<unsigned>(http::status::upgrade_required))
        {
            _response.set(http::field::upgrade, "websocket");
        }
        _response.keep_alive(false);
        _response.body() = refusal.text;
        _response.prepare_payload();
        http::async_write(
            _stream,
            _response,
            [self = this->shared_from_this()](ErrorCode /*error*/, std::size_t /*count*/) {
                self->LeaveAsync("answered with HTTP " + std::to_string(self->_response.result_int()));
            });
    }

    /// A probe that connects and disconnects, or sends nothing.
    [[nodiscard]] static bool IsSilence(ErrorCode error)
    {
        return error == boost::asio::error::eof || error == boost::asio::error::connection_reset
            || error == boost::asio::ssl::error::stream_truncated || error == boost::beast::error::timeout
            || error == boost::beast::http::error::end_of_stream;
    }

    /// Stops sending and waits until the other side closes: closing with unread data would discard the answer.
    void LeaveAsync(const std::string& reason)
    {
        if (!reason.empty() && _owner.onRefused)
        {
            _owner.onRefused(reason);
        }
        auto& lowest = boost::beast::get_lowest_layer(_stream);
        ErrorCode ignored;
        static_cast<void>(lowest.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored));
        lowest.expires_after(_options.closeTimeout);
        DrainAsync();
    }

    void End()
    {
        boost::beast::get_lowest_layer(_stream).close();
        const GateOwner owner = std::exchange(_owner, {});
        if (owner.onEnded)
        {
            owner.onEnded();
        }
    }

    void DrainAsync()
    {
        auto& lowest = boost::beast::get_lowest_layer(_stream);
        lowest.async_read_some(
            boost::asio::buffer(_scrap),
            [self = this->shared_from_this()](ErrorCode error, std::size_t /*count*/) {
                if (error)
                {
                    self->End();
                    return;
                }
                self->DrainAsync();
            });
    }
};

} // namespace ACS::ProtocolBeast
