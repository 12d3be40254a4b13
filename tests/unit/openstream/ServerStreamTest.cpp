#include "Catch.hpp"
#include "ServerFixture.hpp"
#include <acs/openstream/OpenStreamCodec.hpp>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;    // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Core::JsonText;

namespace
{

/// The ts of every data line so far.
std::vector<int> GetTimes(const ServerFixture& server)
{
    OpenStreamCodec codec;
    std::vector<int> times;
    for (const std::string& text : server.lines)
    {
        const auto line = codec.DecodeLine(text);
        REQUIRE(line.has_value());
        if (const auto* data = std::get_if<DataLine>(&*line))
        {
            times.push_back(static_cast<int>(data->ts));
        }
    }
    return times;
}

ServerFixture& Stream(ServerFixture& server, int periodMs)
{
    server.Receive(HANDSHAKE);
    server.Receive(MakeMonitorLine(periodMs));
    return server;
}

} // namespace

TEST_CASE("7.5 7.6 The first sample comes after one period, ts counts from the beginning of the MONITOR")
{
    ServerFixture server;
    server.Pass(123ms);
    Stream(server, 10).Pass(35ms);
    REQUIRE(GetTimes(server) == std::vector<int>{10, 20, 30});
    REQUIRE(server.calls.at(0).method == EApiMethod::Get);
    REQUIRE_FALSE(server.calls.at(0).body.has_value());
}

TEST_CASE("7.7 A second MONITOR replaces the first: no line of the old one after the new ack")
{
    ServerFixture server;
    Stream(server, 10);
    server.bSocketTakes = false;
    server.Pass(25ms);
    server.answer.body = JsonText::FromInteger(2);
    server.Receive(MakeMonitorLine(10, "/project/rgen"));
    server.Drain();
    server.Pass(20ms);
    bool bAcked = false;
    for (const std::string& line : server.lines)
    {
        bAcked = bAcked || (line.find("monitor_ack") != std::string::npos && &line != &server.lines.at(1));
        REQUIRE((line.find("\"result\":{}") == std::string::npos || !bAcked));
    }
    REQUIRE(bAcked);
    REQUIRE(server.calls.back().path == "/project/rgen");
    REQUIRE(server.Count("\"result\":2") == 2);
}

TEST_CASE("7.6 A client that repeats MONITOR does not starve its stream")
{
    ServerFixture server;
    Stream(server, 4);
    for (int count = 0; count < 20; ++count)
    {
        server.Pass(2ms);
        server.Receive(MakeMonitorLine(4, "/project/robot/po_cur"));
    }
    REQUIRE(server.Count("\"data\"") == 10);
}

TEST_CASE("7.9 Only a number or a string as id is repeated in the data lines")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(
        "{\"cmd\":\"MONITOR\",\"payload\":{\"url\":\"/a\",\"method\":\"GET\",\"period_ms\":2,\"id\":\"m1\"}}\n");
    server.Pass(2ms);
    REQUIRE(server.Count("\"id\":\"m1\"") == 1);
    REQUIRE(server.lines.back().find("\"id\":\"m1\"") != std::string::npos);
    server.Receive(
        "{\"cmd\":\"MONITOR\",\"payload\":{\"url\":\"/a\",\"method\":\"GET\",\"period_ms\":2,\"id\":{\"a\":1}}}\n");
    server.Pass(2ms);
    REQUIRE(server.lines.back().find("\"id\"") == std::string::npos);
}

TEST_CASE("7.22 No data after the stop_ack, and every line before it")
{
    ServerFixture server;
    Stream(server, 2);
    server.bSocketTakes = false;
    server.Pass(6ms);
    server.Receive(MakeStopLine("monitor"));
    server.Drain();
    server.Pass(100ms);
    REQUIRE(server.lines.back() == R"({"type":"stop_ack","target":"monitor"})");
    REQUIRE(server.session.GetState() == EServerState::Ready);
}

