#include "Catch.hpp"
#include "ClientFixture.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;    // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

TEST_CASE("3 The client sends HANDSHAKE first, then the configured MONITOR")
{
    ClientFixture client;
    client.SetMonitor(1ms);
    client.Start();
    REQUIRE(client.connects == 1);
    client.session.OnConnected(client.GetNow(), client.actions);
    client.Execute();
    REQUIRE(client.lines == std::vector<std::string>{R"({"cmd":"HANDSHAKE","payload":{"major":1}})"});
    client.Receive(HANDSHAKE_ACK);
    REQUIRE(client.Take<ClientReady>().at(0).version == "1.0.0");
    // 7.1: never outside 2 to 30000
    REQUIRE(
        client.lines.at(1) == R"({"cmd":"MONITOR","payload":{"method":"GET","url":"/project/rgen","period_ms":2}})");
    client.Receive(MakeData(2));
    client.Receive(MONITOR_ACK);
    REQUIRE(client.Take<ClientMonitorStarted>().size() == 1);
    REQUIRE(client.Take<ClientData>().at(0).line.result->GetText() == R"({"a":1})");
}

TEST_CASE("8 The MONITOR is sent again after every reconnect, and the delays grow until a handshake")
{
    ClientFixture client;
    client.SetMonitor(20ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    client.session.OnPeerClosed(client.GetNow(), client.actions);
    client.Execute();
    const auto lost = client.Take<ClientLost>();
    REQUIRE(lost.at(0).reason == EClientLossReason::PeerClosed);
    client.Pass(lost.at(0).retryIn);
    REQUIRE(client.connects == 2);
    client.session.OnConnectFailed("refused", client.GetNow(), client.actions);
    client.Execute();
    const auto failed = client.Take<ClientLost>();
    REQUIRE(failed.at(0).reason == EClientLossReason::ConnectFailed);
    client.Pass(failed.at(0).retryIn);
    REQUIRE(client.connects == 3);
    client.ConnectAndShake();
    REQUIRE(client.CountLines("MONITOR") == 1);
    REQUIRE(client.session.GetStats().connects == 2);
}

TEST_CASE("3 A CONTROL without an error within the window has succeeded; the next one waits for that")
{
    ClientFixture client;
    MakeReady(client);
    const std::uint64_t first = client.Control("/a");
    const std::uint64_t second = client.Control("/b");
    REQUIRE(client.lines.size() == 1);
    client.Pass(499ms);
    REQUIRE(client.Take<ClientControlSettled>().empty());
    client.Pass(1ms);
    const auto settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.at(0).token == first);
    REQUIRE(settled.at(0).outcome == EControlOutcome::Accepted);
    REQUIRE(client.CountLines("\"/b\"") == 1);
    client.Receive("{\"type\":\"control_err\",\"status\":403,\"body\":{\"err_code\":-38500}}\n");
    const auto refused = client.Take<ClientControlSettled>();
    REQUIRE(refused.at(0).token == second);
    REQUIRE(refused.at(0).outcome == EControlOutcome::Refused);
    REQUIRE(refused.at(0).status == 403);
    REQUIRE(refused.at(0).body->GetText() == R"({"err_code":-38500})");
}

TEST_CASE("7.15 7.16 An error line about the request also rejects the CONTROL in flight")
{
    for (const char* code : {"invalid_method", "method_not_allowed", "invalid_url", "control_busy", "invalid_value"})
    {
        ClientFixture client;
        MakeReady(client);
        static_cast<void>(client.Control("/a"));
        client.Receive(std::string(R"({"error":")") + code + "\",\"message\":\"m\"}\n");
        REQUIRE(client.Take<ClientControlSettled>().at(0).outcome == EControlOutcome::Refused);
    }
}

TEST_CASE("3 The window begins when the CONTROL is sent")
{
    ClientFixture client;
    MakeReady(client);
    client.bSocketTakes = false;
    static_cast<void>(client.Control("/a"));
    client.Pass(2s);
    REQUIRE(client.Take<ClientControlSettled>().empty());
    client.session.OnSendCompleted(client.GetNow(), client.actions);
    client.Execute();
    client.Pass(500ms);
    REQUIRE(client.Take<ClientControlSettled>().at(0).outcome == EControlOutcome::Accepted);
}

TEST_CASE("3 After a lost connection the CONTROL in flight is unknown, and the waiting ones are unsent")
{
    ClientFixture client;
    MakeReady(client);
    static_cast<void>(client.Control("/a"));
    static_cast<void>(client.Control("/b"));
    client.session.OnSocketError("reset", client.GetNow(), client.actions);
    client.Execute();
    const auto settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.at(0).outcome == EControlOutcome::Unknown);
    REQUIRE(settled.at(1).outcome == EControlOutcome::NotSent);
    static_cast<void>(client.Control("/c"));
    REQUIRE(client.Take<ClientControlSettled>().at(0).outcome == EControlOutcome::NotSent);
    client.Pass(5s);
    client.ConnectAndShake();
    REQUIRE(client.CountLines("CONTROL") == 1);
}

