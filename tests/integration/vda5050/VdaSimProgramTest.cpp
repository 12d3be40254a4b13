#include "VdaSimFixture.hpp"

#ifdef ACS_TEST_CERTIFICATES
#include "CertificateMaker.hpp"
#endif

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;

} // namespace

TEST_CASE_METHOD(VdaSimFixture, "vda-sim: online, an order with an update and an action to its end, offline")
{
    ChildProcess program(MakeCommand(_broker.GetURL(), ACS_SITE_FILE, "LR01"));
    REQUIRE(program.TryWaitForText("ready: broker=127.0.0.1:" + std::to_string(_broker.GetPort()) + "\n", PATIENCE));
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "ONLINE"); }));
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.CountTopic(STATE_TOPIC) > 0; }));
    CHECK(GetLastState().lastNodeID == "D-CHG01");
    CHECK(GetLastState().agvPosition->x == Approx(1.8));

    Send(MakeOrder(2));
    REQUIRE(TryRunUntil(_context, [this]() { return GetLastState().lastNodeID == "N045"; }));
    REQUIRE(TryRunUntil(_context, [this]() { return !GetLastState().bDriving; }));
    CHECK(GetLastState().nodeStates.size() == 2);
    Send(MakeOrder(4));
    REQUIRE(TryRunUntil(_context, [this]() {
        const VDA5050::StateMessage state = GetLastState();
        return state.nodeStates.empty() && !state.actionStates.empty()
            && state.actionStates[0].actionStatus == VDA5050::EActionStatus::Finished;
    }));
    CHECK(GetLastState().orderUpdateID == 1);
    CHECK(GetLastState().agvPosition->y == Approx(10.0));
    CHECK(GetLastState().loads->size() == 1);
    CHECK(_master->listener.CountTopic("uagv/v2/ACS/LR01/visualization") > 0);

    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "OFFLINE"); }));
    TestLink late(_context, MakeOptions(_broker.GetPort(), "late"));
    late.link.Subscribe({{std::string(CONNECTION_TOPIC), 1}});
    late.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return !late.listener.messages.empty(); }));
    CHECK(late.listener.messages.front().bRetained);
    CHECK_THAT(late.listener.messages.front().payload, Catch::Contains("OFFLINE"));
}

TEST_CASE_METHOD(VdaSimFixture, "vda-sim: the broker reports a killed vehicle as CONNECTIONBROKEN")
{
    ChildProcess program(MakeCommand(_broker.GetURL(), ACS_SITE_FILE, "LR01"));
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "ONLINE"); }));
    program.Signal(SIGKILL);
    REQUIRE(
        TryRunUntil(_context, [this]() { return _master->listener.Contains(CONNECTION_TOPIC, "CONNECTIONBROKEN"); }));
}

