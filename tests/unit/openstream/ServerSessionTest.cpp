#include "Catch.hpp"
#include "ServerFixture.hpp"

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;    // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Core::JsonText;

TEST_CASE("3 HANDSHAKE with the same major version is acknowledged")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    REQUIRE(server.TakeLines() == std::vector<std::string>{R"({"type":"handshake_ack","ok":true,"version":"1.0.0"})"});
    REQUIRE(server.session.GetState() == EServerState::Ready);
}

TEST_CASE("4 Another major version is a mismatch and does not change the session")
{
    ServerFixture server;
    server.Receive("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":2}}\n");
    REQUIRE(server.Count("version_mismatch") == 1);
    REQUIRE(server.session.GetState() == EServerState::Connected);
    server.Receive(HANDSHAKE);
    REQUIRE(server.session.GetState() == EServerState::Ready);
}

TEST_CASE("7.10 HANDSHAKE twice while idle is acknowledged again")
{
    ServerFixture server;
    server.Receive(std::string(HANDSHAKE) + std::string(HANDSHAKE));
    REQUIRE(server.Count("handshake_ack") == 2);
}

TEST_CASE("7.11 HANDSHAKE is busy while a MONITOR is active or a CONTROL in flight, and disturbs neither")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeMonitorLine(2));
    server.Receive(HANDSHAKE);
    REQUIRE(server.Count("busy_session_active") == 1);
    server.Pass(10ms);
    REQUIRE(server.Count("\"data\"") == 5);
    server.Receive(MakeStopLine("monitor"));

    server.bServiceAnswers = false;
    server.Receive(CONTROL);
    server.Receive(HANDSHAKE);
    REQUIRE(server.Count("busy_session_active") == 2);
    server.Answer(server.unanswered.back());
    server.Receive(HANDSHAKE);
    REQUIRE(server.Count("handshake_ack") == 2);
}

TEST_CASE("7.13 Before the HANDSHAKE nothing is executed, and the connection stays open")
{
    ServerFixture server;
    server.Receive(MakeMonitorLine(2));
    server.Receive(CONTROL);
    server.Receive(MakeStopLine("session"));
    server.Pass(10ms);
    REQUIRE(server.Count("handshake_required") == 3);
    REQUIRE(server.lines.size() == 3);
    REQUIRE(server.calls.empty());
    REQUIRE_FALSE(server.closed.has_value());
}

TEST_CASE("7.14 The command is checked first, then the HANDSHAKE, then the fields")
{
    ServerFixture server;
    server.Receive("{\"cmd\":\"MONITOR\",\"payload\":7}\n");
    REQUIRE(server.Count("handshake_required") == 1);
    server.Receive("{\"cmd\":\"DANCE\"}\n");
    REQUIRE(server.Count("invalid_cmd") == 1);
    server.Receive(HANDSHAKE);
    server.Receive("{\"cmd\":\"MONITOR\",\"payload\":7}\n");
    REQUIRE(server.Count("invalid_payload") == 1);
}

TEST_CASE("7.15 A CONTROL that the service rejects is a control_err, an invalid one an error")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    static_cast<void>(server.TakeLines());
    server.answer = ApiResponse{403, JsonText::FromTrusted(R"({"err_code":-38500})")};
    server.Receive(CONTROL);
    REQUIRE(
        server.TakeLines()
        == std::vector<std::string>{R"({"type":"control_err","status":403,"body":{"err_code":-38500}})"});
    server.Receive("{\"cmd\":\"CONTROL\",\"payload\":{\"method\":\"GET\",\"url\":\"/a\"}}\n");
    REQUIRE(server.Count("\"error\":\"invalid_method\"") == 1);
    REQUIRE(server.calls.size() == 1);
}

TEST_CASE("7.17 7.18 Every 2xx is silent; a rejection without a body has no body")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    static_cast<void>(server.TakeLines());
    server.answer = ApiResponse{204, {}};
    server.Receive(CONTROL);
    REQUIRE(server.lines.empty());
    server.answer = ApiResponse{404, {}};
    server.Receive(CONTROL);
    REQUIRE(server.TakeLines() == std::vector<std::string>{R"({"type":"control_err","status":404})"});
}

