#include "config/AcsdConfig.hpp"

#include "Catch.hpp"
#include "CertificateMaker.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <sys/stat.h>
#include <tuple>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)

namespace
{

/// The example site with these keys on top.
Acsd::AcsdConfig Read(const std::vector<std::string>& overrides)
{
    return Acsd::ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
}

/// The example site without these tables, and with others at its end.
Acsd::AcsdConfig ReadWithout(const std::set<std::string>& tables, const std::string& others = {})
{
    const Testing::TemporaryFolder folder;
    std::ifstream from(std::string(ACS_SITE) + "/acsd.toml");
    const std::string file = (folder.GetPath() / "acsd.toml").string();
    std::ofstream to(file);
    bool bKept = true;
    for (std::string line; std::getline(from, line);)
    {
        if (line.starts_with('['))
        {
            bKept = !tables.contains(line.substr(1, line.find(']') - 1));
        }
        to << (bKept ? line : "") << '\n';
    }
    to << others;
    to.close();
    return Acsd::ReadAcsdConfig(file, {"site.map=" + std::string(ACS_SITE) + "/site.lif.json"});
}

} // namespace

TEST_CASE("The example site is without errors, and without TLS")
{
    const Acsd::AcsdConfig config = Read({});
    CHECK(config.errors.empty());
    CHECK(config.mcs.tls == ProtocolBeast::TlsOptions());
}

TEST_CASE("mcs.tls is read, its relative paths count from the folder of the configuration")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles ca = maker.MakeCA("ca");
    const Testing::CertificateFiles own = maker.Make(ca, {});
    const Acsd::AcsdConfig config = Read(
        {"mcs.url=wss://10.0.0.1:9001/acs/",
         "mcs.tls.ca=" + ca.certificate,
         "mcs.tls.certificate=" + own.certificate,
         "mcs.tls.key=" + own.key,
         "mcs.tls.server_name=mcs.example"});
    CHECK(config.errors.empty());
    CHECK(config.mcs.tls == ProtocolBeast::TlsOptions{ca.certificate, own.certificate, own.key, "mcs.example"});

    const Acsd::AcsdConfig relative = Read({"mcs.url=wss://10.0.0.1:9001/acs/", "mcs.tls.ca=nowhere.pem"});
    CHECK(relative.mcs.tls.caFile == std::string(ACS_SITE) + "/nowhere.pem");
}

TEST_CASE("A file for TLS that is missing or does not fit is an error with key, path and reason")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles ca = maker.MakeCA("ca");
    const Testing::CertificateFiles own = maker.Make(ca, {});

    const auto missing = Read({"mcs.url=wss://mcs/acs/", "mcs.tls.ca=/nowhere/ca.pem"}).errors;
    REQUIRE(missing.size() == 1);
    CHECK(missing[0].find("mcs.tls.ca: expected a PEM file") != std::string::npos);
    CHECK(missing[0].find("/nowhere/ca.pem: No such file or directory") != std::string::npos);

    const std::string pipe = folder.GetPath() / "pipe"; // it has no writer
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const auto piped = Read({"mcs.url=wss://mcs/acs/", "mcs.tls.ca=" + pipe}).errors;
    REQUIRE(piped.size() == 1);
    CHECK(piped[0].find(pipe + ": it is no regular file") != std::string::npos);

    const auto foreign =
        Read({"mcs.url=wss://mcs/acs/", "mcs.tls.certificate=" + own.certificate, "mcs.tls.key=" + ca.key}).errors;
    REQUIRE(foreign.size() == 1);
    CHECK(foreign[0].find("mcs.tls.key: ") != std::string::npos);
    CHECK(foreign[0].find("is the key of another certificate than " + own.certificate) != std::string::npos);
}

