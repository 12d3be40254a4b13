#include "robots/VehicleWatch.hpp"

#include "Catch.hpp"
#include "config/AcsdConfig.hpp"
#include "drivers/DriverMetrics.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A robot on the example site whose reports a test writes.
struct WatchFixture
{
    AcsdConfig config = ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", {});
    Testing::RecordingLogSink sink;
    Testing::ManualClock clock;
    Apps::MetricsEndpoint metrics;
    DriverMetrics ofRobot{metrics, "", "LR01"};
    VehicleWatch watch{
        *config.site,
        "LR01",
        {clock, Core::Logger(sink, "robot"), ofRobot},
        config.vehicles.back()->methods.GetPositions(),
        "2.0.0"};
    VDA5050::StateMessage state;

    WatchFixture()
    {
        state.orderID = "O";
        state.orderUpdateID = 1;
        state.lastNodeID = config.site->GetNodes().front().nodeID;
        state.lastNodeSequenceID = 4;
        state.batteryState.batteryCharge = 80;
    }

    void Show()
    {
        watch.OnState(state);
    }

    void ShowAction(VDA5050::EActionStatus status)
    {
        state.actionStates = {{"J", "pick", "", status, ""}};
        Show();
    }

    /// As /metrics shows it.
    [[nodiscard]] std::uint64_t CountOf(const std::string& kind) const
    {
        const std::string text = metrics.Render();
        const std::string series = R"(acsd_robot_oddities_total{kind=")" + kind + R"(",robot="LR01"} )";
        const std::size_t found = text.find(series);
        return found == std::string::npos ? 0 : std::stoull(text.substr(found + series.size()));
    }

    [[nodiscard]] std::size_t CountKinds() const
    {
        const std::string text = metrics.Render();
        const std::string series = "acsd_robot_oddities_total{";
        std::size_t count = 0;
        for (std::size_t at = text.find(series); at != std::string::npos; at = text.find(series, at + 1))
        {
            ++count;
        }
        return count;
    }
};

} // namespace

TEST_CASE_METHOD(WatchFixture, "Consistent reports are not logged: states may be lost, paused and running alternate")
{
    Show();
    using E = VDA5050::EActionStatus;
    for (const E status : {E::Waiting, E::Running, E::Paused, E::Running, E::Finished, E::Finished})
    {
        ShowAction(status);
    }
    state.orderID = "O2"; // a new order counts from 0
    state.orderUpdateID = 0;
    state.lastNodeSequenceID = 0;
    ShowAction(E::Finished);
    state.lastNodeID.clear(); // it may not know yet
    Show();
    CHECK(CountKinds() == 0);
    CHECK(sink.GetLines().empty());
}

TEST_CASE_METHOD(WatchFixture, "Another version of the protocol is noted once for each version, and stays a warning")
{
    VDA5050::MasterStatistics statistics;
    for (const char* const version : {"2.0.0", "2.0.1", "2.0", "2.1.0", "2.0.0", "2.1.0", "3.0.0", "3.0.0"})
    {
        statistics.lastVersion = version;
        watch.OnStatistics(statistics);
    }
    CHECK(CountOf("version") == 2);
    CHECK(
        watch.ListWarnings()
        == std::vector<std::string>{
            "its messages have the VDA5050 version 2.1.0, robots.LR01.protocol is 2.0.0: correct one of them",
            "its messages have the VDA5050 version 3.0.0, robots.LR01.protocol is 2.0.0: correct one of them"});
    CHECK(sink.ContainsField("what", "version"));
    for (int i = 0; i < 100; ++i)
    {
        statistics.lastVersion = "9." + std::to_string(i);
        watch.OnStatistics(statistics);
    }
    CHECK(watch.ListWarnings().size() == 8);
}

TEST_CASE_METHOD(WatchFixture, "A node that the map does not have is logged and counted")
{
    state.lastNodeID = "nowhere";
    Show();
    CHECK(CountOf("unknown_node") == 1);
    CHECK(sink.ContainsField("what", "unknown_node"));
    CHECK(sink.ContainsField("detail", "nowhere"));
}

