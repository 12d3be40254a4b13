#include "OpenStreamSimOptions.hpp"

#include "Catch.hpp"

#include <array>

using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

TEST_CASE("Without options it serves the manuals' ports on the loopback, with the motor off and in real time")
{
    OpenStreamSimOptions options;
    const std::array arguments{"openstream-sim"};
    REQUIRE_FALSE(ParseOptionsOrNull(1, arguments.data(), options).has_value());
    REQUIRE(options.host.stream == ACS::Apps::Endpoint{"127.0.0.1", 49000});
    REQUIRE(options.host.http == ACS::Apps::Endpoint{"127.0.0.1", 8888});
    REQUIRE_FALSE(options.host.controller.bMotorOn);
    REQUIRE_FALSE(options.bRealTime);
    REQUIRE(options.host.controller.timeScale == 1.0);
    REQUIRE(options.host.controller.otherPrograms == ProgramSpec{2s, false});
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
        "--ready",
        "--playing",
        "--realtime",
        "--log-level",
        "error"};
    REQUIRE_FALSE(ParseOptionsOrNull(static_cast<int>(arguments.size()), arguments.data(), options).has_value());
    REQUIRE(options.host.stream == ACS::Apps::Endpoint{"0.0.0.0", 0});
    REQUIRE(options.host.http == ACS::Apps::Endpoint{"::1", 1});
    REQUIRE(options.host.controller.timeScale == 20.0);
    REQUIRE(options.host.controller.bMotorOn);
    REQUIRE(options.host.controller.bWaiting);
    REQUIRE(options.bRealTime);
    REQUIRE(options.host.controller.programs.size() == 2);
    REQUIRE(options.host.controller.programs.at(11) == ProgramSpec{3s, false});
    REQUIRE(options.host.controller.programs.at(12) == ProgramSpec{500ms, true});
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
        REQUIRE_FALSE(TakeProgram(text, options).empty());
    }
    REQUIRE(options.programs.empty());
    REQUIRE(TakeProgram("9999=1h", options).empty());
    REQUIRE(TakeProgram("9999=2s", options) == "program 9999 is given twice");
}

TEST_CASE("A mistake on the command line is exit code 2")
{
    for (const std::array<const char*, 3>& arguments :
         {std::array{"openstream-sim", "--listen", "here"},
          std::array{"openstream-sim", "--time-scale", "0"},
          std::array{"openstream-sim", "--program", "11"},
          std::array{"openstream-sim", "--frobnicate", "1"}})
    {
        OpenStreamSimOptions options;
        REQUIRE(ParseOptionsOrNull(3, arguments.data(), options) == 2);
    }
}
