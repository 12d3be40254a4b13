#include "Catch.hpp"
#include "ClientFixture.hpp"

#include <string>
#include <utility>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;    // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr auto IS_MOVED = [](const DataLine& sample) {
    return sample.result.has_value() && sample.result->GetText() == "\"moved\"";
};

ControlCall MakeCall(const std::string& url)
{
    ControlCall call;
    call.request = ControlRequest{EApiMethod::Post, url, {}, {}};
    return call;
}

ControlCall MakeConfirmedCall(const std::string& url, std::chrono::milliseconds within)
{
    ControlCall call = MakeCall(url);
    call.isConfirmed = IS_MOVED;
    call.confirmWithin = within;
    return call;
}

std::string MakeSample(int ts, const std::string& result)
{
    return R"({"type":"data","ts":)" + std::to_string(ts) + R"(,"svc_dur_ms":0.1,"result":")" + result + "\"}\n";
}

void MakeStreaming(ClientFixture& client)
{
    client.SetMonitor(10ms);
    MakeReady(client);
    client.Receive(MONITOR_ACK);
    client.events.clear();
    client.lines.clear();
}

} // namespace

TEST_CASE("3 A CONTROL is accepted when it is not rejected and a sample confirms it")
{
    ClientFixture client;
    MakeStreaming(client);
    client.Receive(MakeSample(10, "moved")); // sent before the CONTROL: no confirmation
    const std::uint64_t token = client.Call(MakeConfirmedCall("/a", 1'000ms));
    client.Receive(MakeSample(20, "still"));
    client.Pass(500ms);
    CHECK(client.Take<ClientControlSettled>().empty());
    SECTION("within its time")
    {
        client.Pass(400ms);
        client.Receive(MakeSample(30, "moved"));
        const auto settled = client.Take<ClientControlSettled>();
        REQUIRE(settled.size() == 1);
        CHECK(settled.at(0).token == token);
        CHECK(settled.at(0).outcome == EControlOutcome::Accepted);
    }
    SECTION("or not")
    {
        client.Receive(MakeSample(30, "still"));
        client.Pass(499ms);
        CHECK(client.Take<ClientControlSettled>().empty());
        client.Pass(1ms);
        const auto settled = client.Take<ClientControlSettled>();
        REQUIRE(settled.size() == 1);
        CHECK(settled.at(0).token == token);
        CHECK(settled.at(0).outcome == EControlOutcome::Unconfirmed);
        client.Receive(MakeSample(40, "moved"));
        CHECK(client.Take<ClientControlSettled>().empty());
    }
    SECTION("or the connection is lost first")
    {
        client.session.OnPeerClosed(client.GetNow(), client.actions);
        client.Execute();
        const auto settled = client.Take<ClientControlSettled>();
        REQUIRE(settled.size() == 1);
        CHECK(settled.at(0).outcome == EControlOutcome::Unknown);
    }
    SECTION("or STOP control follows")
    {
        client.session.StopControl(client.GetNow(), client.actions);
        client.Execute();
        const auto settled = client.Take<ClientControlSettled>();
        REQUIRE(settled.size() == 1);
        CHECK(settled.at(0).outcome == EControlOutcome::Unknown);
    }
}

TEST_CASE("3 A confirmation within the window counts at its end, because a rejection may still come")
{
    ClientFixture client;
    MakeStreaming(client);
    const std::uint64_t first = client.Call(MakeConfirmedCall("/a", 100ms)); // shorter than the window
    const std::uint64_t second = client.Call(MakeConfirmedCall("/b", 100ms));
    client.Receive(MakeSample(20, "moved"));
    CHECK(client.Take<ClientControlSettled>().empty());
    client.Pass(500ms);
    auto settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 1);
    CHECK(settled.at(0).token == first);
    CHECK(settled.at(0).outcome == EControlOutcome::Accepted);
    client.Receive(MakeSample(30, "moved"));
    client.Receive("{\"type\":\"control_err\",\"status\":403}\n");
    settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 1);
    CHECK(settled.at(0).token == second);
    CHECK(settled.at(0).outcome == EControlOutcome::Refused);
    const std::uint64_t third =
        client.Call(MakeConfirmedCall("/c", 100ms)); // what confirmed the second is not the third's
    client.Pass(500ms);
    settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 1);
    CHECK(settled.at(0).token == third);
    CHECK(settled.at(0).outcome == EControlOutcome::Unconfirmed);
}