TEST_CASE("Client certificates of the operator interface have a CA and roles")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles ca = maker.MakeCA("ca");
    const Testing::CertificateFiles own = maker.Make(ca, {});
    std::vector<std::string> overrides{
        "operator.listen=0.0.0.0:8081",
        "operator.tls.certificate=" + own.certificate,
        "operator.tls.key=" + own.key,
        "operator.tls.client_ca=" + ca.certificate};
    const std::vector<std::string> errors = Read(overrides).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].find("operator.certificates: missing; ") != std::string::npos);

    overrides.emplace_back(R"(operator.certificates={ "Kim Lee" = "operator", "grafana" = "viewer" })");
    const Acsd::AcsdConfig config = Read(overrides);
    CHECK(config.errors.empty());
    const Acsd::OperatorConfig& control = config.http.control;
    CHECK(control.tls == Apps::HttpTlsFiles{own.certificate, own.key, ca.certificate});
    CHECK_FALSE(control.access.tokens.has_value());
    CHECK(
        control.access.certificates
        == std::map<std::string, Acsd::EOperatorRole>{
            {"Kim Lee", Acsd::EOperatorRole::Operator},
            {"grafana", Acsd::EOperatorRole::Viewer}});
}

TEST_CASE("Each error is reported once, under its key, with the line of the file or the option that it comes from")
{
    struct Row
    {
        std::vector<std::string> overrides;
        std::vector<std::string> errors; ///< How each begins.
    };
    const std::string file = std::string(ACS_SITE) + "/acsd.toml:";
    const std::vector<Row> rows{
        {{"robots.LR01.serial="}, {"--set: robots.LR01.serial: is a level of a topic"}},
        {{"robots.LR01.manufacturer=a/b"}, {"--set: robots.LR01.manufacturer: is a level of a topic"}},
        {{"robots.LR01.manufacturer=7"}, {"--set: robots.LR01.manufacturer: expected a string"}},
        {{"mqtt.interface_name=a/b"}, {"--set: mqtt.interface_name: "}},
        {{"robots.LR01=7"}, {"--set: robots.LR01: expected a table"}},
        {{"robots.LR1.actions.CassetteLoad.vehicle_action=x"},
         {"--set: robots.LR1: describes no robot; correct the name, or give type"}},
        {{R"(robots."LR 01".type=LR)"}, {R"(--set: robots."LR 01": expected a robot's name)"}},
        {{"robots.LR01.type=CR"}, {file + "*: robots.LR01.arm: a CR needs"}},
        {{"robots.CR01.arm.http=http://127.0.0.1:2"}, {"--set: robots.CR01.arm.http: unknown key"}},
        {{"arm.counter_finished=0"},
         {"--set: arm.counter_finished: is 0, the same as arm.counter_started: each counter needs a word of its own"}},
        {{"arm.counter_echo=2"}, {"--set: arm.counter_echo: is 2, the same as arm.counter_failed"}},
        {{"robots.CR01.arm.counter_echo=2"},
         {"--set: robots.CR01.arm.counter_echo: is 2, the same as robots.CR01.arm.counter_failed"}},
        {{"arm.counter_failed=1"}, {"--set: arm.counter_failed: is 1, the same as arm.counter_finished"}},
        {{"arm.counter_started=30", "arm.counter_failed=30"},
         {"--set: arm.counter_failed: is 30, the same as arm.counter_started"}},
        {{R"(http.hosts=["acs.example", "acs:80"])"}, {"--set: http.hosts: expected names without port"}},
        {{R"(operator.hosts=["acs:80"])"}, {"--set: operator.hosts: expected names without port"}},
        {{"operator.tokens_file=/nowhere"}, {"--set: operator.tokens_file: /nowhere cannot be read (No such file"}},
        {{"operator.tokens_file=/dev/null"}, {"--set: operator.tokens_file: /dev/null cannot be read (it is a device"}},
        {{"operator.listen=acs.example:8081"},
         {R"(--set: operator.listen: acs.example:8081 can be reached from other machines; add to [operator]: tls = {)"}},
        {{"operator.tls.certificate=/nowhere"}, {"--set: operator.tls.certificate: expected a PEM file"}},
        {{"operator.tls.key=/nowhere"}, {"--set: operator.tls.certificate: expected a PEM file*found none"}},
        {{R"(operator.certificates={ "kim" = "operator" })"},
         {"--set: operator.certificates: is used with operator.tls.client_ca only"}},
        {{"operator.listen=127.0.0.1:8080"},
         {"--set: operator.listen: 127.0.0.1:8080 is also the address of http.listen"}},
        {{R"(mcs.host="a b")"}, {"--set: mcs.host: expected HOST or HOST:PORT, found \"a b\""}},
        {{R"(robots.LR01.ports=["CP01-02", "CP02"])"}, {"--set: robots.LR01.ports: LR01.CP02 is listed twice"}},
        {{R"(robots.CR01.child_ports=["TP01.MP01-03", "TP01.MP03"])"},
         {"--set: robots.CR01.child_ports: CR01.TP01.MP03 is listed twice"}},
        {{R"(robots.CR01.child_ports=["TP09.MP01"])"},
         {"--set: robots.CR01.child_ports: CR01.TP09.MP01 is in CR01.TP09, which is not in ports"}},
        {{"robots.LR01.home=X99"}, {"--set: robots.LR01.home: expected a station of the site map, found X99"}},
        {{"robots.LR01.home=X99", "robots.CR01.start_node=N0", "robot.battery_floor=90"},
         {"--set: robots.CR01.start_node: expected a node",
          "--set: robots.LR01.home: expected a station",
          "--set: robot.battery_floor: expected 0 to 100 percent"}},
        {{"robots.CR01.home=CHG01"}, {"--set: robots.CR01.home: expected a station"}},
        {{"actions.Start=7"}, {"--set: actions.Start: expected a table"}},
        {{"mcs=7"}, {"--set: mcs: expected a table"}},
        {{"store.directory=7"}, {"--set: store.directory: expected a string"}},
        {{"store.directory="}, {"--set: store.directory: is empty"}},
        {{"site.map="}, {"--set: site.map: is empty; give the path of a LIF file"}},
        {{"errors.map=/nowhere"}, {"--set: errors.map: /nowhere cannot be read (No such file or directory)"}},
        {{"mqtt.ca_file=/nowhere"}, {"--set: mqtt.ca_file: is for mqtts:// only"}},
        {{"http.hosts=7"}, {"--set: http.hosts: expected a list of strings"}},
        {{R"(site.ports=["X", "A01.CP01", "Y"])"}, {R"(--set: site.ports: "X": expected a location)"}}};
    for (const Row& row : rows)
    {
        INFO(row.overrides.front());
        std::vector<std::string> errors = Read(row.overrides).errors;
        REQUIRE(errors.size() == row.errors.size());
        for (std::size_t i = 0; i < errors.size(); ++i)
        {
            INFO(errors[i]);
            const std::string& begin = row.errors[i];
            const std::size_t star = begin.find('*'); // any line
            CHECK(errors[i].starts_with(begin.substr(0, star)));
            CHECK(errors[i].find(begin.substr(star == std::string::npos ? 0 : star + 1)) != std::string::npos);
        }
    }
    CHECK(Read({R"(site.ports=["X", "Y"])"}).errors.front().find(R"(; "Y": expected a location)") != std::string::npos);
}