TEST_CASE("3 Streamed CONTROLs do not wait; their rejections are reported as faults")
{
    ClientFixture client;
    MakeReady(client);
    static_cast<void>(client.Control("/a", EControlTracking::Streamed));
    static_cast<void>(client.Control("/b", EControlTracking::Streamed));
    REQUIRE(client.CountLines("CONTROL") == 2);
    client.Receive("{\"type\":\"control_err\",\"status\":403}\n");
    REQUIRE(client.Take<ClientControlFault>().at(0).status == 403);
    client.session.OnPeerClosed(client.GetNow(), client.actions);
    client.Execute();
    static_cast<void>(client.Control("/c", EControlTracking::Streamed));
    const auto unsent = client.Take<ClientControlFault>();
    REQUIRE(unsent.size() == 1);
    REQUIRE(unsent.at(0).status == 0);
    REQUIRE(unsent.at(0).detail == "not sent: there is no session with the controller");
    REQUIRE(client.Take<ClientControlSettled>().empty());
}

TEST_CASE("3 STOP control is sent at once: the CONTROL in flight is unknown, the waiting one unsent")
{
    ClientFixture client;
    MakeReady(client);
    static_cast<void>(client.Control("/a"));
    static_cast<void>(client.Control("/b"));
    client.session.StopControl(client.GetNow(), client.actions);
    client.Execute();
    REQUIRE(client.lines.back() == R"({"cmd":"STOP","payload":{"target":"control"}})");
    const auto settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.at(0).outcome == EControlOutcome::Unknown);
    REQUIRE(settled.at(1).outcome == EControlOutcome::NotSent);
    // 7.19: both mean done
    client.Receive("{\"error\":\"nothing_to_stop\",\"message\":\"\"}\n");
    REQUIRE(client.Take<ClientStopped>().at(0).target == EStopTarget::Control);
}

TEST_CASE("7.7 monitor_already_active means stop and retry")
{
    ClientFixture client;
    MakeReady(client);
    client.SetMonitor(20ms);
    client.Receive("{\"error\":\"monitor_already_active\",\"message\":\"\"}\n");
    REQUIRE(client.lines.back() == R"({"cmd":"STOP","payload":{"target":"monitor"}})");
    client.Receive("{\"type\":\"stop_ack\",\"target\":\"monitor\"}\n");
    REQUIRE(client.CountLines("\"MONITOR\"") == 2);
    SECTION("once: a MONITOR that another connection holds is refused, and the session continues")
    {
        client.Receive("{\"error\":\"monitor_already_active\",\"message\":\"\"}\n");
        REQUIRE(client.Take<ClientMonitorRefused>().size() == 1);
        REQUIRE(client.CountLines("\"MONITOR\"") == 2);
        client.SetMonitor(20ms);
        client.Receive("{\"error\":\"monitor_already_active\",\"message\":\"\"}\n");
        client.Receive("{\"error\":\"nothing_to_stop\",\"message\":\"\"}\n");
        client.Receive("{\"error\":\"monitor_already_active\",\"message\":\"\"}\n");
        REQUIRE(client.Take<ClientMonitorRefused>().size() == 1);
        REQUIRE(client.CountLines("\"MONITOR\"") == 4);
    }
    SECTION("and it is streamed")
    {
        client.Receive(MONITOR_ACK);
        REQUIRE(client.Take<ClientMonitorStarted>().size() == 1);
        client.SetMonitor(30ms);
        client.Receive("{\"error\":\"monitor_already_active\",\"message\":\"\"}\n");
        REQUIRE(client.lines.back() == R"({"cmd":"STOP","payload":{"target":"monitor"}})");
    }
}

TEST_CASE("3 A rejected MONITOR is reported and not repeated until it is set again")
{
    ClientFixture client;
    MakeReady(client);
    client.SetMonitor(20ms);
    client.Receive("{\"error\":\"invalid_url\",\"message\":\"m\"}\n");
    const ClientMonitorRefused refused = client.Take<ClientMonitorRefused>().at(0);
    REQUIRE(refused.error.code == EOpenStreamErrorCode::InvalidURL);
    REQUIRE(refused.url == "/project/rgen");
    client.Pass(10s);
    REQUIRE(client.CountLines("\"MONITOR\"") == 1);
    client.SetMonitor(20ms);
    REQUIRE(client.CountLines("\"MONITOR\"") == 2);
}

