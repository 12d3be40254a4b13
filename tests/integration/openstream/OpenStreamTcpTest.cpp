#include "RawPeer.hpp"
#include "TwoAddresses.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

using namespace ACS::OpenStream;     // NOLINT(google-build-using-namespace)
using namespace ACS::OpenStreamAsio; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;        // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

const MonitorRequest MONITOR{"/project/rgen", 20ms, {}, {}}; // NOLINT(cert-err58-cpp)

} // namespace

TEST_CASE("A client that may not send any more closes its connection instead of sending")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    bool bAllowed = true;
    std::string sent;
    OpenStreamClientOptions options;
    options.maySend = [&bAllowed] {
        return bAllowed;
    };
    options.onSent = [&sent](std::string_view bytes) {
        sent += bytes;
    };
    const auto client = fixture.MakeClient(server->GetPort(), options);
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 1; }));
    bAllowed = false;
    sent.clear();
    client->SendControl(ControlRequest{EApiMethod::Post, "/good", {}, {}}, EControlTracking::Tracked);
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientLost>() == 1; }));
    CHECK(sent.empty());
    bAllowed = true;
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 2; }));
}

TEST_CASE("3 Handshake, a MONITOR at 20 ms delivers, a valid CONTROL is accepted, a rejected one gives the reason")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    const auto client = fixture.MakeClient(server->GetPort());
    client->SetMonitor(MONITOR);
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientData>() >= 5; }));
    REQUIRE(fixture.Count<ClientReady>() == 1);
    REQUIRE(fixture.Count<ClientMonitorStarted>() == 1);

    const std::uint64_t good =
        client->SendControl(ControlRequest{EApiMethod::Post, "/good", {}, {}}, EControlTracking::Tracked);
    const std::uint64_t bad =
        client->SendControl(ControlRequest{EApiMethod::Post, "/refused", {}, {}}, EControlTracking::Tracked);
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientControlSettled>() == 2; }));
    std::vector<ClientControlSettled> settled;
    for (const ClientEvent& event : fixture.events)
    {
        if (const auto* outcome = std::get_if<ClientControlSettled>(&event))
        {
            settled.push_back(*outcome);
        }
    }
    REQUIRE(settled.at(0).token == good);
    REQUIRE(settled.at(0).outcome == EControlOutcome::Accepted);
    REQUIRE(settled.at(1).token == bad);
    REQUIRE(settled.at(1).outcome == EControlOutcome::Refused);
    REQUIRE(settled.at(1).status == 403);
    REQUIRE(settled.at(1).body->GetText() == R"({"err_code":-38500})");

    client->StopControl();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientStopped>() == 1; }));
    REQUIRE(fixture.service.stops == 1);

    client->Stop();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientEnded>() == 1; }));
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == 0; }));
    const ServerSessionStats stats = server->GetStats(); // of the session that has ended
    REQUIRE(stats.dataLines >= fixture.Count<ClientData>());
    REQUIRE(stats.controlErrors == 1);
    REQUIRE(stats.errorLines == 0);
}

TEST_CASE("8 A server at the second address of its host is reached although the first one does not answer")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    const TwoAddresses addresses(fixture.context, server->GetPort());
    OpenStreamClientOptions options;
    options.host = TwoAddresses::HOST;
    options.session.connectTimeout = 50ms;
    const auto client = fixture.MakeClient(server->GetPort(), options);
    client->Start();
    CHECK(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 1; }));
}

TEST_CASE("8 The client reconnects to a restarted server and renews its MONITOR")
{
    TcpFixture fixture;
    auto server = fixture.StartServer();
    OpenStreamServerOptions options = TcpFixture::MakeOptions();
    options.port = server->GetPort();
    const auto client = fixture.MakeClient(options.port);
    client->SetMonitor(MONITOR);
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientData>() > 0; }));
    server.reset();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientLost>() >= 2; }));
    REQUIRE(fixture.log.Contains(ACS::Core::ELogLevel::Warning, "lost"));
    server = fixture.StartServer(options);
    const std::size_t before = fixture.Count<ClientData>();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientData>() > before; }));
    REQUIRE(fixture.Count<ClientReady>() == 2);
    REQUIRE(fixture.Count<ClientMonitorStarted>() == 2);
}

TEST_CASE("8 A server that is stopped and started again at once accepts connections and logs no warning")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    server->Stop();
    REQUIRE(server->GetPort() == 0);
    REQUIRE(server->Start().has_value());
    const auto client = fixture.MakeClient(server->GetPort());
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 1; }));
    REQUIRE(server->GetSessionCount() == 1);
    REQUIRE_FALSE(fixture.log.Contains(ACS::Core::ELogLevel::Warning, ""));
}