TEST_CASE("A name that is not on the map is reported with the line of its key")
{
    const Acsd::AcsdConfig config = ReadWithout(
        {"robots.LR01"},
        "[robots.LR01]\ntype = \"LR\"\nmanufacturer = \"ACS\"\nserial = \"LR01\"\nvehicle_type = \"lr-base\"\n"
        "start_node = \"D-CHG01\"\nports = [\"CP01\"]\nhome = \"X99\"\n");
    REQUIRE(config.errors.size() == 1);
    const std::size_t key = config.errors[0].find(": robots.LR01.home: expected a station of the site map, found X99");
    REQUIRE(key != std::string::npos);
    const std::string place = config.errors[0].substr(0, key);
    CHECK(std::stoi(place.substr(place.rfind(':') + 1)) > 200);
}

TEST_CASE("--check-config checks the store, changes nothing, and reports its errors under its key")
{
    const Testing::TemporaryFolder folder;
    const std::string path = (folder.GetPath() / "store").string();
    const auto check = [](const std::string& store) {
        return Acsd::CheckAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", {"store.directory=" + store}).errors;
    };
    CHECK(check(path).empty());
    CHECK(std::filesystem::is_empty(folder.GetPath()));
    REQUIRE(Planning::SqlitePlanStore::Open(path).has_value());
    CHECK(check(path).empty());
    const std::string text = (folder.GetPath() / "text").string();
    std::ofstream(text) << "no store at all, but long enough to be one";
    const std::string open = (folder.GetPath() / "open").string();
    std::filesystem::create_directory(open);
    std::filesystem::permissions(open, std::filesystem::perms::owner_all | std::filesystem::perms::group_read);
    for (const auto& [store, expected, found] :
         {std::tuple(text, "an undamaged plan store", "file is not a database"),
          std::tuple(open, "a directory for this program only", "mode 0740"),
          std::tuple(std::string("/nowhere/store"), "create the directory /nowhere", "No such file or directory")})
    {
        INFO(store);
        const std::vector<std::string> errors = check(store);
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].starts_with("--set: store.directory: " + store + ": expected "));
        CHECK(errors[0].find(expected) != std::string::npos);
        CHECK(errors[0].find(found) != std::string::npos);
        CHECK(Read({"store.directory=" + store}).errors.empty()); // a SIGHUP does not touch it, a start opens it
    }
}

