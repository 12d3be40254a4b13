#include <acs/acsd/LineClient.hpp>
#include <acs/core/Backoff.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/net/AddressRotation.hpp>
#include <acs/net/HostLookup.hpp>

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::size_t LINE_READ_BYTES = 4096;

bool IsValidLine(std::string_view line)
{
    constexpr char DELETE = 0x7f;
    return Core::JsonText::IsUtf8(line) && std::ranges::none_of(line, [](char letter) {
               return (static_cast<unsigned char>(letter) < ' ' && letter != '\t') || letter == DELETE;
           });
}

} // namespace

class LineClient::Impl final : public std::enable_shared_from_this<LineClient::Impl>
{
    enum class EState : std::uint8_t
    {
        Stopped,
        Connecting,
        Connected,
        Waiting, ///< For the next attempt.
    };

    boost::asio::any_io_executor _executor;
    Core::IRandom& _random;
    LineClientOptions _options;
    Handlers _handlers;
    Core::Backoff _backoff;
    Net::HostLookup _lookup;
    Net::AddressRotation _addresses;
    boost::asio::ip::tcp::socket _socket;
    boost::asio::steady_timer _timer; ///< Of the attempt, of the silence of the peer, or until the next attempt.
    EState _state = EState::Stopped;
    std::chrono::steady_clock::time_point _connectedAt;
    std::uint64_t _connection = 0; ///< Handlers of an earlier attempt or connection do nothing.
    std::array<char, LINE_READ_BYTES> _input{};
    std::string _line;              ///< Received without its end.
    std::deque<std::string> _queue; ///< The first one is being sent.
    LineClientStats _stats;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        LineClientOptions options,
        Handlers handlers)
        : _executor(executor),
          _random(random),
          _options(std::move(options)),
          _handlers(std::move(handlers)),
          _backoff(_options.backoff),
          _lookup(executor),
          _socket(executor),
          _timer(executor)
    {
    }

    void Start()
    {
        if (_state == EState::Stopped)
        {
            Connect();
        }
    }

    void Stop()
    {
        Close(EState::Stopped);
    }

    [[nodiscard]] ELineSend Send(std::string line)
    {
        if (line.size() > _options.maximumLineBytes || line.find_first_of("\r\n") != std::string::npos)
        {
            ++_stats.linesDropped;
            return ELineSend::InvalidLine;
        }
        if (_state != EState::Connected)
        {
            ++_stats.linesDropped;
            return ELineSend::NotConnected;
        }
        if (_queue.size() >= _options.maximumQueuedLines)
        {
            ++_stats.linesDropped;
            LoseLater(fmt::format("the peer does not read: {} lines wait", _queue.size()));
            return ELineSend::QueueFull;
        }
        line += '\n';
        _queue.push_back(std::move(line));
        if (_queue.size() == 1)
        {
            WriteFirst();
        }
        return ELineSend::Accepted;
    }

    [[nodiscard]] bool IsConnected() const noexcept
    {
        return _state == EState::Connected;
    }

    [[nodiscard]] const LineClientStats& GetStats() const noexcept
    {
        return _stats;
    }

