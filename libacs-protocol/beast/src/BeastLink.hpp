#pragma once

#include <acs/protocol_beast/ClientOptions.hpp>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::ProtocolBeast
{

/// Who owns a link. Called on the executor, never from within a call of the owner; nothing after onClosed or Kill.
struct LinkOwner
{
    std::function<void()> onOpen;
    std::function<void(std::string_view text)> onText;
    std::function<void(const std::string& reason)> onClosed; ///< Once.
};

/// One WebSocket connection of either role over any stream of Beast: reads whole messages, writes one unfragmented text
/// frame after the other, pings, closes. The one place that touches Beast's WebSocket.
template <typename TStream>
class BeastLink : public std::enable_shared_from_this<BeastLink<TStream>>
{
    using ErrorCode = boost::beast::error_code;
    using Tcp = boost::asio::ip::tcp;

    boost::beast::websocket::stream<TStream> _stream;
    LinkOptions _options;
    LinkOwner _owner;
    boost::beast::flat_buffer _buffer;
    std::deque<std::string> _queue;
    std::size_t _queuedBytes = 0;
    bool _bOpen = false;
    bool _bCloseWanted = false;
    bool _bCloseSent = false;
    bool _bFinished = false;
    boost::beast::websocket::close_reason _closeReason;
    boost::asio::steady_timer _closeTimer;

public:
    BeastLink(TStream&& stream, const LinkOptions& options, LinkOwner owner)
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

    [[nodiscard]] TStream& GetStream()
    {
        return _stream.next_layer();
    }

    /// As a client, over a stream that is connected.
    void HandshakeAsync(
        const std::string& hostHeader,
        const std::string& target,
        std::vector<std::pair<std::string, std::string>> headers)
    {
        PrepareSocket();
        namespace websocket = boost::beast::websocket;
        _stream.set_option(
            websocket::stream_base::decorator([headers = std::move(headers)](websocket::request_type& request) {
                for (const auto& [name, value] : headers)
                {
                    request.set(name, value);
                }
            }));
        auto response = std::make_shared<websocket::response_type>();
        _stream.async_handshake(
            *response,
            hostHeader,
            target,
            [self = this->shared_from_this(), response](ErrorCode error) {
                if (error == boost::beast::websocket::error::upgrade_declined)
                {
                    self->Finish(
                        "the server refused the connection with HTTP " + std::to_string(response->result_int()));
                    return;
                }
                self->OnOpen(error);
            });
    }

    /// As a server, with the request that asked for it.
    template <typename TRequest>
    void AcceptAsync(const TRequest& request)
    {
        PrepareSocket();
        _stream.async_accept(request, [self = this->shared_from_this()](ErrorCode error) { self->OnOpen(error); });
    }

    /// False where it is left out because others still wait to be written.
    void Send(std::string text, bool bDroppable)
    {
        if (!_bOpen || _bCloseWanted || _bFinished || (bDroppable && !_queue.empty()))
        {
            return;
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

    /// After what waits to be written; bounded by the close timeout.
    void Close(std::uint16_t code, const std::string& reason)
    {
        if (_bCloseWanted || _bFinished)
        {
            return;
        }
        _bCloseWanted = true;
        _closeReason.code = code;
        _closeReason.reason.assign(reason.data(), std::min(reason.size(), _closeReason.reason.max_size()));
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
                self->Finish("the closing handshake took too long");
            }
        });
        if (_queue.empty())
        {
            CloseAsync();
        }
    }

    /// Closes the socket without a handshake; onClosed follows. With a reset, so that the other side notices at once.
    void Abort(std::string reason)
    {
        ErrorCode ignored;
        auto& socket = boost::beast::get_lowest_layer(_stream).socket();
        socket.set_option(boost::asio::socket_base::linger(true, 0), ignored);
        boost::asio::post(_stream.get_executor(), [self = this->shared_from_this(), reason = std::move(reason)] {
            self->Finish(reason);
        });
    }

    /// Closes the socket; the owner hears nothing any more.
    void Kill()
    {
        _owner = {};
        Finish({});
    }

private:
    void PrepareSocket()
    {
        auto& lowest = boost::beast::get_lowest_layer(_stream);
        lowest.expires_never();
        ErrorCode ignored;
        lowest.socket().set_option(Tcp::no_delay(true), ignored);
    }

    void OnOpen(ErrorCode error)
    {
        if (_bFinished)
        {
            return;
        }
        if (error)
        {
            Finish("the WebSocket handshake failed: " + error.message());
            return;
        }
        _bOpen = true;
        ReadAsync();
        if (_owner.onOpen)
        {
            _owner.onOpen();
        }
    }

    void ReadAsync()
    {
        _stream.async_read(_buffer, [self = this->shared_from_this()](ErrorCode error, std::size_t /*count*/) {
            self->OnRead(error);
        });
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

    [[nodiscard]] std::string DescribeReadError(ErrorCode error) const
    {
        namespace websocket = boost::beast::websocket;
        if (error == websocket::error::closed)
        {
            const websocket::close_reason& given = _stream.reason();
            std::string text = "closed by the other side with code " + std::to_string(given.code);
            text += given.reason.empty() ? "" : ": " + std::string(given.reason.data(), given.reason.size());
            return text;
        }
        if (error == boost::beast::error::timeout)
        {
            return "the other side has not answered any ping";
        }
        return "the connection broke: " + error.message();
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
            Finish("the connection broke: " + error.message());
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
            self->Finish("closed: " + std::string(self->_closeReason.reason.data(), self->_closeReason.reason.size()));
        });
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
        boost::beast::get_lowest_layer(_stream).close();
        const LinkOwner owner = std::exchange(_owner, {});
        if (owner.onClosed)
        {
            owner.onClosed(reason);
        }
    }
};

using TcpLink = BeastLink<boost::beast::tcp_stream>;

} // namespace ACS::ProtocolBeast
