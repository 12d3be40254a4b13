#pragma once

#include "TcpFixture.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{

/// A plain socket, as any client in any language has it.
class RawPeer
{
    /// Outlives the peer in the handler that its end aborts.
    struct Reader : std::enable_shared_from_this<Reader>
    {
        boost::asio::ip::tcp::socket socket;
        std::string received;
        std::array<char, 4096> input{};
        bool bClosed = false;

        explicit Reader(boost::asio::io_context& context)
            : socket(context)
        {
        }

        void ReadAsync()
        {
            socket.async_read_some(boost::asio::buffer(input), std::bind_front(&Reader::OnRead, shared_from_this()));
        }

        void OnRead(const boost::system::error_code& error, std::size_t size)
        {
            bClosed = static_cast<bool>(error);
            received.append(input.data(), size);
            if (!error)
            {
                ReadAsync();
            }
        }
    };

    TcpFixture& _fixture;
    std::shared_ptr<Reader> _reader;

public:
    RawPeer(TcpFixture& fixture, std::uint16_t port)
        : RawPeer(fixture, port, 0)
    {
        Read();
    }

    /// With a receive buffer of that many bytes, 0 for the system's own; reads nothing before Read.
    RawPeer(TcpFixture& fixture, std::uint16_t port, int receiveBuffer)
        : _fixture(fixture),
          _reader(std::make_shared<Reader>(fixture.context))
    {
        const boost::asio::ip::tcp::endpoint server(boost::asio::ip::address_v4::loopback(), port);
        _reader->socket.open(server.protocol());
        if (receiveBuffer != 0)
        {
            _reader->socket.set_option(boost::asio::socket_base::receive_buffer_size(receiveBuffer));
        }
        _reader->socket.connect(server);
    }

    RawPeer(const RawPeer&) = delete;
    RawPeer& operator=(const RawPeer&) = delete;

    ~RawPeer()
    {
        boost::system::error_code ignored;
        static_cast<void>(_reader->socket.close(ignored));
    }

    void Read()
    {
        _reader->ReadAsync();
    }

    void Send(std::string_view bytes)
    {
        boost::asio::write(_reader->socket, boost::asio::buffer(bytes));
    }

    void CloseSending()
    {
        _reader->socket.shutdown(boost::asio::ip::tcp::socket::shutdown_send);
    }

    [[nodiscard]] bool TryAwait(std::string_view part)
    {
        return _fixture.TryRunUntil([this, part]() { return _reader->received.find(part) != std::string::npos; });
    }

    /// As many lines with this in them.
    [[nodiscard]] bool TryAwaitCount(std::string_view part, std::size_t count)
    {
        return _fixture.TryRunUntil([this, part, count]() { return CountLines(part) >= count; });
    }

    [[nodiscard]] std::size_t CountLines(std::string_view part) const
    {
        std::size_t count = 0;
        for (const std::string& line : GetLines())
        {
            count += line.find(part) == std::string::npos ? 0U : 1U;
        }
        return count;
    }

    /// The whole lines so far.
    [[nodiscard]] std::vector<std::string> GetLines() const
    {
        std::vector<std::string> lines;
        std::string_view rest = _reader->received;
        for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n'))
        {
            lines.emplace_back(rest.substr(0, end));
            rest.remove_prefix(end + 1);
        }
        return lines;
    }

    [[nodiscard]] bool TryAwaitClose()
    {
        return _fixture.TryRunUntil([this]() { return _reader->bClosed; });
    }

    [[nodiscard]] const std::string& GetReceived() const
    {
        return _reader->received;
    }
};

} // namespace ACS::Testing
