#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// A WebSocket client that sends one text after the other, whatever the answers, and stays connected.
class RawPeer
{
    using Tcp = boost::asio::ip::tcp;

    boost::beast::websocket::stream<Tcp::socket> _stream;
    boost::beast::flat_buffer _buffer;
    std::vector<std::string> _texts;
    std::size_t _said = 0;
    bool _bAnswered = false;
    bool _bAccepted = false;

public:
    RawPeer(boost::asio::io_context& context, std::vector<std::string> texts)
        : _stream(context),
          _texts(std::move(texts))
    {
    }

    void ConnectAsync(std::uint16_t port)
    {
        const Tcp::endpoint endpoint(boost::asio::ip::address_v4::loopback(), port);
        _stream.next_layer().async_connect(endpoint, [this](boost::system::error_code error) {
            if (!error)
            {
                _stream.async_handshake("127.0.0.1", "/acs/", [this](boost::system::error_code refused) {
                    _bAnswered = true;
                    _bAccepted = !refused;
                    if (_bAccepted)
                    {
                        SayNext();
                        Listen();
                    }
                });
            }
        });
    }

    /// Whether the upgrade was answered.
    [[nodiscard]] bool WasAnswered() const noexcept
    {
        return _bAnswered;
    }

    [[nodiscard]] bool WasAccepted() const noexcept
    {
        return _bAccepted;
    }

private:
    void SayNext()
    {
        if (_said < _texts.size())
        {
            _stream.async_write(
                boost::asio::buffer(_texts[_said++]),
                [this](boost::system::error_code error, std::size_t /*bytes*/) {
                    if (!error)
                    {
                        SayNext();
                    }
                });
        }
    }

    void Listen()
    {
        _stream.async_read(_buffer, [this](boost::system::error_code error, std::size_t /*bytes*/) {
            _buffer.clear();
            if (!error)
            {
                Listen();
            }
        });
    }
};

/// A message of an ACS.
inline std::string MakeText(const std::string& command, const std::string& transactionID, const std::string& payload)
{
    return R"({"command":")" + command + R"(","transactionId":")" + transactionID
        + R"(","timestamp":"2025-07-02T21:00:00.123+09:00","payload":)" + payload + "}";
}

} // namespace ACS::Testing