TEST_CASE_METHOD(VdaSimFixture, "vda-sim: waits for its broker, logs that, and comes online when the broker starts")
{
    _broker.Kill();
    ChildProcess program(MakeCommand(_broker.GetURL(), ACS_SITE_FILE, "LR01"));
    REQUIRE(program.TryWaitForText("cannot reach the MQTT broker at 127.0.0.1:", PATIENCE));
    CHECK(program.GetText().find("ready:") == std::string::npos);
    _broker.Restart();
    CHECK(program.TryWaitForText("ready: broker=", PATIENCE));
    program.Signal(SIGINT);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

TEST_CASE_METHOD(VdaSimFixture, "vda-sim: the ready line names the broker of the cluster that is connected")
{
    std::vector<std::string> command =
        MakeCommand("mqtt://127.0.0.1:" + std::to_string(FindFreePort()), ACS_SITE_FILE, "LR01");
    command.insert(command.end(), {"--broker", _broker.GetURL()});
    ChildProcess program(command);
    CHECK(program.TryWaitForText("ready: broker=127.0.0.1:" + std::to_string(_broker.GetPort()) + "\n", PATIENCE));
    program.Signal(SIGINT);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

TEST_CASE("vda-sim: ends with 0 also while its broker is unreachable")
{
    ChildProcess program(MakeCommand("mqtt://127.0.0.1:" + std::to_string(FindFreePort()), ACS_SITE_FILE, "LR01"));
    REQUIRE(program.TryWaitForText("cannot reach the MQTT broker", PATIENCE));
    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

#ifdef ACS_TEST_CERTIFICATES
TEST_CASE("vda-sim: connects to a broker that requires TLS, a certificate, a user and a password, with MQTT 5")
{
    const TemporaryFolder folder;
    CertificateMaker maker(folder.GetPath());
    const CertificateFiles ca = maker.MakeCA("ca");
    const CertificateFiles server = maker.Make(ca, {});
    const CertificateFiles client = maker.Make(ca, {});
    const std::string passwords = maker.WriteFile("passwords", "");
    std::filesystem::permissions(passwords, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    ChildProcess entry({"/usr/bin/mosquitto_passwd", "-b", passwords, "fleet", "secret"});
    REQUIRE(entry.WaitForExitOrNull(PATIENCE) == 0);
    const MosquittoBroker broker(
        "allow_anonymous false\npassword_file " + passwords + "\ncafile " + ca.certificate + "\ncertfile "
        + server.certificate + "\nkeyfile " + server.key + "\nrequire_certificate true\n");
    std::vector<std::string> command =
        MakeCommand("mqtts://127.0.0.1:" + std::to_string(broker.GetPort()), ACS_SITE_FILE, "LR01");
    command.insert(
        command.end(),
        {"--mqtt",
         "5",
         "--user",
         "fleet",
         "--password-file",
         maker.WriteFile("secret", "secret\n"),
         "--tls-ca",
         ca.certificate,
         "--tls-certificate",
         client.certificate,
         "--tls-key",
         client.key});
    ChildProcess program(command);
    CHECK(program.TryWaitForText("ready: broker=", PATIENCE));
    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
    CAPTURE(program.GetText());
    CHECK_THAT(program.GetText(), !Catch::Contains("warning"));
}
#endif

TEST_CASE_METHOD(VdaSimFixture, "vda-sim: with --qos standard a state comes with quality of service 0, else with 1")
{
    const bool bStandard = GENERATE(false, true);
    std::vector<std::string> command = MakeCommand(_broker.GetURL(), ACS_SITE_FILE, "LR01");
    command.insert(command.end(), {"--qos", bStandard ? "standard" : "project"});
    ChildProcess program(command);
    REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.CountTopic(STATE_TOPIC) > 0; }));
    CHECK(_master->listener.FindLastOrNull(STATE_TOPIC)->qos == (bStandard ? 0 : 1));
    CHECK(_master->listener.FindLastOrNull(CONNECTION_TOPIC)->qos == 1);
}

TEST_CASE("vda-sim: each invalid input is one line that names it, and exit code 2")
{
    const std::string broker = "mqtt://127.0.0.1:1883";
    std::vector<std::string> unknownOption = MakeCommand(broker, ACS_SITE_FILE, "LR01");
    unknownOption.insert(unknownOption.end(), {"--colour", "red"});
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
        {MakeCommand(broker, ACS_SITE_FILE, "LR01,node=NOWHERE"), "NOWHERE"},
        {MakeCommand(broker, ACS_SITE_FILE, "LR01,type=XX"), "XX"},
        {MakeCommand(broker, "/etc/hostname", "LR01"), "/etc/hostname"},
        {MakeCommand(broker, "/nonexistent", "LR01"), "/nonexistent"},
        {MakeCommand("http://127.0.0.1", ACS_SITE_FILE, "LR01"), "http://127.0.0.1"},
        {unknownOption, "--colour"}};
    for (const auto& [command, name] : mistakes)
    {
        CAPTURE(name);
        ChildProcess program(command);
        CHECK(program.WaitForExitOrNull(PATIENCE) == 2);
        CHECK_THAT(program.GetText(), Catch::Contains(name));
        CHECK(std::ranges::count(program.GetText(), '\n') == 1);
    }
}

} // namespace ACS::Testing
