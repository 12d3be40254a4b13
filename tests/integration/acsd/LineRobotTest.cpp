#include "Catch.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "drivers/RobotRunner.hpp"
#include "LinePeer.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include <acs/acsd/ILineAdapter.hpp>
#include <acs/acsd/LineRobot.hpp>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using namespace std::chrono_literals;

/// Reports each line as a state whose node is the line. "ask" is answered at once, "later" by a timer.
class EchoAdapter final : public ILineAdapter
{
    std::vector<std::string> _lines;

public:
    void Handle(const Planning::RobotCommand& command, Core::Now /*now*/, Planning::AdapterActions& /*out*/) override
    {
        _lines.emplace_back(std::holds_alternative<Planning::Pause>(command) ? "pause" : "other");
    }

    void OnTimer(Planning::AdapterTimerID timer, Core::Now /*now*/, Planning::AdapterActions& /*out*/) override
    {
        _lines.push_back("timer " + std::to_string(timer));
    }

    void OnLinkUp(Core::Now /*now*/, Planning::AdapterActions& out) override
    {
        out.emplace_back(Planning::RaiseEvent{Planning::LinkChanged{true}});
    }

    void OnLinkDown(Core::Now /*now*/, Planning::AdapterActions& out) override
    {
        out.emplace_back(Planning::RaiseEvent{Planning::LinkChanged{false}});
    }

    void OnLine(std::string_view line, Core::Now /*now*/, Planning::AdapterActions& out) override
    {
        if (line == "later")
        {
            out.emplace_back(Planning::StartAdapterTimer{7, 1ms});
            out.emplace_back(Planning::StartAdapterTimer{8, 1ms});
            out.emplace_back(Planning::CancelAdapterTimer{8});
        }
        else if (line == "throw")
        {
            throw std::out_of_range("map::at");
        }
        else
        {
            Planning::StateChanged state;
            state.lastNodeID = line;
            state.batteryPercent = line == "bad" ? std::numeric_limits<double>::quiet_NaN() : 50;
            state.loads = std::vector<Planning::PortLoad>{{line == "bad" ? "XX99.CP01" : "LR01.CP01", false, ""}};
            out.emplace_back(Planning::RaiseEvent{state});
        }
    }

    [[nodiscard]] std::vector<std::string> TakeLines() override
    {
        return std::exchange(_lines, {});
    }
};

class EchoSetup final : public IRobotSetup
{
    LineClientOptions _options;

public:
    explicit EchoSetup(LineClientOptions options)
        : _options(std::move(options))
    {
    }

    [[nodiscard]] RobotCapabilities GetCapabilities() const override
    {
        return {};
    }

    [[nodiscard]] std::unique_ptr<IRobot> MakeRobot(RobotServices services) const override
    {
        return std::make_unique<LineRobot>(std::move(services), _options, std::make_unique<EchoAdapter>());
    }
};

/// A driven robot, its peer, and the events that it raised as text.
struct LineRobotFixture
{
    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::SeededRandom random{1};
    Testing::RecordingLogSink log;
    Apps::MetricsEndpoint metrics;
    LinePeer peer{context, 0};
    std::vector<std::string> events;
    RobotRunner robot{
        {context.get_executor(), clock, random, Core::Logger(log, "acsd"), metrics, nullptr},
        MakeLink(),
        [this](const std::string& robotID, const Planning::RobotEvent& event) {
            OnEvent(robotID, event);
        }};

    [[nodiscard]] RobotLinkConfig MakeLink() const
    {
        LineClientOptions options;
        options.host = "127.0.0.1";
        options.port = peer.GetPort();
        options.backoff = {1ms, 5ms, 2.0, 0.5};
        RobotLinkConfig link;
        link.robotID = "LR01";
        link.driver = "echo";
        link.ports = {"LR01.CP01"};
        link.setupOrNull = std::make_shared<EchoSetup>(options);
        return link;
    }

