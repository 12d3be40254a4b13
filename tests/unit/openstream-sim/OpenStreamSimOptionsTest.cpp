#include "OpenStreamSimOptions.hpp"

#include "Catch.hpp"

#include <array>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr const char* PROGRAMS = ACS_SITE "/programs.toml";

/// The text on standard error for a command line that is refused.
std::string ReadRefusal(std::vector<const char*> arguments)
{
    OpenStreamSimOptions options;
    const std::ostringstream errors;
    std::streambuf* const before = std::cerr.rdbuf(errors.rdbuf());
    arguments.insert(arguments.begin(), "openstream-sim");
    const std::optional<int> exitCode =
        ParseOptionsOrNull(static_cast<int>(arguments.size()), arguments.data(), options);
    std::cerr.rdbuf(before);
    REQUIRE(exitCode == 2);
    return errors.str();
}

std::optional<int> ParseOrNull(std::vector<const char*> arguments, OpenStreamSimOptions& options)
{
    arguments.insert(arguments.begin(), "openstream-sim");
    return ParseOptionsOrNull(static_cast<int>(arguments.size()), arguments.data(), options);
}

} // namespace

TEST_CASE("Without options it serves the manuals' ports on the loopback, with the motor off and in real time")
{
    OpenStreamSimOptions options;
    const std::array arguments{"openstream-sim"};
    REQUIRE_FALSE(ParseOptionsOrNull(1, arguments.data(), options).has_value());
    REQUIRE(options.fleet.first.stream == ACS::Apps::Endpoint{"127.0.0.1", 49000});
    REQUIRE(options.fleet.first.http == ACS::Apps::Endpoint{"127.0.0.1", 8888});
    REQUIRE_FALSE(options.fleet.first.controller.bMotorOn);
    REQUIRE_FALSE(options.bRealTime);
    REQUIRE(options.fleet.first.controller.timeScale == 1.0);
    REQUIRE(options.fleet.first.sessions == 8);
    REQUIRE(options.fleet.first.handshakeTimeout == 5s);
    REQUIRE(MakeText(options.fleet.first.controller.version) == "70.04-00");
    REQUIRE(options.fleet.first.controller.otherPrograms == ProgramSpec{2s, false});
}

TEST_CASE("Every option reaches its place")
{
    OpenStreamSimOptions options;
    const std::array arguments{
        "openstream-sim",
        "--listen",
        "0.0.0.0:0",
        "--http",
        "[::1]:1",
        "--time-scale",
        "20",
        "--program",
        "11=3s",
        "--program=12=500ms,fail",
        "--controllers",
        "3",
        "--ready",
        "--playing",
        "--realtime",
        "--sessions",
        "2",
        "--handshake-timeout",
        "0s",
        "--controller-version",
        "60.20-01",
        "--robot-model",
        "HS220-02",
        "--robot",
        "1=CR01",
        "--robot=2=CR02",
        "--robot=3=CR03",
        "--programs",
        PROGRAMS,
        "--world",
        "floor.json",
        "--log-level",
        "error"};
    REQUIRE_FALSE(ParseOptionsOrNull(static_cast<int>(arguments.size()), arguments.data(), options).has_value());
    REQUIRE(options.fleet.first.stream == ACS::Apps::Endpoint{"0.0.0.0", 0});
    REQUIRE(options.fleet.first.http == ACS::Apps::Endpoint{"::1", 1});
    REQUIRE(options.fleet.first.controller.timeScale == 20.0);
    REQUIRE(options.fleet.first.controller.bMotorOn);
    REQUIRE(options.fleet.first.controller.bWaiting);
    REQUIRE(options.fleet.controllers == 3);
    REQUIRE(options.fleet.first.sessions == 2);
    REQUIRE(options.fleet.first.handshakeTimeout == 0ms);
    REQUIRE(options.fleet.first.controller.version == ControllerVersion{60, 20, 1});
    REQUIRE(options.fleet.first.controller.robotModel == "HS220-02");
    REQUIRE(options.bRealTime);
    REQUIRE(options.fleet.robots == std::map<std::size_t, std::string>{{1, "CR01"}, {2, "CR02"}, {3, "CR03"}});
    REQUIRE(options.worldFile == "floor.json");
    const std::map<int, ProgramSpec>& programs = options.fleet.first.controller.programs;
    REQUIRE(programs.size() == 6);
    REQUIRE(programs.at(11).duration == 3s); // --program takes precedence
    REQUIRE(std::holds_alternative<TransferWork>(programs.at(11).work));
    REQUIRE(programs.at(11).echo.has_value());
    REQUIRE(programs.at(12).duration == 500ms);
    REQUIRE(programs.at(12).bFails);
    REQUIRE(programs.at(13).duration == 2s);
    REQUIRE(options.common.logLevel == ACS::Core::ELogLevel::Error);
}

