#include "config/DriverConfig.hpp"

#include "Catch.hpp"
#include "config/AcsdConfig.hpp"
#include "config/ExampleSite.hpp"
#include "TemporaryFolder.hpp"
#include <acs/acsd/LineRobotSetup.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

class SledgeSetup final : public IRobotSetup
{
public:
    RobotCapabilities capabilities;

    [[nodiscard]] RobotCapabilities GetCapabilities() const override
    {
        return capabilities;
    }

    [[nodiscard]] std::unique_ptr<IRobot> MakeRobot(RobotServices /*services*/) const override
    {
        return nullptr; // a configuration makes no robot
    }
};

/// A driver with an option of each kind.
class SledgeDriver final : public IRobotDriver
{
    std::string _name;

public:
    explicit SledgeDriver(std::string name = "sledge")
        : _name(std::move(name))
    {
    }

    [[nodiscard]] std::string_view GetName() const noexcept override
    {
        return _name;
    }

    [[nodiscard]] std::unique_ptr<IRobotSetup> MakeSetupOrNull(const DrivenRobotConfig& config) const override
    {
        auto setup = std::make_unique<SledgeSetup>();
        setup->capabilities.types = {Planning::ERobotType::LR};
        setup->capabilities.topicPrefix = config.options.GetString("topics", "");
        const TcpAddress address = config.options.GetTcpAddress("url");
        setup->capabilities.connectionHint = fmt::format("{} at {}:{}", config.robotID, address.host, address.port);
        const std::int64_t dogs = config.options.GetInteger("dogs", 1, 12, 6);
        if (dogs == 1)
        {
            config.options.AddWarning("dogs", "one dog alone is slow");
        }
        if (dogs == 7)
        {
            config.options.AddError("dogs", "an odd team pulls to one side");
            return nullptr;
        }
        for (const auto& [action, options] : config.actions)
        {
            if (!options.IsEnabled("possible", true))
            {
                setup->capabilities.rejectedActions.emplace(action, "the sledge has no " + action);
            }
        }
        return setup;
    }
};

RobotDrivers MakeDrivers(const std::vector<std::string>& names = {"sledge"})
{
    RobotDrivers drivers = MakeBuiltInDrivers();
    std::ranges::transform(names, std::back_inserter(drivers), [](const std::string& name) {
        return std::make_unique<SledgeDriver>(name);
    });
    return drivers;
}

constexpr const char* ROBOT = R"([robots.LR01]
driver = "sledge"
type = "LR"
vehicle_type = "lr-base"
start_node = "D-CHG01"
ports = ["CP01"]
)";

constexpr const char* OPTIONS = "options.url = \"tcp://10.0.0.7:4700\"\n";

/// A configuration whose robots begin at line 8, with two actions after them.
AcsdConfig ReadDriven(
    const std::string& robots,
    const std::string& actionKeys = {},
    const std::vector<std::string>& overrides = {})
{
    const Testing::TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "acsd.toml").string();
    std::ofstream(file) << "[mcs]\nurl = \"ws://127.0.0.1:9001/acs/\"\n[site]\nmap = \"" << ACS_SITE
                        << "/site.lif.json\"\n[store]\ndirectory = \"store\"\n\n"
                        << robots << "[actions.CassetteLoad]\nrobot = \"LR\"\n"
                        << actionKeys << "[actions.CassetteUnload]\nrobot = \"LR\"\n";
    AcsdConfig config = ReadAcsdConfig(file, overrides, MakeDrivers());
    for (std::string& error : config.errors)
    {
        if (error.starts_with(file))
        {
            error = "FILE" + error.substr(file.size());
        }
    }
    return config;
}

using Errors = std::vector<std::string>;

} // namespace

TEST_CASE("A robot without the key driver is a VDA5050 vehicle, and one with an arm has Open Stream as well")
{
    const AcsdConfig config = ReadSite({});
    REQUIRE(config.errors.empty());
    CHECK(std::ranges::find(config.robots, "LR01", &RobotLinkConfig::robotID)->driver == "vda5050");
    CHECK(std::ranges::find(config.robots, "CR01", &RobotLinkConfig::robotID)->driver == "vda5050_openstream");
    CHECK(config.vehicles.size() == config.robots.size());
    CheckErrors(
        {{{"robots.CR01.driver=vda5050"}, "robots.CR01.driver: a robot with an arm has the driver vda5050_openstream"},
         {{"robots.LR01.driver=vda5050_openstream"}, "robots.LR01.arm: "}});
}

