#include "Catch.hpp"
#include "ClientFixture.hpp"

#include <string>
#include <utility>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;    // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

TEST_CASE("3 A late refusal of a CONTROL that STOP control abandoned is not matched to the next command")
{
    ClientFixture client;
    MakeReady(client);
    const std::uint64_t abandoned = client.Control("/a");
    client.StopControl();
    const auto settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 1);
    CHECK(settled.at(0).token == abandoned);
    CHECK(settled.at(0).outcome == EControlOutcome::Unknown);
    SECTION("which is a CONTROL")
    {
        const std::uint64_t next = client.Control("/b");
        CHECK(client.CountLines("\"/b\"") == 0);
        client.Receive(CONTROL_REFUSAL);
        CHECK(client.Take<ClientControlFault>().size() == 1);
        CHECK(client.Take<ClientControlSettled>().empty());
        CHECK(client.CountLines("\"/b\"") == 1);
        client.Pass(500ms);
        const auto accepted = client.Take<ClientControlSettled>();
        REQUIRE(accepted.size() == 1);
        CHECK(accepted.at(0).token == next);
        CHECK(accepted.at(0).outcome == EControlOutcome::Accepted);
    }
    SECTION("which is a MONITOR")
    {
        client.SetMonitor(10ms);
        CHECK(client.CountLines("MONITOR") == 0);
        client.Receive(REQUEST_REFUSAL);
        CHECK(client.Take<ClientControlFault>().size() == 1);
        CHECK(client.Take<ClientMonitorRefused>().empty());
        CHECK(client.CountLines("MONITOR") == 1);
    }
    SECTION("which is sent at the end of the window if no refusal comes")
    {
        client.Pass(200ms);
        client.Control("/b");
        client.StopControl(); // no second report of /a, and no longer window
        CHECK(client.Take<ClientControlSettled>().size() == 1);
        client.Control("/c");
        client.Pass(299ms);
        CHECK(client.CountLines("CONTROL") == 1);
        client.Pass(1ms);
        CHECK(client.CountLines("\"/c\"") == 1);
        CHECK(client.Take<ClientControlSettled>().empty());
    }
    SECTION("and a lost connection does not report it again")
    {
        client.session.OnPeerClosed(client.GetNow(), client.actions);
        client.Execute();
        CHECK(client.Take<ClientControlSettled>().empty());
    }
}