TEST_CASE("8 A second start keeps the port of a server, which still accepts clients")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    const std::uint16_t port = server->GetPort();
    REQUIRE(server->Start().has_value());
    REQUIRE(server->GetPort() == port);
    const auto client = fixture.MakeClient(port);
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 1; }));
}

TEST_CASE("8 Sessions that are dropped without a line reconnect")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    const auto client = fixture.MakeClient(server->GetPort());
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 1; }));
    server->DropSessions();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientReady>() == 2; }));
    REQUIRE(server->GetStats().commands == 2); // a HANDSHAKE of each session
}

TEST_CASE("1 7.33 7.34 Half lines, CRLF and garbage over a real socket")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    peer.Send("\xFF\xFEgarbage\r\n\r\n{\"cmd\":\"HAND");
    REQUIRE(peer.TryAwait("invalid_ndjson"));
    peer.Send("SHAKE\",\"payload\":{\"major\":1}}\r\n");
    REQUIRE(peer.TryAwait("handshake_ack"));
    peer.Send("{\"cmd\":\"MONITOR\",\"payload\":{\"url\":\"/a\",\"method\":\"GET\",\"period_ms\":2}}\n");
    REQUIRE(peer.TryAwait("\"result\":5"));
    REQUIRE(peer.GetReceived().find('\xFF') == std::string::npos);
}

TEST_CASE("7.20 A line that is too long is answered with an error and a close; other sessions continue")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    const auto client = fixture.MakeClient(server->GetPort());
    client->SetMonitor(MONITOR);
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientData>() > 0; }));
    RawPeer peer(fixture, server->GetPort());
    const std::string part(64U * 1024U, 'x');
    for (int count = 0; count < 17; ++count)
    {
        peer.Send(part);
        fixture.context.restart();
        fixture.context.poll();
    }
    REQUIRE(peer.TryAwait("rx_buf_overflow"));
    REQUIRE(peer.TryAwaitClose());
    const std::size_t before = fixture.Count<ClientData>();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientData>() > before; }));
    REQUIRE(fixture.Count<ClientLost>() == 0);
}

TEST_CASE("7.39 Half-close: the answers are sent, then the server closes")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    peer.Send("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n"
              "{\"cmd\":\"CONTROL\",\"payload\":{\"url\":\"/refused\",\"method\":\"POST\"}}\n"
              "{\"cmd\":\"CONTROL\",\"payload\":{\"url\":\"/x");
    peer.CloseSending();
    REQUIRE(peer.TryAwaitClose());
    REQUIRE(peer.GetReceived().find("control_err") != std::string::npos);
    REQUIRE(fixture.service.controls == 1);
}

TEST_CASE("7.12 A session beyond the limit is rejected with a line, and its place is free again later")
{
    TcpFixture fixture;
    OpenStreamServerOptions options = TcpFixture::MakeOptions();
    options.maximumSessions = 1;
    const auto server = fixture.StartServer(options);
    {
        RawPeer first(fixture, server->GetPort());
        first.Send("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n");
        REQUIRE(first.TryAwait("handshake_ack"));
        RawPeer second(fixture, server->GetPort());
        REQUIRE(second.TryAwait("handshake_rejected"));
        REQUIRE(second.TryAwaitClose());
    }
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == 0; }));
    RawPeer third(fixture, server->GetPort());
    third.Send("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n");
    REQUIRE(third.TryAwait("handshake_ack"));
}

TEST_CASE("D-10 A ninth client is served while eight others stay silent")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    std::vector<std::unique_ptr<RawPeer>> silent;
    for (std::size_t count = 0; count < 8; ++count)
    {
        silent.push_back(std::make_unique<RawPeer>(fixture, server->GetPort()));
        REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == count + 1; }));
    }
    RawPeer ninth(fixture, server->GetPort());
    ninth.Send("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n");
    REQUIRE(ninth.TryAwait("handshake_ack"));
    REQUIRE(silent.front()->TryAwait("handshake_rejected"));
    REQUIRE(silent.front()->TryAwaitClose());
    for (std::size_t index = 1; index < silent.size(); ++index)
    {
        CHECK(silent[index]->GetReceived().empty());
    }
}

TEST_CASE("D-10 Many silent connections at once do not keep a client out")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    std::vector<std::unique_ptr<RawPeer>> silent;
    for (std::size_t count = 0; count < 40; ++count)
    {
        silent.push_back(std::make_unique<RawPeer>(fixture, server->GetPort()));
    }
    RawPeer client(fixture, server->GetPort());
    client.Send("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n");
    REQUIRE(client.TryAwait("handshake_ack"));
    REQUIRE(server->GetSessionCount() <= 16);
}