TEST_CASE("A robot of another driver needs no broker; its driver reads its options")
{
    const AcsdConfig config = ReadDriven(std::string(ROBOT) + OPTIONS);
    REQUIRE(config.errors == Errors{});
    CHECK(config.warnings == Errors{});
    CHECK_FALSE(config.mqtt.has_value());
    REQUIRE(config.robots.size() == 1);
    CHECK(config.vehicles.empty());
    CHECK(config.robots[0].driver == "sledge");
    CHECK(config.robots[0].setupOrNull != nullptr);
    CHECK(config.engine.robots[0].connectionHint == "LR01 at 10.0.0.7:4700");
    CHECK(config.engine.robots[0].rejectedActions.empty());
}

TEST_CASE("An unknown driver is an error with its line and the known drivers, and the only one of the robot")
{
    CHECK(
        ReadDriven(
            "[robots.LR01]\ntype = \"LR\"\ndriver = \"sled\"\nvehicle_type = \"lr-base\"\nstart_node = "
            "\"D-CHG01\"\nserial = \"1\"\noptions.speed = 3\n",
            "options.x = 1\n")
            .errors
        == Errors{"FILE:10: robots.LR01.driver: this acsd has no driver \"sled\"; it has vda5050, "
                  "vda5050_openstream, sledge"});
}

TEST_CASE("Unknown, missing and wrong options are errors with line and key")
{
    const std::string robot = ROBOT; // lines 8 to 13
    CHECK(
        ReadDriven(robot + "options.url = \"tcp://h:1\"\noptions.colour = \"red\"\n").errors
        == Errors{"FILE:15: robots.LR01.options.colour: unknown key; allowed here: dogs, topics, url"});
    CHECK(
        ReadDriven(robot + OPTIONS + "options.dogs = \"six\"\n").errors
        == Errors{"FILE:15: robots.LR01.options.dogs: expected an integer from 1 to 12, found the string 'six'"});
    CHECK(
        ReadDriven(robot + OPTIONS + "options.dogs = 7\n").errors
        == Errors{"FILE:15: robots.LR01.options.dogs: an odd team pulls to one side"});
    const Errors missing = ReadDriven(robot).errors; // the line of the robot's table
    REQUIRE(missing.size() == 1);
    CHECK_THAT(missing[0], Catch::StartsWith("FILE:8: robots.LR01.options.url: missing; give "));
    const Errors noTable = ReadDriven(robot + "options = 3\n").errors;
    REQUIRE_FALSE(noTable.empty());
    CHECK(noTable[0] == "FILE:14: robots.LR01.options: expected a table, found the integer 3");
    CHECK(
        ReadDriven(robot + OPTIONS, "options.possible = 1\n").errors
        == Errors{"FILE:17: actions.CassetteLoad.options.possible: expected true or false, found the integer 1"});
    CHECK_THAT(
        ReadDriven(robot + OPTIONS + "serial = \"1\"\n").errors.at(0),
        Catch::StartsWith("FILE:15: robots.LR01.serial: unknown key"));
    CHECK_THAT(
        ReadDriven(robot + OPTIONS, {}, {"robots.LR01.options.dogs=0"}).errors.at(0),
        Catch::StartsWith("--set: robots.LR01.options.dogs: expected an integer from 1 to 12"));
}

TEST_CASE("A driver warns of valid options")
{
    const AcsdConfig config = ReadDriven(std::string(ROBOT) + OPTIONS + "options.dogs = 1\n");
    CHECK(config.errors == Errors{});
    CHECK(config.warnings == Errors{"robots.LR01.options.dogs: one dog alone is slow"});
}

TEST_CASE("The type of a robot is one that its driver has")
{
    const std::string robot = ROBOT;
    const std::string control = "[robots.CR01]\ndriver = \"sledge\"\ntype = \"CR\"\nvehicle_type = \"cr-base\"\n"
                                "start_node = \"D-CHG02\"\nports = [\"TP01\"]\n";
    CHECK(
        ReadDriven(robot + OPTIONS + control + OPTIONS).errors
        == Errors{"FILE:17: robots.CR01.type: the driver sledge has robots of type LR only, found CR"});
}