    void OnEvent(const std::string& robotID, const Planning::RobotEvent& event)
    {
        if (const auto* link = std::get_if<Planning::LinkChanged>(&event))
        {
            events.push_back(robotID + (link->bOnline ? " online" : " offline"));
        }
        else if (const auto* state = std::get_if<Planning::StateChanged>(&event))
        {
            events.push_back(robotID + " at " + state->lastNodeID);
            if (state->lastNodeID == "N1")
            {
                robot.Handle(Planning::Pause{}); // as the engine does, from within the event
            }
        }
    }

    void AwaitEvents(std::size_t count)
    {
        REQUIRE(peer.TryRunUntil([&] { return events.size() == count; }));
    }

    void AwaitLines(const std::string& text)
    {
        REQUIRE(peer.TryRunUntil([&] { return peer.received == text; }));
    }
};

using Events = std::vector<std::string>;

} // namespace

TEST_CASE("A line robot passes lines, commands and timers to its adapter, and sends the lines of the adapter")
{
    LineRobotFixture fixture;
    fixture.robot.Handle(Planning::Resume{}); // without a connection its line is dropped
    fixture.robot.Start();
    REQUIRE(fixture.peer.TryRunUntil([&] { return fixture.events.size() == 1 && fixture.peer.accepted == 1; }));
    fixture.robot.Handle(Planning::Pause{});
    fixture.AwaitLines("pause\n");
    fixture.peer.Send("N1\n");
    fixture.AwaitEvents(2);
    fixture.AwaitLines("pause\npause\n");
    fixture.peer.Send("later\n");
    fixture.AwaitLines("pause\npause\ntimer 7\n"); // 8 was cancelled
    fixture.peer.Close();
    fixture.AwaitEvents(4);
    CHECK(fixture.events == Events{"LR01 online", "LR01 at N1", "LR01 offline", "LR01 online"});

    fixture.robot.UpdateMetrics();
    const std::string text = fixture.metrics.Render();
    CHECK_THAT(text, Catch::Contains("acsd_driver_echo_connected{robot=\"LR01\"} 1"));
    CHECK_THAT(text, Catch::Contains("acsd_driver_echo_connects_total{robot=\"LR01\"} 2"));
    CHECK_THAT(text, Catch::Contains("acsd_driver_echo_lines_received_total{robot=\"LR01\"} 2"));

    fixture.robot.Stop();
    fixture.robot.Handle(Planning::Pause{});
    fixture.context.restart();
    fixture.context.run_for(20ms);
    CHECK(fixture.events.size() == 4);
    CHECK(fixture.peer.received == "pause\npause\ntimer 7\n");
}

TEST_CASE("A robot that sends one line on each connection is logged once, until a connection lasts")
{
    LineRobotFixture fixture;
    fixture.robot.Start();
    for (std::size_t connection = 1; connection <= 3; ++connection)
    {
        REQUIRE(fixture.peer.TryRunUntil(
            [&] { return fixture.events.size() == 3 * connection - 2 && fixture.peer.accepted == connection; }));
        fixture.peer.Send("N2\n");
        fixture.AwaitEvents(3 * connection - 1);
        fixture.peer.Close();
        fixture.AwaitEvents(3 * connection);
    }
    CHECK(fixture.log.CountLevel(Core::ELogLevel::Warning) == 1);
    CHECK(fixture.log.CountLevel(Core::ELogLevel::Info) == 1);
    REQUIRE(fixture.peer.TryRunUntil([&] { return fixture.peer.accepted == 4 && fixture.events.size() == 10; }));
    fixture.clock.Advance(LineClient::STABLE_AFTER);
    fixture.peer.Send("N2\n");
    fixture.AwaitEvents(11);
    CHECK(fixture.log.CountLevel(Core::ELogLevel::Info) == 2);
    fixture.peer.Close();
    fixture.AwaitEvents(12);
    CHECK(fixture.log.CountLevel(Core::ELogLevel::Warning) == 2);
}