TEST_CASE("D-10 A client after its HANDSHAKE is never dropped for another one")
{
    TcpFixture fixture;
    OpenStreamServerOptions options = TcpFixture::MakeOptions();
    options.maximumSessions = 2;
    const auto server = fixture.StartServer(options);
    RawPeer first(fixture, server->GetPort());
    first.Send("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n");
    REQUIRE(first.TryAwait("handshake_ack"));
    RawPeer silent(fixture, server->GetPort());
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == 2; }));
    RawPeer second(fixture, server->GetPort());
    second.Send("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n");
    REQUIRE(second.TryAwait("handshake_ack"));
    REQUIRE(silent.TryAwait("handshake_rejected"));
    RawPeer third(fixture, server->GetPort());
    REQUIRE(third.TryAwait("handshake_rejected"));
    first.Send("{\"cmd\":\"STOP\",\"payload\":{\"target\":\"session\"}}\n");
    REQUIRE(first.TryAwait("stop_ack"));
}

TEST_CASE("D-10 A connection without a HANDSHAKE is closed at its deadline")
{
    TcpFixture fixture;
    OpenStreamServerOptions options = TcpFixture::MakeOptions();
    options.session.handshakeTimeout = 50ms;
    const auto server = fixture.StartServer(options);
    RawPeer silent(fixture, server->GetPort());
    REQUIRE(silent.TryAwait("session_timeout"));
    REQUIRE(silent.TryAwaitClose());
}

TEST_CASE("1 The error about a port in use names the address and the remedy")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    OpenStreamServerOptions options = TcpFixture::MakeOptions();
    options.port = server->GetPort();
    const auto second = fixture.MakeServer(options);
    const auto started = second->Start();
    REQUIRE_FALSE(started.has_value());
    const std::string sentence = ACS::Core::Describe(started.error());
    REQUIRE(sentence.find("127.0.0.1:" + std::to_string(options.port)) != std::string::npos);
    REQUIRE(sentence.find("choose another") != std::string::npos);
    REQUIRE(second->GetPort() == 0);
}

TEST_CASE("8 Destroying both ends in mid stream leaves no handler")
{
    TcpFixture fixture;
    auto server = fixture.StartServer();
    auto client = fixture.MakeClient(server->GetPort());
    client->SetMonitor(MonitorRequest{"/project/rgen", 2ms, {}, {}});
    client->Start();
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.Count<ClientData>() >= 10; }));
    client.reset();
    server.reset();
    const std::size_t before = fixture.events.size();
    fixture.context.restart();
    fixture.context.run_for(1s);
    REQUIRE(fixture.events.size() == before);
    REQUIRE(fixture.context.stopped());
}

TEST_CASE("A server shows all bytes of each connection with its number, and its end once")
{
    TcpFixture fixture;
    struct Wire
    {
        std::string received;
        std::string sent;
        int ends = 0;
    };
    std::map<std::uint64_t, Wire> wires;
    OpenStreamServerOptions options = TcpFixture::MakeOptions();
    options.maximumSessions = 1;
    options.onReceived = [&wires](std::uint64_t connection, std::string_view bytes) {
        wires[connection].received += bytes;
    };
    options.onSent = [&wires](std::uint64_t connection, std::string_view bytes) {
        wires[connection].sent += bytes;
    };
    options.onClosed = [&wires](std::uint64_t connection) {
        ++wires[connection].ends;
    };
    const auto server = fixture.StartServer(options);
    {
        const std::string handshake = R"({"cmd":"HANDSHAKE","payload":{"major":1}})"
                                      "\n";
        const std::string part = R"({"cmd")";
        RawPeer first(fixture, server->GetPort());
        first.Send(handshake + part);
        REQUIRE(first.TryAwait("handshake_ack"));
        RawPeer second(fixture, server->GetPort());
        REQUIRE(second.TryAwait("handshake_rejected"));
        REQUIRE(second.TryAwaitClose());
        REQUIRE(fixture.TryRunUntil([&]() { return wires[1].received == handshake + part; }));
        CHECK(wires[1].sent == first.GetReceived());
        CHECK(wires[1].ends == 0);
        CHECK(wires[2].sent == second.GetReceived());
        server->DropSessions();
        CHECK(wires[1].ends == 1);
    }
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == 0; }));
    server->Stop();
    CHECK(wires.size() == 2);
    CHECK(wires[1].ends == 1);
    CHECK(wires[2].ends == 1);
}