TEST_CASE("An action that the driver rejects is not given to the robot; one that no robot can do is an error")
{
    const std::string robot = std::string(ROBOT) + OPTIONS;
    CHECK(
        ReadDriven(robot, "options.possible = false\n").errors
        == Errors{"FILE:15: actions.CassetteLoad: no robot can do it, LR01: the sledge has no CassetteLoad; give "
                  "arm_program for robots with an arm, vehicle_action for those without, options for those of other "
                  "drivers"});
    const std::string other = "[robots.LR02]\ndriver = \"sledge\"\ntype = \"LR\"\nvehicle_type = \"lr-base\"\n"
                              "start_node = \"N001\"\nports = [\"CP01\"]\n";
    CHECK(ReadDriven(robot + other + OPTIONS).errors == Errors{});
}

TEST_CASE("Keys of vehicles and arms are an error for an action that only robots of other drivers do")
{
    const Errors errors = ReadDriven(std::string(ROBOT) + OPTIONS, "vehicle_action = \"pick\"\n").errors;
    REQUIRE(errors.size() == 1);
    CHECK_THAT(errors[0], Catch::StartsWith("FILE:17: actions.CassetteLoad.vehicle_action: has no effect"));
    CheckErrors({{{"actions.CassetteLoad.options={x=1}"}, "actions.CassetteLoad.options: unknown key"}});
}

TEST_CASE("mqtt is required with a vehicle, and without effect otherwise")
{
    const std::string vehicle = "[robots.LR02]\ntype = \"LR\"\nvehicle_type = \"lr-base\"\nstart_node = \"N001\"\n"
                                "ports = [\"CP01\"]\nmanufacturer = \"ACS\"\nserial = \"1\"\n";
    const std::string both = std::string(ROBOT) + OPTIONS + vehicle;
    const std::string action = "vehicle_action = \"pick\"\n";
    const Errors missing = ReadDriven(both, action).errors;
    REQUIRE(missing.size() == 1);
    CHECK_THAT(missing[0], Catch::StartsWith("FILE: mqtt.url: missing; give "));

    const AcsdConfig mixed = ReadDriven(both, action, {"mqtt.url=mqtt://127.0.0.1:1883"});
    CHECK(mixed.errors == Errors{});
    CHECK(mixed.mqtt.has_value());

    const AcsdConfig needless = ReadDriven(std::string(ROBOT) + OPTIONS, {}, {"mqtt.url=mqtt://127.0.0.1:1883"});
    CHECK(needless.errors == Errors{});
    CHECK_FALSE(needless.mqtt.has_value());
    CHECK(
        needless.warnings
        == Errors{"mqtt: has no effect, because no robot has a driver that uses the broker; remove it"});
}

TEST_CASE("mqtt is required with a driver that declares topics, and each robot has its own")
{
    const std::string robot = std::string(ROBOT) + OPTIONS + "options.topics = \"sledges/1\"\n";
    const Errors missing = ReadDriven(robot).errors;
    REQUIRE(missing.size() == 1);
    CHECK_THAT(missing[0], Catch::StartsWith("FILE: mqtt.url: missing; give "));

    const std::vector<std::string> broker{"mqtt.url=mqtt://127.0.0.1:1883"};
    const AcsdConfig config = ReadDriven(robot, {}, broker);
    CHECK(config.errors == Errors{});
    CHECK(config.warnings == Errors{});
    CHECK(config.mqtt.has_value());
    CHECK(config.robots.at(0).topicPrefix == "sledges/1");

    const std::string second = "[robots.LR02]\ndriver = \"sledge\"\ntype = \"LR\"\nvehicle_type = \"lr-base\"\n"
                               "start_node = \"N001\"\nports = [\"CP01\"]\n";
    CHECK(
        ReadDriven(robot + second + OPTIONS + "options.topics = \"sledges/1\"\n", {}, broker).errors
        == Errors{"FILE:16: robots.LR02: LR01 has the same topics on the broker (sledges/1): give each robot its own"});
    for (const std::string topics : {"sledges/+", "#", "sledges/2/"})
    {
        CHECK(
            ReadDriven(fmt::format("{}{}{}options.topics = \"{}\"\n", robot, second, OPTIONS, topics), {}, broker)
                .errors
            == Errors{fmt::format(
                "FILE:22: robots.LR02.options: the driver sledge declares the topics {}, with a wildcard or with '/' at the end",
                topics)});
    }
}

