#include "AcsSimOptions.hpp"

#include "Catch.hpp"

#include <chrono>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

using ACS::AcsSim::AcsSimOptions;
using ACS::AcsSim::EFault;
using ACS::AcsSim::FaultOrder;

namespace
{

struct ParsedLine
{
    std::optional<int> exitCode;
    AcsSimOptions options;
    std::string errors;
};

ParsedLine ParseLine(std::vector<const char*> arguments)
{
    ParsedLine parsed;
    arguments.insert(arguments.begin(), "acs-sim");
    const std::ostringstream errors;
    std::streambuf* const before = std::cerr.rdbuf(errors.rdbuf());
    parsed.exitCode =
        ACS::AcsSim::ParseOptionsOrNull(static_cast<int>(arguments.size()), arguments.data(), parsed.options);
    std::cerr.rdbuf(before);
    parsed.errors = errors.str();
    return parsed;
}

} // namespace

TEST_CASE("The command line of acs-sim has the documented defaults")
{
    const ParsedLine parsed = ParseLine({});
    CHECK_FALSE(parsed.exitCode.has_value());
    CHECK(MakeText(parsed.options.url) == "ws://127.0.0.1:9001/acs/");
    CHECK(parsed.options.robots.empty());
    CHECK(parsed.options.faults.empty());
    CHECK(parsed.options.plans == 0);
    CHECK(parsed.options.duration == std::chrono::milliseconds(0));
    CHECK(parsed.options.ackTimeout == std::chrono::seconds(5));
    CHECK(parsed.options.queue == 100);
}

TEST_CASE("The options of acs-sim are read")
{
    const ParsedLine parsed = ParseLine({"--url",         "wss://mcs:1/x",
                                         "--tls-ca",      "ca.pem",
                                         "--header",      "Authorization: Bearer a:b",
                                         "--robot",       "LR02",
                                         "--robot",       "CR07",
                                         "--fault",       "malformed",
                                         "--fault",       "reconnect=3",
                                         "--fault",       "late-ack=always",
                                         "--plans",       "2",
                                         "--for",         "3s",
                                         "--ack-timeout", "200ms",
                                         "--queue",       "0",
                                         "--time-scale",  "20"});
    REQUIRE_FALSE(parsed.exitCode.has_value());
    CHECK(MakeText(parsed.options.url) == "wss://mcs:1/x");
    CHECK(parsed.options.tls.caFile == "ca.pem");
    CHECK(parsed.options.headers == ACS::ProtocolBeast::HttpHeaders{{"Authorization", "Bearer a:b"}});
    CHECK(parsed.options.robots == std::vector<std::string>{"LR02", "CR07"});
    CHECK(
        parsed.options.faults
        == std::vector<FaultOrder>{{EFault::Malformed, 1}, {EFault::Reconnect, 3}, {EFault::LateAck, std::nullopt}});
    CHECK(parsed.options.plans == 2);
    CHECK(parsed.options.duration == std::chrono::seconds(3));
    CHECK(parsed.options.ackTimeout == std::chrono::milliseconds(200));
    CHECK(parsed.options.queue == 0);
}

TEST_CASE("An invalid value ends acs-sim with exit code 2 and a line that names the option")
{
    const auto arguments = GENERATE(
        std::vector<const char*>{"--fault", "dance"},
        std::vector<const char*>{"--fault", "malformed=0"},
        std::vector<const char*>{"--fault", "malformed=x"},
        std::vector<const char*>{"--robot", "XX01"},
        std::vector<const char*>{"--robot", "LR 01"},
        std::vector<const char*>{"--for", "0s"},
        std::vector<const char*>{"--for", "soon"},
        std::vector<const char*>{"--header", "Authorization"},
        std::vector<const char*>{"--url", "http://127.0.0.1"},
        std::vector<const char*>{"--plans", "-1"},
        std::vector<const char*>{"--plans", "-18446744073709551615"},
        std::vector<const char*>{"--queue", "0x10"},
        std::vector<const char*>{"--tls-ca", "ca.pem"});
    const ParsedLine parsed = ParseLine(arguments);
    CHECK(parsed.exitCode == 2);
    CHECK(parsed.errors.find(arguments.front()) != std::string::npos);
}