TEST_CASE("3 The window of an abandoned CONTROL begins when it has been written, and samples do not confirm it")
{
    ClientFixture client;
    client.SetMonitor(10ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    client.bSocketTakes = false;
    ControlCall call;
    call.request = ControlRequest{EApiMethod::Post, "/a", {}, {}};
    call.isConfirmed = [](const DataLine& /*sample*/) {
        return true;
    };
    client.Call(std::move(call));
    client.StopControl();
    CHECK(client.Take<ClientControlSettled>().size() == 1);
    client.Pass(1s);
    client.bSocketTakes = true;
    client.CompleteSend();
    client.Control("/b");
    client.Receive(MakeData(10));
    client.Pass(499ms);
    CHECK(client.CountLines("\"/b\"") == 0);
    client.Pass(1ms);
    CHECK(client.CountLines("\"/b\"") == 1);
    CHECK(client.Take<ClientControlSettled>().empty());
}

TEST_CASE("3 STOP control drops the CONTROLs that wait for the socket, and precedes everything that waits")
{
    const std::string stop = R"({"cmd":"STOP","payload":{"target":"control"}})";
    ClientFixture client;
    MakeReady(client);
    client.bSocketTakes = false;
    client.Control("/p1", EControlTracking::Streamed); // given to the socket
    client.Control("/p2", EControlTracking::Streamed);
    SECTION("streamed ones")
    {
        client.Control("/p3", EControlTracking::Streamed);
        client.StopControl();
        client.lines.clear();
        client.CompleteSend();
        CHECK(client.lines == std::vector<std::string>{stop});
        CHECK(client.Take<ClientControlFault>().empty());
    }
    SECTION("a tracked one, which was not sent")
    {
        const std::uint64_t dropped = client.Control("/a");
        client.Control("/p3", EControlTracking::Streamed);
        client.StopControl();
        const auto settled = client.Take<ClientControlSettled>();
        REQUIRE(settled.size() == 1);
        CHECK(settled.at(0).token == dropped);
        CHECK(settled.at(0).outcome == EControlOutcome::NotSent);
        client.lines.clear();
        client.CompleteSend();
        CHECK(client.lines == std::vector<std::string>{stop});
        client.CompleteSend();
        client.Control("/b"); // waits for no window
        CHECK(client.CountLines("\"/b\"") == 1);
        client.Receive(CONTROL_REFUSAL);
        REQUIRE(client.Take<ClientControlSettled>().size() == 1);
    }
    SECTION("but no MONITOR")
    {
        client.SetMonitor(10ms);
        client.Control("/p3", EControlTracking::Streamed);
        client.StopControl();
        client.Control("/p4", EControlTracking::Streamed);
        client.StopControl();
        client.Receive(MONITOR_ACK); // of nothing: the MONITOR was not given to the socket
        CHECK(client.Take<ClientMonitorStarted>().empty());
        client.lines.clear();
        client.CompleteSend();
        REQUIRE(client.lines.size() == 2);
        CHECK(client.lines.at(0) == stop);
        CHECK(client.lines.at(1).find("MONITOR") != std::string::npos);
        client.Receive(MONITOR_ACK);
        CHECK(client.Take<ClientMonitorStarted>().size() == 1);
    }
}

TEST_CASE("3 The time limit of a STOP control that waits is its own, and is not extended by another one")
{
    ClientFixture client;
    MakeReady(client);
    client.bSocketTakes = false;
    client.SetMonitor(10ms); // given to the socket
    ControlCall call;
    call.request = ControlRequest{EApiMethod::Post, "/a", {}, {}};
    call.tracking = EControlTracking::Streamed;
    call.timeout = 200ms;
    client.Call(std::move(call));
    client.StopControl();
    client.Pass(1'900ms);
    CHECK(client.Take<ClientLost>().empty());
    client.Receive(MONITOR_ACK);
    client.Receive(MakeData(10));
    client.StopControl();
    client.Pass(1'500ms);
    client.Receive(MakeData(20));
    client.Pass(1'599ms);
    CHECK(client.Take<ClientLost>().empty());
    client.Pass(1ms);
    const auto lost = client.Take<ClientLost>();
    REQUIRE(lost.size() == 1);
    CHECK(lost.at(0).reason == EClientLossReason::SendTimeout);
}

TEST_CASE("7.19 nothing_to_stop answers the STOP that was sent first")
{
    constexpr std::string_view NOTHING_TO_STOP = "{\"error\":\"nothing_to_stop\",\"message\":\"\"}\n";
    constexpr std::string_view MONITOR_STOPPED = "{\"type\":\"stop_ack\",\"target\":\"monitor\"}\n";
    ClientFixture client;
    client.SetMonitor(10ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    std::vector<EStopTarget> expected{EStopTarget::Control, EStopTarget::Monitor};
    SECTION("STOP control")
    {
        client.StopControl();
        client.StopMonitor();
        client.Control("/a");
        client.Receive(NOTHING_TO_STOP);
        CHECK(client.CountLines("CONTROL") == 0);
        client.Receive(MONITOR_STOPPED);
        CHECK(client.CountLines("CONTROL") == 1);
    }
    SECTION("STOP monitor")
    {
        expected = {EStopTarget::Monitor, EStopTarget::Control};
        client.StopMonitor();
        client.StopControl();
        client.Receive(NOTHING_TO_STOP);
        client.Control("/a");
        CHECK(client.CountLines("CONTROL") == 1);
        client.Receive("{\"type\":\"stop_ack\",\"target\":\"control\"}\n");
    }
    SECTION("an acknowledged STOP control has been answered")
    {
        client.StopControl();
        client.Receive("{\"type\":\"stop_ack\",\"target\":\"control\"}\n");
        client.StopMonitor();
        client.Receive(NOTHING_TO_STOP);
    }
    SECTION("a STOP control that precedes a STOP monitor which waits for the socket")
    {
        client.bSocketTakes = false;
        client.Control("/p", EControlTracking::Streamed);
        client.StopMonitor();
        client.StopControl();
        client.StopControl();
        client.bSocketTakes = true;
        client.CompleteSend();
        client.Receive(NOTHING_TO_STOP);
        client.Receive(NOTHING_TO_STOP);
    }
    SECTION("a STOP control that was never answered")
    {
        client.StopControl();
        client.StopMonitor();
        client.Receive(MONITOR_STOPPED);
        client.SetMonitor(10ms);
        client.Receive(MONITOR_ACK);
        client.StopMonitor();
        client.Receive(NOTHING_TO_STOP);
        expected = {EStopTarget::Monitor, EStopTarget::Monitor};
    }
    SECTION("a STOP control of an earlier connection has no answer")
    {
        client.StopControl();
        client.session.OnPeerClosed(client.GetNow(), client.actions);
        client.Execute();
        client.Pass(client.Take<ClientLost>().at(0).retryIn);
        client.ConnectAndShake();
        client.Receive(MONITOR_ACK);
        client.StopMonitor();
        client.Receive(NOTHING_TO_STOP);
        expected = {EStopTarget::Monitor};
    }
    std::vector<EStopTarget> stopped;
    for (const ClientStopped& event : client.Take<ClientStopped>())
    {
        stopped.push_back(event.target);
    }
    CHECK(stopped == expected);
}
