#include "ExampleSite.hpp"
#include "TemporaryFolder.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

TEST_CASE("robot.* and robots.NAME.charge are read; a charging station is no other robot's home")
{
    const AcsdConfig config = ReadSite(
        {"robot.battery_floor=15",
         "robot.battery_resume=90",
         "robot.max_rejections=5",
         "robot.taken_port=load",
         "robots.LR01.charge=CHG01",
         "mcs.position_while_moving=target"});
    REQUIRE(config.errors.empty());
    CHECK(config.engine.dispatch.batteryFloor == 15);
    CHECK(config.engine.dispatch.batteryResume == 90);
    CHECK(config.engine.maximumRejections == 5);
    CHECK(ReadSite({}).engine.maximumRejections == 3);
    CHECK(config.engine.dispatch.bLoadsIntoTakenPorts);
    CHECK(config.engine.robots.back().chargingStationID == "CHG01");
    CHECK(config.engine.movingPosition == Planning::EMovingPosition::Target);
    CHECK_FALSE(ReadSite({}).engine.robots.back().chargingStationID.has_value());

    const AcsdConfig wrong =
        ReadSite({"robot.battery_floor=90", "robots.LR01.charge=CHG02", "robots.CR01.charge=NOWHERE"});
    std::string errors;
    for (const std::string& error : wrong.errors)
    {
        errors += error + "\n";
    }
    CHECK(errors.find("robot.battery_floor") != std::string::npos);
    CHECK(errors.find("robots.LR01.charge") != std::string::npos);
    CHECK(errors.find("robots.CR01.charge") != std::string::npos);
    CHECK(ReadSite({"robot.battery_floor=-1"}).errors.size() == 1);
    CHECK(ReadSite({"robot.max_rejections=0"}).errors.size() == 1);
    CHECK(ReadSite({"mcs.position_while_moving=here"}).errors.size() == 1);
}

TEST_CASE("The topics of a robot's vehicle are named, also to the engine, for the alarm of one that does not connect")
{
    const AcsdConfig config =
        ReadSite({"mqtt.interface_name=plant", "robots.LR01.manufacturer=ACME", "robots.LR01.serial=0007"});
    REQUIRE(config.errors.empty());
    CHECK(config.robots.back().topicPrefix == "plant/v2/ACME/0007");
    CHECK(
        config.engine.robots.back().connectionHint
        == "The connection message of its vehicle is expected on plant/v2/ACME/0007/connection.");
    CHECK(ReadSite({"robots.LR01.serial=a/b"}).engine.robots.back().connectionHint.empty());
}

