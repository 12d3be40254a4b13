#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

/// A TCP connection with lines of text, as many vehicle makers have one. Connects until it succeeds, and again after each
/// loss. Lines and unsent bytes are limited: a vehicle that exceeds a limit is disconnected.
class MakerLink
{
    static constexpr std::size_t MAX_LINE = 1'000;     ///< Bytes.
    static constexpr std::size_t MAX_UNSENT = 100'000; ///< Bytes.
    static constexpr std::chrono::milliseconds RETRY_DELAY{200};

    boost::asio::ip::tcp::endpoint _vehicle;
    std::function<void(std::string_view)> _onLine;
    std::function<void(bool bConnected)> _onLink;
    boost::asio::ip::tcp::socket _socket;
    boost::asio::steady_timer _retry;
    std::array<char, 1'000> _chunk{};
    std::string _input;   ///< A line without its end so far.
    std::string _output;  ///< Waits.
    std::string _writing; ///< In flight.
    bool _bConnected = false;

public:
    /// onLink is called with true after each connect, and with false after each loss.
    MakerLink(
        boost::asio::io_context& io,
        boost::asio::ip::tcp::endpoint vehicle,
        std::function<void(std::string_view line)> onLine,
        std::function<void(bool bConnected)> onLink)
        : _vehicle(std::move(vehicle)),
          _onLine(std::move(onLine)),
          _onLink(std::move(onLink)),
          _socket(io),
          _retry(io)
    {
        ConnectAsync();
    }

    /// Does nothing without a connection: after a connect the owner sends what still applies.
    void Send(std::string_view line)
    {
        if (_bConnected)
        {
            _output.append(line).append("\n");
            WriteAsync();
        }
    }

private:
    void ConnectAsync()
    {
        _socket.async_connect(_vehicle, [this](const boost::system::error_code& error) {
            if (error)
            {
                RetryAsync();
                return;
            }
            _bConnected = true;
            _input.clear();
            _output.clear();
            _onLink(true);
            ReadAsync();
        });
    }

    void RetryAsync()
    {
        boost::system::error_code ignored;
        _socket.close(ignored);
        _retry.expires_after(RETRY_DELAY);
        _retry.async_wait([this](const boost::system::error_code& error) {
            if (!error)
            {
                ConnectAsync();
            }
        });
    }

    /// Called by the reader only, so that a connection is lost once.
    void OnLost()
    {
        _bConnected = false;
        _onLink(false);
        RetryAsync();
    }

    void ReadAsync()
    {
        _socket.async_read_some(
            boost::asio::buffer(_chunk),
            [this](const boost::system::error_code& error, std::size_t count) {
                if (error || !TryPassLines({_chunk.data(), count}))
                {
                    OnLost();
                    return;
                }
                ReadAsync();
            });
    }

    /// False if a line is too long.
    [[nodiscard]] bool TryPassLines(std::string_view text)
    {
        for (const char letter : text)
        {
            if (letter == '\n')
            {
                _onLine(std::exchange(_input, {}));
            }
            else
            {
                _input += letter;
            }
        }
        return _input.size() <= MAX_LINE; // A chunk may be added to it.
    }

    /// One write at a time. What the socket did not accept is written with what has come since then.
    void WriteAsync()
    {
        if (_output.size() > MAX_UNSENT)
        {
            boost::system::error_code ignored;
            _socket.close(ignored); // The reader reports the loss.
        }
        if (!_writing.empty() || _output.empty() || !_socket.is_open())
        {
            return;
        }
        _writing = std::exchange(_output, {});
        _socket.async_write_some(
            boost::asio::buffer(_writing),
            [this](const boost::system::error_code& error, std::size_t count) {
                const std::string rest = std::exchange(_writing, {}).substr(count);
                if (!error)
                {
                    _output.insert(0, rest);
                    WriteAsync();
                }
            });
    }
};
