#include "controller/HostFixture.hpp"

#include <chrono>
#include <string>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using OpenStream::ClientControlSettled;
using OpenStream::ClientLost;
using OpenStream::ClientMonitorStale;
using OpenStream::ClientReady;
using OpenStream::ControlCall;
using OpenStream::EClientLossReason;
using OpenStream::EControlOutcome;

constexpr const char* MOTOR = "/project/robot/motor_on_state";
constexpr const char* ON = R"({"_type":"JObject","val":0})";
constexpr const char* OFF = R"({"_type":"JObject","val":1})";

/// A client that notices soon.
OpenStream::ClientSessionOptions MakeAlert()
{
    OpenStream::ClientSessionOptions options;
    options.staleAfter = 100ms;
    options.lostAfter = 0ms;
    return options;
}

void SwitchOn(HostFixture& fixture)
{
    fixture.Monitor(MOTOR, "{}");
    REQUIRE(fixture.TryAwaitSample(OFF));
    REQUIRE(fixture.Control("/project/robot/motor_on", "{}").outcome == EControlOutcome::Accepted);
    REQUIRE(fixture.TryAwaitSample(ON));
}

} // namespace

TEST_CASE("9 Over a socket: in a silence the data becomes stale and nothing else is reported, CONTROL is served")
{
    HostFixture fixture(MakeAlert());
    SwitchOn(fixture);
    fixture.Begin("silence");
    REQUIRE(fixture.TryAwaitCount<ClientMonitorStale>(1));
    CHECK(fixture.GetLast<ClientMonitorStale>().age >= 100ms);
    CHECK(fixture.Control("/project/robot/emergency_stop", "{}").outcome == EControlOutcome::Accepted);
    CHECK(fixture.GetSample() == ON);
    CHECK(fixture.Count<ClientLost>() == 0);
    CHECK(fixture.Count<OpenStream::ClientErrorReported>() == 0);
    REQUIRE(fixture.host->EndFaults(OpenStreamSim::EFaultKind::Silence) == 1);
    REQUIRE(fixture.TryAwaitSample(OFF));
    CHECK(fixture.Count<ClientReady>() == 1);
    CHECK(fixture.client->GetQuality().missing >= 9U); // of 10 ms
}

TEST_CASE("9 Over a socket: a client that abandons a silent stream reaches the controller, but gets no data yet")
{
    OpenStream::ClientSessionOptions options = MakeAlert();
    options.lostAfter = 300ms;
    HostFixture fixture(options);
    fixture.Monitor(MOTOR, "{}");
    REQUIRE(fixture.TryAwaitSample(OFF));
    fixture.Begin("silence");
    REQUIRE(fixture.TryAwaitCount<ClientReady>(2));
    CHECK(fixture.GetLast<ClientLost>().reason == EClientLossReason::DataSilent);
    REQUIRE(fixture.TryAwaitCount<ClientLost>(2)); // the new MONITOR is accepted and silent, too
    const std::size_t before = fixture.Count<OpenStream::ClientData>();
    REQUIRE(fixture.host->EndFaults(std::nullopt) == 1);
    REQUIRE(fixture.TryAwaitCount<OpenStream::ClientData>(before + 3));
}

TEST_CASE("9 Over a socket: a hole is a gap, and the periods that it took are missing")
{
    HostFixture fixture;
    fixture.Monitor(MOTOR, "{}");
    REQUIRE(fixture.TryAwaitSample(OFF));
    fixture.Begin("hole");
    const std::uint64_t before = fixture.client->GetQuality().samples;
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.client->GetQuality().samples > before + 5; }));
    const OpenStream::StreamQuality quality = fixture.client->GetQuality();
    CHECK(quality.missing >= 9U);
    CHECK(quality.byServer.largest >= 100.0);
    CHECK(fixture.Count<ClientLost>() == 0);
}

TEST_CASE("9 Over a socket: a drop is a closed connection without a line, and the client comes back")
{
    HostFixture fixture;
    fixture.Monitor(MOTOR, "{}");
    REQUIRE(fixture.TryAwaitSample(OFF));
    const std::size_t before = fixture.Count<OpenStream::ClientData>();
    fixture.Begin("drop");
    REQUIRE(fixture.TryAwaitCount<ClientLost>(1));
    const EClientLossReason reason = fixture.GetLast<ClientLost>().reason;
    CHECK((reason == EClientLossReason::PeerClosed || reason == EClientLossReason::SocketError));
    CHECK(fixture.Count<OpenStream::ClientErrorReported>() == 0);
    REQUIRE(fixture.TryAwaitCount<ClientReady>(2));
    REQUIRE(fixture.TryAwaitCount<OpenStream::ClientData>(before + 5));
}

