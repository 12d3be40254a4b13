#include "McsSimOptions.hpp"

#include <CLI/CLI.hpp>

#include <utility>

namespace ACS::McsSim
{

namespace
{

constexpr std::size_t MAX_REPEAT = 10'000;

std::string TakePath(const std::string& text, std::string& path)
{
    if (!text.starts_with('/') || text.find_first_of(" ?#") != std::string::npos)
    {
        return "expected a path that begins with a slash (/acs/), found '" + text + "'";
    }
    path = text;
    return {};
}

std::string TakeLiveMode(const std::string& text, ELiveMode& mode)
{
    for (const auto& [word, value] :
         {std::pair{"auto", ELiveMode::Auto},
          std::pair{"always", ELiveMode::Always},
          std::pair{"never", ELiveMode::Never}})
    {
        if (text == word)
        {
            mode = value;
            return {};
        }
    }
    return "expected auto, always or never, found '" + text + "'";
}

void AddTlsOptions(CLI::App& app, ProtocolBeast::TlsOptions& tls)
{
    const auto addFile = [&app](const std::string& name, std::string& file, const std::string& help) {
        Apps::AddTextOption(
            app,
            name,
            [&file](const std::string& text) {
                file = text;
                return std::string();
            },
            help)
            .type_name("FILE.pem");
    };
    addFile(
        "--tls-certificate",
        tls.certificateFile,
        "Serve wss with this certificate (and its intermediate certificates)");
    addFile("--tls-key", tls.keyFile, "The private key of --tls-certificate, without a passphrase");
    addFile("--tls-client-ca", tls.caFile, "Accept only an ACS with a certificate of this CA");
}

std::string TakeProfile(const std::string& text, EProfile& profile)
{
    for (const auto& [word, value] : {std::pair{"spec", EProfile::Spec}, std::pair{"nexus", EProfile::Nexus}})
    {
        if (text == word)
        {
            profile = value;
            return {};
        }
    }
    return "expected spec or nexus, found '" + text + "'";
}

void AddWorldOptions(CLI::App& app, McsSimOptions& options)
{
    CLI::Option& world = Apps::AddFileOption(
        app,
        "--world",
        options.worldFile,
        "Compare the reports with what the simulated robots have moved: the world file that they share (docs/reference/mcs-sim.md)");
    world.type_name("FILE.json");
    CLI::Option* const restock =
        app.add_flag(
               "--restock",
               options.bRestock,
               "With --world, before a plan is sent: put its carriers and memories where it picks them first and empty the "
               "places where it puts some; plans that share a station or a carrier go one after the other (default)")
            ->needs(&world);
    app.add_flag_callback(
           "--no-restock",
           [&options] { options.bRestock = false; },
           "With --world: leave the floor as it is")
        ->needs(&world)
        ->excludes(restock);
}

/// What is wrong with options that do not go together; empty: nothing.
std::string FindContradiction(const McsSimOptions& options)
{
    const bool bScenarios = !options.scenarioFiles.empty();
    if (options.planFiles.empty() && !bScenarios && !options.bConsole)
    {
        return "nothing to send: give --plan FILE.json or --scenario FILE.json; try mcs-sim --help";
    }
    if (bScenarios && !options.planFiles.empty())
    {
        return "--plan and --scenario do not go together: let a scenario send the plan";
    }
    if (options.bConsole && (bScenarios || options.bWaitForEnter))
    {
        return "--console does not go together with --scenario and --wait-for-enter: it reads standard input itself";
    }
    return {};
}

} // namespace

std::optional<int> ParseOptionsOrNull(int argc, const char* const* argv, McsSimOptions& options)
{
    CLI::App app{
        "Simulates the MCS: accepts an ACS on a WebSocket, sends it plans and shows its reports until all plans have "
        "ended, or plays scenarios. Exit code 0 if every plan was completed or every expectation of the scenarios held, "
        "every report was valid and no carrier was misplaced; otherwise 1; 2 for an invalid command line or file.",
        std::string(PROGRAM_NAME)};
    Apps::AddEndpointOption(app, "--listen", options.listen, "Address to listen on; port 0 selects a free one");
    Apps::AddTextOption(
        app,
        "--path",
        [&options](const std::string& text) { return TakePath(text, options.path); },
        "Path of the WebSocket")
        .type_name("PATH")
        ->default_str(options.path);
    ProtocolBeast::TlsOptions tls;
    AddTlsOptions(app, tls);
    Apps::AddRepeatedOption(
        app,
        "--plan",
        [&options](const std::string& text) {
            options.planFiles.push_back(text);
            return std::string();
        },
        "Plans to send: files with the payload of an ExecutionPlan or the whole message")
        .type_name("FILE.json")
        ->allow_extra_args();
    Apps::AddRepeatedOption(
        app,
        "--scenario",
        [&options](const std::string& text) {
            options.scenarioFiles.push_back(text);
            return std::string();
        },
        "Scenarios to play instead of plans, one after the other: files of what to send and what to expect "
        "(docs/reference/mcs-sim.md has the format)")
        .type_name("FILE.json")
        ->allow_extra_args();
    Apps::AddCountOption(
        app,
        "--repeat",
        options.repeat,
        {1, MAX_REPEAT},
        "Number of times that each file is sent, in rotation, with fresh ids (default 1)");
    app.add_flag("--fresh-ids", options.bFreshIDs, "Replace the ids of plans, transactions, jobs and carriers");
    Apps::AddTextOption(
        app,
        "--live",
        [&options](const std::string& text) { return TakeLiveMode(text, options.liveMode); },
        "Show robots and plans in place: auto (on a terminal), always or never")
        .type_name("MODE")
        ->default_str("auto");
    app.add_flag("--keep", options.bKeep, "Keep running when all plans have ended, until SIGINT or SIGTERM");
    app.add_flag(
        "--wait-for-enter",
        options.bWaitForEnter,
        "Send the plans only after a line was read from standard input");
    Apps::AddFileOption(
        app,
        "--trace",
        options.traceFile,
        "Write every message of both directions to this file, a line of JSON each, with time and connection");
    Apps::AddTextOption(
        app,
        "--profile",
        [&options](const std::string& text) { return TakeProfile(text, options.profile); },
        "MCS behaviour profile: spec (as specified) or nexus (as the public MCS: longer messages than 4096 bytes are lost, "
        "a second client is refused, nothing is resent, plans with fresh ids name their robot)")
        .type_name("NAME")
        ->default_str("spec");
    app.add_flag(
        "--console",
        options.bConsole,
        "Read lines from standard input: plan FILE, cancel PLANID, abort, pause, resume, drop, list, help, quit");
    AddWorldOptions(app, options);
    Apps::AddCommonOptions(app, options.common);
    const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCode.has_value())
    {
        return exitCode;
    }
    const std::string contradiction = FindContradiction(options);
    if (!contradiction.empty())
    {
        Apps::PrintError(PROGRAM_NAME, contradiction);
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    if (tls != ProtocolBeast::TlsOptions())
    {
        if (tls.certificateFile.empty() || tls.keyFile.empty())
        {
            Apps::PrintError(PROGRAM_NAME, "wss needs both --tls-certificate FILE.pem and --tls-key FILE.pem");
            return Apps::EXIT_BAD_COMMAND_LINE;
        }
        options.tls = std::move(tls);
    }
    return std::nullopt;
}

} // namespace ACS::McsSim
