#include "console/ConsoleCommand.hpp"

#include "Catch.hpp"

#include <string>

using ACS::McsSim::ConsoleCommand;
using ACS::McsSim::EConsoleVerb;
using ACS::McsSim::ParseConsoleLine;

TEST_CASE("A line of the console is a verb and what it is about")
{
    CHECK(*ParseConsoleLine("plan a file.json") == ConsoleCommand{EConsoleVerb::Plan, "a file.json"});
    CHECK(*ParseConsoleLine("  cancel \t PLAN-1 \r") == ConsoleCommand{EConsoleVerb::Cancel, "PLAN-1"});
    CHECK(*ParseConsoleLine("resume PLAN-1") == ConsoleCommand{EConsoleVerb::Resume, "PLAN-1"});
    CHECK(*ParseConsoleLine("list") == ConsoleCommand{EConsoleVerb::List, ""});
    CHECK(*ParseConsoleLine(" ") == ConsoleCommand{});
}

TEST_CASE("An invalid line of the console is reported")
{
    CHECK(ParseConsoleLine("dance\x1b[2J").error() == "there is no 'dance?[2J': try help");
    CHECK(ParseConsoleLine("cancel").error() == "expected 'cancel PLANID', found 'cancel'");
    CHECK(ParseConsoleLine("quit now").error() == "expected 'quit', found 'quit now'");
    CHECK(ParseConsoleLine("list" + std::string(4'092, ' ')).error() == "a line has at most 4095 bytes");
    CHECK(ParseConsoleLine("list" + std::string(4'091, ' ')).has_value());
}

TEST_CASE("The help of the console names every verb")
{
    const std::string help(ACS::McsSim::GetConsoleHelp());
    for (const std::string verb : {"plan", "cancel", "abort", "pause", "resume", "drop", "list", "help", "quit"})
    {
        CAPTURE(verb);
        CHECK(("\n" + help).find("\n" + verb + " ") != std::string::npos);
    }
}