TEST_CASE("3 A waiting CONTROL expires at its time limit and is never sent")
{
    ClientSessionOptions options;
    options.controlTimeout = 700ms;
    ClientFixture client(options);
    MakeReady(client);
    ControlCall shorter = MakeCall("/shorter");
    shorter.timeout = 200ms;
    client.Control("/first");
    const std::uint64_t second = client.Control("/second");
    const std::uint64_t third = client.Control("/third");
    const std::uint64_t last = client.Call(std::move(shorter));
    client.Pass(199ms);
    CHECK(client.Take<ClientControlSettled>().empty());
    client.Pass(1ms);
    auto settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 1);
    CHECK(settled.at(0).token == last);
    CHECK(settled.at(0).outcome == EControlOutcome::NotSent);
    client.Pass(500ms); // the second was sent meanwhile
    settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 2);
    CHECK(settled.at(0).outcome == EControlOutcome::Accepted);
    CHECK(settled.at(1).token == third);
    CHECK(settled.at(1).outcome == EControlOutcome::NotSent);
    client.Pass(1'000ms);
    settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 1);
    CHECK(settled.at(0).token == second);
    CHECK(client.CountLines("third") + client.CountLines("shorter") == 0);
}

TEST_CASE("3 A CONTROL that the socket does not send ends the connection, so that it cannot be sent later")
{
    ClientFixture client;
    MakeReady(client);
    client.bSocketTakes = false;
    const std::uint64_t token = client.Control("/a");
    client.Pass(4'999ms);
    CHECK(client.Take<ClientLost>().empty());
    client.Pass(1ms);
    const auto settled = client.Take<ClientControlSettled>();
    REQUIRE(settled.size() == 1);
    CHECK(settled.at(0).token == token);
    CHECK(settled.at(0).outcome == EControlOutcome::Unknown); // some of its bytes may have been sent
    REQUIRE(client.Take<ClientLost>().size() == 1);
    CHECK(client.closes == 1);
}

TEST_CASE("3 A streamed CONTROL that the socket does not send ends the connection, so that it cannot be sent later")
{
    ClientFixture client;
    MakeReady(client);
    client.bSocketTakes = false;
    client.Control("/a", EControlTracking::Streamed);
    client.Pass(1'000ms);
    client.Control("/b", EControlTracking::Streamed); // waits until the first one is sent
    SECTION("5 s after it was given")
    {
        client.Pass(3'999ms);
        CHECK(client.Take<ClientLost>().empty());
        client.Pass(1ms);
    }
    SECTION("or at the time limit of the next one, when the first has been sent")
    {
        client.Pass(3'000ms);
        client.CompleteSend();
        CHECK(client.CountLines("/b") == 1);
        client.Pass(1'999ms);
        CHECK(client.Take<ClientLost>().empty());
        client.Pass(1ms);
    }
    SECTION("or at its own time limit")
    {
        ControlCall call = MakeCall("/c");
        call.tracking = EControlTracking::Streamed;
        call.timeout = 200ms;
        client.Call(std::move(call));
        client.Control("/d", EControlTracking::Streamed);
        client.Pass(199ms);
        CHECK(client.Take<ClientLost>().empty());
        client.Pass(1ms);
    }
    const auto lost = client.Take<ClientLost>();
    REQUIRE(lost.size() == 1);
    CHECK(lost.at(0).reason == EClientLossReason::SendTimeout);
    CHECK(client.closes == 1);
    // The next connection begins without it, and with the full time limit.
    client.lines.clear();
    client.Pass(lost.at(0).retryIn);
    client.ConnectAndShake();
    client.Pass(10s);
    CHECK(client.CountLines("CONTROL") == 0);
    client.Control("/e", EControlTracking::Streamed);
    client.Pass(4'999ms);
    CHECK(client.Take<ClientLost>().empty());
    client.CompleteSend(); // of the HANDSHAKE
    CHECK(client.CountLines("CONTROL") == 1);
}

TEST_CASE("3 Streamed CONTROLs that are sent in time never end the connection")
{
    ClientFixture client;
    MakeReady(client);
    for (int count = 0; count < 20; ++count)
    {
        client.bSocketTakes = false;
        client.Control("/a", EControlTracking::Streamed);
        client.Control("/b", EControlTracking::Streamed);
        client.Pass(4'999ms);
        client.bSocketTakes = true;
        client.CompleteSend();
    }
    client.Pass(60s);
    CHECK(client.Take<ClientLost>().empty());
    CHECK(client.CountLines("CONTROL") == 40);
}

TEST_CASE("3 STOP control has a time limit too; a session that ends does not reconnect for it")
{
    ClientFixture client;
    MakeReady(client);
    client.bSocketTakes = false;
    client.session.StopControl(client.GetNow(), client.actions);
    client.Execute();
    SECTION("STOP control")
    {
        client.Pass(4'999ms);
        CHECK(client.Take<ClientLost>().empty());
        client.Pass(1ms);
        REQUIRE(client.Take<ClientLost>().size() == 1);
    }
    SECTION("the end of the session")
    {
        client.Pass(4'000ms);
        client.session.Stop(client.GetNow(), client.actions);
        client.Execute();
        client.Pass(2'000ms);
        CHECK(client.Take<ClientLost>().empty());
        CHECK(client.Take<ClientEnded>().size() == 1);
        CHECK(client.session.GetState() == EClientState::Stopped);
    }
}

TEST_CASE("3 A STOP control that waits for the socket is not repeated, and drops the CONTROLs that follow it")
{
    ClientFixture client;
    MakeReady(client);
    client.lines.clear();
    client.bSocketTakes = false;
    const auto stop = [&client](int times) {
        for (int count = 0; count < times; ++count)
        {
            client.session.StopControl(client.GetNow(), client.actions);
            client.Execute();
        }
    };
    stop(1'000); // the first one is given to the socket
    client.Control("/a", EControlTracking::Streamed);
    stop(1'000);
    client.bSocketTakes = true;
    client.CompleteSend();
    CHECK(client.CountLines("CONTROL") == 0);
    CHECK(client.CountLines("STOP") == 2);
    stop(2);
    CHECK(client.CountLines("STOP") == 4);
}

TEST_CASE("3 Without a time limit a CONTROL waits indefinitely")
{
    ClientSessionOptions options;
    options.controlTimeout = 0ms;
    ClientFixture client(options);
    MakeReady(client);
    client.bSocketTakes = false;
    SECTION("a tracked one")
    {
        client.Control("/a");
    }
    SECTION("a streamed one")
    {
        client.Control("/a", EControlTracking::Streamed);
    }
    client.Pass(60s);
    CHECK(client.Take<ClientControlSettled>().empty());
    CHECK(client.Take<ClientLost>().empty());
}

TEST_CASE("11 The newest sample can be read at any time, and never one of another MONITOR or connection")
{
    ClientFixture client;
    MakeStreaming(client);
    CHECK(client.session.GetLatestOrNull() == nullptr);
    client.Receive(MakeSample(10, "a") + MakeSample(20, "b"));
    CHECK(client.Take<ClientData>().size() == 2);
    REQUIRE(client.session.GetLatestOrNull() != nullptr);
    CHECK(client.session.GetLatestOrNull()->line.result->GetText() == "\"b\"");
    CHECK(client.session.GetLatestOrNull()->receivedAt.steady == client.GetNow().steady);
    SECTION("another MONITOR")
    {
        client.SetMonitor(20ms);
    }
    SECTION("another connection")
    {
        client.session.OnPeerClosed(client.GetNow(), client.actions);
        client.Execute();
    }
    CHECK(client.session.GetLatestOrNull() == nullptr);
}

TEST_CASE("11 Without sample events only the newest sample is kept")
{
    ClientSessionOptions options;
    options.bSampleEvents = false;
    ClientFixture client(options);
    MakeStreaming(client);
    client.Receive(MakeSample(10, "a") + MakeSample(20, "b"));
    CHECK(client.Take<ClientData>().empty());
    CHECK(client.session.GetLatestOrNull()->line.ts == 20.0);
    CHECK(client.session.GetStats().dataLines == 2);
}

TEST_CASE("11 Quality restarts with each MONITOR, the counts of the session do not")
{
    ClientFixture client;
    MakeStreaming(client);
    client.Receive(MakeSample(10, "a") + MakeSample(40, "b"));
    CHECK(client.session.GetQuality().samples == 2);
    CHECK(client.session.GetQuality().missing == 2);
    CHECK(client.session.GetQuality().inTime == 0.5);
    client.SetMonitor(20ms);
    client.Receive(MONITOR_ACK);
    CHECK(client.session.GetQuality() == StreamQuality{});
    client.Receive(MakeSample(60, "b") + MakeSample(80, "b"));
    CHECK(client.session.GetQuality().missing == 0);
    CHECK(client.session.GetStats().missingLines == 2);
    CHECK(client.session.GetStats().dataLines == 4);
}

TEST_CASE("3 Stop ends at the time limit of a streamed CONTROL that the socket does not accept")
{
    ClientSessionOptions options;
    options.controlTimeout = 100ms;
    ClientFixture client(options);
    MakeReady(client);
    client.bSocketTakes = false;
    client.Control("/a", EControlTracking::Streamed);
    client.session.Stop(client.GetNow(), client.actions);
    client.Execute();
    client.Pass(99ms);
    REQUIRE(client.Take<ClientEnded>().empty());
    client.Pass(1ms);
    REQUIRE(client.Take<ClientEnded>().size() == 1);
}
