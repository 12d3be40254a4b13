#include "options/AcsctlParser.hpp"

#include "Catch.hpp"

namespace Acsctl = ACS::Acsctl;
using Acsctl::ECommand;

namespace
{

using Words = std::vector<std::string>;

Acsctl::AcsctlOptions Parse(Words words)
{
    words.insert(words.begin(), "acsctl");
    Acsctl::AcsctlOptions options;
    REQUIRE_FALSE(Acsctl::ParseOptionsOrNull(words, options).has_value());
    return options;
}

int ParseBad(Words words)
{
    words.insert(words.begin(), "acsctl");
    Acsctl::AcsctlOptions options;
    return Acsctl::ParseOptionsOrNull(words, options).value_or(0);
}

} // namespace

TEST_CASE("Options are read before and after the command")
{
    const Acsctl::AcsctlOptions options =
        Parse({"--json", "plans", "--state", "finished", "--url", "http://x", "--limit", "5", "--timeout", "3s"});
    CHECK(options.command == ECommand::Plans);
    CHECK(options.bJSON);
    CHECK(options.arguments.state == "finished");
    CHECK(options.arguments.limit == 5);
    CHECK(Parse({"events", "--after", "0"}).arguments.after == 0);
    CHECK(Parse({"events", "--after", "18446744073709551615"}).arguments.after == 18'446'744'073'709'551'615U);
    CHECK(Parse({"trace", "--limit", "010"}).arguments.limit == 10);
    CHECK(Parse({"skip", "P", "010"}).arguments.number == 10);
    CHECK(Parse({"priority", "P", "010"}).arguments.number == 10);
    CHECK(Parse({"priority", "P", "-3"}).arguments.number == -3);
    CHECK(Parse({"priority", "P", "2147483647"}).arguments.number == 2'147'483'647);
    CHECK(Parse({"priority", "P", "-2147483648"}).arguments.number == -2'147'483'648);
    CHECK(options.connection.url == "http://x");
    CHECK(options.timeout.count() == 3'000);
    CHECK(Parse({"tsc", "resume", "-y"}).command == ECommand::TscResume);
    CHECK(Parse({"tsc", "resume", "-y"}).bYes);
    CHECK(Parse({"context", "set", "a", "--url", "http://x"}).command == ECommand::ContextSet);
}

TEST_CASE("The interval of --watch may be left out")
{
    CHECK(Parse({"plans", "--watch"}).watch->count() == 2'000);
    CHECK(Parse({"plans", "--watch", "0.5"}).watch->count() == 500);
    CHECK(Parse({"plan", "--watch", "P1"}).arguments.id == "P1");
    CHECK(Parse({"--watch=7", "plans"}).watch->count() == 7'000);
    CHECK(ParseBad({"plans", "--watch=x"}) == 2);
    CHECK(ParseBad({"plans", "--watch=0"}) == 2);
    CHECK(ParseBad({"plans", "--watch=nan"}) == 2);
}

TEST_CASE("The parameters of an instant action are KEY=VALUE")
{
    const Acsctl::AcsctlOptions options = Parse({"action", "LR01", "beep", "x=-1", "text=a=b", "empty=", "--no-wait"});
    CHECK(options.command == ECommand::Action);
    CHECK(options.arguments.id == "LR01");
    CHECK(options.arguments.word == "beep");
    CHECK(options.arguments.parameters == Words{"x=-1", "text=a=b", "empty="});
    CHECK(options.arguments.bNotAwaited);
    CHECK(Parse({"action", "LR01", "beep"}).arguments.parameters.empty());
    CHECK(ParseBad({"action", "LR01"}) == 2);
    CHECK(ParseBad({"action", "LR01", "beep", "x"}) == 2);
    CHECK(ParseBad({"action", "LR01", "beep", "=1"}) == 2);
}

TEST_CASE("A port without a carrier is - or --")
{
    CHECK(Parse({"carriers", "CR01", "C_01", "--", "-"}).arguments.carriers == Words{"C_01", "-", "-"});
    CHECK(Parse({"carriers", "CR01", "-", "--yes"}).arguments.carriers == Words{"-"});
    CHECK(Acsctl::NormalizeArguments({"acsctl", "plan", "--", "-P"}) == Words{"acsctl", "plan", "--", "-P"});
    CHECK(Parse({"plan", "--", "-P"}).arguments.id == "-P");
}

TEST_CASE("A trace may be read from files, then with more lines")
{
    CHECK(Parse({"trace", "--limit", "1000"}).arguments.files.empty());
    const Acsctl::AcsctlOptions options = Parse({"trace", "--file", "a", "--limit", "1000000", "--file", "b"});
    CHECK(options.command == ECommand::Trace);
    CHECK(options.arguments.files == Words{"a", "b"});
    CHECK(options.arguments.limit == 1'000'000);
}

TEST_CASE("A plan may have the name of a command")
{
    CHECK(Parse({"plan", "status"}).arguments.id == "status");
    CHECK(Parse({"cancel", "why"}).command == ECommand::Cancel);
}

TEST_CASE("An invalid command line is refused")
{
    const Words words = GENERATE(
        Words{},
        Words{"odd"},
        Words{"plan"},
        Words{"plan", ""},
        Words{"plan", "P1", "P2"},
        Words{"plans", "--state", "odd"},
        Words{"plans", "--limit", "0"},
        Words{"plans", "--limit", "1001"},
        Words{"plans", "--limit", "-18446744073709551615"}, // 1 in 64 bits without a sign
        Words{"events", "--after", "-1"},
        Words{"events", "--after", "x"},
        Words{"events", "--after", "18446744073709551616"},
        Words{"trace", "--limit", "1001"},
        Words{"trace", "--file", ""},
        Words{"trace", "--file", "a", "--limit", "1000001"},
        Words{"plans", "--url", "a", "--url", "b"},
        Words{"tsc"},
        Words{"tsc", "stop"},
        Words{"resolve", "P", "J", "maybe"},
        Words{"skip", "P", "-1"},
        Words{"skip", "P", "x"},
        Words{"skip", "P", "2147483648"},
        Words{"priority", "P", "1.5"},
        Words{"priority", "P", "2147483648"},
        Words{"priority", "P", "-2147483649"},
        Words{"maintenance", "LR01", "maybe"},
        Words{"carriers", "LR01"},
        Words{"block", "robot", "X"},
        Words{"plans", "--timeout", "0s"},
        Words{"completion", "fish"});
    CAPTURE(words);
    CHECK(ParseBad(words) == 2);
}