TEST_CASE("3 The acknowledgement of a MONITOR has the number of its call")
{
    ClientFixture client;
    MakeReady(client);
    client.SetMonitor(20ms);
    client.SetMonitor(30ms);
    client.SetMonitor(40ms);
    REQUIRE(client.CountLines("\"MONITOR\"") == 1);
    client.Receive(MONITOR_ACK);
    REQUIRE(client.Take<ClientMonitorStarted>().at(0).requestNumber == 1);
    REQUIRE(client.CountLines("\"MONITOR\"") == 2);
    client.Receive(MONITOR_ACK);
    REQUIRE(client.Take<ClientMonitorStarted>().at(0).requestNumber == 3);
    client.session.OnPeerClosed(client.GetNow(), client.actions);
    client.Execute();
    client.Pass(client.Take<ClientLost>().at(0).retryIn);
    client.ConnectAndShake();
    client.Receive(MONITOR_ACK);
    REQUIRE(client.Take<ClientMonitorStarted>().at(0).requestNumber == 3);
}

TEST_CASE("7.22 Data after the stream was stopped is tolerated and not reported")
{
    ClientFixture client;
    MakeReady(client);
    client.SetMonitor(20ms);
    client.Receive(MONITOR_ACK);
    client.session.SetMonitor(std::nullopt, client.GetNow(), client.actions);
    client.Execute();
    REQUIRE(client.CountLines("\"monitor\"") == 1);
    client.Receive(MakeData(20));
    client.Receive("{\"type\":\"stop_ack\",\"target\":\"monitor\"}\n");
    client.Receive(MakeData(40));
    REQUIRE(client.Take<ClientData>().empty());
    client.Pass(20s);
    REQUIRE(client.Take<ClientLost>().empty());
}

