#include "Catch.hpp"
#include "LinePeer.hpp"
#include "SeededRandom.hpp"
#include "TwoAddresses.hpp"
#include <acs/acsd/LineClient.hpp>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using namespace std::chrono_literals;

constexpr std::size_t LINE_BYTES = 100;
constexpr std::size_t QUEUED_LINES = 8;

/// A client with small limits and short delays, and its peer.
struct LineClientFixture
{
    boost::asio::io_context context;
    Testing::SeededRandom random{1};
    std::optional<LinePeer> peer{std::in_place, context, std::uint16_t{0}};
    std::vector<std::string> lines;
    std::vector<std::string> losses;
    std::size_t connects = 0;
    LineClientOptions options = MakeOptions();
    std::optional<LineClient> client;

    LineClientOptions MakeOptions()
    {
        LineClientOptions made;
        made.host = "127.0.0.1";
        made.port = peer->GetPort();
        made.maximumLineBytes = LINE_BYTES;
        made.maximumQueuedLines = QUEUED_LINES;
        made.backoff = {1ms, 5ms, 2.0, 0.5};
        return made;
    }

    void Start()
    {
        client.emplace(
            context.get_executor(),
            random,
            options,
            LineClient::Handlers{
                [this] { ++connects; },
                [this](std::string_view line) { lines.emplace_back(line); },
                [this](std::string_view reason) {
                    losses.emplace_back(reason);
                }});
        client->Start();
    }

    /// Until both ends have the connection of that number.
    void Connect(std::size_t number = 1)
    {
        REQUIRE(peer->TryRunUntil([&] { return connects == number && peer->accepted >= number; }));
    }

    void ReceiveLines(std::size_t count)
    {
        REQUIRE(peer->TryRunUntil([&] { return lines.size() == count; }));
    }

    void Lose(std::size_t count)
    {
        REQUIRE(peer->TryRunUntil([&] { return losses.size() >= count; }));
    }
};

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("A peer at the second address of its host is reached although the first one does not answer")
{
    LineClientFixture fixture;
    const Testing::TwoAddresses addresses(fixture.context, fixture.options.port);
    fixture.options.host = Testing::TwoAddresses::HOST;
    fixture.options.connectTimeout = 50ms;
    fixture.Start();
    fixture.Connect();
    CHECK_FALSE(fixture.losses.empty());
}

TEST_CASE("Lines arrive whole, wherever their bytes are split")
{
    LineClientFixture fixture;
    fixture.Start();
    fixture.Connect();
    fixture.peer->Send("one\ntw");
    fixture.ReceiveLines(1);
    fixture.peer->Send("o\r");
    fixture.peer->Send("\n\n\xED\x95");
    fixture.ReceiveLines(3);
    fixture.peer->Send("\x9C\tx\n");
    fixture.ReceiveLines(4);
    CHECK(fixture.lines == Lines{"one", "two", "", "\xED\x95\x9C\tx"});

    CHECK(fixture.client->Send("a") == ELineSend::Accepted);
    CHECK(fixture.client->Send("b") == ELineSend::Accepted);
    REQUIRE(fixture.peer->TryRunUntil([&] { return fixture.peer->received == "a\nb\n"; }));
    REQUIRE(fixture.peer->TryRunUntil([&] { return fixture.client->GetStats().linesSent == 2; }));
    CHECK(fixture.client->GetStats().connects == 1);
    CHECK(fixture.client->GetStats().linesReceived == 4);
    CHECK(fixture.client->GetStats().linesDropped == 0);
    CHECK(fixture.losses.empty());
}

TEST_CASE("A line of the maximum length is accepted; a longer one ends the connection, with or without its end")
{
    LineClientFixture fixture;
    fixture.Start();
    fixture.Connect();
    const std::string longest(LINE_BYTES, 'x');
    fixture.peer->Send(longest + "\r\n");
    fixture.ReceiveLines(1);
    CHECK(fixture.lines == Lines{longest});

    std::size_t connection = 1;
    for (const std::string& text : {longest + "x\n", longest + "xx"})
    {
        fixture.peer->Send(text);
        fixture.Lose(connection);
        CHECK(fixture.losses.back() == "a line has more than 100 bytes");
        fixture.Connect(++connection);
        fixture.peer->Send("after\n"); // what was received of the long line is gone
        fixture.ReceiveLines(connection);
        CHECK(fixture.lines.back() == "after");
    }
}

TEST_CASE("A line that is not valid UTF-8 or has a control character ends the connection")
{
    LineClientFixture fixture;
    fixture.Start();
    std::size_t connection = 0;
    for (const std::string& text :
         {std::string("\xFF\n"), std::string("a\0b\n", 4), std::string("\x1B[2J\n"), std::string("\x7F\n")})
    {
        fixture.Connect(++connection);
        fixture.peer->Send(text);
        fixture.Lose(connection);
        CHECK(fixture.losses.back() == "a line is not valid UTF-8 or has a control character");
    }
    CHECK(fixture.lines.empty());
}