TEST_CASE("A program is NUMBER=DURATION or NUMBER=DURATION,fail, once a number")
{
    ControllerOptions options;
    for (const char* text :
         {"",
          "11",
          "=3s",
          "11=",
          "0=3s",
          "10000=3s",
          "-1=3s",
          "x=3s",
          "11=3",
          "11=0s",
          "11=3s,",
          "11=,fail",
          "11=3s,fail,fail",
          "11=3s,failed",
          " 11=3s"})
    {
        INFO(text);
        REQUIRE_FALSE(ParseProgram(text, options).empty());
    }
    REQUIRE(options.programs.empty());
    REQUIRE(ParseProgram("9999=1h", options).empty());
    REQUIRE(ParseProgram("9999=2s", options) == "program 9999 is given twice");
}

TEST_CASE("An error in the command line is exit code 2")
{
    for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
             {"--listen", "here"},
             {"--listen", "127.0.0.1:65536"},
             {"--http", "127.0.0.1"},
             {"--time-scale", "0"},
             {"--time-scale", "nan"},
             {"--program", "11"},
             {"--program", "11=1s", "--program", "11=2s"},
             {"--controllers", "0"},
             {"--controllers", "501"},
             {"--controllers", "-1"},
             {"--controllers", "2x"},
             {"--controllers", "2", "--controllers", "2"},
             {"--controllers"},
             {"--sessions", "0"},
             {"--sessions", "1001"},
             {"--handshake-timeout", "5"},
             {"--handshake-timeout", "-5s"},
             {"--controller-version", "70"},
             {"--controller-version", "70.4-0"},
             {"--controller-version", "70.04-000"},
             {"--controller-version", "7x.04-00"},
             {"--robot-model", ""},
             {"--robot-model", "HA 006"},
             {"--robot", "CR01"},
             {"--robot", "0=CR01"},
             {"--robot", "1="},
             {"--robot", "1=AMR"},
             {"--robot", "1=CR01", "--robot", "1=CR02"},
             {"--robot", "2=CR01"},
             {"--robot", "1=CR01"}, // nothing names it
             {"--controllers", "2", "--robot", "1=CR01", "--robot", "2=CR01"},
             {"--programs", ""},
             {"--programs", "/nowhere/programs.toml"},
             {"--programs", PROGRAMS}, // names {robot}
             {"--programs", ACS_SITE "/acsd.toml", "--robot", "1=CR01"},
             {"--world", "floor.json"},
             {"--log-level", "loud"},
             {"--ready=maybe"},
             {"--frobnicate", "1"},
             {"positional"}})
    {
        CAPTURE(arguments);
        OpenStreamSimOptions options;
        REQUIRE(ParseOrNull(arguments, options) == 2);
    }
}

TEST_CASE("A controller without a robot is reported with the file that needs it")
{
    REQUIRE_THAT(
        ReadRefusal({"--programs", PROGRAMS, "--world", "floor.json", "--controllers", "2", "--robot", "1=CR01"}),
        Catch::Contains("--world floor.json needs the robot of controller 2: give --robot 2=NAME"));
    REQUIRE_THAT(
        ReadRefusal({"--programs", PROGRAMS}),
        Catch::Contains("{robot} in " ACS_SITE "/programs.toml needs the robot of controller 1: give --robot 1=NAME"));
}

TEST_CASE("Ports beyond the last one, or the same ones for both sides, are refused; one less is not, nor is port 0")
{
    for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
             {"--controllers", "3", "--listen", "127.0.0.1:65534"},
             {"--controllers", "3", "--http", "127.0.0.1:65534"},
             {"--controllers", "3", "--listen", "127.0.0.1:9000", "--http", "127.0.0.1:9002"},
             {"--controllers", "3", "--listen", "127.0.0.1:9002", "--http", "127.0.0.1:9000"},
             {"--listen", "127.0.0.1:9000", "--http", "127.0.0.1:9000"}})
    {
        CAPTURE(arguments);
        OpenStreamSimOptions options;
        REQUIRE(ParseOrNull(arguments, options) == 2);
    }
    for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
             {"--controllers", "3", "--listen", "127.0.0.1:65533"},
             {"--controllers", "3", "--http", "127.0.0.1:65533"},
             {"--controllers", "3", "--listen", "127.0.0.1:9000", "--http", "127.0.0.1:9003"},
             {"--controllers", "3", "--listen", "127.0.0.1:9003", "--http", "127.0.0.1:9000"},
             {"--controllers", "3", "--listen", "127.0.0.1:9000", "--http", "127.0.0.2:9000"},
             {"--controllers", "500", "--listen", "127.0.0.1:0", "--http", "127.0.0.1:0"}})
    {
        CAPTURE(arguments);
        OpenStreamSimOptions options;
        REQUIRE_FALSE(ParseOrNull(arguments, options).has_value());
    }
}
