#pragma once

#include "CutText.hpp"
#include "ILink.hpp"
#include "LinkStream.hpp"
#include "SocketQueue.hpp"
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/ClientOptions.hpp>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::ProtocolBeast
{

/// One WebSocket connection of either role: reads whole messages, writes one unfragmented text frame after the other,
/// pings, closes. The only user of Beast's WebSocket. TLayer defines the layer below: the type Stream,
/// HandshakeAsync(stream, handler), which may call the handler at once, and Describe(stream, error).
template <typename TLayer>
class BeastLink final : public ILink, public std::enable_shared_from_this<BeastLink<TLayer>>
{
    using Stream = typename TLayer::Stream;
    using ErrorCode = boost::beast::error_code;
    using Tcp = boost::asio::ip::tcp;

    boost::beast::websocket::stream<LinkStream<Stream>> _stream;
    LinkOptions _options;
    LinkOwner _owner;
    boost::beast::flat_buffer _buffer;
    std::deque<std::string> _queue;
    std::size_t _queuedBytes = 0;
    std::size_t _bytesBefore = 0;  ///< Of texts since the last droppable one of an earlier turn.
    std::size_t _bytesPassed = 0;  ///< Those up to the last droppable text of this turn; 0: none.
    std::size_t _bytesOfParts = 0; ///< Of the droppable texts of this turn.
    std::size_t _bytesOfLast = 0;  ///< Likewise of the last turn that had any.
    bool _bOpen = false;
    bool _bCloseWanted = false;
    bool _bCloseSent = false;
    bool _bFinished = false;
    boost::beast::websocket::close_reason _closeReason;
    boost::asio::steady_timer _closeTimer;

public:
    BeastLink(Stream&& stream, const LinkOptions& options, LinkOwner owner)
        : _stream(std::move(stream)),
          _options(options),
          _owner(std::move(owner)),
          _closeTimer(_stream.get_executor())
    {
        namespace websocket = boost::beast::websocket;
        websocket::stream_base::timeout timeouts{};
        timeouts.handshake_timeout = options.handshakeTimeout;
        // Beast pings after half of the idle time.
        timeouts.idle_timeout = options.pingInterval * std::max<std::size_t>(options.pingMisses, 1);
        timeouts.keep_alive_pings = true;
        _stream.set_option(timeouts);
        _stream.read_message_max(options.maximumRead);
        _stream.auto_fragment(false);
        _stream.text(true);
    }

    [[nodiscard]] boost::beast::tcp_stream& GetTcpStream() override
    {
        return boost::beast::get_lowest_layer(_stream);
    }

    void HandshakeAsync(UpgradeOffer offer) override
    {
        GetTcpStream().expires_after(_options.handshakeTimeout);
        TLayer::HandshakeAsync(
            _stream.next_layer(),
            [self = this->shared_from_this(), offer = std::move(offer)](ErrorCode error) {
                self->OnSecured(error, offer);
            });
    }

    /// As a server, with the request that asked for it.
    template <typename TRequest>
    void AcceptAsync(const TRequest& request)
    {
        PrepareSocket();
        _stream.async_accept(request, [self = this->shared_from_this()](ErrorCode error) { self->OnOpen(error); });
    }

    void Send(std::string text, bool bDroppable) override
    {
        if (!_bOpen || _bCloseWanted || _bFinished || (bDroppable && IsHeldUp(text.size())))
        {
            return;
        }
        _bytesBefore += text.size();
        if (bDroppable)
        {
            _bytesOfParts += text.size();
            if (std::exchange(_bytesPassed, _bytesBefore) == 0)
            {
                EndTurnAsync();
            }
        }
        _queuedBytes += text.size();
        _queue.push_back(std::move(text));
        if (_queuedBytes > _options.maximumQueued)
        {
            Abort("the other side does not read: too much waits to be written");
        }
        else if (_queue.size() == 1)
        {
            WriteAsync();
        }
    }

    void Close(std::uint16_t code, const std::string& reason) override
    {
        if (_bCloseWanted || _bFinished)
        {
            return;
        }
        _bCloseWanted = true;
        _closeReason.code = code;
        const std::string text = MakeUTF8(reason);
        const std::string_view shown = CutAtCharacter(text, _closeReason.reason.max_size());
        _closeReason.reason.assign(shown.data(), shown.size());
        if (!_bOpen)
        {
            Abort(reason);
            return;
        }
        _closeTimer.expires_after(_options.closeTimeout);
        _closeTimer.async_wait([weak = this->weak_from_this()](ErrorCode error) {
            const auto self = weak.lock();
            if (!error && self != nullptr)
            {
                self->Finish(
                    "closed: " + self->GetCloseReason() + "; the other side did not answer the closing handshake");
            }
        });
        if (_queue.empty())
        {
            CloseAsync();
        }
    }

    void Abort(std::string reason) override
    {
        ErrorCode ignored;
        static_cast<void>(GetTcpStream().socket().set_option(boost::asio::socket_base::linger(true, 0), ignored));
        boost::asio::post(_stream.get_executor(), [self = this->shared_from_this(), reason = std::move(reason)] {
            self->Finish(reason);
        });
    }

    void Kill() override
    {
        _owner = {};
        Finish({});
    }

private:
    /// Whether too many bytes wait, here or in the system for a droppable text to be in time. One droppable text under way
    /// is not a delay, nor are a few others sent just before this one: they count here until they are written, and in the
    /// system until the other side has acknowledged them, which takes time even without congestion. Droppable texts sent
    /// in one turn are the parts of one.
    [[nodiscard]] bool IsHeldUp(std::size_t size)
    {
        constexpr std::size_t MAX_OTHERS = 65'536;
        const std::size_t waiting = _queuedBytes + CountUntaken(GetTcpStream().socket().native_handle());
        return waiting > 2 * std::max(size, _bytesOfLast) + std::min(2 * _bytesBefore, MAX_OTHERS);
    }

    /// Texts sent after the current handler has returned belong to the next turn.
    void EndTurnAsync()
    {
        boost::asio::post(_stream.get_executor(), [self = this->shared_from_this()] {
            self->_bytesBefore -= std::exchange(self->_bytesPassed, 0);
            self->_bytesOfLast = std::exchange(self->_bytesOfParts, 0);
        });
    }

    void PrepareSocket()
    {
        GetTcpStream().expires_never();
        ErrorCode ignored;
        static_cast<void>(GetTcpStream().socket().set_option(Tcp::no_delay(true), ignored));
    }

    void OnSecured(ErrorCode error, const UpgradeOffer& offer)
    {
        namespace websocket = boost::beast::websocket;
        if (_bFinished)
        {
            return;
        }
        if (error)
        {
            Finish("the TLS handshake failed: " + Describe(error));
            return;
        }
        PrepareSocket();
        _stream.set_option(
            websocket::stream_base::decorator([headers = offer.headers](websocket::request_type& request) {
                for (const auto& [name, value] : headers)
                {
                    request.set(name, value);
                }
            }));
        auto response = std::make_shared<websocket::response_type>();
        _stream.async_handshake(
            *response,
            offer.host,
            offer.target,
            [self = this->shared_from_this(), response](ErrorCode handshakeError) {
                if (handshakeError == websocket::error::upgrade_declined)
                {
                    self->Finish(DescribeRefusal(response->result_int(), response->body()));
                    return;
                }
                if (handshakeError == boost::beast::http::error::end_of_stream)
                {
                    self->Finish("the server closed the connection instead of an upgrade (wss where ws was meant?)");
                    return;
                }
                self->OnOpen(handshakeError);
            });
    }

    [[nodiscard]] static std::string DescribeRefusal(unsigned status, std::string_view body)
    {
        std::string text = "the server refused the connection with HTTP " + std::to_string(status);
        const std::size_t end = body.find_last_not_of(" \t\r\n");
        if (end != std::string_view::npos)
        {
            text += ": " + QuoteReason(body.substr(0, end + 1));
        }
        return text;
    }

    [[nodiscard]] std::string Describe(ErrorCode error)
    {
        return error == boost::beast::error::timeout ? "the other side did not answer in time"
                                                     : TLayer::Describe(_stream.next_layer(), error);
    }

    void OnOpen(ErrorCode error)
    {
        if (_bFinished)
        {
            return;
        }
        if (error)
        {
            Finish("the WebSocket handshake failed: " + Describe(error));
            return;
        }
        _bOpen = true;
        _stream.next_layer().onTeardown = [weak = this->weak_from_this()] {
            if (const auto self = weak.lock())
            {
                self->LimitTeardown();
            }
        };
        ReadAsync();
        if (_owner.onOpen)
        {
            _owner.onOpen();
        }
    }

    /// The other side has closed, or Beast has for its error: a socket that the other side keeps open is closed in time.
    void LimitTeardown()
    {
        if (_bCloseWanted || _bFinished)
        {
            return;
        }
        _closeTimer.expires_after(_options.closeTimeout);
        _closeTimer.async_wait([weak = this->weak_from_this()](ErrorCode error) {
            const auto self = weak.lock();
            if (!error && self != nullptr)
            {
                self->GetTcpStream().close(); // OnRead follows
            }
        });
    }

    void ReadAsync()
    {
        if (_options.bLastFrameOnly)
        {
            ReadPieceAsync();
            return;
        }
        _stream.async_read(_buffer, [self = this->shared_from_this()](ErrorCode error, std::size_t /*count*/) {
            self->OnRead(error);
        });
    }

    void ReadPieceAsync()
    {
        _stream.async_read_some(_buffer, 0, [self = this->shared_from_this()](ErrorCode error, std::size_t /*count*/) {
            self->OnPiece(error);
        });
    }

    void OnPiece(ErrorCode error)
    {
        if (error || _bFinished || _stream.is_message_done())
        {
            OnRead(error);
            return;
        }
        // Beast does not report the end of a frame, but its hint is the rest of the frame only for the last one.
        constexpr std::size_t UNKNOWN = std::numeric_limits<std::size_t>::max();
        if (_stream.read_size_hint(UNKNOWN) == UNKNOWN)
        {
            _buffer.consume(_buffer.size());
        }
        ReadPieceAsync();
    }

    void OnRead(ErrorCode error)
    {
        if (_bFinished)
        {
            return;
        }
        if (error)
        {
            if (!_bCloseSent)
            {
                Finish(DescribeReadError(error));
            }
            return;
        }
        const auto data = _buffer.cdata();
        if (_owner.onText)
        {
            _owner.onText(std::string_view(static_cast<const char*>(data.data()), data.size()));
        }
        _buffer.consume(_buffer.size());
        if (!_bFinished)
        {
            ReadAsync();
        }
    }

    [[nodiscard]] std::string DescribeReadError(ErrorCode error)
    {
        namespace websocket = boost::beast::websocket;
        // A peer that does not wait for the answer to its close frame causes an error of the socket.
        const websocket::close_reason& given = _stream.reason();
        if (error == websocket::error::closed || given.code != websocket::close_code::none)
        {
            std::string text = "closed by the other side";
            text += given.code == websocket::close_code::none ? " without a code"
                                                              : " with code " + std::to_string(given.code);
            text += given.reason.empty() ? "" : ": " + std::string(given.reason.data(), given.reason.size());
            return text;
        }
        if (error == boost::beast::error::timeout)
        {
            return "the other side has not answered any ping";
        }
        if (error == websocket::error::message_too_big)
        {
            return "a message is longer than " + std::to_string(_options.maximumRead)
                + " bytes, the most that is taken";
        }
        if (error == websocket::error::bad_frame_payload)
        {
            return "the other side sent a text that is not UTF-8";
        }
        return "the connection broke: " + Describe(error);
    }

    void WriteAsync()
    {
        const std::string& front = _queue.front();
        _stream.async_write(
            boost::asio::buffer(front.data(), front.size()),
            [self = this->shared_from_this()](ErrorCode error, std::size_t /*count*/) { self->OnWritten(error); });
    }

    void OnWritten(ErrorCode error)
    {
        if (_bFinished)
        {
            return;
        }
        if (error)
        {
            Finish("the connection broke: " + Describe(error));
            return;
        }
        _queuedBytes -= _queue.front().size();
        _queue.pop_front();
        if (!_queue.empty())
        {
            WriteAsync();
        }
        else if (_bCloseWanted)
        {
            CloseAsync();
        }
    }

    void CloseAsync()
    {
        _bCloseSent = true;
        _stream.async_close(_closeReason, [self = this->shared_from_this()](ErrorCode /*error*/) {
            self->Finish("closed: " + self->GetCloseReason());
        });
    }

    [[nodiscard]] std::string GetCloseReason() const
    {
        return {_closeReason.reason.data(), _closeReason.reason.size()};
    }

    void Finish(const std::string& reason)
    {
        if (_bFinished)
        {
            return;
        }
        _bFinished = true;
        ErrorCode ignored;
        static_cast<void>(_closeTimer.cancel(ignored));
        GetTcpStream().close();
        const LinkOwner owner = std::exchange(_owner, {});
        if (owner.onClosed)
        {
            owner.onClosed(reason);
        }
    }
};

} // namespace ACS::ProtocolBeast
