#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd::Test
{

/// The robot's end of the connections of a LineClient, on the same event loop.
class LinePeer final
{
    using Tcp = boost::asio::ip::tcp;

    static constexpr std::chrono::seconds LIMIT{20};

    boost::asio::io_context& _context;
    Tcp::acceptor _acceptor;
    std::unique_ptr<Tcp::socket> _socketOrNull;
    std::array<char, 1024> _input{};

public:
    std::string received;     ///< On all connections.
    std::size_t accepted = 0; ///< Number of connections.
    bool bReading = true;     ///< Of connections that are accepted from now on.

    /// Port 0: any free one.
    LinePeer(boost::asio::io_context& context, std::uint16_t port)
        : _context(context),
          _acceptor(context, Tcp::endpoint(boost::asio::ip::address_v4::loopback(), port))
    {
        Accept();
    }

    LinePeer(const LinePeer&) = delete;
    LinePeer& operator=(const LinePeer&) = delete;
    ~LinePeer() = default;

    [[nodiscard]] std::uint16_t GetPort() const
    {
        return _acceptor.local_endpoint().port();
    }

    void Send(std::string_view bytes)
    {
        boost::asio::write(*_socketOrNull, boost::asio::buffer(bytes));
    }

    void Close()
    {
        _socketOrNull.reset();
    }

    /// Runs the event loop until the condition holds. Returns false after 20 s.
    template <typename TCondition>
    [[nodiscard]] bool TryRunUntil(TCondition condition)
    {
        const auto end = std::chrono::steady_clock::now() + LIMIT;
        while (!condition())
        {
            _context.restart();
            _context.run_one_until(end);
            if (std::chrono::steady_clock::now() >= end)
            {
                return false;
            }
        }
        return true;
    }

private:
    void Accept()
    {
        _acceptor.async_accept([this](const boost::system::error_code& error, Tcp::socket socket) {
            if (error)
            {
                return; // the acceptor is gone, and perhaps this object too
            }
            _socketOrNull = std::make_unique<Tcp::socket>(std::move(socket));
            ++accepted;
            if (bReading)
            {
                Read();
            }
            Accept();
        });
    }

    void Read()
    {
        _socketOrNull->async_read_some(
            boost::asio::buffer(_input),
            [this](const boost::system::error_code& error, std::size_t size) {
                if (!error)
                {
                    received.append(_input.data(), size);
                    Read();
                }
            });
    }
};

} // namespace ACS::Acsd::Test