TEST_CASE("3 A CONTROL without a body is an empty object for the service; args are added to the query")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive("{\"cmd\":\"CONTROL\",\"payload\":{\"method\":\"PUT\",\"url\":\"/a?x=1\",\"args\":{\"x\":2}}}\n");
    REQUIRE(server.calls.size() == 1);
    REQUIRE(server.calls[0].method == EApiMethod::Put);
    REQUIRE(server.calls[0].path == "/a");
    REQUIRE(*server.calls[0].GetParameterOrNull("x") == "2");
    REQUIRE(server.calls[0].body->GetText() == "{}");
}

TEST_CASE("8 CONTROLs reach the service one after another, in their order")
{
    ServerFixture server;
    server.bServiceAnswers = false;
    server.Receive(HANDSHAKE);
    for (const char* url : {"/a", "/b", "/c"})
    {
        server.Receive(std::string(R"({"cmd":"CONTROL","payload":{"method":"POST","url":")") + url + "\"}}\n");
    }
    REQUIRE(server.calls.size() == 1);
    server.Answer(server.unanswered.at(0));
    server.Answer(server.unanswered.at(1));
    REQUIRE(server.calls.size() == 3);
    REQUIRE(server.calls[0].path == "/a");
    REQUIRE(server.calls[2].path == "/c");
}

TEST_CASE("8 A full queue of CONTROLs stops reading; control_busy is sent only when the service blocks")
{
    ServerSessionOptions options;
    options.maximumControls = 2;
    ServerFixture server(options);
    server.bServiceAnswers = false;
    server.Receive(HANDSHAKE);
    server.Receive(std::string(CONTROL) + std::string(CONTROL) + std::string(CONTROL));
    REQUIRE(server.bReadingPaused);
    server.Answer(server.unanswered.at(0));
    server.Answer(server.unanswered.at(1));
    REQUIRE(server.calls.size() == 3);
    REQUIRE_FALSE(server.bReadingPaused);
    server.Pass(2'000ms);
    REQUIRE(server.Count("control_busy") == 0);
    server.Receive(std::string(CONTROL) + std::string(CONTROL));
    server.Pass(999ms);
    REQUIRE(server.Count("control_busy") == 0);
    server.Pass(1ms);
    REQUIRE(server.Count("control_busy") == 1);
    server.Answer(server.unanswered.at(2));
    server.Receive(CONTROL);
    REQUIRE(server.Count("control_busy") == 1);
}

TEST_CASE("8 Waiting CONTROLs are limited in bytes and in number")
{
    ServerSessionOptions options;
    options.maximumControlBytes = 3'000;
    ServerFixture server(options);
    server.bServiceAnswers = false;
    server.Receive(HANDSHAKE);
    const std::string line = R"({"cmd":"CONTROL","payload":{"method":"POST","url":"/a","body":{"text":")"
        + std::string(1'000, 'x') + "\"}}}\n";
    server.Receive(line + line);
    REQUIRE_FALSE(server.bReadingPaused);
    server.Receive(line + line);
    REQUIRE(server.bReadingPaused);
    server.Answer(server.unanswered.at(0));
    REQUIRE(server.calls.size() == 2);
    REQUIRE(server.bReadingPaused); // the fourth has come in
    server.Answer(server.unanswered.at(1));
    REQUIRE_FALSE(server.bReadingPaused);
    server.Receive(line + line);
    server.Pass(1'000ms);
    REQUIRE(server.Count("control_busy") == 1);
    server.Receive(MakeStopLine("control"));
    server.Receive(line);
    REQUIRE(server.Count("control_busy") == 1);
    REQUIRE_FALSE(server.bReadingPaused);
}

TEST_CASE("8 STOP control frees the queue: when it fills again it waits before it rejects")
{
    ServerSessionOptions options;
    options.maximumControls = 2;
    ServerFixture server(options);
    server.bServiceAnswers = false;
    server.Receive(HANDSHAKE);
    server.Receive(std::string(CONTROL) + std::string(CONTROL) + std::string(CONTROL));
    server.Pass(1'000ms);
    REQUIRE(server.Count("control_busy") == 1);
    server.Receive(MakeStopLine("control"));
    server.Answer(server.unanswered.at(0));
    server.Receive(std::string(CONTROL) + std::string(CONTROL) + std::string(CONTROL));
    REQUIRE(server.Count("control_busy") == 1);
    REQUIRE(server.bReadingPaused);
}

TEST_CASE("7.19 STOP without anything to stop is nothing_to_stop; STOP session is always acknowledged")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeStopLine("monitor"));
    REQUIRE(server.stopControls == 0);
    server.Receive(MakeStopLine("control"));
    REQUIRE(server.Count("nothing_to_stop") == 2);
    REQUIRE(server.stopControls == 1); // another client's motion may be left
    server.Receive(CONTROL);
    server.Receive(MakeStopLine("control"));
    REQUIRE(server.Count(R"({"type":"stop_ack","target":"control"})") == 1);
    REQUIRE(server.stopControls == 2);
    server.Receive(MakeStopLine("control"));
    REQUIRE(server.Count("nothing_to_stop") == 3);
    REQUIRE(server.stopControls == 3);
    server.Receive(MakeStopLine("session"));
    REQUIRE(server.Count(R"({"type":"stop_ack","target":"session"})") == 1);
}

TEST_CASE("3 STOP control drops the CONTROLs that wait")
{
    ServerFixture server;
    server.bServiceAnswers = false;
    server.Receive(HANDSHAKE);
    server.Receive(std::string(CONTROL) + std::string(CONTROL) + MakeStopLine("control"));
    server.Answer(server.unanswered.at(0));
    REQUIRE(server.calls.size() == 1);
    REQUIRE(server.stopControls == 1);
}

TEST_CASE("7.21 STOP session: ack, only handshake_required after it, shutdown, close within a second")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeMonitorLine(2));
    server.Pass(4ms);
    server.Receive(MakeStopLine("session") + MakeStopLine("monitor"));
    REQUIRE(server.lines.back().find("handshake_required") != std::string::npos);
    REQUIRE(server.bSendShutDown);
    const std::size_t count = server.lines.size();
    server.Pass(999ms);
    REQUIRE(server.lines.size() == count);
    REQUIRE_FALSE(server.closed.has_value());
    server.Pass(1ms);
    REQUIRE(server.closed == EServerCloseReason::StopSession);
}

