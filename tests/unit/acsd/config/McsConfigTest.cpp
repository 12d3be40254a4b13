#include "config/McsConfig.hpp"

#include "Catch.hpp"
#include "config/AcsdConfig.hpp"
#include "TemporaryFolder.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using namespace std::chrono_literals;

constexpr std::filesystem::perms PRIVATE = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;

AcsdConfig ReadMCS(const std::vector<std::string>& overrides)
{
    return ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
}

/// The only error that this override causes; empty without one.
std::string FindError(const std::string& override)
{
    const std::vector<std::string> errors = ReadMCS({override}).errors;
    return errors.size() == 1 ? errors[0] : std::string();
}

} // namespace

TEST_CASE("The keys about messages have their defaults")
{
    const AcsdConfig config = ReadMCS({});
    REQUIRE(config.errors == std::vector<std::string>{});
    CHECK(config.mcs.host.empty());
    CHECK(config.mcs.pingInterval == 10s);
    CHECK(config.mcs.session.ackTimeout == 5s);
    CHECK(config.mcs.session.ackRetries == 3);
    CHECK(config.mcs.session.ackDeadAfter == 5);
    CHECK(config.mcs.session.window == 16);
    CHECK(config.mcs.session.positionInterval == 200ms);
    CHECK(config.mcs.session.codec.maximumBytes == 4U * 1024 * 1024);
    CHECK_FALSE(config.mcs.session.codec.bUnknownMembersRefused);
    CHECK(config.mcs.session.codec.bLegacyNames);
    CHECK_FALSE(config.mcs.session.codec.bLenientJSON);
    CHECK(config.mcs.warnBytes == 4096);
    CHECK(config.mcs.style == MessageStyle{});
    CHECK(config.operations == OperationsConfig{});
    CHECK(config.operations.workGrace == 10s);
    CHECK(config.operations.offlineAfter == 15s);
    CHECK(config.operations.statusInterval == 0s);
}

TEST_CASE("The keys about messages are read")
{
    const AcsdConfig config = ReadMCS(
        {"mcs.host=mcs.example:9001",
         "mcs.ping_interval=1s",
         "mcs.ping_timeout=2s",
         "mcs.ack_timeout=1s",
         "mcs.ack_retries=1",
         "mcs.ack_dead_after=2",
         "mcs.window=4",
         "mcs.max_rx_bytes=65536",
         "mcs.unknown_fields=reject",
         "mcs.legacy_aliases=false",
         "mcs.json_lenient=true",
         "mcs.unassigned_robot_id=\"\"",
         "mcs.empty_carriers=omit",
         "mcs.on_report_nack=retry",
         "mcs.tx_warn_bytes=0",
         "mcs.tx_max_bytes=4096",
         "outbox.replay=final_only",
         "position.interval=0s",
         "comm.grace=0s",
         "robot.offline_after=20s",
         "robot.status_interval=1m",
         "log.level=warning",
         "shutdown.drain_timeout=7s",
         "trace.max_file_bytes=4096",
         "trace.max_files=2"});
    REQUIRE(config.errors == std::vector<std::string>{});
    CHECK(config.mcs.host == "mcs.example:9001");
    CHECK(config.mcs.pingInterval == 1s);
    CHECK(config.mcs.session.ackTimeout == 1s);
    CHECK(config.mcs.session.ackRetries == 1);
    CHECK(config.mcs.session.ackDeadAfter == 2);
    CHECK(config.mcs.session.window == 4);
    CHECK(config.mcs.session.positionInterval == 0s);
    CHECK(config.mcs.session.codec.maximumBytes == 65536);
    CHECK(config.mcs.session.codec.bUnknownMembersRefused);
    CHECK_FALSE(config.mcs.session.codec.bLegacyNames);
    CHECK(config.mcs.session.codec.bLenientJSON);
    CHECK(config.mcs.warnBytes == 0);
    CHECK(config.mcs.style.bUnassignedRobotEmpty);
    CHECK(config.mcs.style.bEmptyCarriersOmitted);
    CHECK(config.mcs.style.bRefusedReportsRetried);
    CHECK(config.mcs.style.longestText == 4096);
    CHECK(config.mcs.style.replay == EOutboxReplay::FinalOnly);
    CHECK(config.operations.workGrace == 0s);
    CHECK(config.operations.offlineAfter == 20s);
    CHECK(config.operations.statusInterval == 1min);
    CHECK(config.operations.logLevel == Core::ELogLevel::Warning);
    CHECK(config.operations.drainTimeout == 7s);
    CHECK(config.operations.trace == Apps::TraceLimits{4096, 2});
    CHECK(ReadMCS({"outbox.replay=none"}).mcs.style.replay == EOutboxReplay::None);
}