TEST_CASE("7.24 A stream that is not read ends after 5 s; a silent client that reads stays connected")
{
    ServerFixture server;
    Stream(server, 2).Pass(600s);
    REQUIRE_FALSE(server.closed.has_value());
    server.bSocketTakes = false;
    server.Pass(5'001ms);
    REQUIRE(server.session.GetState() == EServerState::Streaming);
    server.Pass(2ms);
    REQUIRE(server.session.GetState() == EServerState::Closing);
    server.Drain();
    REQUIRE(server.lines.back().find("session_timeout") != std::string::npos);
    server.Pass(1'000ms);
    REQUIRE(server.closed == EServerCloseReason::StreamingTimeout);
}

TEST_CASE("7.24 Repeating the MONITOR does not count as reading; the longest period is no interruption")
{
    ServerFixture server;
    Stream(server, 30'000).Pass(100s);
    REQUIRE(server.Count("\"data\"") == 3);
    server.bSocketTakes = false;
    for (int count = 0; count < 60; ++count)
    {
        server.Receive(MakeMonitorLine(2));
        server.Pass(100ms);
        REQUIRE((count >= 49 || server.session.GetState() == EServerState::Streaming)); // for 5 s
    }
    REQUIRE(server.session.GetState() >= EServerState::Closing);
}

TEST_CASE("7.24 A shorter period does not make the silence before it an interruption")
{
    ServerFixture server;
    Stream(server, 30'000).Pass(20s);
    server.Receive(MakeMonitorLine(20));
    server.Pass(100ms);
    REQUIRE(server.session.GetState() == EServerState::Streaming);
    REQUIRE(server.Count("session_timeout") == 0);
    REQUIRE(server.Count("\"data\"") == 5);
    server.bSocketTakes = false;
    server.Pass(5'100ms);
    REQUIRE(server.session.GetState() == EServerState::Closing);
}

TEST_CASE("7.26 A slow reader gets the newest sample complete, and every ack")
{
    ServerFixture server;
    Stream(server, 2);
    server.bSocketTakes = false;
    server.Pass(100ms);
    server.Receive(MakeMonitorLine(2));
    server.Receive("x\n");
    server.Pass(100ms);
    server.Drain();
    REQUIRE(GetTimes(server) == std::vector<int>{2, 100, 200});
    REQUIRE(server.Count("monitor_ack") == 2);
    REQUIRE(server.Count("invalid_ndjson") == 1);
    const ServerSessionStats& stats = server.session.GetStats();
    REQUIRE(stats.dataLines + stats.replacedLines + stats.skippedTicks == 100);
    REQUIRE(stats.skippedTicks == 0);
}

TEST_CASE("7.27 After an overrun the phase is kept, and skipped ticks are counted and not sent later")
{
    ServerFixture server;
    Stream(server, 10).Pass(20ms);
    server.Stall(37ms);
    server.Pass(13ms);
    REQUIRE(GetTimes(server) == std::vector<int>{10, 20, 57, 60, 70});
    REQUIRE(server.session.GetStats().skippedTicks == 2);
}

TEST_CASE("7.27 A service slower than the period skips ticks, one call at a time")
{
    ServerFixture server;
    server.bServiceAnswers = false;
    Stream(server, 10).Pass(35ms);
    REQUIRE(server.calls.size() == 1);
    REQUIRE(server.session.GetStats().skippedTicks == 2);
    server.Answer(server.unanswered.at(0));
    server.Pass(5ms);
    REQUIRE(server.calls.size() == 2);
    REQUIRE(server.Count("\"svc_dur_ms\":25") == 1);
}

TEST_CASE("9 Without a sample of the service no line is sent; skipped ticks are counted, phase and ts are kept")
{
    ServerFixture server;
    Stream(server, 10).Pass(20ms);
    server.answer.bNoSample = true;
    server.Pass(30ms);
    server.answer.bNoSample = false;
    server.Pass(20ms);
    REQUIRE(GetTimes(server) == std::vector<int>{10, 20, 60, 70});
    REQUIRE(server.session.GetStats().skippedTicks == 3);
    REQUIRE(server.calls.size() == 7);
    REQUIRE(server.Count("\"error\"") == 0);
}

TEST_CASE("7.24 A service without a sample for longer than the limit of interrupted streaming ends the session")
{
    ServerFixture server;
    server.answer.bNoSample = true;
    Stream(server, 10).Pass(6s);
    REQUIRE(server.Count("\"data\"") == 0);
    REQUIRE(server.Count("session_timeout") == 1);
}

TEST_CASE("7.17 A CONTROL is answered without a sample too")
{
    ServerFixture server;
    server.answer.bNoSample = true;
    server.answer.status = 403;
    Stream(server, 10);
    server.Receive(R"({"cmd":"CONTROL","payload":{"method":"POST","url":"/x"}})"
                   "\n");
    REQUIRE(server.Count("control_err") == 1);
}

TEST_CASE("7.28 An unknown url gives data with its status, not an error for each tick")
{
    ServerFixture server;
    server.answer = ApiResponse{404, {}};
    Stream(server, 2).Pass(4ms);
    REQUIRE(server.Count("monitor_ack") == 1);
    REQUIRE(server.Count("\"status\":404") == 2);
    REQUIRE(server.Count("\"error\"") == 0);
}

TEST_CASE("4 A service that fails gives one monitor_internal_error for each episode, and the stream continues")
{
    ServerFixture server;
    server.answer = ApiResponse{500, {}};
    Stream(server, 2).Pass(10ms);
    REQUIRE(server.Count("monitor_internal_error") == 1);
    server.answer = ApiResponse{200, JsonText::FromInteger(1)};
    server.Pass(2ms);
    server.answer = ApiResponse{500, {}};
    server.Pass(10ms);
    REQUIRE(server.Count("monitor_internal_error") == 2);
    REQUIRE(server.Count("\"result\":1") == 1);
}

TEST_CASE("4 7.24 A service that hangs gives an internal error at its time limit, and a timeout later")
{
    ServerFixture server;
    server.bServiceAnswers = false;
    Stream(server, 2).Pass(1'100ms);
    REQUIRE(server.Count("monitor_internal_error") == 1);
    server.Pass(4s);
    REQUIRE(server.Count("monitor_internal_error") == 1);
    REQUIRE(server.Count("session_timeout") == 1);
}

TEST_CASE("7.7 The answer to a replaced MONITOR is not sent")
{
    ServerFixture server;
    server.bServiceAnswers = false;
    Stream(server, 2).Pass(2ms);
    server.Receive(MakeMonitorLine(2, "/project/rgen"));
    server.Answer(server.unanswered.at(0));
    REQUIRE(server.Count("\"data\"") == 0);
}

TEST_CASE("8 In a flood of commands a due tick is handled after 64 lines")
{
    ServerFixture server;
    Stream(server, 2);
    std::string flood;
    for (int count = 0; count < 100; ++count)
    {
        flood += CONTROL;
    }
    server.Receive(flood);
    REQUIRE(server.calls.size() == 64);
    REQUIRE(server.bReadingPaused);
    REQUIRE(server.bContinueWanted);
    server.Pass(2ms);
    REQUIRE(server.Count("\"data\"") == 1);
    server.Continue();
    REQUIRE(server.calls.size() == 101);
    REQUIRE_FALSE(server.bReadingPaused);
}
