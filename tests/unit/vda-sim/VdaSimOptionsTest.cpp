#include "vda-sim/VdaSimOptions.hpp"

#include "Catch.hpp"
#include "TemporaryFolder.hpp"
#include "vda-sim/VdaSim.hpp"
#include "VehicleDriver.hpp"

#include <fstream>
#include <iostream>
#include <sstream>

namespace ACS::Testing
{

using VdaSim::EVehicleType;
using VdaSim::VehicleSpec;

TEST_CASE("A vehicle is its name, and optionally its type and its node, in any order")
{
    CHECK(VdaSim::ParseVehicleSpec("LR01") == VehicleSpec{"LR01", EVehicleType::Logistics, {}, {}, 100.0});
    CHECK(VdaSim::ParseVehicleSpec("CR01,type=CR") == VehicleSpec{"CR01", EVehicleType::Control, {}, {}, 100.0});
    CHECK(VdaSim::ParseVehicleSpec("X,node=N1,type=LR") == VehicleSpec{"X", EVehicleType::Logistics, "N1", {}, 100.0});
    CHECK(
        VdaSim::ParseVehicleSpec("X,battery=7.5,protocol=2.1.0")
        == VehicleSpec{"X", EVehicleType::Logistics, {}, VDA5050::EVda5050Version::Version210, 7.5});
    CHECK(VdaSim::ParseVehicleSpec("X,position=-1.5:20").value().startPosition == VdaSim::StartPosition{-1.5, 20.0});
}

TEST_CASE("A vehicle may have its own number of ports, names of them, action types and parameters")
{
    const VdaSim::LoadHandling handling =
        VdaSim::ParseVehicleSpec("A,ports=2,load=CP02:rear,drop=unload,lhd=arm:INTEGER,side=").value().handling;
    CHECK(
        VdaSim::GetLoadPositions(EVehicleType::Logistics, handling)
        == std::vector<VdaSim::LoadPosition>{{"CP01", "CP01"}, {"CP02", "rear"}});
    CHECK(handling.pickType == "pick");
    CHECK(handling.dropType == "unload");
    CHECK(handling.GetParameterName("lhd") == "arm");
    CHECK(handling.GetParameterName("side").empty());
    CHECK(handling.GetParameterName("loadId") == "loadId");
    CHECK(VdaSim::GetLoadPositions(EVehicleType::Logistics).size() == 4);
    CHECK(VdaSim::GetLoadPositions(EVehicleType::Control).empty());
    CHECK(VdaSim::ParseVehicleSpec("A,lhd=side,side=lhd").has_value());
}

TEST_CASE("An invalid vehicle is refused with what is expected")
{
    for (const std::string text :
         {"",
          ",type=LR",
          "A/B",
          "A B",
          "$A",
          "A$",
          "A\tB",
          "A\x7F",
          "M\xC3\xBCller",
          "A*",
          "A=B",
          "A+",
          "A,type=",
          "A,type=lr",
          "A,node=",
          "A,speed=3",
          "A,protocol=3.0.0",
          "A,position=",
          "A,position=1",
          "A,position=1:",
          "A,position=1:2:3",
          "A,position=nan:1",
          "A,battery=101",
          "A,battery=-1",
          "A,battery=nan",
          "A,battery=5%",
          "A,profile=",
          "A,profile=fast",
          "A,profile=blocking,profile=blocking",
          "A,type=LR,type=CR",
          "A,node=N1,node=N2",
          "A,ports=",
          "A,ports=100",
          "A,ports=2,ports=3",
          "A,load=CP01",
          "A,load=CP01:",
          "A,load=CP05:front",
          "A,load=CP01:one,load=CP01:two",
          "A,load=CP01:one,load=CP02:one",
          "A,load=CP01:CP02",
          "A,type=CR,load=CP01:front",
          "A,pick=",
          "A,pick=drop",
          "A,pick=cancelOrder",
          "A,pick=same,drop=same",
          "A,lhd",
          "A,lhd=side",
          "A,lhd=one,side=one",
          "A,lhd=one two",
          "A,lhd=one:TEXT",
          "A,triggerType=one",
          "A,type=CR,pick=grab",
          "A,type=CR,drop=put",
          "A,type=CR,lhd=arm",
          "A,ports=0,side=",
          "A,,"})
    {
        CAPTURE(text);
        const Core::Result<VehicleSpec> spec = VdaSim::ParseVehicleSpec(text);
        REQUIRE_FALSE(spec.has_value());
        CHECK_FALSE(spec.error().expected.empty());
    }
}

TEST_CASE("An error in a vehicle's keys names the vehicle")
{
    const auto describe = [](std::string_view text) {
        return Core::Describe(VdaSim::ParseVehicleSpec(text).error());
    };
    CHECK(describe("LR07,ports=100") == "LR07: ports: expected a number from 0 to 99, found \"100\"");
    CHECK_THAT(describe("LR07,load=CP05:front"), Catch::StartsWith("LR07: load: expected one of the 4 ports"));
    CHECK(
        describe("CR07,type=CR,pick=grab")
        == "CR07: pick: expected ports=N too, because the vehicle has no load positions and neither picks nor drops");
    CHECK_THAT(describe("LR07,type=XR"), Catch::StartsWith("LR07: type: expected LR or CR"));
    CHECK_THAT(describe("LR07,speed=3"), Catch::StartsWith("LR07: expected type=LR|CR"));
}

TEST_CASE("A vehicle starts at its own node, else at the charger of its number, else at a node of the site")
{
    const Planning::SiteMap site = MakeTestSite();
    VehicleSpec vehicle;
    vehicle.name = "A";
    CHECK(VdaSim::GetStartNode(vehicle, 0, site) == "DOCK");
    CHECK(VdaSim::GetStartNode(vehicle, 1, site) == "N1");
    CHECK(VdaSim::GetStartNode(vehicle, 4, site) == "N0");
    vehicle.startNodeID = "N2";
    CHECK(VdaSim::GetStartNode(vehicle, 0, site) == "N2");
    vehicle.startNodeID = "N9";
    const auto unknown = VdaSim::GetStartNode(vehicle, 0, site);
    REQUIRE_FALSE(unknown.has_value());
    CHECK(unknown.error() == "vehicle A: the site has no node N9");
}

TEST_CASE("A site file that is missing is named")
{
    std::vector<std::string> warnings;
    const auto site = VdaSim::LoadSite("/nonexistent/site.lif.json", warnings);
    REQUIRE_FALSE(site.has_value());
    CHECK_THAT(site.error(), Catch::Contains("/nonexistent/site.lif.json"));
    CHECK_FALSE(VdaSim::LoadSite("/", warnings).has_value());
}

TEST_CASE("The warnings about a site file are kept")
{
    const TemporaryFolder folder;
    const std::string file = folder.GetPath() / "site.lif.json";
    std::ofstream(file) << R"({"metaInformation": {"projectIdentification": "p", "creator": "c", "exportTimestamp": "t",
        "lifVersion": "1.0.0"}, "layouts": [{"layoutId": "one", "layoutVersion": "1", "edges": [], "stations": [],
        "nodes": [{"nodeId": "N1", "nodePosition": {"x": 0, "y": 0}, "vehicleTypeNodeProperties": []}]}]})";
    std::vector<std::string> warnings;
    CHECK(VdaSim::LoadSite(file, warnings).has_value());
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::StartsWith("1 node has no mapId, layouts[0].nodes[0]"));
}

