#include "config/LiveConfig.hpp"

#include "Catch.hpp"
#include "config/NamedFiles.hpp"
#include "RecordingLogSink.hpp"
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

AcsdConfig ReadLive(const std::vector<std::string>& overrides)
{
    AcsdConfig config = ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
    REQUIRE(config.errors == std::vector<std::string>{});
    return config;
}

} // namespace

TEST_CASE("A reload reports per key whether it was applied or needs a restart")
{
    const ConfigChange change = CompareConfigs(
        {{"log.level", "\"info\""}, {"comm.grace", "\"1s\""}, {"mcs.url", "\"ws://a\""}, {"store.directory", "\"a\""}},
        {{"log.level", "\"debug\""},
         {"mcs.url", "\"ws://b\""},
         {"store.directory", "\"a\""},
         {"queue.max_plans", "7"}});
    CHECK(change.applied == std::vector<std::string>{"comm.grace", "log.level"});
    CHECK(change.pending == std::vector<std::string>{"mcs.url", "queue.max_plans"});
}

TEST_CASE("A reload changes the live keys and nothing else")
{
    AcsdConfig present = ReadLive({});
    const AcsdConfig before = present;
    const AcsdConfig fresh = ReadLive(
        {"log.level=debug",
         "comm.grace=1s",
         "robot.status_interval=2s",
         "shutdown.drain_timeout=1s",
         "trace.max_files=3",
         "mcs.tx_max_bytes=4096",
         "mcs.ack_timeout=1s",
         "queue.max_plans=7"});
    Testing::RecordingLogSink sink;
    LogChange(present, fresh, Core::Logger(sink, "config"));
    CHECK(sink.ContainsField("key", "log.level"));
    CHECK(sink.ContainsField("value", "\"debug\""));
    CHECK(sink.Contains(Core::ELogLevel::Warning, "needs a restart"));
    CHECK(sink.CountLevel(Core::ELogLevel::Warning) == 2);

    ApplyLiveKeys(fresh, present);
    CHECK(present.operations.logLevel == Core::ELogLevel::Debug);
    CHECK(present.operations.workGrace == std::chrono::seconds(1));
    CHECK(present.operations.statusInterval == std::chrono::seconds(2));
    CHECK(present.operations.drainTimeout == std::chrono::seconds(1));
    CHECK(present.operations.trace.maxFiles == 3);
    CHECK(present.mcs.style.longestText == 4096);
    CHECK(present.mcs.session.ackTimeout == before.mcs.session.ackTimeout);
    CHECK(present.engine.maximumPlans == before.engine.maximumPlans);

    // Applied keys are not reported again; those that need a restart are.
    const ConfigChange next = CompareConfigs(present.values, fresh.values);
    CHECK(next.applied.empty());
    CHECK(next.pending == std::vector<std::string>{"mcs.ack_timeout", "queue.max_plans"});
}

