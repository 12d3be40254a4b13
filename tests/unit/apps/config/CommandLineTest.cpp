#include "common/config/CommandLine.hpp"

#include "Catch.hpp"
#include "common/Version.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace Apps = ACS::Apps;
namespace Core = ACS::Core;
using Catch::Matchers::Contains;

namespace
{

/// Captures what is written to a stream while this object exists.
class StreamCapture final
{
    std::ostream& _stream;
    std::ostringstream _text;
    std::streambuf* _original;

public:
    explicit StreamCapture(std::ostream& stream)
        : _stream(stream),
          _original(stream.rdbuf(_text.rdbuf()))
    {
    }

    StreamCapture(const StreamCapture&) = delete;
    StreamCapture& operator=(const StreamCapture&) = delete;

    ~StreamCapture()
    {
        _stream.rdbuf(_original);
    }

    [[nodiscard]] std::string GetText() const
    {
        return _text.str();
    }
};

struct Outcome
{
    std::optional<int> exitCode;
    std::string output;
    std::string errors;
    Apps::CommonOptions common;
    Apps::Endpoint listen{"127.0.0.1", 9001};
    Apps::Url broker;
    double timeScale = 1.0;
    std::vector<std::string> vehicles;
};

Outcome Parse(const std::vector<const char*>& arguments)
{
    Outcome outcome;
    CLI::App app{"A program for tests", "some-sim"};
    Apps::AddCommonOptions(app, outcome.common);
    Apps::AddEndpointOption(app, "--listen", outcome.listen, "Where to serve");
    Apps::AddUrlOption(app, "--broker", outcome.broker, {Apps::EUrlScheme::Mqtt}, "The broker");
    Apps::AddTimeScaleOption(app, outcome.timeScale);
    const auto takeVehicle = [&outcome](const std::string& text) {
        outcome.vehicles.push_back(text);
        return std::string(text == "bad" ? "no such vehicle" : "");
    };
    Apps::AddRepeatedOption(app, "--vehicle", takeVehicle, "A vehicle");
    Apps::AddRepeatedOption(app, "--plan", takeVehicle, "Plans").allow_extra_args();
    std::vector<const char*> argv{"/usr/bin/renamed"};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    const StreamCapture output(std::cout);
    const StreamCapture errors(std::cerr);
    outcome.exitCode = Apps::ParseCommandLineOrNull(app, static_cast<int>(argv.size()), argv.data());
    outcome.output = output.GetText();
    outcome.errors = errors.GetText();
    return outcome;
}

} // namespace

TEST_CASE("A help or a version that cannot be written is an error")
{
    const auto* const word = GENERATE("--help", "--version");
    class FullDevice final : public std::streambuf
    {
    };
    FullDevice device;
    std::streambuf* const original = std::cout.rdbuf(&device);
    CLI::App app{"A program for tests", "some-sim"};
    Apps::CommonOptions common;
    Apps::AddCommonOptions(app, common);
    const std::vector<const char*> argv{"some-sim", word};
    const StreamCapture errors(std::cerr);
    const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, static_cast<int>(argv.size()), argv.data());
    std::cout.rdbuf(original); // clears its state too
    CHECK(exitCode == 1);
    CHECK(errors.GetText() == "some-sim: the output could not be written\n");
}

TEST_CASE("Valid options are read and the program continues")
{
    const Outcome outcome = Parse(
        {"--listen",
         "[::1]:0",
         "--broker=mqtt://h",
         "--log-level",
         "debug",
         "--time-scale",
         "2.5",
         "--vehicle",
         "LR01",
         "--vehicle",
         "CR01,type=CR",
         "--plan",
         "a.json",
         "b.json"});
    CAPTURE(outcome.errors);
    REQUIRE_FALSE(outcome.exitCode.has_value());
    REQUIRE(outcome.listen == Apps::Endpoint{"::1", 0});
    REQUIRE(outcome.broker.peer == Apps::Endpoint{"h", 1883});
    REQUIRE(outcome.common.logLevel == Core::ELogLevel::Debug);
    REQUIRE(outcome.timeScale == 2.5);
    REQUIRE(outcome.vehicles == std::vector<std::string>{"LR01", "CR01,type=CR", "a.json", "b.json"});
    REQUIRE(outcome.output.empty());
}

