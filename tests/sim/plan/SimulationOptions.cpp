#include "SimulationOptions.hpp"

#include "common/config/CommandLine.hpp"
#include <acs/core/Result.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace ACS::Simulation
{

namespace
{

std::string ParseFault(std::string_view text, FaultSet& faults)
{
    const auto* const found = std::ranges::find(FAULT_NAMES, text);
    if (found == FAULT_NAMES.end())
    {
        return fmt::format("expected {}, found {}", fmt::join(FAULT_NAMES, ", "), Core::QuoteForError(text));
    }
    faults.set(static_cast<std::size_t>(found - FAULT_NAMES.begin()));
    return {};
}

std::string ParseMutation(std::string_view text, EMutation& mutation)
{
    const auto* const found = std::ranges::find(MUTATION_TEXTS, text, &MutationText::name);
    if (found == MUTATION_TEXTS.end())
    {
        return fmt::format("expected a name from --list-mutations, found {}", Core::QuoteForError(text));
    }
    mutation = static_cast<EMutation>(found - MUTATION_TEXTS.begin());
    return {};
}

std::string ParseRobots(std::string_view text, std::optional<ERobotKind>& robots)
{
    for (const ERobotKind kind : {ERobotKind::Memory, ERobotKind::Vda5050, ERobotKind::Arms})
    {
        if (text == GetText(kind))
        {
            robots = kind;
            return {};
        }
    }
    return fmt::format("expected memory, vda5050 or arms, found {}", Core::QuoteForError(text));
}

} // namespace

std::optional<int> ReadOptionsOrNull(int argc, const char* const* argv, SimulationOptions& options)
{
    CLI::App app{
        "Runs acsd's engine, sessions and adapters against a simulated MCS, disk, network and robots in virtual time, and\n"
        "checks after every event that nothing is lost, executed twice, reported wrongly or never finished.\n"
        "See docs/design/simulation.md.",
        "plan_simulation"};
    app.add_option("--seeds", options.seeds, "number of runs, each from its own seed")->capture_default_str();
    app.add_option("--first", options.first, "the first seed")->capture_default_str();
    app.add_option("--seed", options.seedOrNull, "only this seed");
    app.add_flag("--trace", options.bTrace, "print a trace of all events; with --seed");
    app.add_flag("--keep-going", options.bKeepsGoing, "continue after a seed that fails, and report all of them");
    app.add_option("--workers", options.workers, "number of threads, each with its own runs")
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    Apps::AddRepeatedOption(
        app,
        "--without",
        [&options](const std::string& text) { return ParseFault(text, options.without); },
        fmt::format("leave out one kind of fault: {}", fmt::join(FAULT_NAMES, ", ")));
    Apps::AddTextOption(
        app,
        "--mutation",
        [&options](const std::string& text) { return ParseMutation(text, options.mutation); },
        "build in one defect around the engine; a seed that fails must be found");
    Apps::AddTextOption(
        app,
        "--robots",
        [&options](const std::string& text) { return ParseRobots(text, options.robots); },
        "kind of all robots: memory, vda5050 or arms (vehicles, CRs with arms); default: from the seed");
    app.add_flag("--shared", options.bShared, "all runs with a shared store and a standby; default: from the seed");
    app.add_flag("--mutations", options.bAllMutations, "check that every mutation is found within --seeds runs");
    app.add_flag("--list-mutations", options.bListMutations, "list the mutations with their meaning");
    return Apps::ParseCommandLineOrNull(app, argc, argv);
}

} // namespace ACS::Simulation
