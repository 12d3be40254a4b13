#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Testing
{

/// MQTT's control packets that hand a message over, and the answer to a subscription.
enum class EPacket : std::uint8_t
{
    Publish = 3,
    Pubrec = 5,
    Pubrel = 6,
    Pubcomp = 7,
    Suback = 9,
};

/// A proxy between clients and a broker that cuts the connection at a chosen MQTT packet.
class CuttingProxy
{
public:
    struct Cut
    {
        EPacket packet = EPacket::Publish;
        bool bToBroker = false;
        bool bForwarded = false; ///< Whether the packet itself still arrives.
    };

private:
    using Tcp = boost::asio::ip::tcp;

    struct Side
    {
        Tcp::socket socket;
        std::array<char, 4096> chunk{};
        std::string buffer;

        explicit Side(Tcp::socket connected)
            : socket(std::move(connected))
        {
        }
    };

    struct Line
    {
        Side client;
        Side broker;
        bool bCut = false;

        Line(Tcp::socket first, Tcp::socket second)
            : client(std::move(first)),
              broker(std::move(second))
        {
        }
    };

    boost::asio::io_context& _context;
    Tcp::acceptor _acceptor;
    Tcp::endpoint _broker;

public:
    std::optional<Cut> cutOrNull; ///< Done once.
    std::size_t connections = 0;

    CuttingProxy(boost::asio::io_context& context, std::uint16_t brokerPort)
        : _context(context),
          _acceptor(context, Tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0)),
          _broker(boost::asio::ip::address_v4::loopback(), brokerPort)
    {
        Accept();
    }

    [[nodiscard]] std::uint16_t GetPort() const
    {
        return _acceptor.local_endpoint().port();
    }

private:
    void Accept()
    {
        _acceptor.async_accept([this](const boost::system::error_code& error, Tcp::socket client) {
            if (error)
            {
                return;
            }
            ++connections;
            Tcp::socket broker(_context);
            boost::system::error_code refused;
            broker.connect(_broker, refused);
            const auto line = std::make_shared<Line>(std::move(client), std::move(broker));
            Read(line, true);
            Read(line, false);
            Accept();
        });
    }

    void Read(const std::shared_ptr<Line>& line, bool bToBroker)
    {
        Side& from = bToBroker ? line->client : line->broker;
        from.socket.async_read_some(
            boost::asio::buffer(from.chunk),
            [this, line, bToBroker](const boost::system::error_code& error, std::size_t length) {
                Side& source = bToBroker ? line->client : line->broker;
                Side& target = bToBroker ? line->broker : line->client;
                if (error)
                {
                    End(target);
                    return;
                }
                source.buffer.append(source.chunk.data(), length);
                while (const std::optional<std::string> packet = TakePacketOrNull(source.buffer))
                {
                    Forward(line, *packet, bToBroker);
                }
                Read(
                    line,
                    bToBroker); // after a cut, too: what is not read resets the connection, and undoes what was sent
            });
    }

    void Forward(const std::shared_ptr<Line>& line, const std::string& packet, bool bToBroker)
    {
        if (line->bCut)
        {
            return;
        }
        constexpr unsigned TYPE_SHIFT = 4;
        const unsigned type = static_cast<unsigned char>(packet.front()) >> TYPE_SHIFT;
        line->bCut = cutOrNull.has_value() && cutOrNull->bToBroker == bToBroker
            && static_cast<unsigned>(cutOrNull->packet) == type;
        boost::system::error_code ignored;
        if (!line->bCut || cutOrNull->bForwarded)
        {
            boost::asio::write((bToBroker ? line->broker : line->client).socket, boost::asio::buffer(packet), ignored);
        }
        if (line->bCut)
        {
            cutOrNull.reset();
            End(line->client);
            End(line->broker);
        }
    }

    static void End(Side& side)
    {
        boost::system::error_code ignored;
        side.socket.shutdown(Tcp::socket::shutdown_send, ignored);
    }

    /// One whole packet from the front: its type, its length in bytes of seven bits each, and the rest.
    [[nodiscard]] static std::optional<std::string> TakePacketOrNull(std::string& buffer)
    {
        constexpr unsigned MORE = 0x80;
        constexpr unsigned LENGTH_BITS = 7;
        std::size_t length = 0;
        std::size_t position = 1;
        unsigned shift = 0;
        bool bMore = true;
        for (; bMore && position < buffer.size(); ++position)
        {
            const auto byte = static_cast<unsigned char>(buffer[position]);
            length |= static_cast<std::size_t>(byte & ~MORE) << shift;
            shift += LENGTH_BITS;
            bMore = (byte & MORE) != 0;
        }
        if (bMore || buffer.size() < position + length)
        {
            return std::nullopt;
        }
        std::string packet = buffer.substr(0, position + length);
        buffer.erase(0, position + length);
        return packet;
    }
};

} // namespace ACS::Testing
