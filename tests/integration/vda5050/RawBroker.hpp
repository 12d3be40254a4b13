#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Testing
{

/// A peer that accepts every MQTT 3.1.1 client. It answers a packet only if the test has set an answer.
class RawBroker
{
public:
    static constexpr char SUBSCRIBE = '\x82';

private:
    struct Client
    {
        boost::asio::ip::tcp::socket socket;
        std::array<char, 4096> buffer{};

        explicit Client(boost::asio::ip::tcp::socket accepted)
            : socket(std::move(accepted))
        {
        }
    };

    boost::asio::ip::tcp::acceptor _acceptor;
    std::shared_ptr<Client> _lastClient;

public:
    std::size_t connections = 0;
    std::string received; ///< By all clients.
    /// What is sent after a SUBSCRIBE, by its packet id.
    std::function<std::string(std::string_view packetID)> answerSubscribe;

    explicit RawBroker(boost::asio::io_context& context)
        : _acceptor(context, boost::asio::ip::tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0))
    {
        Accept();
    }

    [[nodiscard]] std::uint16_t GetPort() const
    {
        return _acceptor.local_endpoint().port();
    }

    /// A PUBLISH with QoS 0; topic and payload together less than 120 bytes.
    [[nodiscard]] static std::string MakePublish(const std::string& topic, const std::string& payload)
    {
        std::string packet(1, '\x30');
        packet += static_cast<char>(2 + topic.size() + payload.size());
        packet += '\0';
        packet += static_cast<char>(topic.size());
        return packet + topic + payload;
    }

    /// A PUBLISH with QoS 2, limited like the one of MakePublish.
    [[nodiscard]] static std::string MakePublishOnce(
        const std::string& topic,
        const std::string& packetID,
        const std::string& payload)
    {
        std::string packet(1, '\x34');
        packet += static_cast<char>(2 + topic.size() + packetID.size() + payload.size());
        packet += '\0';
        packet += static_cast<char>(topic.size());
        return packet + topic + packetID + payload;
    }

    /// Resets the connection of the client that came last. What was sent before can still be read there.
    void Reset()
    {
        _lastClient->socket.set_option(boost::asio::socket_base::linger(true, 0));
        _lastClient->socket.close();
    }

    /// To the client that came last.
    void Send(const std::string& bytes)
    {
        boost::asio::write(_lastClient->socket, boost::asio::buffer(bytes));
    }

private:
    void Accept()
    {
        _acceptor.async_accept([this](const boost::system::error_code& error, boost::asio::ip::tcp::socket socket) {
            if (error)
            {
                return;
            }
            ++connections;
            _lastClient = std::make_shared<Client>(std::move(socket));
            Read(_lastClient);
            Accept();
        });
    }

    void Read(const std::shared_ptr<Client>& client)
    {
        client->socket.async_read_some(
            boost::asio::buffer(client->buffer),
            [this, client](const boost::system::error_code& error, std::size_t length) {
                if (error)
                {
                    return;
                }
                const std::string_view packet(client->buffer.data(), length);
                received += packet;
                std::string answer;
                if (packet.front() == '\x10')
                {
                    answer = std::string("\x20\x02\x00\x00", 4);
                }
                else if (packet.front() == SUBSCRIBE && answerSubscribe)
                {
                    answer = answerSubscribe(packet.substr(2, 2));
                }
                boost::system::error_code ignored;
                boost::asio::write(client->socket, boost::asio::buffer(answer), ignored);
                Read(client);
            });
    }
};

} // namespace ACS::Testing