TEST_CASE_METHOD(WatchFixture, "A very long name that the vehicle reports is shortened in the log")
{
    state.lastNodeID = std::string(10'000, 'n');
    Show();
    CHECK(CountOf("unknown_node") == 1);
    CHECK(sink.ContainsField("detail", std::string(200, 'n') + "..."));
}

TEST_CASE_METHOD(WatchFixture, "A position off the map is logged; one near its border or an unknown one is not")
{
    VDA5050::AgvPosition& at = state.agvPosition.emplace();
    at.bPositionInitialized = true;
    at.x = config.site->GetNodes().front().x;
    at.y = config.site->GetNodes().front().y;
    Show();
    CHECK(CountOf("off_map") == 0);
    at.x = 1e6;
    Show();
    CHECK(CountOf("off_map") == 1);
    at.bPositionInitialized = false;
    Show();
    CHECK(CountOf("off_map") == 1);
}

TEST_CASE_METHOD(
    WatchFixture,
    "A position that no lane from the last node leads to is logged, unless the vehicle is driven by hand")
{
    const Planning::SiteEdge& edge = config.site->GetEdges().front();
    const Planning::SiteNode& end = *config.site->FindNodeOrNull(edge.endNodeID);
    state.lastNodeID = edge.startNodeID;
    VDA5050::AgvPosition& at = state.agvPosition.emplace();
    at.bPositionInitialized = true;
    at.x = end.x;
    at.y = end.y + VehicleWatch::MARGIN / 2;
    Show();
    CHECK(CountOf("far_from_node") == 0);
    at.y = end.y + VehicleWatch::MARGIN + Planning::GetDistance(*config.site->FindNodeOrNull(edge.startNodeID), end);
    Show();
    CHECK(CountOf("far_from_node") == 1);
    CHECK(CountOf("off_map") == 0);
    state.operatingMode = VDA5050::EOperatingMode::Manual;
    Show();
    state.operatingMode = VDA5050::EOperatingMode::Automatic;
    at.bPositionInitialized = false;
    Show();
    state.lastNodeID.clear();
    at.bPositionInitialized = true;
    Show();
    CHECK(CountOf("far_from_node") == 1);
}

TEST_CASE_METHOD(WatchFixture, "An action that goes backwards is logged, before and after its end")
{
    using E = VDA5050::EActionStatus;
    ShowAction(E::Running);
    ShowAction(E::Waiting);
    CHECK(CountOf("action_backwards") == 1);
    ShowAction(E::Finished);
    ShowAction(E::Running);
    CHECK(CountOf("action_backwards") == 2);
    ShowAction(E::Finished);
    ShowAction(E::Failed); // an end is an end
    CHECK(CountOf("action_backwards") == 3);
    CHECK(sink.ContainsField("detail", "J: WAITING after RUNNING"));
}

TEST_CASE_METHOD(
    WatchFixture,
    "An order whose update or node number goes backwards is logged, except after the robot was offline")
{
    Show();
    state.orderUpdateID = 0;
    state.lastNodeSequenceID = 2;
    Show();
    CHECK(CountOf("update_backwards") == 1);
    CHECK(CountOf("node_backwards") == 1);
    watch.OnAway();
    state.lastNodeSequenceID = 0;
    Show();
    CHECK(CountOf("node_backwards") == 1);
}

TEST_CASE_METHOD(WatchFixture, "Two actions of one id and a battery beyond its range are logged")
{
    state.actionStates = {
        {"J", "pick", "", VDA5050::EActionStatus::Waiting, ""},
        {"J", "pick", "", VDA5050::EActionStatus::Running, ""}};
    state.batteryState.batteryCharge = 140;
    Show();
    CHECK(CountOf("action_twice") == 1);
    CHECK(CountOf("battery_range") == 1);
}

TEST_CASE_METHOD(WatchFixture, "Messages that the session dropped are counted by kind")
{
    VDA5050::MasterStatistics statistics;
    statistics.messagesRefused = 2;
    statistics.lastRefusal = "state: operatingMode: unknown";
    statistics.statesIgnored = 1;
    watch.OnStatistics(statistics);
    statistics.messagesRefused = 3;
    statistics.retainedIgnored = 1;
    watch.OnStatistics(statistics);
    CHECK(CountOf("unreadable_message") == 3);
    CHECK(sink.ContainsField("detail", "state: operatingMode: unknown"));
    CHECK(CountOf("state_out_of_order") == 1);
    CHECK(CountOf("state_retained") == 1);
}

TEST_CASE_METHOD(WatchFixture, "Invalid answers of an arm are logged with their text")
{
    watch.OnArmEvent(OpenStream::ClientBadLine{"no JSON"});
    OpenStream::ClientErrorReported reported;
    reported.error.codeText = "monitor_internal_error";
    watch.OnArmEvent(reported);
    watch.OnArmEvent(OpenStream::ClientMonitorRefused{});
    watch.OnArmEvent(OpenStream::ClientControlFault{});
    watch.OnArmEvent(OpenStream::ClientMonitorStale{});
    watch.OnArmEvent(OpenStream::ClientReady{});
    for (const char* kind :
         {"arm_bad_line", "arm_error_line", "arm_monitor_refused", "arm_control_fault", "arm_silent"})
    {
        CHECK(CountOf(kind) == 1);
    }
    CHECK(CountKinds() == 5);
}

TEST_CASE_METHOD(
    WatchFixture,
    "A robot that repeats its error does not fill the log: the first few, then one line a minute with its count")
{
    state.lastNodeID = "nowhere";
    for (int i = 0; i < 250; ++i)
    {
        Show();
    }
    CHECK(CountOf("unknown_node") == 250);
    CHECK(sink.GetLines().size() == Apps::LogRateLimiter::BURST);
    clock.Advance(Apps::LogRateLimiter::INTERVAL);
    Show();
    CHECK(sink.GetLines().back().message == "the robot reports a contradiction (245 similar lines suppressed)");
    CHECK(sink.ContainsField("count", "251"));
}

TEST_CASE_METHOD(WatchFixture, "A load at a position that no port has is reported")
{
    REQUIRE(config.vehicles.back()->robotID == "LR01");
    VDA5050::Load load;
    load.loadPosition = "CP01";
    state.loads = {load};
    Show();
    state.loads->front().loadPosition.clear(); // of the only port
    Show();
    CHECK(CountOf("unknown_load_position") == 0);
    state.loads->front().loadPosition = "front";
    Show();
    CHECK(CountOf("unknown_load_position") == 1);
}

TEST_CASE("A factsheet that contradicts itself, or requires an unknown member of orders, is logged and counted")
{
    WatchFixture fixture;
    VDA5050::FactsheetMessage factsheet;
    factsheet.protocolFeatures.agvActions.resize(2);
    factsheet.protocolFeatures.agvActions[0].actionType = "pick";
    factsheet.protocolFeatures.agvActions[1].actionType = "drop";
    factsheet.protocolFeatures.optionalParameters = {
        {"order.edges.maxSpeed", VDA5050::EParameterSupport::Required, {}},
        {"order.nodes.nodeId", VDA5050::EParameterSupport::Required, {}},
        {"state.loads", VDA5050::EParameterSupport::Required, {}}};
    fixture.watch.OnFactsheet(factsheet);
    CHECK(fixture.CountOf("factsheet") == 0);
    SECTION("an action twice")
    {
        factsheet.protocolFeatures.agvActions[1].actionType = "pick";
    }
    SECTION("a member twice")
    {
        factsheet.protocolFeatures.optionalParameters->push_back(
            {"order.edges.maxSpeed", VDA5050::EParameterSupport::Supported, {}});
    }
    SECTION("an unknown member is required")
    {
        factsheet.protocolFeatures.optionalParameters->push_back(
            {"order.edges.colour", VDA5050::EParameterSupport::Required, {}});
    }
    fixture.watch.OnFactsheet(factsheet);
    CHECK(fixture.CountOf("factsheet") == 1);
}

} // namespace ACS::Acsd::Test
