#include "ClientMonitor.hpp"

#include "Catch.hpp"
#include "ClientFixture.hpp"
#include "ManualClock.hpp"

#include <chrono>
#include <optional>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

/// A ClientMonitor for which a MONITOR with a period of 10 ms was set.
class MonitorFixture
{
public:
    ACS::Testing::ManualClock clock;
    ClientSessionOptions options;
    ClientMonitor monitor{options};
    ClientActions actions;

    MonitorFixture()
    {
        Set("/first");
    }

    void Set(const char* url)
    {
        monitor.Set(MonitorRequest{url, 10ms, {}, {}});
    }

    [[nodiscard]] bool HasBegunStart()
    {
        const std::optional<OpenStreamRequest> request = monitor.BeginNextOrNull();
        return request.has_value() && std::holds_alternative<MonitorRequest>(*request) && monitor.IsStarting();
    }

    [[nodiscard]] bool HasBegunStop()
    {
        const std::optional<OpenStreamRequest> request = monitor.BeginNextOrNull();
        return request.has_value() && std::holds_alternative<StopRequest>(*request) && monitor.IsStopping();
    }

    void Start()
    {
        REQUIRE(HasBegunStart());
        monitor.OnStarted(clock.GetNow(), actions);
    }

    void Receive()
    {
        monitor.OnSample(DataLine{}, clock.GetNow(), actions);
    }
};

} // namespace

TEST_CASE("A MONITOR is sent once, and again after a disconnect")
{
    MonitorFixture fixture;
    fixture.Start();
    CHECK_FALSE(fixture.monitor.IsInFlight());
    CHECK_FALSE(fixture.monitor.BeginNextOrNull().has_value());
    fixture.monitor.OnDisconnected();
    CHECK(fixture.HasBegunStart());
}

TEST_CASE("A server that is occupied by another MONITOR is stopped first")
{
    MonitorFixture fixture;
    REQUIRE(fixture.HasBegunStart());
    ErrorLine error;
    error.code = EOpenStreamErrorCode::MonitorAlreadyActive;
    fixture.monitor.OnRefused(error, fixture.actions);
    fixture.Receive();
    CHECK(fixture.monitor.GetLatestOrNull() == nullptr);
    REQUIRE(fixture.HasBegunStop());
    fixture.monitor.OnStopped(fixture.actions);
    CHECK(fixture.HasBegunStart());
}

TEST_CASE("A MONITOR that is not wanted any more is stopped only where the server streams")
{
    MonitorFixture fixture;
    SECTION("it streams")
    {
        fixture.Start();
        fixture.monitor.Set(std::nullopt);
        CHECK(fixture.HasBegunStop());
    }
    SECTION("it does not")
    {
        fixture.monitor.Set(std::nullopt);
    }
    CHECK_FALSE(fixture.monitor.BeginNextOrNull().has_value());
}

TEST_CASE("The latest sample is of the current MONITOR")
{
    MonitorFixture fixture;
    fixture.Start();
    fixture.Receive();
    CHECK(fixture.monitor.GetLatestOrNull() != nullptr);
    fixture.Set("/second");
    fixture.Receive(); // of the first one
    CHECK(fixture.monitor.GetLatestOrNull() == nullptr);
    fixture.Start();
    fixture.Receive();
    CHECK(fixture.monitor.GetLatestOrNull() != nullptr);
}

TEST_CASE("Samples that are overdue are reported as stale once, and then as lost")
{
    MonitorFixture fixture;
    fixture.Start();
    fixture.actions.clear();
    fixture.clock.Advance(10ms + fixture.options.staleAfter);
    CHECK(fixture.monitor.TryAwaitData(fixture.clock.GetNow(), fixture.actions));
    CHECK(fixture.actions.size() == 2); // stale, and the timer for lostAfter
    fixture.clock.Advance(fixture.options.lostAfter - fixture.options.staleAfter);
    CHECK_FALSE(fixture.monitor.TryAwaitData(fixture.clock.GetNow(), fixture.actions));
    CHECK(fixture.actions.size() == 2);
}

TEST_CASE("11 Missing samples are counted by the period of the MONITOR that the server streams")
{
    ACS::Testing::ClientFixture client;
    MakeReady(client);
    client.SetMonitor(1'000ms);
    SECTION("while its replacement is not acknowledged, and after it was")
    {
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.SetMonitor(2ms);
        client.Receive(ACS::Testing::MakeData(1'000) + ACS::Testing::MakeData(2'000));
        CHECK(client.session.GetStats().missingLines == 0);
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.Receive(ACS::Testing::MakeData(2'002) + ACS::Testing::MakeData(2'004));
    }
    SECTION("after its replacement was refused")
    {
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.Receive(ACS::Testing::MakeData(1'000));
        client.SetMonitor(2ms);
        client.Receive(ACS::Testing::MakeData(2'000) + ACS::Testing::MakeData(3'000));
        client.Receive(ACS::Testing::REQUEST_REFUSAL);
        client.Receive(ACS::Testing::MakeData(4'000) + ACS::Testing::MakeData(5'000));
        CHECK(client.session.GetQuality().samples == 5);
    }
    SECTION("where another one was set before its acknowledgement")
    {
        client.SetMonitor(2ms);
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.Receive(ACS::Testing::MakeData(1'000) + ACS::Testing::MakeData(2'000));
        CHECK(client.session.GetStats().missingLines == 0);
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.Receive(ACS::Testing::MakeData(2'002) + ACS::Testing::MakeData(2'008));
        CHECK(client.session.GetStats().missingLines == 2);
        return;
    }
    CHECK(client.session.GetStats().missingLines == 0);
}

TEST_CASE("3 A MONITOR that is acknowledged after a refusal is watched, and can be stopped")
{
    ACS::Testing::ClientFixture client;
    MakeReady(client);
    client.Control("/x", EControlTracking::Streamed);
    client.SetMonitor(10ms);
    client.Receive(ACS::Testing::REQUEST_REFUSAL); // of the streamed CONTROL
    CHECK(client.Take<ClientMonitorRefused>().size() == 1);
    SECTION("it is watched")
    {
        client.Receive(ACS::Testing::MONITOR_ACK);
        const auto started = client.Take<ClientMonitorStarted>();
        REQUIRE(started.size() == 1);
        CHECK(started.at(0).requestNumber == 1);
        client.Pass(3'600ms);
        const auto lost = client.Take<ClientLost>();
        REQUIRE(lost.size() == 1);
        CHECK(lost.at(0).reason == EClientLossReason::DataSilent);
    }
    SECTION("it can be stopped")
    {
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.Receive(ACS::Testing::MakeData(10));
        client.StopMonitor();
        CHECK(client.CountLines("STOP") == 1);
    }
    SECTION("it is stopped where it is not wanted any more")
    {
        client.StopMonitor();
        CHECK(client.CountLines("STOP") == 0);
        client.Receive(ACS::Testing::MONITOR_ACK);
        CHECK(client.CountLines("STOP") == 1);
    }
    SECTION("the window of a CONTROL that was sent meanwhile continues")
    {
        client.Control("/y");
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.Pass(500ms);
        CHECK(client.Take<ClientControlSettled>().size() == 1);
    }
    SECTION("the acknowledgement is that of the next MONITOR, if one was sent")
    {
        client.SetMonitor(20ms);
        client.Receive(ACS::Testing::MONITOR_ACK);
        client.Receive(ACS::Testing::MONITOR_ACK);
        const auto started = client.Take<ClientMonitorStarted>();
        REQUIRE(started.size() == 1);
        CHECK(started.at(0).requestNumber == 2);
    }
}
