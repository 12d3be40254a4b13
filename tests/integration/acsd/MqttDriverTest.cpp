#include "Acsd.hpp"
#include "Catch.hpp"
#include "common/process/SystemClock.hpp"
#include "LinkFixture.hpp"
#include "operator/HttpAddresses.hpp"
#include "TemporaryFolder.hpp"
#include <acs/acsd/IRobotDriver.hpp>

#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// Decides nothing: its robot is not commanded.
class BuoyAdapter final : public Planning::IRobotAdapter
{
public:
    void Handle(const Planning::RobotCommand& /*command*/, Core::Now /*now*/, Planning::AdapterActions& /*out*/)
        override
    {
    }

    void OnTimer(Planning::AdapterTimerID /*timer*/, Core::Now /*now*/, Planning::AdapterActions& /*out*/) override
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }
};

/// A robot that reports its node as plain text on PREFIX/node, and receives "seen NODE" on PREFIX/answer.
class BuoyRobot final : public IRobot, private VDA5050::IMqttLinkListener
{
    RobotServices _services;
    std::string _topics;
    BuoyAdapter _adapter;

public:
    BuoyRobot(RobotServices services, std::string topics)
        : _services(std::move(services)),
          _topics(std::move(topics))
    {
        _services.metrics.AddCounter("nodes_total", "Nodes received");
    }

    [[nodiscard]] Planning::IRobotAdapter& GetAdapter() noexcept override
    {
        return _adapter;
    }

    void Start() override
    {
        _services.mqttOrNull->SetListener(this);
        _services.mqttOrNull->Subscribe({{_topics + "/node", 1}});
    }

    void Stop() override
    {
    }

    void OnAdapterCalled() override
    {
    }

    void UpdateMetrics() override
    {
    }

private:
    void OnLinkUp() override
    {
    }

    void OnLinkDown(std::error_code /*reason*/) override
    {
        _services.call([](Core::Now /*now*/, Planning::AdapterActions& out) {
            out.emplace_back(Planning::RaiseEvent{Planning::LinkChanged{false}});
        });
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        _services.call([&message](Core::Now /*now*/, Planning::AdapterActions& out) {
            Planning::StateChanged state;
            state.lastNodeID = message.payload;
            state.bAutomatic = true;
            out.emplace_back(Planning::RaiseEvent{Planning::LinkChanged{true}});
            out.emplace_back(Planning::RaiseEvent{state});
        });
        _services.metrics.Increment("nodes_total", {});
        static_cast<void>(_services.mqttOrNull->Publish({_topics + "/answer", "seen " + message.payload, 1, false}));
    }
};

class BuoySetup final : public IRobotSetup
{
    std::string _topics;

public:
    explicit BuoySetup(std::string topics)
        : _topics(std::move(topics))
    {
    }

    [[nodiscard]] RobotCapabilities GetCapabilities() const override
    {
        return {{Planning::ERobotType::LR}, {}, {}, _topics};
    }

    [[nodiscard]] std::unique_ptr<IRobot> MakeRobot(RobotServices services) const override
    {
        return std::make_unique<BuoyRobot>(std::move(services), _topics);
    }
};

class BuoyDriver final : public IRobotDriver
{
public:
    [[nodiscard]] std::string_view GetName() const noexcept override
    {
        return "buoy";
    }

    [[nodiscard]] std::unique_ptr<IRobotSetup> MakeSetupOrNull(const DrivenRobotConfig& config) const override
    {
        return std::make_unique<BuoySetup>(config.options.GetString("topics"));
    }
};

/// acsd with two robots of that driver, and the connection of their program.
struct BuoyFixture
{
    boost::asio::io_context context;
    Testing::MosquittoBroker broker;
    Testing::TemporaryFolder folder;
    Apps::SystemClock clock;
    Testing::SeededRandom random{1};
    Testing::RecordingLogSink log;
    std::optional<HttpAddresses> addresses;
    std::unique_ptr<Acsd> acsd;
    Testing::TestLink robots{context, Testing::MakeOptions(broker.GetPort(), "robots")};

    BuoyFixture()
    {
        const std::string file = (folder.GetPath() / "acsd.toml").string();
        std::ofstream(file) << "[mcs]\nurl = \"ws://127.0.0.1:9/acs/\"\n[site]\nmap = \"" << ACS_SITE
                            << "/site.lif.json\"\n[store]\ndirectory = \"store\"\n[http]\nlisten = \"127.0.0.1:0\"\n"
                               "[operator]\nlisten = \"127.0.0.1:0\"\n[mqtt]\nurl = \"mqtt://127.0.0.1:"
                            << broker.GetPort() << "\"\n[actions.CassetteLoad]\nrobot = \"LR\"\n"
                            << MakeRobot("LR01", "D-CHG01") << MakeRobot("LR02", "N001");
        RobotDrivers drivers;
        drivers.push_back(std::make_unique<BuoyDriver>());
        AcsdConfig config = ReadAcsdConfig(file, {}, drivers);
        REQUIRE(config.errors == std::vector<std::string>{});
        Acsd::Dependencies
            dependencies{context.get_executor(), clock, random, Core::Logger(log, "acsd"), nullptr, {}, {}};
        auto store = OpenDirectoryStore(config.store);
        REQUIRE(store.has_value());
        addresses.emplace(dependencies.executor, dependencies.logger, config.http);
        auto created = Acsd::Create(std::move(dependencies), *addresses, std::move(config), std::move(*store));
        REQUIRE(created.has_value());
        acsd = std::move(*created);
        robots.link.Subscribe({{"buoys/+/answer", 1}});
        robots.link.Start();
        acsd->Start();
    }

    [[nodiscard]] static std::string MakeRobot(const std::string& robotID, const std::string& node)
    {
        return "[robots." + robotID + "]\ndriver = \"buoy\"\ntype = \"LR\"\nvehicle_type = \"lr-base\"\nstart_node = \""
            + node + "\"\nports = [\"CP01\"]\noptions.topics = \"buoys/" + robotID + "\"\n";
    }

    [[nodiscard]] bool TryAwaitAnswer(const std::string& topic, const std::string& text)
    {
        return Testing::TryRunUntil(context, [&] {
            return std::ranges::any_of(robots.listener.messages, [&](const VDA5050::MqttMessage& message) {
                return message.topic == topic && message.payload == text;
            });
        });
    }
};

} // namespace

TEST_CASE("Robots of a driver that uses the broker receive their messages, and answer")
{
    BuoyFixture fixture;
    REQUIRE(Testing::TryRunUntil(fixture.context, [&] { return fixture.robots.listener.ups == 1; }));
    // Retained: acsd may subscribe later.
    for (const char* topic : {"buoys/LR01/node", "buoys/LR02/node", "buoys/LR03/node"})
    {
        REQUIRE(fixture.robots.link.Publish({topic, std::string(topic).substr(6, 4), 1, true}).has_value());
    }
    CHECK(fixture.TryAwaitAnswer("buoys/LR01/answer", "seen LR01"));
    CHECK(fixture.TryAwaitAnswer("buoys/LR02/answer", "seen LR02"));
    bool bStopped = false;
    fixture.acsd->StopAsync([&bStopped] { bStopped = true; });
    CHECK(Testing::TryRunUntil(fixture.context, [&bStopped] { return bStopped; }));
    CHECK(fixture.robots.listener.messages.size() == 2);
}

} // namespace ACS::Acsd::Test
