#include "BareStream.hpp"

#include "ContextThread.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace ACS::Load
{

namespace
{

using Tcp = boost::asio::ip::tcp;

constexpr std::size_t LINE_BYTES = 200;
constexpr std::chrono::milliseconds BARE_WARM_UP{200};
constexpr std::chrono::seconds LAST_LINES{5};

class BareSender
{
    Tcp::acceptor _acceptor;
    Tcp::socket _socket;
    boost::asio::steady_timer _timer;
    std::string _line = std::string(LINE_BYTES - 1, 'x') + '\n';
    Core::SteadyTime _next;
    bool _bStopped = false;
    bool _bWriting = false;

public:
    std::uint64_t sent = 0;
    std::uint64_t skipped = 0;

    explicit BareSender(boost::asio::io_context& context)
        : _acceptor(context, Tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0)),
          _socket(context),
          _timer(context)
    {
        _acceptor.async_accept(_socket, [this](const boost::system::error_code& error) {
            if (!error)
            {
                _socket.set_option(Tcp::no_delay(true));
                _next = std::chrono::steady_clock::now() + PERIOD;
                WaitAsync();
            }
        });
    }

    [[nodiscard]] Tcp::endpoint GetEndpoint() const
    {
        return _acceptor.local_endpoint();
    }

    void Stop()
    {
        _bStopped = true;
        _timer.cancel();
    }

private:
    void WaitAsync()
    {
        _timer.expires_at(_next);
        _timer.async_wait([this](const boost::system::error_code& error) {
            if (!error && !_bStopped)
            {
                Tick();
            }
        });
    }

    void Tick()
    {
        const auto missed = (std::chrono::steady_clock::now() - _next) / Core::Duration(PERIOD);
        skipped += static_cast<std::uint64_t>(missed);
        _next += PERIOD * (missed + 1);
        WaitAsync();
        if (std::exchange(_bWriting, true))
        {
            ++skipped; // two writes at once would tear lines
            return;
        }
        boost::asio::async_write(
            _socket,
            boost::asio::buffer(_line),
            [this](const boost::system::error_code& error, std::size_t /*size*/) {
                _bWriting = false;
                sent += error ? 0U : 1U;
            });
    }
};

class BareReader
{
    Tcp::socket _socket;
    GapLog& _log;
    std::array<char, 4096> _input{};
    std::optional<Core::SteadyTime> _last;

public:
    std::uint64_t received = 0;
    bool bRecording = false;

    BareReader(boost::asio::io_context& context, const Tcp::endpoint& endpoint, GapLog& log)
        : _socket(context),
          _log(log)
    {
        _socket.connect(endpoint);
        ReadAsync();
    }

private:
    void ReadAsync()
    {
        _socket.async_read_some(
            boost::asio::buffer(_input),
            [this](const boost::system::error_code& error, std::size_t size) {
                if (!error)
                {
                    Take(size);
                    ReadAsync();
                }
            });
    }

    void Take(std::size_t size)
    {
        const Core::SteadyTime now = std::chrono::steady_clock::now();
        const auto lines =
            std::count(_input.begin(), std::next(_input.begin(), static_cast<std::ptrdiff_t>(size)), '\n');
        for (std::ptrdiff_t line = 0; line < lines; ++line)
        {
            ++received;
            if (bRecording && _last.has_value())
            {
                _log.Note(*_last, now);
            }
            _last = bRecording ? std::optional(now) : std::nullopt;
        }
    }
};

} // namespace

void RunBareTurn(std::chrono::milliseconds duration, StreamMetrics& metrics)
{
    ContextThread server;
    boost::asio::io_context context(1);
    std::optional<BareSender> sender;
    server.Call([&]() { sender.emplace(server.GetContext()); });
    BareReader reader(context, sender->GetEndpoint(), metrics.frames);
    context.run_for(BARE_WARM_UP);

    const Core::Duration serverBefore = server.GetProcessorTime();
    const Core::Duration clientBefore = GetOwnProcessorTime();
    reader.bRecording = true;
    context.run_for(duration);
    reader.bRecording = false;
    metrics.elapsed += duration;
    metrics.serverTime += server.GetProcessorTime() - serverBefore;
    metrics.clientTime += GetOwnProcessorTime() - clientBefore;

    server.Call([&]() { sender->Stop(); });
    const Core::SteadyTime end = std::chrono::steady_clock::now() + LAST_LINES;
    std::uint64_t sent = 0;
    do
    {
        server.Call([&]() { sent = sender->sent; });
        context.run_for(PERIOD);
    }
    while (reader.received < sent && std::chrono::steady_clock::now() < end);
    metrics.framesSent += sent;
    metrics.framesReceived += reader.received;
    metrics.framesAtPeriod += reader.received;
    metrics.ticksSkipped += sender->skipped;
    metrics.periods += static_cast<std::int64_t>(sent + sender->skipped);
    server.Stop();
}

} // namespace ACS::Load