TEST_CASE("7.21 The client's own close ends the wait after STOP session")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeStopLine("session"));
    server.ClosePeer();
    REQUIRE(server.closed == EServerCloseReason::StopSession);
}

TEST_CASE("7.23 7.8 STOP without target and MONITOR with stop are rejected; session and stream continue")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeMonitorLine(2));
    server.Receive("{\"cmd\":\"STOP\",\"payload\":{\"id\":1}}\n");
    server.Receive("{\"cmd\":\"MONITOR\",\"payload\":{\"stop\":true}}\n");
    REQUIRE(server.Count("missing_target") == 1);
    REQUIRE(server.Count("missing_url") == 1);
    server.Pass(4ms);
    REQUIRE(server.Count("\"data\"") == 2);
}

TEST_CASE("7.20 A line beyond the limit is answered with one rx_buf_overflow, then the session is closed")
{
    ServerSessionOptions options;
    options.longestLine = 100;
    ServerFixture server(options);
    server.Receive(HANDSHAKE);
    server.Receive(std::string(101, 'x'));
    server.Receive(std::string(500, 'x') + "\n" + std::string(CONTROL));
    REQUIRE(server.Count("rx_buf_overflow") == 1);
    REQUIRE(server.calls.empty());
    REQUIRE(server.bSendShutDown);
    server.Pass(1'000ms);
    REQUIRE(server.closed == EServerCloseReason::LineTooLong);
}

TEST_CASE("7.33 7.34 7.35 Empty lines are skipped; each broken one is answered with one error without its text")
{
    ServerFixture server;
    server.Receive("\r\n\n  \n");
    REQUIRE(server.lines.empty());
    server.Receive("{\n\xFF\xFE\nnull\n");
    REQUIRE(server.Count("invalid_ndjson") == 3);
    REQUIRE(server.lines.size() == 3);
    for (const std::string& line : server.lines)
    {
        REQUIRE(line.find('\xFF') == std::string::npos);
    }
    server.Receive("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\r\n");
    REQUIRE(server.session.GetState() == EServerState::Ready);
}

TEST_CASE("7.39 Half-close: complete lines are executed, half a line is dropped, then the session closes")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeMonitorLine(2));
    server.answer = ApiResponse{403, {}};
    server.Receive(std::string(CONTROL) + R"({"cmd":"CONTR)");
    server.ClosePeer();
    REQUIRE(server.Count("control_err") == 1);
    REQUIRE(server.calls.size() == 1);
    REQUIRE(server.closed == EServerCloseReason::PeerClosed);
}