TEST_CASE("--count names its vehicles by the prefix and a number of at least two digits")
{
    CHECK(VdaSim::MakeVehicleName("LR", 1, 3) == "LR01");
    CHECK(VdaSim::MakeVehicleName("CR", 99, 500) == "CR099");
    CHECK(VdaSim::MakeVehicleName("CR", 500, 500) == "CR500");
}

namespace
{

struct ReadOptions
{
    VdaSim::VdaSimOptions options;
    std::optional<int> exitCode;
};

ReadOptions ReadOptionsFrom(std::vector<const char*> arguments)
{
    arguments.insert(arguments.begin(), {"vda-sim", "--broker", "mqtt://127.0.0.1:1", "--site", "x"});
    ReadOptions read;
    read.exitCode = VdaSim::ReadCommandLineOrNull(static_cast<int>(arguments.size()), arguments.data(), read.options);
    return read;
}

} // namespace

TEST_CASE("The command line counts vehicles, and takes faults, their files, action times and the seed")
{
    const TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "faults.txt").string();
    std::ofstream(file) << "# two of them\nC* loss percent=5\n\nC2* estop at=3s for=1s # late\n";
    const std::vector<const char*> arguments{
        "--count",
        "3",
        "--prefix",
        "C",
        "--type",
        "CR",
        "--fault-file",
        file.c_str(),
        "--seed",
        "42",
        "--action-time",
        "startCharging=250ms",
        "--no-control"};
    // C2* names no vehicle of C01 to C03.
    CHECK(ReadOptionsFrom(arguments).exitCode == 2);
    std::ofstream(file) << "C* loss percent=5\n";
    const ReadOptions good = ReadOptionsFrom(arguments);
    REQUIRE_FALSE(good.exitCode.has_value());
    REQUIRE(good.options.vehicles.size() == 3);
    CHECK(good.options.vehicles.back().name == "C03");
    CHECK(good.options.vehicles.back().type == EVehicleType::Control);
    REQUIRE(good.options.faults.size() == 1);
    CHECK(good.options.faults[0].fault.percent == 5.0);
    CHECK(good.options.seed == 42);
    CHECK(good.options.controlTopic.empty());
    CHECK(good.options.actionSeconds.at("startCharging") == 0.25);
}

