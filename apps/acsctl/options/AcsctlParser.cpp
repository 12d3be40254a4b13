#include "options/AcsctlParser.hpp"

#include "common/config/CommandLine.hpp"
#include "common/Version.hpp"
#include "ExitCodes.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <string_view>

namespace ACS::Acsctl
{

namespace
{

constexpr std::uint64_t MAX_LIMIT = 1'000;
constexpr std::uint64_t MAX_FILE_LIMIT = 1'000'000;
constexpr double SHORTEST_WATCH = 0.1;
constexpr double LONGEST_WATCH = 86'400;
constexpr double MILLISECONDS = 1'000;

std::string ReadWatch(const std::string& text, std::optional<std::chrono::milliseconds>& watch)
{
    const std::optional<double> seconds = Core::ParseNumberOrNull<double>(text);
    if (!seconds.has_value() || !(*seconds >= SHORTEST_WATCH) || !(*seconds <= LONGEST_WATCH))
    {
        return fmt::format(
            "expected seconds from {} to {}, found {}",
            SHORTEST_WATCH,
            LONGEST_WATCH,
            Core::QuoteForError(text));
    }
    watch = std::chrono::milliseconds(static_cast<std::int64_t>(*seconds * MILLISECONDS));
    return {};
}

std::string CheckNotEmpty(const std::string& text)
{
    return text.empty() ? "expected a text that is not empty" : "";
}

CLI::Option& AddText(
    CLI::App& app,
    const std::string& name,
    std::optional<std::string>& target,
    const std::string& help)
{
    CLI::Option& option = Apps::AddTextOption(
        app,
        name,
        [&target](const std::string& text) {
            target = text;
            return CheckNotEmpty(text);
        },
        help);
    return option;
}

CLI::Option& AddPositional(CLI::App& app, const std::string& name, std::string& target, const std::string& help)
{
    return *app.add_option(name, target, help)->required()->type_name("")->check(CheckNotEmpty);
}

std::function<std::string(const std::string&)> MakeWordCheck(const std::vector<std::string>& words)
{
    return [words](const std::string& text) {
        const bool bKnown = std::find(words.begin(), words.end(), text) != words.end();
        return bKnown ? std::string()
                      : fmt::format("expected {}, found {}", fmt::join(words, ", "), Core::QuoteForError(text));
    };
}

void AddWord(
    CLI::App& app,
    const std::string& name,
    std::string& target,
    const std::vector<std::string>& words,
    const std::string& help)
{
    AddPositional(app, name, target, help).check(MakeWordCheck(words));
}

void AddNumber(
    CLI::App& app,
    const std::string& name,
    std::optional<std::uint64_t>& target,
    const Apps::NumberRange<std::uint64_t>& range,
    const std::string& help)
{
    const auto read = [&target, range](const std::string& text) {
        return Apps::AssignNumber(text, range, target);
    };
    Apps::AddTextOption(app, name, read, help).type_name("N");
}

/// A required number without a name.
void AddPositionalNumber(
    CLI::App& app,
    const std::string& name,
    std::int64_t& target,
    const Apps::NumberRange<std::int64_t>& range,
    const std::string& help)
{
    const auto read = [&target, range](const std::string& text) {
        return Apps::AssignNumber(text, range, target);
    };
    Apps::AddTextOption(app, name, read, help).required()->type_name("");
}

void AddLimit(CLI::App& app, CommandArguments& arguments)
{
    AddNumber(app, "--limit", arguments.limit, {1, MAX_LIMIT}, "Maximum number, 1 to 1000 (default 100)");
}

/// Adds a command below the app.
CLI::App& AddCommand(
    CLI::App& app,
    AcsctlOptions& options,
    const std::string& name,
    ECommand command,
    const std::string& help)
{
    CLI::App* const added = app.add_subcommand(name, help);
    added->fallthrough();
    added->callback([&options, command] { options.command = command; });
    return *added;
}

void AddGlobalOptions(CLI::App& app, AcsctlOptions& options)
{
    ConnectionOptions& connection = options.connection;
    AddText(app, "--context", connection.context, "Context of the configuration file").type_name("NAME");
    AddText(app, "--url", connection.url, "Address of acsd's operator API (default http://127.0.0.1:8081)")
        .type_name("URL");
    AddText(app, "--token-file", connection.tokenFile, "File with the token").type_name("FILE");
    AddText(app, "--ca", connection.ca, "With https: the CA of acsd's certificate (default: those of the system)")
        .type_name("FILE.pem");
    AddText(app, "--certificate", connection.certificate, "With https: the client's certificate").type_name("FILE.pem");
    AddText(app, "--key", connection.key, "The private key of --certificate, without a passphrase")
        .type_name("FILE.pem");
    Apps::AddDurationOption(app, "--timeout", options.timeout, "Maximum time for an answer (default 10s)");
    app.add_flag("--json", options.bJSON, "Print the answer of the API: one JSON document, or one for each line");
    Apps::AddTextOption(
        app,
        "--watch",
        [&options](const std::string& text) { return ReadWatch(text, options.watch); },
        "Repeat a command that reads, every SECONDS (default 2), until Ctrl-C")
        .type_name("[SECONDS]");
    app.add_flag("--no-color", options.bPlain, "Print without colours (also: the environment variable NO_COLOR)");
    app.add_flag("-y,--yes", options.bYes, "Do not ask before a command that ends work or lets robots move");
}

void AddStateCommands(CLI::App& app, AcsctlOptions& options)
{
    CommandArguments& arguments = options.arguments;
    CLI::App& status = AddCommand(app, options, "status", ECommand::Status, "Show acsd, its links, the TSC and counts");
    status.add_flag(
        "--check",
        arguments.bCheck,
        "Exit with 5 if acsd is not ready, a link is down, the TSC is not Auto or "
        "a heavy alarm is active");
    CLI::App& plans = AddCommand(app, options, "plans", ECommand::Plans, "List plans (default: the unfinished ones)");
    AddText(plans, "--state", arguments.state, "active, waiting, unfinished or finished")
        .check(MakeWordCheck({"active", "waiting", "unfinished", "finished"}))
        ->type_name("STATE");
    AddText(plans, "--robot", arguments.robot, "Only plans of this robot").type_name("ROBOT");
    AddText(plans, "--lot", arguments.lot, "Only plans of this lot").type_name("LOT");
    AddLimit(plans, arguments);
    CLI::App& plan = AddCommand(app, options, "plan", ECommand::Plan, "Show a plan with its steps and jobs");
    AddPositional(plan, "PLAN", arguments.id, "The plan");
    CLI::App& why = AddCommand(
        app,
        options,
        "why",
        ECommand::Why,
        "Explain why a plan or a robot does not move, and what to do; exit with 5 if it does not");
    why.add_option("ID", arguments.id, "A plan or a robot (default: everything that does not move)")
        ->type_name("")
        ->check(CheckNotEmpty);
    AddCommand(app, options, "robots", ECommand::Robots, "List robots");
    CLI::App& robot = AddCommand(app, options, "robot", ECommand::Robot, "Show a robot");
    AddPositional(robot, "ROBOT", arguments.id, "The robot");
    CLI::App& actions = AddCommand(
        app,
        options,
        "actions",
        ECommand::Actions,
        "Show the last instant actions of a robot with their outcome, and those that it offers");
    AddPositional(actions, "ROBOT", arguments.id, "The robot");
    AddCommand(app, options, "alarms", ECommand::Alarms, "List active alarms");
    AddCommand(app, options, "links", ECommand::Links, "Show the links to the MCS and to the MQTT broker");
    AddCommand(app, options, "queue", ECommand::Queue, "Show the waiting plans in queue order, and the outbox");
    AddCommand(app, options, "site", ECommand::Site, "Show the size of the map and what is blocked");
}

void AddHistoryCommands(CLI::App& app, AcsctlOptions& options)
{
    CommandArguments& arguments = options.arguments;
    CLI::App& events =
        AddCommand(app, options, "events", ECommand::Events, "Show what happens, one line for each event");
    events.add_flag("-f,--follow", arguments.bFollow, "Continue until Ctrl-C");
    AddText(events, "--types", arguments.types, "entry (default), changes, or both: entry,changes")
        .check([](const std::string& text) {
            const bool bKnown =
                text == "entry" || text == "changes" || text == "entry,changes" || text == "changes,entry";
            return bKnown ? std::string()
                          : "expected entry, changes, or both with a comma, found " + Core::QuoteForError(text);
        })
        ->type_name("TYPES");
    AddLimit(events, arguments);
    AddNumber(events, "--after", arguments.after, {}, "Only events after this event id");
    CLI::App& trace = AddCommand(app, options, "trace", ECommand::Trace, "Show messages of all links on one time line");
    AddText(trace, "--plan", arguments.plan, "Only messages about this plan").type_name("PLAN");
    AddText(trace, "--robot", arguments.robot, "Only messages of this robot").type_name("ROBOT");
    AddText(trace, "--transaction", arguments.transaction, "Only messages of this transaction").type_name("ID");
    AddNumber(
        trace,
        "--limit",
        arguments.limit,
        {1, MAX_FILE_LIMIT},
        fmt::format("Maximum number, 1 to {}, with --file to {} (default 100)", MAX_LIMIT, MAX_FILE_LIMIT));
    Apps::AddRepeatedOption(
        trace,
        "--file",
        [&arguments](const std::string& text) {
            arguments.files.push_back(text);
            return CheckNotEmpty(text);
        },
        "Do not ask acsd: merge the files of --trace of acsd and of the simulators. A file, or a folder with files; may be repeated")
        .type_name("PATH");
    trace.callback([&options] {
        options.command = ECommand::Trace;
        if (options.arguments.files.empty() && options.arguments.limit.value_or(1) > MAX_LIMIT)
        {
            throw CLI::ValidationError("--limit", fmt::format("expected 1 to {}; more lines need --file", MAX_LIMIT));
        }
    });
    CLI::App& audit = AddCommand(app, options, "audit", ECommand::Audit, "Show commands of identified operators");
    AddLimit(audit, arguments);
}

void AddReason(CLI::App& app, CommandArguments& arguments)
{
    AddText(app, "--reason", arguments.reason, "Why; acsd records it").type_name("TEXT");
}

void AddPlanCommands(CLI::App& app, AcsctlOptions& options)
{
    CommandArguments& arguments = options.arguments;
    struct Control
    {
        const char* name;
        ECommand command;
        const char* help;
    };
    for (const Control& control :
         {Control{
              "cancel",
              ECommand::Cancel,
              "Cancel a plan whose robot has not arrived at its first place (acsd: cancel.until)"},
          Control{"abort", ECommand::Abort, "Abort a plan"},
          Control{"pause", ECommand::Pause, "Pause a plan"},
          Control{"resume", ECommand::Resume, "Resume a paused plan"}})
    {
        CLI::App& command = AddCommand(app, options, control.name, control.command, control.help);
        AddPositional(command, "PLAN", arguments.id, "The plan");
        AddReason(command, arguments);
    }
    CLI::App& priority = AddCommand(app, options, "priority", ECommand::Priority, "Change the priority of a plan");
    AddPositional(priority, "PLAN", arguments.id, "The plan");
    using Limits = std::numeric_limits<std::int32_t>; // of the operator API
    AddPositionalNumber(priority, "N", arguments.number, {Limits::min(), Limits::max()}, "The new priority");
    CLI::App& resolve =
        AddCommand(app, options, "resolve", ECommand::Resolve, "Resolve a job whose outcome is unknown");
    AddPositional(resolve, "PLAN", arguments.id, "The plan");
    AddPositional(resolve, "JOB", arguments.jobID, "The job");
    AddWord(
        resolve,
        "OUTCOME",
        arguments.word,
        {"done", "failed", "again"},
        "done: the plan continues; failed: the plan fails; again: nothing was moved, the job starts again");
    CLI::App& skip = AddCommand(app, options, "skip", ECommand::Skip, "Skip a step of a plan");
    AddPositional(skip, "PLAN", arguments.id, "The plan");
    AddPositionalNumber(skip, "STEP", arguments.number, {0, Limits::max()}, "The number of the step");
}

void AddSiteCommands(CLI::App& app, AcsctlOptions& options)
{
    CommandArguments& arguments = options.arguments;
    CLI::App* const tsc = app.add_subcommand("tsc", "Pause or resume the TSC");
    tsc->fallthrough();
    tsc->require_subcommand(1);
    AddCommand(*tsc, options, "pause", ECommand::TscPause, "No robot begins new work");
    AddCommand(*tsc, options, "resume", ECommand::TscResume, "Robots continue");
    CLI::App& block =
        AddCommand(app, options, "block", ECommand::Block, "Block a node, an edge or a station for all robots");
    AddWord(block, "KIND", arguments.word, {"node", "edge", "station"}, "node, edge or station");
    AddPositional(block, "ID", arguments.id, "Its id on the map");
    AddReason(block, arguments);
    CLI::App& unblock = AddCommand(app, options, "unblock", ECommand::Unblock, "Unblock a node, an edge or a station");
    AddWord(unblock, "KIND", arguments.word, {"node", "edge", "station"}, "node, edge or station");
    AddPositional(unblock, "ID", arguments.id, "Its id on the map");
}

void AddRobotCommands(CLI::App& app, AcsctlOptions& options)
{
    CommandArguments& arguments = options.arguments;
    CLI::App& maintenance =
        AddCommand(app, options, "maintenance", ECommand::Maintenance, "Put a robot out of or back into service");
    AddPositional(maintenance, "ROBOT", arguments.id, "The robot");
    AddWord(maintenance, "MODE", arguments.word, {"on", "off"}, "on: it completes its plan and receives no other; off");
    CLI::App& carriers =
        AddCommand(app, options, "carriers", ECommand::Carriers, "Correct the record of a robot's carriers");
    AddPositional(carriers, "ROBOT", arguments.id, "The robot");
    carriers
        .add_option("CARRIER", arguments.carriers, "One for each port, in the order of its ports; - for no carrier")
        ->required()
        ->type_name("");
    CLI::App& clear = AddCommand(app, options, "clear", ECommand::Clear, "Clear an alarm");
    AddPositional(clear, "ROBOT", arguments.id, "The robot of the alarm; ACS: acsd itself");
    AddPositional(clear, "CODE", arguments.word, "The code of the alarm");
    AddText(clear, "--plan", arguments.plan, "Only the alarm of this plan").type_name("PLAN");
    AddText(clear, "--job", arguments.job, "Only the alarm of this job").type_name("JOB");
}

std::string CheckParameter(const std::string& text)
{
    const std::size_t equals = text.find('=');
    return equals == std::string::npos || equals == 0 ? "expected KEY=VALUE, found " + Core::QuoteForError(text) : "";
}

void AddActionCommand(CLI::App& app, AcsctlOptions& options)
{
    CommandArguments& arguments = options.arguments;
    CLI::App& action = AddCommand(
        app,
        options,
        "action",
        ECommand::Action,
        "Send an instant action to a robot and wait up to 60 s for its outcome; exit with 5 unless it is Finished");
    AddPositional(action, "ROBOT", arguments.id, "The robot");
    AddPositional(action, "TYPE", arguments.word, "The type of the action; acsctl actions ROBOT lists them");
    action.add_option("PARAMETER", arguments.parameters, "KEY=VALUE for each parameter; a value is JSON, or a text")
        ->type_name("")
        ->check(CheckParameter);
    AddReason(action, arguments);
    action.add_flag("--no-wait", arguments.bNotAwaited, "Do not wait for the outcome");
}

void AddLocalCommands(CLI::App& app, AcsctlOptions& options)
{
    CommandArguments& arguments = options.arguments;
    CLI::App& bundle = AddCommand(
        app,
        options,
        "bundle",
        ECommand::Bundle,
        "Write everything that the API shows to an archive (.tar.gz) for support; it has no tokens");
    AddPositional(bundle, "FILE", arguments.id, "The archive; it must not exist");
    AddText(bundle, "--http-url", arguments.httpURL, "Also the metrics and the readiness of this address of acsd")
        .type_name("URL");
    CLI::App& completion =
        AddCommand(app, options, "completion", ECommand::Completion, "Print the completion script of a shell");
    AddWord(completion, "SHELL", arguments.word, {"bash", "zsh"}, "bash or zsh");
    CLI::App* const context = app.add_subcommand("context", "Manage the contexts of the configuration file");
    context->fallthrough();
    context->require_subcommand(1);
    AddCommand(*context, options, "list", ECommand::ContextList, "List contexts; * marks the current one");
    CLI::App& use = AddCommand(*context, options, "use", ECommand::ContextUse, "Make a context the current one");
    AddPositional(use, "NAME", arguments.id, "The context");
    CLI::App& set = AddCommand(
        *context,
        options,
        "set",
        ECommand::ContextSet,
        "Add or change a context: --url, --token-file, --ca, --certificate and --key are stored in it");
    AddPositional(set, "NAME", arguments.id, "The context");
    set.add_flag("--token-stdin", arguments.bTokenFromInput, "Store the token that standard input has");
    CLI::App& remove = AddCommand(*context, options, "remove", ECommand::ContextRemove, "Remove a context");
    AddPositional(remove, "NAME", arguments.id, "The context");
}

bool IsNumber(const std::string& text)
{
    return Core::ParseNumberOrNull<double>(text).has_value();
}

} // namespace

void BuildCommandLine(CLI::App& app, AcsctlOptions& options)
{
    app.set_version_flag("--version", fmt::format("{} {}", PROGRAM_NAME, Apps::VERSION));
    app.require_subcommand(1);
    AddStateCommands(app, options);
    AddHistoryCommands(app, options);
    AddPlanCommands(app, options);
    AddRobotCommands(app, options);
    AddActionCommand(app, options);
    AddSiteCommands(app, options);
    AddLocalCommands(app, options);
    AddGlobalOptions(app, options);
    app.footer("Exit codes: 0 done, 1 refused, 2 invalid command line or file, 3 no connection, 4 not authorised, "
               "5 attention needed (why, status --check, action), 6 not an answer of acsd, 7 file not written.");
}

std::vector<std::string> NormalizeArguments(const std::vector<std::string>& arguments)
{
    std::vector<std::string> normal;
    const auto carriers = std::find(arguments.begin(), arguments.end(), "carriers");
    for (auto word = arguments.begin(); word != arguments.end(); ++word)
    {
        if (*word == "--watch")
        {
            const auto next = std::next(word);
            const bool bNumber = next != arguments.end() && IsNumber(*next);
            normal.push_back(fmt::format("--watch={}", bNumber ? *next : "2"));
            word = bNumber ? next : word;
        }
        else
        {
            normal.push_back(*word == "--" && word > carriers ? "-" : *word);
        }
    }
    return normal;
}

std::optional<int> ParseOptionsOrNull(const std::vector<std::string>& arguments, AcsctlOptions& options)
{
    CLI::App app{DESCRIPTION, std::string(PROGRAM_NAME)};
    BuildCommandLine(app, options);
    const std::vector<std::string> normal = NormalizeArguments(arguments);
    std::vector<const char*> pointers;
    pointers.reserve(normal.size());
    for (const std::string& argument : normal)
    {
        pointers.push_back(argument.c_str());
    }
    return Apps::ParseCommandLineOrNull(app, static_cast<int>(pointers.size()), pointers.data(), EXIT_LOCAL_FAILURE);
}

} // namespace ACS::Acsctl