TEST_CASE("--check-config checks the directory of the audit log, and changes nothing")
{
    const Testing::TemporaryFolder folder;
    const auto check = [&folder](const std::filesystem::path& directory) {
        return Acsd::CheckAcsdConfig(
                   std::string(ACS_SITE) + "/acsd.toml",
                   {"store.directory=" + (folder.GetPath() / "store/").string(),
                    "operator.audit.directory=" + directory.string()})
            .errors;
    };
    CHECK(check(folder.GetPath() / "audit").empty());
    CHECK(check(folder.GetPath() / "store" / "audit").empty()); // the start creates the directory of the store
    CHECK(std::filesystem::is_empty(folder.GetPath()));
    const std::filesystem::path file = folder.GetPath() / "file";
    std::ofstream(file) << "no directory";
    for (const auto& [directory, found] :
         {std::pair(file, "Not a directory"),
          std::pair(file / "audit", "Not a directory"),
          std::pair(folder.GetPath() / "absent" / "audit", "No such file or directory")})
    {
        const std::vector<std::string> errors = check(directory);
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].starts_with("--set: operator.audit.directory: " + directory.string() + ": expected "));
        CHECK(errors[0].find(found) != std::string::npos);
    }
}

TEST_CASE("4.1 An action that no robot can do as configured is an error that names the missing keys")
{
    const auto noProgram =
        ReadWithout({"actions.Start"}, "[actions.Start]\nrobot = 'CR'\nvehicle_action = 'start'\n").errors;
    REQUIRE(noProgram.size() == 1);
    CHECK(
        noProgram[0].find(
            "actions.Start.vehicle_action: no robot can do it, CR01: the arm has no program for Start; give "
            "arm_program")
        != std::string::npos);
    const auto noArm = ReadWithout({"actions.Start"}, "[actions.Start]\nrobot = 'LR'\narm_program = 3\n").errors;
    REQUIRE(noArm.size() == 1);
    CHECK(
        noArm[0].find("actions.Start.arm_program: no robot can do it, LR01: the vehicle has no action for Start")
        != std::string::npos);
}

TEST_CASE("4.1 The engine does not assign a robot actions that its adapter rejects, and reports the reason")
{
    const Acsd::AcsdConfig config = ReadWithout(
        {},
        "[robots.LR02]\ntype = 'LR'\nmanufacturer = 'ACS'\nserial = 'LR02'\nvehicle_type = 'lr-base'\n"
        "start_node = 'N001'\nports = ['CP01']\narm.url = 'tcp://127.0.0.1:1'\n");
    REQUIRE(config.errors.empty());
    const auto find = [&config](const std::string& robotID) {
        return *std::ranges::find_if(config.engine.robots, [&robotID](const Planning::RobotOptions& robot) {
            return robot.robotID.GetText() == robotID;
        });
    };
    CHECK(
        find("LR02").rejectedActions
        == Planning::RejectedActions{
            {"CassetteLoad", "the arm has no program for CassetteLoad"},
            {"CassetteUnload", "the arm has no program for CassetteUnload"}});
    CHECK(find("LR01").rejectedActions.empty());
    CHECK(find("CR01").rejectedActions.empty());
}

TEST_CASE("An omitted counter has its default, which no other counter may share")
{
    const auto errors = ReadWithout({"arm"}, "[arm]\ncounter_started = 2\n").errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].find(": arm.counter_started: is 2, the same as arm.counter_failed") != std::string::npos);
    CHECK(ReadWithout({"arm"}, "[arm]\ncounter_started = 3\n").errors.empty());
}