TEST_CASE("The client reconnects when the peer closes the connection, and when it is absent for a while")
{
    LineClientFixture fixture;
    const std::uint16_t port = fixture.peer->GetPort();
    fixture.Start();
    fixture.Connect();
    fixture.peer->Close();
    fixture.Lose(1);
    CHECK(fixture.losses[0] == "the peer has closed the connection");
    CHECK_FALSE(fixture.client->IsConnected());
    fixture.Connect(2);

    fixture.peer->Send("half a li");
    fixture.peer.emplace(fixture.context, std::uint16_t{0}); // somewhere else
    fixture.Lose(4);
    CHECK(fixture.losses[2] == "Connection refused");
    CHECK(fixture.connects == 2);
    fixture.peer.emplace(fixture.context, port);
    REQUIRE(fixture.peer->TryRunUntil([&] { return fixture.connects == 3 && fixture.peer->accepted == 1; }));
    fixture.peer->Send("whole\n");
    fixture.ReceiveLines(1);
    CHECK(fixture.lines == Lines{"whole"});
}

TEST_CASE("A peer that does not read fills the queue; then the connection is closed and the lines are dropped")
{
    LineClientFixture fixture;
    fixture.options.maximumLineBytes = std::size_t{1024} * 1024;
    fixture.peer->bReading = false;
    fixture.Start();
    fixture.Connect();
    const std::string line(fixture.options.maximumLineBytes, 'x');
    std::size_t accepted = 0;
    ELineSend sent = ELineSend::Accepted;
    while (sent == ELineSend::Accepted)
    {
        fixture.context.restart();
        fixture.context.poll();
        sent = fixture.client->Send(line);
        accepted += sent == ELineSend::Accepted ? 1 : 0;
        REQUIRE(accepted < 1000); // the buffers of the system are smaller
    }
    CHECK(sent == ELineSend::QueueFull);
    CHECK(fixture.losses.empty()); // not from within Send
    fixture.Lose(1);
    CHECK(fixture.losses[0] == "the peer does not read: 8 lines wait");
    const LineClientStats& stats = fixture.client->GetStats();
    CHECK(stats.linesSent + stats.linesDropped == accepted + 1);
    CHECK(stats.linesDropped == QUEUED_LINES + 1);

    fixture.peer->bReading = true;
    fixture.Connect(2);
    CHECK(fixture.client->Send("next") == ELineSend::Accepted);
    REQUIRE(fixture.peer->TryRunUntil([&] { return !fixture.peer->received.empty(); }));
    CHECK(fixture.peer->received == "next\n"); // nothing of the old connection
}

TEST_CASE("A line is dropped without a connection, and if it is too long or has a line end")
{
    LineClientFixture fixture;
    fixture.Start();
    CHECK(fixture.client->Send("early") == ELineSend::NotConnected);
    fixture.Connect();
    CHECK(fixture.client->Send(std::string(LINE_BYTES + 1, 'x')) == ELineSend::InvalidLine);
    CHECK(fixture.client->Send("a\nb") == ELineSend::InvalidLine);
    CHECK(fixture.client->Send("a\r") == ELineSend::InvalidLine);
    CHECK(fixture.client->Send(std::string(LINE_BYTES, 'x')) == ELineSend::Accepted);
    CHECK(fixture.client->GetStats().linesDropped == 4);
}

TEST_CASE("A silent peer is lost after the receive timeout, one that sends is not")
{
    LineClientFixture fixture;
    fixture.options.receiveTimeout = 50ms;
    fixture.Start();
    fixture.Connect();
    fixture.Lose(1);
    CHECK(fixture.losses[0] == "the peer is silent");
    fixture.Connect(2);
    const auto end = std::chrono::steady_clock::now() + 4 * fixture.options.receiveTimeout;
    while (std::chrono::steady_clock::now() < end)
    {
        const std::size_t count = fixture.lines.size();
        fixture.peer->Send("alive\n");
        fixture.ReceiveLines(count + 1);
    }
    CHECK(fixture.losses.size() == 1);
}

TEST_CASE("After a stop no handler is called; a handler may destroy the client")
{
    LineClientFixture fixture;
    fixture.Start();
    fixture.Connect();
    fixture.peer->Send("one\ntwo\n");
    fixture.client->Stop();
    fixture.peer->Close();
    fixture.context.restart();
    fixture.context.run_for(20ms);
    CHECK(fixture.lines.empty());
    CHECK(fixture.losses.empty());
    CHECK_FALSE(fixture.client->IsConnected());

    std::optional<LineClient> other;
    bool bCalled = false;
    other.emplace(
        fixture.context.get_executor(),
        fixture.random,
        fixture.options,
        LineClient::Handlers{
            [] {},
            [&](std::string_view /*line*/) {
                bCalled = true;
                other.reset();
            },
            [](std::string_view /*reason*/) {
            }});
    other->Start();
    REQUIRE(fixture.peer->TryRunUntil([&] { return other->IsConnected() && fixture.peer->accepted == 2; }));
    fixture.peer->Send("one\ntwo\n");
    REQUIRE(fixture.peer->TryRunUntil([&] { return bCalled; }));
    CHECK_FALSE(other.has_value());
}

} // namespace ACS::Acsd::Test