TEST_CASE("A robot that was stopped is not asked for its metrics and details any more")
{
    /// Has released everything in Stop.
    class FragileRobot final : public IRobot
    {
        std::unique_ptr<EchoAdapter> _adapter = std::make_unique<EchoAdapter>();

    public:
        [[nodiscard]] Planning::IRobotAdapter& GetAdapter() noexcept override
        {
            return *_adapter;
        }
        void Start() override
        {
        }
        void Stop() override
        {
            _adapter.reset();
        }
        void OnAdapterCalled() override
        {
        }
        void UpdateMetrics() override
        {
            CHECK(_adapter != nullptr);
        }
        [[nodiscard]] DriverDetails GetDetails() const override
        {
            CHECK(_adapter != nullptr);
            return {{"a warning"}, {}};
        }
    };
    struct FragileSetup final : IRobotSetup
    {
        [[nodiscard]] RobotCapabilities GetCapabilities() const override
        {
            return {};
        }
        [[nodiscard]] std::unique_ptr<IRobot> MakeRobot(RobotServices /*services*/) const override
        {
            return std::make_unique<FragileRobot>();
        }
    };
    LineRobotFixture fixture;
    RobotLinkConfig link = fixture.MakeLink();
    link.setupOrNull = std::make_shared<FragileSetup>();
    const Core::Logger logger(fixture.log, "acsd");
    RobotRunner robot(
        {fixture.context.get_executor(), fixture.clock, fixture.random, logger, fixture.metrics, nullptr},
        link,
        {});
    CHECK(robot.GetDetails().warnings.size() == 1);
    robot.UpdateMetrics();
    robot.Stop();
    robot.UpdateMetrics();
    CHECK(robot.GetDetails().warnings.empty());
}

TEST_CASE("A robot without instant actions refuses a requested one and offers none")
{
    LineRobotFixture fixture;
    CHECK(fixture.robot.ListActionOffers().empty());
    CHECK(
        fixture.robot.RequestAction({"beep", {}}, {}).error()
        == RobotActionRefusal{false, "Robots of the driver echo have no instant actions."});
    CHECK(fixture.robot.GetActions().empty());
}

TEST_CASE("What acsd ignores in the states of a robot is logged once for each kind, and the robot stays connected")
{
    LineRobotFixture fixture;
    fixture.robot.Start();
    REQUIRE(fixture.peer.TryRunUntil([&] { return fixture.events.size() == 1 && fixture.peer.accepted == 1; }));
    fixture.peer.Send("N2\nbad\nbad\n");
    fixture.AwaitEvents(4);
    CHECK(fixture.log.Contains(Core::ELogLevel::Warning, "a value of the robot's state is ignored"));
    CHECK(fixture.log.CountLevel(Core::ELogLevel::Warning) == 2);
    CHECK(fixture.log.ContainsField("reason", "the battery nan % is not from 0 to 100"));
    CHECK(fixture.log.ContainsField("reason", "loads of the port 'XX99.CP01', which the robot does not have"));
    CHECK(fixture.log.ContainsField("robotId", "LR01"));
}

TEST_CASE("An exception that leaves an adapter names the robot and its driver")
{
    LineRobotFixture fixture;
    fixture.robot.Start();
    REQUIRE(fixture.peer.TryRunUntil([&] { return fixture.events.size() == 1 && fixture.peer.accepted == 1; }));
    fixture.peer.Send("throw\n");
    CHECK_THROWS_WITH(
        fixture.peer.TryRunUntil([] { return false; }),
        "the adapter of the robot LR01 (driver echo) has thrown: map::at");
}

TEST_CASE("The loss of a connection is logged once, with the peer and the reason")
{
    LineRobotFixture fixture;
    fixture.robot.Start();
    for (std::size_t connection = 1; connection <= 3; ++connection)
    {
        REQUIRE(fixture.peer.TryRunUntil(
            [&] { return fixture.events.size() == 2 * connection - 1 && fixture.peer.accepted == connection; }));
        fixture.peer.Close();
        fixture.AwaitEvents(2 * connection);
    }
    std::size_t warnings = 0;
    for (const Testing::RecordedLine& line : fixture.log.GetLines())
    {
        warnings += line.level == Core::ELogLevel::Warning ? 1U : 0U;
        CHECK(line.HasField("robot", "127.0.0.1:" + std::to_string(fixture.peer.GetPort())));
        CHECK(line.component == "robot.LR01");
    }
    CHECK(warnings == 1);
}

} // namespace ACS::Acsd::Test