TEST_CASE("A site without actions is an error")
{
    std::set<std::string> all;
    for (const auto& [name, rule] : Read({}).engine.actions)
    {
        all.insert("actions." + name);
    }
    const auto errors = ReadWithout(all).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].find("actions: needs at least one table, such as [actions.CassetteLoad]") != std::string::npos);
}

TEST_CASE("Two robots do not share an arm: both would command one controller")
{
    const auto add = [](const std::string& address) {
        return ReadWithout(
                   {},
                   "[robots.CR02]\ntype = 'CR'\nmanufacturer = 'ACS'\nserial = 'CR02'\nvehicle_type = 'cr-base'\n"
                   "start_node = 'N001'\nports = ['TP01-03']\narm.url = '"
                       + address + "'\n")
            .errors;
    };
    CHECK(add("tcp://127.0.0.1:49001").empty());
    for (const std::string address : {"tcp://127.0.0.1:49000", "tcp://127.0.0.1"}) // 49000 is the default
    {
        INFO(address);
        const auto errors = add(address);
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].find(": robots.CR02.arm.url: CR01 has the same: one arm") != std::string::npos);
    }
}

TEST_CASE("mcs.tls with a ws URL is an error: it would encrypt nothing")
{
    const auto errors = Read({"mcs.tls.server_name=mcs.example"}).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].find("mcs.tls: is for wss:// only") != std::string::npos);
}

TEST_CASE("mcs.headers are sent with the upgrade; an invalid header is an error that does not show the value")
{
    CHECK(Read({}).mcs.headers.empty());
    const Acsd::AcsdConfig config = Read({"mcs.headers.Authorization=Bearer secret", "mcs.headers.X-Site=A"});
    CHECK(config.errors.empty());
    CHECK(config.mcs.headers == ProtocolBeast::HttpHeaders{{"Authorization", "Bearer secret"}, {"X-Site", "A"}});

    const auto control = Read({R"(mcs.headers.X-Key="secret\r\nX-Other: 1")"}).errors;
    REQUIRE(control.size() == 1);
    CHECK(control[0].find("mcs.headers.X-Key: expected a value without control characters") != std::string::npos);
    CHECK(control[0].find("secret") == std::string::npos);
    const auto own = Read({"mcs.headers.Sec-WebSocket-Key=x"}).errors;
    REQUIRE(own.size() == 1);
    CHECK(own[0].find("mcs.headers.Sec-WebSocket-Key: expected a header that") != std::string::npos);
    CHECK(Read({"mcs.headers.X-Number=1"}).errors.size() == 1);
}

