#include "RawPeer.hpp"
#include <acs/openstream/OpenStreamCodec.hpp>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

using namespace ACS::OpenStream;     // NOLINT(google-build-using-namespace)
using namespace ACS::OpenStreamAsio; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;        // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

/// Bytes and timing over a real socket. The rules are tested one by one in virtual time; here they meet TCP.

namespace
{

constexpr std::string_view SHAKE = "{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n";

std::string MakeMonitorLine(const std::string& url, int periodMs = 2)
{
    return R"({"cmd":"MONITOR","payload":{"method":"GET","url":")" + url + R"(","period_ms":)"
        + std::to_string(periodMs) + "}}\n";
}

std::string MakeStopLine(const std::string& target)
{
    return R"({"cmd":"STOP","payload":{"target":")" + target + "\"}}\n";
}

std::string MakeControlLine(const std::string& members = R"("url":"/good")")
{
    return R"({"cmd":"CONTROL","payload":{"method":"POST",)" + members + "}}\n";
}

/// Every line can be decoded, and ts increases from one data line to the next.
void CheckLines(const RawPeer& peer)
{
    OpenStreamCodec codec;
    double last = 0.0;
    for (const std::string& text : peer.GetLines())
    {
        INFO(text.substr(0, 200));
        const auto line = codec.DecodeLine(text);
        REQUIRE(line.has_value());
        if (const auto* data = std::get_if<DataLine>(&*line))
        {
            REQUIRE(data->ts > last);
            last = data->ts;
        }
    }
}

} // namespace

TEST_CASE("1 A command in single bytes and a hundred commands in one write are the same lines")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    for (const char& letter : SHAKE)
    {
        peer.Send(std::string_view(&letter, 1));
        fixture.context.restart();
        fixture.context.poll();
    }
    REQUIRE(peer.TryAwait("handshake_ack"));
    std::string many;
    for (int count = 0; count < 100; ++count)
    {
        many += MakeControlLine(count % 2 == 0 ? R"("url":"/good")" : R"("url":"/refused")");
        many += "x\n";
    }
    peer.Send(many + MakeStopLine("session"));
    REQUIRE(peer.TryAwait("stop_ack"));
    CHECK(peer.CountLines("control_err") == 50);
    CHECK(peer.CountLines("invalid_ndjson") == 100);
    CHECK(fixture.service.controls == 100);
    CheckLines(peer);
}

TEST_CASE("1 7.1 7.2 7.33 7.34 7.35 7.36 7.37 7.38 Each bad line is answered with one error; all sessions continue")
{
    struct Row
    {
        const char* rule;
        std::string line; ///< With its end.
        std::string code; ///< Empty: no line at all.
    };
    const std::vector<Row> rows{
        {"7.33", "\n", ""},
        {"7.33", "\r\n \t \r\n", ""},
        {"7.34", "{\"cmd\":\n", "invalid_ndjson"},
        {"7.35", "{\"cmd\":\"\xFF\xFE\"}\n", "invalid_ndjson"},
        {"7.36", "{\"cmd\":\"STOP\",\"payload\":{\"target\":\"monitor\",\"target\":\"monitor\"}}\n", "invalid_ndjson"},
        {"7.36", "{} {}\n", "invalid_ndjson"},
        {"7.37", MakeControlLine(R"("url":"/good","body":{"a":NaN})"), "invalid_ndjson"},
        {"7.37", "{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1e999}}\n", "invalid_ndjson"},
        {"7.38", std::string(50'000, '[') + "\n", "invalid_ndjson"},
        {"7.38",
         MakeControlLine(R"("url":"/good","body":)" + std::string(65, '[') + std::string(65, ']')),
         "invalid_ndjson"},
        {"7.2", MakeMonitorLine("/a").replace(MakeMonitorLine("/a").find("2}}"), 1, "2.5"), "invalid_period"},
        {"7.30", MakeControlLine(R"("url":"/)" + std::string(LONGEST_URL, 'u') + '"'), "url_too_long"},
        {"2", "{\"cmd\":\"MONITOR\"}\r\n", "invalid_payload"},
    };
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer other(fixture, server->GetPort());
    other.Send(std::string(SHAKE) + MakeMonitorLine("/path/other"));
    RawPeer peer(fixture, server->GetPort());
    peer.Send(SHAKE);
    REQUIRE(peer.TryAwait("handshake_ack"));
    std::size_t errors = 0;
    for (const Row& row : rows)
    {
        INFO(row.rule << " " << row.line.substr(0, 200));
        errors += row.code.empty() ? 0U : 1U;
        const std::size_t lines = peer.GetLines().size();
        peer.Send(row.line + std::string(SHAKE)); // acknowledged after the error
        REQUIRE(peer.TryAwaitCount("handshake_ack", static_cast<std::size_t>(&row - rows.data()) + 2));
        const std::vector<std::string> received = peer.GetLines();
        REQUIRE(received.size() == lines + (row.code.empty() ? 1U : 2U));
        CHECK((row.code.empty() || received.at(lines).find(row.code) != std::string::npos));
        CHECK(peer.CountLines("\"error\"") == errors);
    }
    CHECK(fixture.service.controls == 0);
    // Numbers beyond 64 bits are numbers: the period is the longest one, and no sample comes.
    peer.Send(
        "{\"cmd\":\"MONITOR\",\"payload\":{\"method\":\"GET\",\"url\":\"/path/a\",\"period_ms\":18446744073709551617}}\r\n");
    REQUIRE(peer.TryAwait("monitor_ack"));
    const std::size_t before = other.CountLines("\"data\"");
    REQUIRE(other.TryAwaitCount("\"data\"", before + 3));
    CHECK(other.CountLines("\"error\"") == 0);
    CHECK(peer.CountLines("\"data\"") == 0);
    CheckLines(peer);
    CheckLines(other);
}

TEST_CASE("7.39 Half a line and then FIN: no answer, a close, and nothing executed")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    peer.Send(SHAKE);
    REQUIRE(peer.TryAwait("handshake_ack"));
    peer.Send(MakeControlLine().substr(0, 40));
    peer.CloseSending();
    REQUIRE(peer.TryAwaitClose());
    CHECK(peer.GetLines().size() == 1);
    CHECK(fixture.service.controls == 0);
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == 0; }));
}