private:
    [[nodiscard]] bool IsCurrent(std::uint64_t connection) const noexcept
    {
        return _connection == connection && _state != EState::Stopped;
    }

    /// Wraps the handler of an operation: it is called only while its connection exists.
    template <typename THandler>
    [[nodiscard]] auto Guard(THandler handler)
    {
        return [weak = weak_from_this(), connection = _connection, handler](const auto&... results) {
            const std::shared_ptr<Impl> self = weak.lock();
            if (self != nullptr && self->IsCurrent(connection))
            {
                handler(*self, results...);
            }
        };
    }

    /// The same for a method. By a pointer, because the handler of one write starts the next one, which is not a recursion.
    template <typename... TResults>
    [[nodiscard]] auto Guard(void (Impl::*method)(TResults...))
    {
        return [weak = weak_from_this(), connection = _connection, method](TResults... results) {
            const std::shared_ptr<Impl> self = weak.lock();
            if (self != nullptr && self->IsCurrent(connection))
            {
                (self.get()->*method)(results...);
            }
        };
    }

    void Connect()
    {
        ++_connection;
        _state = EState::Connecting;
        StartTimer(_options.connectTimeout, [](Impl& self) {
            if (self._state == EState::Connecting)
            {
                self.Lose("the peer does not answer");
            }
        });
        _lookup.ResolveAsync(_options.host, std::to_string(_options.port), Guard(&Impl::OnResolved));
    }

    void OnResolved(const boost::system::error_code& error, const Net::HostLookup::Addresses& found)
    {
        if (error)
        {
            Lose(error.message());
            return;
        }
        boost::asio::async_connect(
            _socket,
            _addresses.Rotate(found),
            _addresses.MakeCondition(),
            Guard(&Impl::OnConnectDone));
    }

    void OnConnectDone(const boost::system::error_code& error, const boost::asio::ip::tcp::endpoint& /*endpoint*/)
    {
        if (error)
        {
            Lose(error.message());
            return;
        }
        _addresses.Reset();
        boost::system::error_code ignored;
        static_cast<void>(_socket.set_option(boost::asio::ip::tcp::no_delay(true), ignored));
        _state = EState::Connected;
        _connectedAt = std::chrono::steady_clock::now();
        ++_stats.connects;
        AwaitLine();
        const std::uint64_t connection = _connection;
        _handlers.onConnected();
        if (_connection == connection)
        {
            ReadMore();
        }
    }

    void ReadMore()
    {
        _socket.async_read_some(boost::asio::buffer(_input), Guard(&Impl::OnRead));
    }

    void OnRead(const boost::system::error_code& error, std::size_t size)
    {
        if (error)
        {
            Lose(error == boost::asio::error::eof ? "the peer has closed the connection" : error.message());
            return;
        }
        if (TryHandle(std::string_view(_input.data(), size)))
        {
            ReadMore();
        }
    }

    /// Returns false if the connection has ended by that.
    [[nodiscard]] bool TryHandle(std::string_view bytes)
    {
        const std::shared_ptr<Impl> self = shared_from_this(); // a handler may destroy the client
        const std::uint64_t connection = _connection;
        while (!bytes.empty())
        {
            const std::size_t end = bytes.find('\n');
            _line += bytes.substr(0, end);
            bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
            if (end != std::string_view::npos && _line.ends_with('\r'))
            {
                _line.pop_back();
            }
            // One byte more may be the begin of CR LF.
            const std::size_t limit = _options.maximumLineBytes + (end == std::string_view::npos ? 1 : 0);
            if (_line.size() > limit)
            {
                Lose(fmt::format("a line has more than {} bytes", _options.maximumLineBytes));
                return false;
            }
            if (end == std::string_view::npos)
            {
                break;
            }
            const std::string line = std::exchange(_line, {});
            if (!IsValidLine(line))
            {
                Lose("a line is not valid UTF-8 or has a control character");
                return false;
            }
            ++_stats.linesReceived;
            if (std::chrono::steady_clock::now() - _connectedAt >= STABLE_AFTER)
            {
                _backoff.Reset();
            }
            AwaitLine();
            _handlers.onLine(line);
            if (_connection != connection)
            {
                return false;
            }
        }
        return true;
    }

    void WriteFirst()
    {
        if (_options.maySend && !_options.maySend())
        {
            LoseLater("this process does not lead any more");
            return;
        }
        boost::asio::async_write(_socket, boost::asio::buffer(_queue.front()), Guard(&Impl::OnWritten));
    }

    void OnWritten(const boost::system::error_code& error, std::size_t /*size*/)
    {
        if (error)
        {
            Lose(error.message());
            return;
        }
        ++_stats.linesSent;
        _queue.pop_front();
        if (!_queue.empty())
        {
            WriteFirst();
        }
    }

    void AwaitLine()
    {
        if (_options.receiveTimeout.count() > 0)
        {
            StartTimer(_options.receiveTimeout, [](Impl& self) { self.Lose("the peer is silent"); });
        }
        else
        {
            _timer.cancel();
        }
    }

    template <typename THandler>
    void StartTimer(std::chrono::milliseconds delay, THandler handler)
    {
        _timer.expires_after(delay);
        _timer.async_wait(Guard([handler](Impl& self, const boost::system::error_code& error) {
            // A wait that had expired when it was restarted cannot be cancelled.
            if (!error && self._timer.expiry() <= boost::asio::steady_timer::clock_type::now())
            {
                handler(self);
            }
        }));
    }

    void LoseLater(std::string reason)
    {
        boost::asio::post(_executor, Guard([reason = std::move(reason)](Impl& self) { self.Lose(reason); }));
    }

    void Lose(const std::string& reason)
    {
        Close(EState::Waiting);
        StartTimer(_backoff.GetNextDelay(_random), [](Impl& self) { self.Connect(); });
        const std::shared_ptr<Impl> self = shared_from_this(); // the handler may destroy the client
        _handlers.onLost(reason);
    }

    void Close(EState next)
    {
        ++_connection;
        _state = next;
        boost::system::error_code ignored;
        _timer.cancel(ignored);
        _lookup.Cancel();
        static_cast<void>(_socket.close(ignored));
        _line.clear();
        _stats.linesDropped += _queue.size();
        _queue.clear();
    }
};

LineClient::LineClient(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    LineClientOptions options,
    Handlers handlers)
    : _impl(std::make_shared<Impl>(executor, random, std::move(options), std::move(handlers)))
{
}

LineClient::~LineClient()
{
    _impl->Stop();
}

void LineClient::Start()
{
    _impl->Start();
}

void LineClient::Stop()
{
    _impl->Stop();
}

ELineSend LineClient::Send(std::string line)
{
    return _impl->Send(std::move(line));
}

bool LineClient::IsConnected() const noexcept
{
    return _impl->IsConnected();
}

const LineClientStats& LineClient::GetStats() const noexcept
{
    return _impl->GetStats();
}

} // namespace ACS::Acsd