TEST_CASE("The keys of the decision register have its defaults, in the example file and where they are left out")
{
    const Planning::EngineOptions defaults;
    for (const Acsd::AcsdConfig& config :
         {Read({}), ReadWithout({"plan", "cancel", "pause", "abort", "tsc", "reports", "history", "queue", "traffic"})})
    {
        REQUIRE(config.errors == std::vector<std::string>{});
        CHECK(config.engine.controls == defaults.controls);
        CHECK(config.engine.controls.cancelUntil == Planning::ECancelWindow::FirstArrival);
        CHECK(config.engine.controls.cancelTimeout == std::chrono::seconds(30));
        CHECK(config.engine.controls.pauseTimeout == std::chrono::seconds(30));
        CHECK_FALSE(config.engine.controls.bPausesAfterJob);
        CHECK_FALSE(config.engine.controls.bAbortStopsJob);
        CHECK_FALSE(config.engine.controls.bAbortFinishesPausedJob);
        CHECK(config.engine.controls.bJobFailureFailsAbort);
        CHECK_FALSE(config.engine.controls.bAbortReportsStep);
        CHECK(config.engine.controls.bResultAfterRefusal);
        CHECK(config.engine.clearance == 0);
        CHECK(config.engine.baseLength == 3);
        CHECK(config.engine.maximumPlans == 100);
        CHECK(config.engine.defaultPriority == 0);
        CHECK_FALSE(config.engine.bLowerPriorityFirst);
        CHECK(config.engine.queueAgeing == std::chrono::minutes(10));
        CHECK(config.engine.queueOvertaking == std::chrono::minutes(0));
        CHECK_FALSE(config.engine.bFinishedIDsReused);
        CHECK_FALSE(config.engine.bInitialPendingReported);
        CHECK_FALSE(config.engine.bTscStartsPaused);
        CHECK(config.engine.bTscPausedAcceptsPlans);
        CHECK(config.engine.finishedPlansKept == 1'000);
        CHECK(config.engine.maximumReports == 100'000);
    }
}

TEST_CASE("The keys of the decision register are read")
{
    const Acsd::AcsdConfig config = Read(
        {"cancel.until=first_job",
         "cancel.confirm_timeout=5s",
         "pause.mode=after_job",
         "pause.confirm_timeout=6s",
         "abort.running_job=stop",
         "abort.paused_job=finish",
         "abort.job_failure_final=Aborted",
         "abort.report_step=true",
         "abort.end_timeout=7s",
         "mcs.result_after_fail_ack=false",
         "queue.max_plans=7",
         "queue.priority_order=lower_first",
         "queue.default_priority=-3",
         "queue.ageing=1m",
         "queue.overtaking=2m",
         "plan.reuse_finished_id=true",
         "tsc.initial=paused",
         "tsc.paused_accepts_plans=false",
         "reports.initial_pending=true",
         "traffic.clearance=0.8",
         "traffic.base_length=5",
         "drive.stall_timeout=90s",
         "drive.wait_timeout=8m",
         "history.keep=9",
         "outbox.max=500"});
    REQUIRE(config.errors == std::vector<std::string>{});
    Planning::ControlOptions controls;
    controls.cancelUntil = Planning::ECancelWindow::FirstJob;
    controls.cancelTimeout = std::chrono::seconds(5);
    controls.pauseTimeout = std::chrono::seconds(6);
    controls.jobEndTimeout = std::chrono::seconds(7);
    controls.bPausesAfterJob = true;
    controls.bAbortStopsJob = true;
    controls.bAbortFinishesPausedJob = true;
    controls.bJobFailureFailsAbort = false;
    controls.bAbortReportsStep = true;
    controls.bResultAfterRefusal = false;
    CHECK(config.engine.controls == controls);
    CHECK(config.engine.clearance == 0.8);
    CHECK(config.engine.baseLength == 5);
    CHECK(config.engine.stallTimeout == std::chrono::seconds(90));
    CHECK(config.engine.waitTimeout == std::chrono::minutes(8));
    CHECK(config.engine.maximumPlans == 7);
    CHECK(config.engine.bLowerPriorityFirst);
    CHECK(config.engine.defaultPriority == -3);
    CHECK(config.engine.queueAgeing == std::chrono::minutes(1));
    CHECK(config.engine.queueOvertaking == std::chrono::minutes(2));
    CHECK(config.engine.bFinishedIDsReused);
    CHECK(config.engine.bTscStartsPaused);
    CHECK_FALSE(config.engine.bTscPausedAcceptsPlans);
    CHECK(config.engine.bInitialPendingReported);
    CHECK(config.engine.finishedPlansKept == 9);
    CHECK(config.engine.maximumReports == 500);
    CHECK(Read({"cancel.until=dispatch"}).engine.controls.cancelUntil == Planning::ECancelWindow::Dispatch);
}

TEST_CASE("A removed key is an error that states why or what replaces it, for every value")
{
    for (const char* override :
         {"plan.duplicate=fail",
          "plan.allow_mixed_robot_types=false",
          "locations.unknown=reject",
          R"(locations.robot_aliases=["AMR"])",
          "mcs.sync_config={a=1}",
          "ext.battery_station=false",
          "store.path=acsd.db"})
    {
        INFO(override);
        const std::string key = std::string(override).substr(0, std::string(override).find('='));
        const std::vector<std::string> errors = Read({override}).errors;
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].starts_with("--set: " + key + ": removed: "));
    }
    CHECK(Read({"plan.duplicate=fail"}).errors[0].ends_with("; see plan.reuse_finished_id"));
}

TEST_CASE("An unknown value of a key is an error")
{
    CHECK(Read({"pause.mode=later"}).errors.size() == 1);
}
