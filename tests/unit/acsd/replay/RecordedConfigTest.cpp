#include "replay/RecordedConfig.hpp"

#include "Catch.hpp"
#include "drivers/BuiltInDrivers.hpp"
#include "ManualClock.hpp"
#include "TemporaryFolder.hpp"

#include <filesystem>
#include <fstream>
#include <string>

namespace ACS::Acsd::Test
{

namespace
{

const std::string SITE_CONFIG = std::string(ACS_SITE) + "/acsd.toml";

} // namespace

TEST_CASE("A recorded configuration is read in another folder, with its map and the same settings of the engine")
{
    const AcsdConfig config = ReadAcsdConfig(SITE_CONFIG, {"queue.max_plans=17", "robot.load_timeout=7s"});
    REQUIRE(config.errors.empty());
    const Core::Result<RecordedRun> run = DecodeBegin(MakeBeginRecord(config, Testing::ManualClock().GetNow()).text);
    REQUIRE(run.has_value());
    const Testing::TemporaryFolder folder;
    const AcsdConfig read = ReadRecordedConfig(*run, folder.GetPath().string(), MakeBuiltInDrivers());
    REQUIRE(read.errors.empty());
    CHECK(read.engine.maximumPlans == 17);
    CHECK(read.operations == config.operations);
    CHECK(read.mcs.style == config.mcs.style);
    CHECK(read.robots.size() == config.robots.size());
    CHECK(read.site->GetNodes().size() == config.site->GetNodes().size());
}

TEST_CASE("A recording has the files as acsd has read them, also if they have changed since")
{
    const Testing::TemporaryFolder folder;
    const std::filesystem::path names = folder.GetPath() / "errors.toml";
    std::ofstream(names) << "[\"ACS-1002\"]\ncode = \"E-2\"\n";
    const AcsdConfig config = ReadAcsdConfig(SITE_CONFIG, {"errors.map=" + names.string()});
    REQUIRE(config.errors.empty());
    const std::string fingerprint = MakeConfigFingerprint(config);
    std::ofstream(names) << "[\"ACS-1002\"]\ncode = \"E-3\"\n";
    CHECK(MakeConfigFingerprint(config) == fingerprint);
    const std::string text = MakeBeginRecord(config, Testing::ManualClock().GetNow()).text;
    CHECK(text.find("E-2") != std::string::npos);
    CHECK(text.find("E-3") == std::string::npos);
}

TEST_CASE("A recorded configuration has no addresses, names and secrets of the links")
{
    const AcsdConfig config = ReadAcsdConfig(
        SITE_CONFIG,
        {"mcs.url=ws://10.1.2.3:9001/acs/", "mqtt.url=mqtt://10.1.2.4:1883", "mqtt.username=someone"});
    const std::string text = MakeRecordedConfig(config);
    for (const char* const secret : {"10.1.2.3", "10.1.2.4", "someone", "127.0.0.1:8080"})
    {
        CAPTURE(secret);
        CHECK(text.find(secret) == std::string::npos);
    }
}

} // namespace ACS::Acsd::Test