TEST_CASE("7.26 A reader with a small buffer gets whole lines, every answer, and no backlog; other sessions continue")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer slow(fixture, server->GetPort(), 4096);
    slow.Send(std::string(SHAKE) + MakeMonitorLine("/big"));
    RawPeer other(fixture, server->GetPort());
    other.Send(std::string(SHAKE) + MakeMonitorLine("/path/other"));
    // The buffers of both ends fill up, then samples are replaced.
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetStats().replacedLines >= 20; }));
    for (int count = 0; count < 10; ++count)
    {
        slow.Send("bad\n");
    }
    const std::size_t before = other.CountLines("\"data\"");
    REQUIRE(other.TryAwaitCount("\"data\"", before + 20));
    slow.Send(MakeStopLine("monitor"));
    slow.Read();
    REQUIRE(slow.TryAwait("stop_ack"));
    CHECK(slow.CountLines("invalid_ndjson") == 10);
    CHECK(slow.CountLines("handshake_ack") == 1);
    CHECK(slow.CountLines("monitor_ack") == 1);
    CHECK(slow.GetLines().back().find("stop_ack") != std::string::npos);
    CheckLines(slow);
    CheckLines(other);
}

TEST_CASE("7.24 A stream that is not read ends its session and no other")
{
    TcpFixture fixture;
    OpenStreamServerOptions options = TcpFixture::MakeOptions();
    options.session.streamingTimeout = 300ms;
    options.session.closeTimeout = 100ms;
    const auto server = fixture.StartServer(options);
    RawPeer slow(fixture, server->GetPort(), 4096);
    slow.Send(std::string(SHAKE) + MakeMonitorLine("/big"));
    RawPeer other(fixture, server->GetPort());
    other.Send(std::string(SHAKE) + MakeMonitorLine("/path/other"));
    REQUIRE(other.TryAwait("\"data\""));
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == 1; }));
    const std::size_t before = other.CountLines("\"data\"");
    REQUIRE(other.TryAwaitCount("\"data\"", before + 3));
    CHECK(other.CountLines("\"error\"") == 0);
}