TEST_CASE("The name of a driver is valid, not built in and used once")
{
    CHECK(FindDriverFaultOrNull(MakeDrivers()) == std::nullopt);
    CHECK(FindDriverFaultOrNull(MakeDrivers({"a", "b_2"})) == std::nullopt);
    for (const char* name : {"", "Sledge", "2nd", "sled-ge", "a23456789012345678901234567890123"})
    {
        INFO(name);
        CHECK_THAT(FindDriverFaultOrNull(MakeDrivers({name})).value_or(""), Catch::Contains("needs a name of 1 to 32"));
    }
    for (const std::vector<std::string>& names : {Errors{"vda5050"}, Errors{"vda5050_openstream"}, Errors{"a", "a"}})
    {
        CHECK_THAT(
            FindDriverFaultOrNull(MakeDrivers(names)).value_or(""),
            Catch::Contains("two robot drivers have the name " + names.back()));
    }
    RobotDrivers drivers;
    drivers.push_back(nullptr);
    CHECK(FindDriverFaultOrNull(drivers) == "a robot driver is null");
}

TEST_CASE("The options of a robot that speaks lines are its address and the time limit of its silence")
{
    using namespace std::chrono_literals;
    const LineClientOptions fallback = ReadLineOptions(OptionTable::ReadText("url = 'tcp://cart:4700'\n", "x.toml"));
    CHECK(fallback.host == "cart");
    CHECK(fallback.port == 4700);
    CHECK(fallback.receiveTimeout == 5s);
    const auto read = [](const std::string& timeout) {
        const OptionTable table =
            OptionTable::ReadText("url = 'tcp://cart:4700'\nreceive_timeout = '" + timeout + "'\n", "x.toml");
        const std::chrono::milliseconds limit = ReadLineOptions(table).receiveTimeout;
        return std::pair(limit, table.GetErrors());
    };
    CHECK(read("0s") == std::pair(std::chrono::milliseconds(0), Errors{}));
    CHECK(read("100ms") == std::pair(std::chrono::milliseconds(100), Errors{}));
    CHECK(
        read("99ms").second
        == Errors{"x.toml:2: receive_timeout: expected '0s' or a duration from '100ms' to '1h', found '99ms'"});
    CHECK_THAT(read("2h").second.at(0), Catch::StartsWith("x.toml:2: receive_timeout: expected a duration from '"));

    for (const std::string url :
         {"tcp://cart", "tcp://[::1]", "tcp://cart:", "tcp://cart:0", "tcp://cart:99999", "", "http://cart:1"})
    {
        const OptionTable table = OptionTable::ReadText("url = '" + url + "'\n", "x.toml");
        static_cast<void>(table.GetTcpAddress("url"));
        CHECK(table.GetErrors() == Errors{"x.toml:1: url: expected tcp://HOST:PORT, found '" + url + "'"});
    }
    const OptionTable ipv6 = OptionTable::ReadText("url = 'tcp://[::1]:7'\n", "x.toml");
    CHECK(ipv6.GetTcpAddress("url").port == 7);
    CHECK(ipv6.GetErrors().empty());

    const LineRobotSetup setup({{Planning::ERobotType::CR}, {}, {}}, fallback, {});
    CHECK(setup.GetCapabilities().connectionHint == "It is expected at cart:4700.");
    CHECK(LineRobotSetup({{}, {}, "Look."}, fallback, {}).GetCapabilities().connectionHint == "Look.");
}

TEST_CASE("A driver's own test reads its options from a text")
{
    const OptionTable table = OptionTable::ReadText("speed = 1.5\nmodes = ['a', 'b']\nlamp.on = 3\n", "x.toml");
    CHECK(table.GetNumber("speed", 0, 2) == 1.5);
    CHECK(table.GetStringList("modes") == std::vector<std::string>{"a", "b"});
    const OptionTable lamp = table.GetTable("lamp");
    CHECK_FALSE(lamp.IsEnabled("on", false));
    lamp.AddWarning("on", "is bright");
    table.AddWarning("", "is short");
    CHECK(table.GetWarnings() == Errors{"lamp.on: is bright", ": is short"});
    CHECK(lamp.GetErrors() == Errors{"x.toml:3: lamp.on: expected true or false, found the integer 3"});
}

} // namespace ACS::Acsd::Test