TEST_CASE("Without options the defaults are kept")
{
    const Outcome outcome = Parse({});
    REQUIRE_FALSE(outcome.exitCode.has_value());
    REQUIRE(outcome.listen == Apps::Endpoint{"127.0.0.1", 9001});
    REQUIRE(outcome.common.logLevel == Core::ELogLevel::Info);
    REQUIRE(outcome.timeScale == 1.0);
}

TEST_CASE("Help is printed on standard output with the defaults; the exit code is 0")
{
    const Outcome outcome = Parse({"--help"});
    REQUIRE(outcome.exitCode == 0);
    REQUIRE_THAT(outcome.output, Contains("A program for tests"));
    REQUIRE_THAT(outcome.output, Contains("127.0.0.1:9001"));
    REQUIRE_THAT(outcome.output, Contains("--log-level"));
    REQUIRE(outcome.errors.empty());
}

TEST_CASE("The option --version prints the name of the program and the version of the project")
{
    const Outcome outcome = Parse({"--version"});
    REQUIRE(outcome.exitCode == 0);
    REQUIRE(outcome.output == "some-sim " + std::string(Apps::VERSION) + "\n");
}

TEST_CASE("An invalid command line prints one line with program and option; the exit code is 2")
{
    using Row = std::pair<std::vector<const char*>, const char*>;
    const Row row = GENERATE(
        Row{{"--colour"}, "--colour"},
        Row{{"--log-level", "loud"}, "--log-level: expected debug, info, warning or error, found 'loud'"},
        Row{{"--log-level"}, "--log-level"},
        Row{{"--listen", "here"}, "--listen: expected HOST:PORT"},
        Row{{"--listen", "a:1", "--listen", "b:2"}, "--listen"},
        Row{{"--broker", "http://h"}, "--broker: expected a URL mqtt://"},
        Row{{"--time-scale", "0"}, "--time-scale"},
        Row{{"--time-scale", "fast"}, "--time-scale"},
        Row{{"--time-scale", "nan"}, "--time-scale"},
        Row{{"--vehicle", "LR01", "--vehicle", "bad"}, "--vehicle: no such vehicle"},
        Row{{"--vehicle", "LR01", "LR02"}, "LR02"},
        Row{{"stray"}, "stray"});
    const Outcome outcome = Parse(row.first);
    CAPTURE(row.first, outcome.errors);
    REQUIRE(outcome.exitCode == Apps::EXIT_BAD_COMMAND_LINE);
    REQUIRE(outcome.output.empty());
    REQUIRE_THAT(outcome.errors, Catch::Matchers::StartsWith("some-sim: "));
    REQUIRE_THAT(outcome.errors, Contains(row.second));
    REQUIRE_THAT(outcome.errors, Catch::Matchers::EndsWith("; try some-sim --help\n"));
    REQUIRE(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
}

TEST_CASE("An unknown word is named before what is missing")
{
    CLI::App app{"A program for tests", "some-sim"};
    std::string file;
    Apps::AddFileOption(app, "--config", file, "The configuration").required();
    app.add_subcommand("plans", "Lists plans");
    app.require_subcommand(1);
    const std::vector<const char*> words{"some-sim", "plnas"};
    const StreamCapture errors(std::cerr);
    CHECK(
        Apps::ParseCommandLineOrNull(app, static_cast<int>(words.size()), words.data()) == Apps::EXIT_BAD_COMMAND_LINE);
    CHECK_THAT(errors.GetText(), Contains("plnas"));
}

TEST_CASE("An uncaught exception prints one line; the exit code is 1")
{
    const StreamCapture errors(std::cerr);
    const int exitCode = Apps::RunProgram("acsd", []() -> int { throw std::runtime_error("first\nsecond"); });
    REQUIRE(exitCode == 1);
    REQUIRE(errors.GetText() == "acsd: stopped by an unexpected error: first second\n");
}

TEST_CASE("Control characters in an error are escaped")
{
    const StreamCapture errors(std::cerr);
    Apps::PrintError("vda-sim", std::string_view("carriers.A\0B\x1B[2J: wrong\nname", 28));
    REQUIRE(errors.GetText() == "vda-sim: carriers.A\\x00B\\x1b[2J: wrong name\n");
}
