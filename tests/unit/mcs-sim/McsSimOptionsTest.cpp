#include "McsSimOptions.hpp"

#include "Catch.hpp"

#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

using ACS::McsSim::ELiveMode;
using ACS::McsSim::McsSimOptions;

namespace
{

struct Outcome
{
    std::optional<int> exitCode;
    McsSimOptions options;
    std::string errors;
};

Outcome Parse(std::vector<const char*> arguments)
{
    Outcome outcome;
    arguments.insert(arguments.begin(), "mcs-sim");
    const std::ostringstream errors;
    std::streambuf* const before = std::cerr.rdbuf(errors.rdbuf());
    outcome.exitCode =
        ACS::McsSim::ParseOptionsOrNull(static_cast<int>(arguments.size()), arguments.data(), outcome.options);
    std::cerr.rdbuf(before);
    outcome.errors = errors.str();
    return outcome;
}

} // namespace

TEST_CASE("The command line has the documented defaults")
{
    const Outcome outcome = Parse({"--plan", "a.json"});
    CHECK_FALSE(outcome.exitCode.has_value());
    CHECK(MakeText(outcome.options.listen) == "127.0.0.1:9001");
    CHECK(outcome.options.path == "/acs/");
    CHECK(outcome.options.repeat == 1);
    CHECK(outcome.options.liveMode == ELiveMode::Auto);
    CHECK_FALSE(outcome.options.tls.has_value());
    CHECK_FALSE(outcome.options.bFreshIDs);
    CHECK_FALSE(outcome.options.bKeep);
    CHECK_FALSE(outcome.options.bWaitForEnter);
    CHECK(outcome.options.worldFile.empty());
}

TEST_CASE("With a world file the floor is restocked, unless that is off")
{
    CHECK(Parse({"--plan", "a.json", "--world", "w.json"}).options.worldFile == "w.json");
    CHECK(Parse({"--plan", "a.json", "--world", "w.json"}).options.bRestock);
    CHECK(Parse({"--plan", "a.json", "--world", "w.json", "--restock"}).options.bRestock);
    CHECK_FALSE(Parse({"--plan", "a.json", "--world", "w.json", "--no-restock"}).options.bRestock);
}

TEST_CASE("A message names the option that was given, not its opposite")
{
    CHECK_THAT(
        Parse({"--plan", "a.json", "--no-restock"}).errors,
        Catch::Contains("mcs-sim: --no-restock requires --world"));
    CHECK_THAT(Parse({"--plan", "a.json", "--restock"}).errors, Catch::Contains("mcs-sim: --restock requires --world"));
    const Outcome both = Parse({"--plan", "a.json", "--world", "w.json", "--restock", "--no-restock"});
    CHECK(both.exitCode == 2);
    CHECK_THAT(both.errors, Catch::Contains("--restock excludes --no-restock"));
}

TEST_CASE("Plans may follow one --plan or several, in order")
{
    const Outcome outcome =
        Parse({"--plan", "a.json", "b.json", "--repeat", "3", "--live", "never", "--plan", "c.json", "--keep"});
    CHECK_FALSE(outcome.exitCode.has_value());
    CHECK(outcome.options.planFiles == std::vector<std::string>{"a.json", "b.json", "c.json"});
    CHECK(outcome.options.repeat == 3);
    CHECK(outcome.options.liveMode == ELiveMode::Never);
    CHECK(outcome.options.bKeep);
}

TEST_CASE("A certificate and its key make it wss, a client CA asks for certificates")
{
    const Outcome outcome =
        Parse({"--plan", "a.json", "--tls-certificate", "a.pem", "--tls-key", "a.key", "--tls-client-ca", "ca.pem"});
    CHECK_FALSE(outcome.exitCode.has_value());
    REQUIRE(outcome.options.tls.has_value());
    CHECK(*outcome.options.tls == ACS::ProtocolBeast::TlsOptions{"ca.pem", "a.pem", "a.key", {}});
}

TEST_CASE("An invalid command line is reported in one line, with exit code 2")
{
    using Arguments = std::vector<const char*>;
    const auto arguments = GENERATE(
        Arguments{"--frobnicate"},
        Arguments{},
        Arguments{"--plan", "a.json", "--scenario", "b.json"},
        Arguments{"--plan", "a.json", "--profile", "both"},
        Arguments{"--console", "--scenario", "b.json"},
        Arguments{"--plan", "a.json", "--repeat", "0"},
        Arguments{"--plan", "a.json", "--repeat", "-18446744073709551615"},
        Arguments{"--plan", "a.json", "--live", "perhaps"},
        Arguments{"--plan", "a.json", "--no-restock"},
        Arguments{"--plan", "a.json", "--restock"},
        Arguments{"--plan", "a.json", "--no-restock", "--restock", "--world", "w.json"},
        Arguments{"--plan", "a.json", "--world", ""},
        Arguments{"--plan", "a.json", "--path", "acs"},
        Arguments{"--plan", "a.json", "--tls-key", "a.key"},
        Arguments{"--plan", "a.json", "--tls-certificate", "a.pem"},
        Arguments{"--plan", "a.json", "--listen", "nowhere"});
    const Outcome outcome = Parse(arguments);
    CHECK(outcome.exitCode == 2);
    CHECK(outcome.errors.find('\n') == outcome.errors.size() - 1);
    if (arguments.size() != 3 && !arguments.empty())
    {
        CHECK(outcome.errors.find(arguments[arguments.size() == 1 ? 0 : 2]) != std::string::npos);
    }
}

TEST_CASE("Scenarios, a profile, a trace and the console have their options")
{
    const Outcome outcome = Parse({"--scenario", "a.json", "b.json", "--profile", "nexus", "--trace", "t.ndjson"});
    CHECK_FALSE(outcome.exitCode.has_value());
    CHECK(outcome.options.scenarioFiles == std::vector<std::string>{"a.json", "b.json"});
    CHECK(outcome.options.profile == ACS::McsSim::EProfile::Nexus);
    CHECK(outcome.options.traceFile == "t.ndjson");
    CHECK_FALSE(outcome.options.bConsole);
    CHECK(Parse({"--console"}).options.bConsole);
}