TEST_CASE("A vehicle has its own profile, else that of the command line, else the standard one")
{
    const ReadOptions read =
        ReadOptionsFrom({"--vehicle", "A", "--vehicle", "B,profile=blocking", "--profile", "no-horizon"});
    REQUIRE_FALSE(read.exitCode.has_value());
    CHECK(read.options.profile == VdaSim::EVehicleProfile::NoHorizon);
    CHECK_FALSE(read.options.vehicles[0].profile.has_value());
    CHECK(read.options.vehicles[1].profile == VdaSim::EVehicleProfile::Blocking);
    CHECK(ReadOptionsFrom({"--vehicle", "A"}).options.profile == VdaSim::EVehicleProfile::Standard);
    CHECK(ReadOptionsFrom({"--vehicle", "A", "--profile", "fast"}).exitCode == 2);
}

TEST_CASE("With a world every vehicle has the name of a robot")
{
    const ReadOptions good = ReadOptionsFrom({"--vehicle", "LR01", "--world", "world.json"});
    REQUIRE_FALSE(good.exitCode.has_value());
    CHECK(good.options.worldPath == "world.json");
    CHECK_FALSE(good.options.bLenientParameters);
    CHECK(ReadOptionsFrom({"--vehicle", "A", "--lenient-parameters"}).options.bLenientParameters);
    CHECK(ReadOptionsFrom({"--vehicle", "A.B", "--world", "world.json"}).exitCode == 2);
    CHECK(ReadOptionsFrom({"--vehicle", "AMR", "--world", "world.json"}).exitCode == 2);
    CHECK(ReadOptionsFrom({"--vehicle", "LR01", "--world", ""}).exitCode == 2);
    CHECK_FALSE(ReadOptionsFrom({"--vehicle", "A.B"}).exitCode.has_value());
}

TEST_CASE("An invalid world file is an error of --world")
{
    VdaSim::VdaSimOptions options;
    options.sitePath = ACS_SITE "/site.lif.json";
    options.worldPath = "/nonexistent/world.json";
    const std::ostringstream errors;
    std::streambuf* const before = std::cerr.rdbuf(errors.rdbuf());
    const int exitCode = VdaSim::RunVdaSim(options);
    std::cerr.rdbuf(before);
    CHECK(exitCode == 2);
    CHECK_THAT(errors.str(), Catch::StartsWith("vda-sim: --world: /nonexistent/world.json: expected a world file"));
}

TEST_CASE("The command line has the settings of the broker: MQTT version, QoS profile, user and password")
{
    const TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "password").string();
    std::ofstream(file) << "secret word\nnot this\n";
    const ReadOptions plain = ReadOptionsFrom({"--vehicle", "A"});
    CHECK(plain.options.link.version == VDA5050::EMqttVersion::Version311);
    CHECK(plain.options.link.qos == VDA5050::QosTable());
    const ReadOptions read = ReadOptionsFrom(
        {"--vehicle", "A", "--mqtt", "5", "--qos", "standard", "--user", "acs", "--password-file", file.c_str()});
    REQUIRE_FALSE(read.exitCode.has_value());
    CHECK(read.options.link.version == VDA5050::EMqttVersion::Version5);
    CHECK(read.options.link.qos == VDA5050::QosTable(VDA5050::EQosProfile::Standard));
    CHECK(read.options.link.username == "acs");
    CHECK(read.options.link.password == "secret word");
    std::ofstream(file) << "\n";
    const std::string other = "/etc/hostname";
    for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
             {"--user", "acs", "--password-file", file.c_str()},
             {"--user", "acs", "--password-file", "/nonexistent/password"},
             {"--password-file", other.c_str()},
             {"--mqtt", "4"},
             {"--qos", "2"},
             {"--max-qos", "3"},
             {"--broker", "mqtt://127.0.0.1:1"}, // given twice
             {"--broker", "mqtts://127.0.0.2:1"},
             {"--broker", "broker"},
             {"--tls-ca", other.c_str()}, // at mqtt://
             {"--tls-key", "/nonexistent/key.pem"}})
    {
        CAPTURE(arguments);
        std::vector<const char*> all{"--vehicle", "A"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        CHECK(ReadOptionsFrom(all).exitCode == 2);
    }
    const std::vector<Apps::Url> brokers{{Apps::EUrlScheme::Mqtts, {"broker", 8883}, {}}};
    VdaSim::BrokerOptions half;
    CHECK(VdaSim::CheckBrokerOptions(half, brokers).empty());
    half.tls.certFile = "vehicle.pem";
    CHECK_THAT(VdaSim::CheckBrokerOptions(half, brokers), Catch::Contains("--tls-key"));
    half.tls.keyFile = "vehicle-key.pem";
    CHECK(VdaSim::CheckBrokerOptions(half, brokers).empty());
}