TEST_CASE("Headers in a configuration that every user can read, or that are sent unencrypted, are a warning")
{
    const Testing::TemporaryFolder folder;
    std::filesystem::copy(ACS_SITE, folder.GetPath(), std::filesystem::copy_options::recursive);
    const std::filesystem::path file = folder.GetPath() / "acsd.toml";
    const auto warn = [&file](const std::string& url) {
        return ReadAcsdConfig(file.string(), {"mcs.headers.Authorization=Bearer secret", "mcs.url=" + url}).warnings;
    };
    std::filesystem::permissions(file, PRIVATE);
    CHECK(warn("ws://127.0.0.1:9001/acs/").empty());
    CHECK(warn("wss://10.0.0.5:9001/acs/").empty());
    CHECK(
        warn("ws://10.0.0.5:9001/acs/")
        == std::vector<std::string>{"mcs.headers: it is sent to 10.0.0.5 unencrypted; use wss://"});
    std::filesystem::permissions(file, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
    CHECK(
        warn("wss://10.0.0.5:9001/acs/")
        == std::vector<std::string>{
            "mcs.headers: every user of this machine can read " + file.string() + "; run chmod o-rwx "
            + file.string()});
    CHECK(ReadAcsdConfig(file.string(), {}).warnings.empty());
}

TEST_CASE("mcs.headers_file has a header per line; an invalid line, or a file that every user can read, is an error")
{
    const Testing::TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "headers").string();
    const auto write = [&file](const std::string& text) {
        std::ofstream(file) << text;
        std::filesystem::permissions(file, PRIVATE);
    };
    const std::string override = "mcs.headers_file=" + file;
    write("# of the MCS\n\nAuthorization: Bearer a:b \r\n X-Site:7");
    AcsdConfig config = ReadMCS({override});
    REQUIRE(config.errors.empty());
    CHECK(config.mcs.headers == ProtocolBeast::HttpHeaders{{"Authorization", "Bearer a:b"}, {"X-Site", "7"}});
    CHECK(
        ReadMCS({override, "mcs.url=ws://10.0.0.5:9001/acs/"}).warnings
        == std::vector<std::string>{"mcs.headers_file: it is sent to 10.0.0.5 unencrypted; use wss://"});

    write("A: b\nsecret");
    CHECK(FindError(override) == "--set: mcs.headers_file: " + file + " line 2: expected NAME: VALUE");
    write("Upgrade: secret");
    CHECK(FindError(override).starts_with("--set: mcs.headers_file: " + file + " line 1: expected "));
    CHECK(FindError(override).find("secret") == std::string::npos);
    write("A: b");
    std::filesystem::permissions(file, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
    CHECK(
        FindError(override)
        == "--set: mcs.headers_file: every user of this machine can read " + file + "; run chmod o-rwx " + file);
    CHECK(
        FindError("mcs.headers_file=/nowhere/headers")
        == "--set: mcs.headers_file: /nowhere/headers cannot be read (No such file or directory)");
}

TEST_CASE("A path that begins with ${CREDENTIALS_DIRECTORY} is a credential of systemd")
{
    const std::string path = "${CREDENTIALS_DIRECTORY}/mqtt";
    ::setenv("CREDENTIALS_DIRECTORY", "/run/credentials/acsd.service", 1); // NOLINT(concurrency-mt-unsafe): one thread
    CHECK(ResolvePath("/etc/acsd/acsd.toml", path) == "/run/credentials/acsd.service/mqtt");
    ::unsetenv("CREDENTIALS_DIRECTORY");                     // NOLINT(concurrency-mt-unsafe): one thread
    CHECK(ResolvePath("/etc/acsd/acsd.toml", path) == path); // named by the error
    CHECK(ResolvePath("/etc/acsd/acsd.toml", "mqtt") == "/etc/acsd/mqtt");
}

TEST_CASE("A value that the register does not have, or that cannot take effect, is an error with its key")
{
    for (const char* override :
         {R"(mcs.host="a\nb")",
          "mcs.ack_dead_after=0",
          "mcs.window=0",
          "mcs.max_rx_bytes=10",
          "mcs.unknown_fields=keep",
          "mcs.unassigned_robot_id=none",
          "mcs.empty_carriers=drop",
          "mcs.on_report_nack=ignore",
          "mcs.tx_max_bytes=100",
          "outbox.replay=some",
          "position.interval=5ms",
          "robot.offline_after=0s",
          "log.level=loud",
          "trace.max_files=0",
          "errors.map=/nowhere/errors.toml"})
    {
        INFO(override);
        const std::string error = FindError(override);
        const std::string key = std::string(override).substr(0, std::string(override).find('='));
        CHECK(error.find(key == "errors.map" ? "/nowhere/errors.toml" : key) != std::string::npos);
    }
    CHECK(FindError("mcs.ping_timeout=11s").find("twice mcs.ping_interval") != std::string::npos);
}

TEST_CASE("errors.map gives alarms the site's names and levels; its errors have their file and line")
{
    const Testing::TemporaryFolder folder;
    const std::string path = (folder.GetPath() / "errors.toml").string();
    std::ofstream(path) << "[ACS-1002]\ncode = \"E77\"\nlevel = \"light\"\n\n[AGV-blocked]\nmessage = \"steht\"\n";
    const AcsdConfig config = ReadMCS({"errors.map=" + path});
    REQUIRE(config.errors == std::vector<std::string>{});

    Planning::Alarm alarm;
    alarm.errorCode = "ACS-1002";
    alarm.level = Planning::EAlarmLevel::Heavy;
    alarm.message = "The connection is lost.";
    const Planning::Alarm renamed = Rename(alarm, config.mcs.style.errors);
    CHECK(renamed.errorCode == "E77");
    CHECK(renamed.level == Planning::EAlarmLevel::Light);
    CHECK(renamed.message == alarm.message);
    alarm.errorCode = "AGV-blocked";
    CHECK(Rename(alarm, config.mcs.style.errors).message == "steht");
    CHECK(Rename(alarm, config.mcs.style.errors).errorCode == "AGV-blocked");
    alarm.errorCode = "ACS-1003";
    CHECK(Rename(alarm, config.mcs.style.errors) == alarm);

    std::ofstream(path) << "[ACS-1002]\ncode = \"\"\nlevel = \"loud\"\ncolour = 1\n";
    const std::vector<std::string> errors = ReadMCS({"errors.map=" + path}).errors;
    REQUIRE(errors.size() == 3);
    CHECK(errors[0].find(path + ":2: ACS-1002.code") != std::string::npos);
    CHECK(errors[1].find(path + ":3: ACS-1002.level") != std::string::npos);
    CHECK(errors[2].find(path + ":4: ACS-1002.colour") != std::string::npos);

    std::ofstream(path) << "[ACS-1002]\ncode = \"E77\"\n[ACS-102]\ncode = \"E78\"\n";
    const std::vector<std::string> misspelt = ReadMCS({"errors.map=" + path}).errors;
    REQUIRE(misspelt.size() == 1);
    CHECK(misspelt[0].find(path + ":3: ACS-102: is no alarm of acsd") != std::string::npos);
}

} // namespace ACS::Acsd::Test