TEST_CASE("The maps of a robot are maps of the site with a version; link and hash are optional")
{
    const std::string map = "robots.LR01.maps.floor-1";
    const AcsdConfig config = ReadSite(
        {"robots.LR01.protocol=2.1.0", map + R"(.version="2")", map + R"(.download="http://files/floor.zip")"});
    CHECK(config.errors.empty());
    CHECK(config.warnings.empty());
    const VehicleConfig& vehicle = FindVehicle(config, "LR01");
    CHECK(vehicle.maps == std::vector<NeededMap>{{"floor-1", "2", "http://files/floor.zip", {}}});
    for (const char* const link :
         {"https://files.example:8443/a/floor.zip?v=2", "file:///maps/floor.zip", "s3://bucket/floor"})
    {
        INFO(link);
        CHECK(ReadSite({map + R"(.version="2")", map + ".download=" + link, map + ".hash=9f86"}).errors.empty());
    }
}

TEST_CASE("A map that the site does not have, an invalid link, or a hash without a link is an error")
{
    const std::string map = "robots.LR01.maps.floor-1";
    const std::string version = map + R"(.version="2")";
    std::vector<ConfigErrorRow> rows{
        {{R"(robots.LR01.maps.hall.version="2")"}, "robots.LR01.maps.hall: no node of site.map has this mapId"},
        {{version, map + ".hash=9f86"}, map + ".hash: is of the download, which is not given"},
        {{map + ".download=http://files/floor.zip"}, map + ".version: "},
    };
    for (const char* const link :
         {"floor.zip", "http://", "://files/floor.zip", "http//files", "http://fi les", "ht tp://f"})
    {
        rows.push_back(
            {{version, map + ".download='" + link + "'"}, map + ".download: expected a URL such as http://HOST/FILE"});
    }
    rows.push_back(
        {{version, map + ".download=''"}, map + ".download: expected a URL such as http://HOST/FILE, found \"\""});
    CheckErrors(rows);
}

TEST_CASE("Maps of a vehicle of 2.0 are a warning, because that version has none")
{
    const std::string map = "robots.LR01.maps.floor-1";
    const AcsdConfig config = ReadSite({map + R"(.version="2")", "robots.LR01.protocol=2.0.0"});
    CHECK(config.errors.empty());
    CHECK(
        config.warnings
        == std::vector<std::string>{
            "robots.LR01.maps: has no effect, because VDA5050 has maps since 2.1; remove it, or set protocol"});
}

namespace
{

/// A factsheet; the header has its members, each followed by a comma.
void WriteFactsheet(
    const std::string& file,
    const std::string& header,
    const std::string& speeds,
    const std::string& interval,
    const std::string& features)
{
    std::ofstream(file)
        << "{" << header
        << R"("typeSpecification":{"seriesName":"LR","agvKinematic":"DIFF","agvClass":"CARRIER","maxLoadMass":1,)"
        << R"("localizationTypes":[],"navigationTypes":[]},"physicalParameters":{)" << speeds
        << R"(,"accelerationMax":1,"decelerationMax":1,"heightMax":1,"width":1,"length":1},"protocolLimits":{)"
        << R"("maxStringLens":{},"maxArrayLens":{},"timing":{"minOrderInterval":)" << interval
        << R"(,"minStateInterval":0}},"protocolFeatures":)" << features
        << R"(,"agvGeometry":{},"loadSpecification":{}})";
}

std::vector<std::string> Sort(std::vector<std::string> lines)
{
    std::ranges::sort(lines);
    return lines;
}

constexpr const char* SPEEDS = R"("speedMin":0,"speedMax":1)";

} // namespace

TEST_CASE("A factsheet_file is read without a header, and an unreadable one is an error with path and reason")
{
    const Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "lr.json";
    const auto write = [&file](const std::string& features) {
        WriteFactsheet(file, {}, SPEEDS, "0", features);
    };
    const std::vector<std::string> keys{"robots.LR01.factsheet_file=" + file};
    write(R"({"agvActions":[]})");
    const AcsdConfig good = ReadSite(keys);
    CHECK(good.errors.empty());
    CHECK(good.warnings.empty());
    const VehicleConfig& vehicle = FindVehicle(good, "LR01");
    REQUIRE(vehicle.factsheet.has_value());
    CHECK(vehicle.factsheet->typeSpecification.seriesName == "LR");
    CHECK_FALSE(vehicle.drives->GetMap().GetRoutes().empty());

    write(R"({"agvActions":[],"optionalParameters":[]})");
    const AcsdConfig poor = ReadSite(keys);
    CHECK(poor.errors.empty());
    REQUIRE(poor.warnings.size() == 1);
    CHECK(poor.warnings[0].find("robots.LR01: the drive from ") == 0);
    CHECK(poor.warnings[0].find("does not support order.edges.") != std::string::npos);

    write("7");
    const AcsdConfig wrong = ReadSite(keys);
    REQUIRE(wrong.errors.size() == 1);
    CHECK(
        wrong.errors[0].find("robots.LR01.factsheet_file: " + file + " is not a VDA5050 factsheet: ")
        != std::string::npos);
    CHECK(wrong.errors[0].find("protocolFeatures") != std::string::npos);

    const AcsdConfig missing = ReadSite({"robots.LR01.factsheet_file=nowhere.json"});
    REQUIRE(missing.errors.size() == 1);
    CHECK(missing.errors[0].find(std::string(ACS_SITE) + "/nowhere.json cannot be read") != std::string::npos);
}

TEST_CASE("A factsheet_file that contradicts itself or is of another make or version is a warning for each")
{
    const Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "lr.json";
    const std::vector<std::string> keys{"robots.LR01.factsheet_file=" + file, "robots.LR01.protocol=2.1.0"};
    const auto makeHeader = [](const std::string& manufacturer, const std::string& version) {
        return R"("headerId":1,"timestamp":"2026-01-01T00:00:00.00Z","version":")" + version + R"(","manufacturer":")"
            + manufacturer + R"(","serialNumber":"of another one",)";
    };
    const std::string begin = "robots.LR01.factsheet_file: ";
    WriteFactsheet(file, makeHeader("ACS", "2.1.0"), SPEEDS, "0", R"({"agvActions":[]})");
    CHECK(ReadSite(keys).warnings.empty());

    WriteFactsheet(
        file,
        makeHeader("KUKA", "2.0.0"),
        R"("speedMin":2,"speedMax":1)",
        "86400",
        R"({"agvActions":[{"actionType":"pick","actionScopes":["NODE"]},{"actionType":"pick","actionScopes":["NODE"]}]})");
    const AcsdConfig config = ReadSite(keys);
    CHECK(config.errors.empty());
    const std::vector<std::string> expected{
        begin + R"(the manufacturer is "KUKA", and ACS in the configuration; give the factsheet of this vehicle)",
        begin
            + R"(the version is "2.0.0", and protocol is 2.1.0; correct protocol, or give the factsheet of this vehicle)",
        begin + "the action pick is listed twice",
        begin + "speedMin 2 is above speedMax 1",
        begin + "minOrderInterval is 86400 s, above 300 s: each order message waits this long after the one before"};
    CHECK(std::ranges::includes(Sort(config.warnings), Sort(expected)));
}

TEST_CASE("A factsheet_file that makes an action of its vehicle impossible is a warning, also if others are possible")
{
    const Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "lr.json";
    WriteFactsheet(file, {}, SPEEDS, "0", R"({"agvActions":[{"actionType":"pick","actionScopes":["NODE"]}]})");
    const std::vector<std::string> warnings = ReadSite({"robots.LR01.factsheet_file=" + file}).warnings;
    CHECK(warnings == std::vector<std::string>{"robots.LR01: the vehicle's factsheet does not list drop"});
}

TEST_CASE("Warnings of a factsheet_file are limited in number and in length")
{
    const Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "lr.json";
    const std::string row = R"({"actionType":")" + std::string(5'000, 'x') + R"(","actionScopes":["NODE"]})";
    std::string rows = row;
    for (int i = 0; i < 12; ++i)
    {
        rows += "," + row;
    }
    WriteFactsheet(file, {}, SPEEDS, "0", R"({"agvActions":[)" + rows + "]}");
    const AcsdConfig config = ReadSite({"robots.LR01.factsheet_file=" + file});
    CHECK(config.errors.empty());
    std::vector<std::string> warnings;
    std::ranges::copy_if(config.warnings, std::back_inserter(warnings), [](const std::string& warning) {
        return warning.starts_with("robots.LR01.factsheet_file: ");
    });
    REQUIRE(warnings.size() == 10);
    CHECK(warnings.front().size() < 300);
    CHECK(warnings.back() == "robots.LR01.factsheet_file: 3 more contradictions");
}

} // namespace ACS::Acsd::Test