TEST_CASE("A reload reports a file that has changed under the same name")
{
    const Testing::TemporaryFolder folder;
    const std::filesystem::path headers = folder.GetPath() / "headers";
    const std::filesystem::path names = folder.GetPath() / "errors.toml";
    std::ofstream(headers) << "X-Line: 1\n";
    std::filesystem::permissions(headers, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    std::ofstream(names) << "[\"ACS-1002\"]\ncode = \"E-2\"\n";
    const std::vector<std::string> overrides{
        "mcs.headers_file=" + headers.string(),
        "errors.map=" + names.string(),
        "log.level=debug"};
    AcsdConfig present = ReadLive(overrides);
    Testing::RecordingLogSink sink;
    LogChange(present, ReadLive(overrides), Core::Logger(sink, "config"));
    CHECK(sink.Contains(Core::ELogLevel::Info, "without changes"));
    sink.Clear();

    std::ofstream(headers) << "X-Line: 2\n";
    std::ofstream(names) << "[\"ACS-1002\"]\ncode = \"E-3\"\n";
    for (int reload = 0; reload < 2; ++reload)
    {
        const AcsdConfig fresh = ReadLive(overrides);
        LogChange(present, fresh, Core::Logger(sink, "config"));
        ApplyLiveKeys(fresh, present);
        CHECK(sink.CountLevel(Core::ELogLevel::Warning) == 2);
        CHECK(sink.ContainsField("key", "errors.map"));
        CHECK(sink.ContainsField("key", "mcs.headers_file"));
        CHECK_FALSE(sink.Contains(Core::ELogLevel::Info, "without changes"));
        sink.Clear();
    }
}

TEST_CASE("A reload warns of credentials of systemd, because it reads the copies of the start")
{
    const Testing::TemporaryFolder folder;
    const std::filesystem::path tokens = folder.GetPath() / "tokens";
    std::ofstream(tokens) << "viewer anna " << std::string(64, '0') << '\n';
    std::filesystem::permissions(tokens, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    const auto reload = [](const std::string& path) {
        const AcsdConfig config = ReadLive({"operator.tokens_file=" + path});
        Testing::RecordingLogSink sink;
        LogChange(config, config, Core::Logger(sink, "config"));
        CHECK(sink.Contains(Core::ELogLevel::Info, "without changes"));
        CHECK(sink.ContainsField("keys", "operator.tokens_file") == (sink.CountLevel(Core::ELogLevel::Warning) == 1));
        return sink.Contains(Core::ELogLevel::Warning, "systemd copies them when the service starts");
    };
    CHECK_FALSE(reload(tokens.string()));
    ::setenv("CREDENTIALS_DIRECTORY", folder.GetPath().c_str(), 1); // NOLINT(concurrency-mt-unsafe): one thread
    CHECK(reload("${CREDENTIALS_DIRECTORY}/tokens"));
    CHECK(reload(tokens.string()));
    ::setenv(
        "CREDENTIALS_DIRECTORY",
        (folder.GetPath() / "tok").c_str(),
        1); // NOLINT(concurrency-mt-unsafe): one thread
    CHECK_FALSE(reload(tokens.string()));
    ::unsetenv("CREDENTIALS_DIRECTORY"); // NOLINT(concurrency-mt-unsafe): one thread
}

TEST_CASE("The keys of credentials are found in tables too")
{
    CHECK(
        FindCredentialKeys(
            {{"operator.tls.key", R"('${CREDENTIALS_DIRECTORY}/acsd.key')"},
             {"mqtt.password_file", R"("${CREDENTIALS_DIRECTORY}/mqtt")"},
             {"operator.tls.certificate", R"("acsd.pem")"},
             {"queue.max_plans", "7"}})
        == std::vector<std::string>{"mqtt.password_file", "operator.tls.key"});
}

TEST_CASE("Of the keys of the message style, only the live ones are applied")
{
    const Testing::TemporaryFolder folder;
    const std::string names = (folder.GetPath() / "errors.toml").string();
    std::ofstream(names) << "[\"ACS-1002\"]\ncode = \"E-2\"\n";
    const std::vector<std::string> live{
        "mcs.unassigned_robot_id=",
        "mcs.empty_carriers=omit",
        "mcs.on_report_nack=retry",
        "mcs.tx_max_bytes=4096",
        "outbox.replay=final_only"};
    // A report that is sent again is the same message; an alarm is cleared under the name that it was set with.
    const std::vector<std::string> waiting{"mcs.result_report_failure=Fail", "errors.map=" + names};
    std::vector<std::string> all = live;
    all.insert(all.end(), waiting.begin(), waiting.end());

    AcsdConfig present = ReadLive({});
    const AcsdConfig fresh = ReadLive(all);
    REQUIRE_FALSE(fresh.mcs.style.errors == present.mcs.style.errors);
    REQUIRE(fresh.mcs.style.bResultFailureIsFail);
    ApplyLiveKeys(fresh, present);
    CHECK((present.mcs.style == ReadLive(live).mcs.style));
    CHECK_FALSE((present.mcs.style == fresh.mcs.style));
}

} // namespace ACS::Acsd::Test
