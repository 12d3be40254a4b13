#pragma once

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace ACS::Testing
{

/// A raw peer on the server's own loop, so that a test sends exactly the bytes that it wants to.
class RawHttpClient final
{
    static constexpr const char* LOOPBACK = "127.0.0.1";
    static constexpr std::chrono::seconds LIMIT{10};

    boost::asio::io_context& _context;
    boost::asio::ip::tcp::socket _socket;
    std::string _received;
    bool _bClosed = false;

public:
    RawHttpClient(boost::asio::io_context& context, std::uint16_t port, const char* from = LOOPBACK)
        : _context(context),
          _socket(context, {boost::asio::ip::make_address(from), 0})
    {
        _socket.connect({boost::asio::ip::make_address(LOOPBACK), port});
        ReadAsync();
    }

    void Send(const std::string& text)
    {
        auto copy = std::make_shared<std::string>(text);
        boost::asio::async_write(
            _socket,
            boost::asio::buffer(*copy),
            [copy](const boost::system::error_code&, std::size_t) {});
    }

    /// Runs the loop until this number of answers with that end has arrived, or the time limit expires.
    [[nodiscard]] bool HasReceived(const std::string& end)
    {
        return Matches([this, &end] { return _received.find(end) != std::string::npos; });
    }

    [[nodiscard]] bool WasClosed()
    {
        return Matches([this] { return _bClosed; });
    }

    [[nodiscard]] std::string TakeReceived()
    {
        return std::exchange(_received, {});
    }

private:
    bool Matches(const std::function<bool()>& isDone)
    {
        const auto deadline = std::chrono::steady_clock::now() + LIMIT;
        while (!isDone() && std::chrono::steady_clock::now() < deadline)
        {
            _context.restart();
            _context.run_one_for(std::chrono::milliseconds(100));
        }
        return isDone();
    }

    void ReadAsync()
    {
        auto chunk = std::make_shared<std::string>(4096, '\0');
        _socket.async_read_some(
            boost::asio::buffer(*chunk),
            [this, chunk](const boost::system::error_code& error, std::size_t count) {
                if (error == boost::asio::error::operation_aborted)
                {
                    return;
                }
                _received += chunk->substr(0, count);
                _bClosed = error.failed();
                if (!_bClosed)
                {
                    ReadAsync();
                }
            });
    }
};

} // namespace ACS::Testing