TEST_CASE("--broker is repeated for the nodes of a cluster; --max-qos limits the QoS")
{
    const ReadOptions plain = ReadOptionsFrom({"--vehicle", "A"});
    CHECK(plain.options.brokers.size() == 1);
    CHECK(plain.options.link.maxQos == 2);
    const ReadOptions read =
        ReadOptionsFrom({"--vehicle", "A", "--broker", "mqtt://b", "--broker", "mqtt://c:1884", "--max-qos", "1"});
    REQUIRE_FALSE(read.exitCode.has_value());
    REQUIRE(read.options.brokers.size() == 3);
    CHECK(read.options.brokers[0].peer.port == 1);
    CHECK(read.options.brokers[1] == Apps::Url{Apps::EUrlScheme::Mqtt, {"b", 1883}, {}});
    CHECK(read.options.brokers[2] == Apps::Url{Apps::EUrlScheme::Mqtt, {"c", 1884}, {}});
    CHECK(read.options.link.maxQos == 1);
}

TEST_CASE("An action time is accepted if one of the vehicles has the action, also under a name of its own")
{
    for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
             {"--vehicle", "A,type=CR", "--vehicle", "B", "--action-time", "pick=1s"},
             {"--vehicle", "A,type=CR,ports=1,pick=grab", "--action-time", "pick=1s"},
             {"--vehicle", "A,pick=grab,profile=partial-factsheet", "--action-time", "pick=1s"},
             {"--vehicle", "A,profile=standard", "--profile", "line-guided", "--action-time", "initPosition=1s"}})
    {
        CAPTURE(arguments);
        CHECK_FALSE(ReadOptionsFrom(arguments).exitCode.has_value());
    }
}

TEST_CASE("A contradictory command line ends the program with 2")
{
    for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
             {},
             {"--count", "0"},
             {"--count", "-18446744073709551615"},
             {"--count", "2", "--prefix", "a/b"},
             {"--count", "2", "--type", "XR"},
             {"--count", "2", "--vehicle", "LR01"},
             {"--vehicle", "A", "--fault", "B stuck"},
             {"--vehicle", "A", "--fault", "A end"},
             {"--vehicle", "A", "--fault", "A stuck for=soon"},
             {"--vehicle", "A", "--fault-file", "/nonexistent/faults"},
             {"--vehicle", "A", "--action-time", "pick"},
             {"--vehicle", "A", "--action-time", "=1s"},
             {"--vehicle", "A", "--action-time", "foo=1s"},
             {"--vehicle", "A", "--action-time", "cancelOrder=1s"},
             {"--vehicle", "A,type=CR", "--action-time", "pick=1s"},
             {"--vehicle", "A,ports=0", "--action-time", "drop=1s"},
             {"--count", "2", "--type", "CR", "--action-time", "pick=1s"},
             {"--vehicle", "A,profile=line-guided", "--action-time", "initPosition=1s"},
             {"--vehicle", "A", "--profile", "partial-factsheet", "--action-time", "startCharging=1s"},
             {"--vehicle", "A", "--control-topic", "a/#"},
             {"--vehicle", "A", "--control-topic", "x", "--no-control"},
             {"--vehicle", "A", "--seed", "-1"},
             {"--vehicle", "A", "--seed", "1x"},
             {"--vehicle", "A", "--time-scale", "nan"},
             {"--vehicle", "A", "--time-scale", "0"},
             {"--vehicle", "A", "--manufacturer", "K T"},
             {"--vehicle", "A", "--interface-name", "$SYS"}})
    {
        CAPTURE(arguments);
        CHECK(ReadOptionsFrom(arguments).exitCode == 2);
    }
}

} // namespace ACS::Testing
