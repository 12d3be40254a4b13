#include "console/ConsoleCommand.hpp"

#include "console/CleanText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view SPACE = " \t\r\n";

struct VerbEntry
{
    std::string_view name;
    EConsoleVerb verb;
    std::string_view argument; ///< Empty: there is none.
};

constexpr std::array<VerbEntry, 9> VERBS{
    {{"plan", EConsoleVerb::Plan, "FILE"},
     {"cancel", EConsoleVerb::Cancel, "PLANID"},
     {"abort", EConsoleVerb::Abort, "PLANID"},
     {"pause", EConsoleVerb::Pause, "PLANID"},
     {"resume", EConsoleVerb::Resume, "PLANID"},
     {"drop", EConsoleVerb::Drop, ""},
     {"list", EConsoleVerb::List, ""},
     {"help", EConsoleVerb::Help, ""},
     {"quit", EConsoleVerb::Quit, ""}}};

std::string_view Trim(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(SPACE);
    return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(SPACE) + 1 - first);
}

} // namespace

tl::expected<ConsoleCommand, std::string> ParseConsoleLine(std::string_view line)
{
    if (line.size() > MAX_CONSOLE_LINE)
    {
        return tl::make_unexpected(fmt::format("a line has at most {} bytes", MAX_CONSOLE_LINE));
    }
    line = Trim(line);
    if (line.empty())
    {
        return ConsoleCommand{};
    }
    const std::string_view name = line.substr(0, line.find_first_of(SPACE));
    const std::string_view argument = Trim(line.substr(name.size()));
    const auto* const entry =
        std::find_if(VERBS.begin(), VERBS.end(), [name](const VerbEntry& candidate) { return candidate.name == name; });
    if (entry == VERBS.end())
    {
        return tl::make_unexpected("there is no '" + CleanText(name) + "': try help");
    }
    if (entry->argument.empty() != argument.empty())
    {
        std::string sentence = "expected '" + std::string(name);
        sentence += entry->argument.empty() ? "" : " " + std::string(entry->argument);
        return tl::make_unexpected(sentence + "', found '" + CleanText(line) + "'");
    }
    return ConsoleCommand{entry->verb, std::string(argument)};
}

std::string_view GetConsoleHelp()
{
    return "plan FILE      send the plan of a file, with fresh ids\n"
           "cancel PLANID  CancelPlan\n"
           "abort PLANID   AbortPlan\n"
           "pause PLANID   PausePlan\n"
           "resume PLANID  ResumePlan\n"
           "drop           cut the connection\n"
           "list           the plans of this run, and what became of them\n"
           "help           this\n"
           "quit           end the run";
}

} // namespace ACS::McsSim