TEST_CASE("7.39 Half-close with a CONTROL in flight waits for its answer, at most one second")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.bServiceAnswers = false;
    server.answer = ApiResponse{403, {}};
    server.Receive(CONTROL);
    server.ClosePeer();
    REQUIRE_FALSE(server.closed.has_value());
    SECTION("answered")
    {
        server.Answer(server.unanswered.at(0));
        REQUIRE(server.Count("control_err") == 1);
        REQUIRE(server.closed == EServerCloseReason::PeerClosed);
    }
    SECTION("never answered")
    {
        server.Pass(1'000ms);
        REQUIRE(server.closed == EServerCloseReason::PeerClosed);
    }
}

TEST_CASE("7.12 4 A session beyond the limit gets an error and is closed")
{
    ServerFixture server;
    server.Reject();
    server.Receive(HANDSHAKE);
    REQUIRE(server.Count("handshake_rejected") == 1);
    REQUIRE(server.lines.size() == 1);
    server.Pass(1'000ms);
    REQUIRE(server.closed == EServerCloseReason::Rejected);
}

TEST_CASE("D-10 Without a HANDSHAKE the session ends after 5 s; no other line extends the deadline")
{
    ServerFixture server;
    server.Pass(4s);
    server.Receive("garbage\n\n");
    server.Receive(MakeMonitorLine(2));
    server.Receive("{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":2}}\n");
    server.Pass(999ms);
    REQUIRE(server.Count("session_timeout") == 0);
    server.Pass(1ms);
    REQUIRE(server.Count("session_timeout") == 1);
    server.Pass(1'000ms);
    REQUIRE(server.closed == EServerCloseReason::HandshakeTimeout);
}

TEST_CASE("D-10 A HANDSHAKE just before the deadline is in time")
{
    ServerFixture server;
    server.Pass(4'999ms);
    server.Receive(HANDSHAKE);
    server.Pass(10s);
    REQUIRE(server.Count("handshake_ack") == 1);
    REQUIRE(server.Count("session_timeout") == 0);
}

TEST_CASE("D-10 7.25 Without a deadline for the HANDSHAKE the 180 s run before it too; garbage does not extend them")
{
    ServerSessionOptions options;
    options.handshakeTimeout = 0ms;
    ServerFixture server(options);
    server.Pass(100s);
    server.Receive("garbage\n");
    server.Receive(MakeMonitorLine(2));
    server.Pass(79'999ms);
    REQUIRE(server.Count("session_timeout") == 0);
    server.Pass(1ms);
    REQUIRE(server.Count("session_timeout") == 1);
    server.Pass(1'000ms);
    REQUIRE(server.closed == EServerCloseReason::IdleTimeout);
}

TEST_CASE("7.25 A valid command restarts the 180 s")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Pass(100s);
    server.Receive(HANDSHAKE);
    server.Pass(179'999ms);
    REQUIRE(server.Count("session_timeout") == 0);
    server.Pass(1ms);
    REQUIRE(server.Count("session_timeout") == 1);
}

TEST_CASE("8 Unread acks and errors are limited")
{
    ServerSessionOptions options;
    options.maximumOutput = 1'000;
    ServerFixture server(options);
    server.bSocketTakes = false;
    for (int count = 0; count < 100 && !server.closed.has_value(); ++count)
    {
        server.Receive("x\n");
    }
    REQUIRE(server.closed == EServerCloseReason::OutputFull);
}