TEST_CASE("9 Over a socket: a CONTROL that a slow controller works on is unknown when the connection drops")
{
    OpenStream::ClientSessionOptions options;
    options.controlWindow = 10s;
    HostFixture fixture(options);
    fixture.Begin("slow time=1m side=stream");
    REQUIRE(fixture.TryAwaitCount<ClientReady>(1));
    const std::uint64_t token = fixture.client->SendControl(
        OpenStream::ControlRequest{OpenStream::EApiMethod::Post, "/project/robot/tool_no", {}, {}},
        OpenStream::EControlTracking::Tracked);
    // It is with the controller: HTTP waits for nothing.
    REQUIRE(fixture.TryRunUntil([&]() { return fixture.GetOverHTTP("/api_ver").ends_with("5"); }));
    fixture.Begin("drop");
    REQUIRE(fixture.TryAwaitCount<ClientControlSettled>(1));
    CHECK(fixture.GetLast<ClientControlSettled>().token == token);
    CHECK(fixture.GetLast<ClientControlSettled>().outcome == EControlOutcome::Unknown);
}

TEST_CASE("9 7.27 Over a socket: a slow service skips ticks and shows that in svc_dur_ms; HTTP answers late as well")
{
    HostFixture fixture;
    fixture.Begin("slow time=50ms");
    fixture.Monitor(MOTOR, "{}");
    REQUIRE(fixture.TryAwaitCount<OpenStream::ClientData>(5));
    CHECK(fixture.GetLast<OpenStream::ClientData>().line.serviceDurationMs >= 50.0);
    CHECK(fixture.client->GetQuality().missing >= 4U * 4U);
    const auto asked = std::chrono::steady_clock::now();
    CHECK(fixture.GetOverHTTP("/api_ver").ends_with("\r\n\r\n5"));
    CHECK(std::chrono::steady_clock::now() - asked >= 50ms);
}

TEST_CASE("9 Over a socket: a burst of refusals is a control_err each, with status and body, and then over")
{
    HostFixture fixture;
    SwitchOn(fixture);
    fixture.Begin("refuse count=2");
    for (int i = 0; i < 2; ++i)
    {
        const ClientControlSettled settled = fixture.Control("/project/robot/tool_no", R"({"val":1})");
        CHECK(settled.outcome == EControlOutcome::Refused);
        CHECK(settled.status == 403);
        CHECK_THAT(settled.body.value_or(Core::JsonText()).GetText(), Catch::Contains(R"("err_code":-1554)"));
    }
    CHECK(fixture.Control("/project/robot/tool_no", R"({"val":1})").outcome == EControlOutcome::Accepted);
}

TEST_CASE("9 Over a socket: motor off, emergency and protective stop and the mode switch show, and CONTROL is refused")
{
    HostFixture fixture;
    SwitchOn(fixture);
    fixture.Begin("motor-off");
    REQUIRE(fixture.TryAwaitSample(OFF));
    for (const std::string name : {"estop", "protective-stop", "mode"})
    {
        CAPTURE(name);
        fixture.Begin(name);
        CHECK(fixture.Control("/project/robot/motor_on", "{}").status == 403);
        REQUIRE(fixture.host->EndFaults(std::nullopt) == 1);
    }
    CHECK(fixture.Control("/project/robot/motor_on", "{}").outcome == EControlOutcome::Accepted);
    REQUIRE(fixture.TryAwaitSample(ON));
}

TEST_CASE("9 Over a socket: the start of a program that fails when it begins is not confirmed by its sample")
{
    HostFixture fixture;
    SwitchOn(fixture);
    REQUIRE(
        fixture.Control("/project/context/tasks[0]/cur_prog_cnt", R"({"pno":11,"ext_sel":1})").outcome
        == EControlOutcome::Accepted);
    fixture.Begin("program-fails when=start");
    fixture.Monitor("/project/robot", "{}");
    ControlCall call;
    call.request = OpenStream::ControlRequest{OpenStream::EApiMethod::Post, "/project/robot/start", {}, {}};
    call.isConfirmed = [](const OpenStream::DataLine& sample) {
        return sample.result.value_or(Core::JsonText()).GetText().find(R"("is_playback":1)") != std::string::npos;
    };
    call.confirmWithin = 200ms;
    const std::size_t before = fixture.Count<ClientControlSettled>();
    static_cast<void>(fixture.client->SendControlCall(call));
    REQUIRE(fixture.TryAwaitCount<ClientControlSettled>(before + 1));
    CHECK(fixture.GetLast<ClientControlSettled>().outcome == EControlOutcome::Unconfirmed);
    CHECK_THAT(fixture.GetOverHTTP("/project/plc/m/val_s32?st=400&len=4"), Catch::Contains("[1,0,1,11]"));
}

TEST_CASE("9 Stopping in the middle of every fault lets nothing follow")
{
    HostFixture fixture;
    fixture.Monitor(MOTOR, "{}");
    REQUIRE(fixture.TryAwaitSample(OFF));
    for (const std::string text :
         {"hole every=150ms",
          "drop every=10ms",
          "slow time=1m",
          "silence at=1ms",
          "mode silence=1h",
          "estop every=20ms for=10ms"})
    {
        fixture.Begin(text);
    }
    REQUIRE(fixture.TryAwaitCount<ClientLost>(2));
    fixture.host->Stop();
    fixture.host.reset();
    fixture.client->Stop();
    fixture.client.reset();
    fixture.context.restart();
    const auto end = std::chrono::steady_clock::now() + LIMIT;
    fixture.context.run_until(end);
    CHECK(fixture.context.stopped());
}

} // namespace ACS::Testing