TEST_CASE("9 Overdue data is reported as stale once, and at the limit the client reconnects")
{
    ClientFixture client;
    MakeReady(client);
    client.SetMonitor(20ms);
    client.Receive(MONITOR_ACK);
    for (int count = 1; count <= 100; ++count)
    {
        client.Pass(20ms);
        client.Receive(MakeData(20 * count));
    }
    REQUIRE(client.Take<ClientMonitorStale>().empty());
    client.Pass(520ms);
    REQUIRE(client.Take<ClientMonitorStale>().at(0).age == 520ms);
    client.Receive(MakeData(2'520));
    client.Pass(519ms);
    REQUIRE(client.Take<ClientMonitorStale>().empty());
    client.Pass(1ms);
    REQUIRE(client.Take<ClientMonitorStale>().size() == 1);
    client.Pass(2'499ms);
    REQUIRE(client.Take<ClientLost>().empty());
    client.Pass(1ms);
    REQUIRE(client.Take<ClientLost>().at(0).reason == EClientLossReason::DataSilent);
    REQUIRE(client.closes == 1);
}

TEST_CASE("11 What ts skipped is counted as missing")
{
    ClientFixture client;
    MakeReady(client);
    client.SetMonitor(20ms);
    client.Receive(MONITOR_ACK);
    for (const int ts : {20, 40, 61, 100, 120, 200})
    {
        client.Receive(MakeData(ts));
    }
    REQUIRE(client.session.GetStats().dataLines == 6);
    REQUIRE(client.session.GetStats().missingLines == 4);
}

TEST_CASE("4 Only the codes that end a session end the connection")
{
    for (const char* code : {"session_timeout", "stop_failed", "handshake_rejected", "rx_buf_overflow"})
    {
        ClientFixture client;
        MakeReady(client);
        client.Receive(std::string(R"({"error":")") + code + "\",\"message\":\"m\"}\n" + std::string(HANDSHAKE_ACK));
        REQUIRE(client.Take<ClientLost>().at(0).reason == EClientLossReason::SessionEnded);
        REQUIRE(client.session.GetState() == EClientState::Waiting);
    }
    for (const char* code : {"monitor_internal_error", "busy_session_active", "invalid_ndjson", "new_code"})
    {
        ClientFixture client;
        MakeReady(client);
        client.Receive(std::string(R"({"error":")") + code + "\",\"message\":\"m\"}\n");
        REQUIRE(client.session.GetState() == EClientState::Ready);
    }
}

TEST_CASE("3 A rejected or unanswered HANDSHAKE is sent again on a new connection")
{
    ClientFixture client;
    client.Start();
    client.session.OnConnected(client.GetNow(), client.actions);
    client.Execute();
    SECTION("refused")
    {
        client.Receive("{\"error\":\"version_mismatch\",\"message\":\"m\"}\n");
        REQUIRE(client.Take<ClientLost>().at(0).reason == EClientLossReason::HandshakeFailed);
    }
    SECTION("unanswered")
    {
        client.Pass(2s);
        REQUIRE(client.Take<ClientLost>().at(0).reason == EClientLossReason::AnswerTimeout);
    }
    client.Pass(1s);
    REQUIRE(client.connects == 2);
}

TEST_CASE("1 Half lines, CRLF and garbage from the server have no other effect")
{
    ClientFixture client;
    MakeReady(client);
    client.SetMonitor(20ms);
    client.Receive(R"({"type":"moni)");
    client.Receive("tor_ack\"}\r\n\xFFgarbage\n\n{\"type\":\"new\"}\n");
    REQUIRE(client.Take<ClientMonitorStarted>().size() == 1);
    REQUIRE(client.Take<ClientBadLine>().size() == 2);
    REQUIRE(client.session.GetStats().badLines == 2);
    REQUIRE(client.session.GetState() == EClientState::Ready);
}

TEST_CASE("7.20 A line beyond the limit ends the connection")
{
    ClientSessionOptions options;
    options.longestLine = 200;
    ClientFixture client(options);
    MakeReady(client);
    client.Receive(std::string(201, 'x'));
    REQUIRE(client.Take<ClientLost>().at(0).reason == EClientLossReason::LineTooLong);
}

TEST_CASE("7.21 Stop sends STOP session and waits for its ack; without an answer it ends too")
{
    ClientSessionOptions options;
    options.longestLine = 1'000;
    ClientFixture client(options);
    MakeReady(client);
    static_cast<void>(client.Control("/a"));
    client.session.Stop(client.GetNow(), client.actions);
    client.Execute();
    REQUIRE(client.lines.back() == R"({"cmd":"STOP","payload":{"target":"session"}})");
    REQUIRE(client.Take<ClientControlSettled>().at(0).outcome == EControlOutcome::Unknown);
    SECTION("acknowledged")
    {
        client.Receive("{\"type\":\"stop_ack\",\"target\":\"session\"}\n");
    }
    SECTION("closed")
    {
        client.session.OnPeerClosed(client.GetNow(), client.actions);
        client.Execute();
    }
    SECTION("silent")
    {
        client.Pass(2s);
    }
    SECTION("an overlong line")
    {
        client.Receive(std::string(options.longestLine + 1, 'x'));
    }
    REQUIRE(client.Take<ClientEnded>().size() == 1);
    REQUIRE(client.session.GetState() == EClientState::Stopped);
    client.Pass(60s);
    REQUIRE(client.connects == 1);
}

TEST_CASE("8 A connect has a time limit and is retried indefinitely")
{
    ClientFixture client;
    client.Start();
    client.Pass(3s);
    REQUIRE(client.Take<ClientLost>().at(0).reason == EClientLossReason::ConnectTimeout);
    client.Pass(600s);
    REQUIRE(client.connects > 30);
}

TEST_CASE("3 Answers to a command that has not left do not make the session send more")
{
    ClientFixture client;
    client.SetMonitor(2ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    client.bSocketTakes = false;
    client.Control("/a", EControlTracking::Streamed);
    client.SetMonitor(4ms);
    client.lines.clear();
    for (int count = 0; count < 100; ++count)
    {
        client.Receive("{\"error\":\"monitor_already_active\"}\n{\"type\":\"stop_ack\",\"target\":\"monitor\"}\n");
    }
    client.CompleteSend();
    REQUIRE(client.lines.size() == 1);
}

TEST_CASE("3 A sample of an earlier MONITOR is not the latest one of the present MONITOR")
{
    ClientFixture client;
    client.SetMonitor(2ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    client.Receive(MakeData(2));
    REQUIRE(client.session.GetLatestOrNull() != nullptr);
    client.SetMonitor(4ms);
    client.Receive(MakeData(4));
    REQUIRE(client.session.GetLatestOrNull() == nullptr);
    client.Receive(MONITOR_ACK);
    client.Receive(MakeData(6));
    REQUIRE(client.session.GetLatestOrNull() != nullptr);
}

TEST_CASE("8 Data is lost in time where it counts as stale only later")
{
    ClientSessionOptions options;
    options.staleAfter = 500ms;
    options.lostAfter = 200ms;
    ClientFixture client(options);
    client.SetMonitor(2ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    client.Pass(201ms);
    REQUIRE(client.Take<ClientLost>().empty());
    client.Pass(1ms);
    REQUIRE(client.Take<ClientLost>().size() == 1);
}

TEST_CASE("3 A stop_ack before the handshake is not reported")
{
    ClientFixture client;
    client.Start();
    client.session.OnConnected(client.GetNow(), client.actions);
    client.Execute();
    client.Receive("{\"type\":\"stop_ack\",\"target\":\"control\"}\n");
    REQUIRE(client.Take<ClientStopped>().empty());
}