TEST_CASE("7.27 A delayed answer delays neither other sessions nor the server")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    fixture.service.delay = 30s;
    RawPeer slow(fixture, server->GetPort());
    slow.Send(std::string(SHAKE) + MakeMonitorLine("/path/slow", 2) + MakeControlLine(R"("url":"/refused")"));
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.service.gets == 1 && fixture.service.controls == 1; }));
    fixture.service.delay = 20ms;
    RawPeer other(fixture, server->GetPort());
    other.Send(std::string(SHAKE) + MakeMonitorLine("/path/other", 4) + MakeControlLine(R"("url":"/refused")"));
    REQUIRE(other.TryAwaitCount("\"data\"", 5));
    REQUIRE(other.TryAwait("control_err"));
    CheckLines(other);
    for (const std::string& line : other.GetLines())
    {
        const std::size_t at = line.find("svc_dur_ms");
        CHECK((at == std::string::npos || std::stod(line.substr(at + 12)) >= 20.0));
    }
    CHECK(slow.CountLines("control_err") == 0);
    // A MONITOR that replaces one whose answer is still awaited gets its own answers alone.
    fixture.service.delay = 0ms;
    slow.Send(MakeMonitorLine("/path/new", 2));
    REQUIRE(slow.TryAwaitCount("/path/new", 5));
    CHECK(slow.CountLines("/path/slow") == 0);
    CHECK(slow.CountLines("control_err") == 0); // its answer is still to come, and its connection is closed before that
}

TEST_CASE("7.27 With a service slower than the period ticks are skipped and counted, and not sent later")
{
    TcpFixture fixture;
    fixture.service.duration = 11ms;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    peer.Send(std::string(SHAKE) + MakeMonitorLine("/path/slow", 4));
    REQUIRE(peer.TryAwaitCount("\"data\"", 10));
    peer.Send(MakeStopLine("monitor"));
    REQUIRE(peer.TryAwait("stop_ack"));
    CheckLines(peer);
    // At least one more tick falls due within each call.
    CHECK(server->GetStats().skippedTicks >= 9U);
    CHECK(server->GetStats().dataLines <= static_cast<std::uint64_t>(fixture.service.gets));
}

TEST_CASE(
    "7.6 7.7 MONITOR repeated at every period with another url: the stream does not starve, no old line behind an ack")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    peer.Send(SHAKE);
    std::size_t sent = 0;
    constexpr std::size_t SAMPLES = 40;
    while (peer.CountLines("\"data\"") < SAMPLES && sent < 10'000)
    {
        peer.Send(MakeMonitorLine("/path/" + std::to_string(sent)));
        ++sent;
        REQUIRE(peer.TryAwaitCount("monitor_ack", sent));
        fixture.context.restart();
        fixture.context.run_for(1ms);
    }
    REQUIRE(peer.CountLines("\"data\"") >= SAMPLES);
    std::size_t acks = 0;
    for (const std::string& line : peer.GetLines())
    {
        acks += line.find("monitor_ack") == std::string::npos ? 0U : 1U;
        if (line.find("\"data\"") != std::string::npos)
        {
            INFO(line);
            CHECK(line.find("\"/path/" + std::to_string(acks - 1) + '"') != std::string::npos);
        }
    }
    CheckLines(peer);
}

TEST_CASE("7.20 A burst of short commands is no overflow: the server reads the rest after executing them")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    const std::string control = MakeControlLine(R"("url":"/good","body":{"x":")" + std::string(1000, 'p') + R"("})");
    const std::size_t controls = 2U * LONGEST_LINE / control.size();
    std::string burst(SHAKE);
    for (std::size_t count = 0; count < controls; ++count)
    {
        burst += control;
    }
    burst += MakeStopLine("session");
    std::string_view rest = burst;
    while (!rest.empty())
    {
        constexpr std::size_t PIECE = 32U * 1024U;
        peer.Send(rest.substr(0, PIECE));
        rest.remove_prefix(std::min(PIECE, rest.size()));
        fixture.context.restart();
        fixture.context.poll();
    }
    REQUIRE(peer.TryAwait("stop_ack"));
    CHECK(static_cast<std::size_t>(fixture.service.controls) == controls);
    CHECK(peer.CountLines("\"error\"") == 0);
}

TEST_CASE("7.21 STOP session: the ack is the last line, then the server closes its side")
{
    TcpFixture fixture;
    const auto server = fixture.StartServer();
    RawPeer peer(fixture, server->GetPort());
    peer.Send(std::string(SHAKE) + MakeMonitorLine("/path/a"));
    REQUIRE(peer.TryAwaitCount("\"data\"", 3));
    peer.Send(MakeStopLine("session"));
    REQUIRE(peer.TryAwaitClose());
    CHECK(peer.GetLines().back() == R"({"type":"stop_ack","target":"session"})");
    REQUIRE(fixture.TryRunUntil([&]() { return server->GetSessionCount() == 0; }));
}
