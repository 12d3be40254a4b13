#include "RawPeer.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>

#include <chrono>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <optional>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <utility>

using namespace ACS::OpenStream;     // NOLINT(google-build-using-namespace)
using namespace ACS::OpenStreamAsio; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;        // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

/// The client over a real socket, with a controller that violates the protocol.

namespace
{

using Tcp = boost::asio::ip::tcp;

/// Answers the HANDSHAKE of each connection, then stops reading.
class DeafController
{
public:
    static constexpr std::string_view ACK = "{\"type\":\"handshake_ack\",\"ok\":true,\"version\":\"1.0.0\"}\n";

private:
    Tcp::acceptor _acceptor;
    std::optional<Tcp::socket> _socket;
    std::optional<Tcp::socket> _former; ///< Of the connection before.
    boost::asio::streambuf _input;

public:
    std::size_t connections = 0;
    std::string firstLine; ///< Of the last connection.

    explicit DeafController(boost::asio::io_context& context)
        : _acceptor(context)
    {
        const Tcp::endpoint endpoint(boost::asio::ip::address_v4::loopback(), 0);
        _acceptor.open(endpoint.protocol());
        _acceptor.set_option(boost::asio::socket_base::receive_buffer_size(4'096)); // inherited by what it accepts
        _acceptor.bind(endpoint);
        _acceptor.listen();
        AcceptAsync();
    }

    [[nodiscard]] std::uint16_t GetPort() const
    {
        return _acceptor.local_endpoint().port();
    }

    void Send(std::string_view text)
    {
        boost::asio::write(*_socket, boost::asio::buffer(text));
    }

    /// The error that ended the former connection, after all its data was read.
    [[nodiscard]] boost::system::error_code ReadFormer()
    {
        std::string ignored;
        boost::system::error_code error;
        boost::asio::read(*_former, boost::asio::dynamic_buffer(ignored), error);
        return error;
    }

    /// Whether the client's system has acknowledged every byte.
    [[nodiscard]] bool IsAcknowledged()
    {
        tcp_info info{};
        socklen_t size = sizeof info;
        REQUIRE(getsockopt(_socket->native_handle(), IPPROTO_TCP, TCP_INFO, &info, &size) == 0);
        return info.tcpi_unacked == 0;
    }

private:
    void AcceptAsync()
    {
        _acceptor.async_accept([this](const boost::system::error_code& error, Tcp::socket socket) {
            if (!error)
            {
                ++connections;
                _former = std::exchange(_socket, std::move(socket));
                _socket->set_option(Tcp::no_delay(true));
                ReadLineAsync();
            }
        });
    }

    void ReadLineAsync()
    {
        _input.consume(_input.size());
        boost::asio::async_read_until(
            *_socket,
            _input,
            '\n',
            [this](const boost::system::error_code& error, std::size_t size) {
                if (!error)
                {
                    firstLine.assign(static_cast<const char*>(_input.data().data()), size);
                    boost::asio::write(*_socket, boost::asio::buffer(ACK));
                    AcceptAsync();
                }
            });
    }
};

std::optional<EClientLossReason> GetLossOrNull(const TcpFixture& fixture)
{
    for (const ClientEvent& event : fixture.events)
    {
        if (const auto* lost = std::get_if<ClientLost>(&event))
        {
            return lost->reason;
        }
    }
    return std::nullopt;
}

} // namespace

TEST_CASE("3 A controller that does not read loses the connection before old streamed CONTROLs can reach it")
{
    TcpFixture fixture;
    DeafController controller(fixture.context);
    OpenStreamClientOptions options;
    options.session.controlTimeout = 200ms;
    const auto client = fixture.MakeClient(controller.GetPort(), options);
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 1; }));
    const ControlRequest point{
        EApiMethod::Post,
        "/point",
        {},
        ACS::Core::JsonText::FromTrusted("[\"" + std::string(100'000, 'x') + "\"]")};
    REQUIRE(fixture.TryRunUntil([&]() {
        static_cast<void>(
            client->SendControl(point, EControlTracking::Streamed)); // until the system's buffers are full
        return GetLossOrNull(fixture).has_value();
    }));
    REQUIRE(GetLossOrNull(fixture) == EClientLossReason::SendTimeout);
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 2; }));
    REQUIRE(controller.connections == 2);
    REQUIRE(controller.firstLine.find("HANDSHAKE") != std::string::npos);
    // The data in the client's socket buffer is discarded: it is not delivered later.
    REQUIRE(controller.ReadFormer() == boost::asio::error::connection_reset);
}

TEST_CASE("1 A client that only listens acknowledges each line as it reads it, not each second one")
{
    TcpFixture fixture;
    DeafController controller(fixture.context);
    const auto client = fixture.MakeClient(controller.GetPort());
    client->SetMonitor(MonitorRequest{"/a", 2ms, {}, {}});
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 1; }));
    controller.Send("{\"type\":\"monitor_ack\"}\n");
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientMonitorStarted>() == 1; }));
    constexpr std::size_t LINES = 40;
    std::size_t late = 0;
    for (std::size_t count = 1; count <= LINES; ++count)
    {
        controller.Send(R"({"type":"data","ts":)" + std::to_string(2 * count) + ",\"svc_dur_ms\":0,\"result\":1}\n");
        REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientData>() == count; }));
        late += controller.IsAcknowledged() ? 0U : 1U;
    }
    CHECK(late < LINES / 4);
}
