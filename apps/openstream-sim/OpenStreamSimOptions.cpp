#include "OpenStreamSimOptions.hpp"

#include "common/config/DurationText.hpp"
#include "common/faults/FaultOptions.hpp"
#include "programs/ProgramFile.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/RobotID.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view FAIL_SUFFIX = ",fail";

std::optional<int> ParseProgramNumberOrNull(std::string_view text)
{
    const std::optional<int> number = Core::ParseNumberOrNull<int>(text);
    return number.has_value() && *number >= FIRST_PROGRAM && *number <= LAST_PROGRAM ? number : std::nullopt;
}

std::string ReadCount(std::string_view text, std::size_t maximum, std::size_t& target)
{
    const std::optional<std::size_t> count = Core::ParseNumberOrNull<std::size_t>(text);
    if (!count.has_value() || *count < 1 || *count > maximum)
    {
        return fmt::format("expected a number from 1 to {}, found {}", maximum, Core::QuoteForError(text));
    }
    target = *count;
    return {};
}

std::string ReadTimeout(std::string_view text, std::chrono::milliseconds& target)
{
    const Core::Result<std::chrono::milliseconds> timeout = Apps::ParseDuration(text);
    if (!timeout.has_value())
    {
        return fmt::format("expected {}, found {}", timeout.error().expected, Core::QuoteForError(text));
    }
    target = *timeout;
    return {};
}

std::string ReadVersion(std::string_view text, ControllerVersion& target)
{
    const std::optional<ControllerVersion> version = ParseControllerVersionOrNull(text);
    if (!version.has_value())
    {
        return fmt::format("expected a version such as 70.04-00, found {}", Core::QuoteForError(text));
    }
    target = *version;
    return {};
}

std::string ReadModel(std::string_view text, std::string& target)
{
    constexpr std::size_t MAX_LENGTH = 64;
    const bool bPrintable = std::ranges::all_of(text, [](char letter) { return letter > ' ' && letter <= '~'; });
    if (text.empty() || text.size() > MAX_LENGTH || !bPrintable)
    {
        return fmt::format(
            "expected a name of 1 to {} printable characters without blanks (HA006B-01), found {}",
            MAX_LENGTH,
            Core::QuoteForError(text));
    }
    target = text;
    return {};
}

/// The last of the consecutive ports, one for each controller.
std::size_t GetLastPort(const Apps::Endpoint& first, std::size_t controllers)
{
    return first.port + controllers - 1;
}

std::string CheckLastPort(std::string_view option, const Apps::Endpoint& first, std::size_t controllers)
{
    constexpr std::size_t LAST_PORT = 65'535;
    if (first.port == 0 || GetLastPort(first, controllers) <= LAST_PORT)
    {
        return {};
    }
    return fmt::format(
        "{} controllers from {} {} need ports beyond {}: give fewer controllers, a lower port, or port 0",
        controllers,
        option,
        Apps::MakeText(first),
        LAST_PORT);
}

/// Checks that the controllers have enough ports, and different ones.
std::string CheckPorts(const FleetOptions& fleet)
{
    const Apps::Endpoint& stream = fleet.first.stream;
    const Apps::Endpoint& http = fleet.first.http;
    std::string error = CheckLastPort("--listen", stream, fleet.controllers);
    error = error.empty() ? CheckLastPort("--http", http, fleet.controllers) : error;
    const bool bMeet =
        stream.port <= GetLastPort(http, fleet.controllers) && http.port <= GetLastPort(stream, fleet.controllers);
    if (error.empty() && stream.port != 0 && http.port != 0 && stream.host == http.host && bMeet)
    {
        error = fmt::format(
            "--listen {} and --http {} use the same port: give them ports that are at least {} apart",
            Apps::MakeText(stream),
            Apps::MakeText(http),
            fleet.controllers);
    }
    return error;
}

/// A fault for an unknown controller would never occur.
std::string CheckFaults(const FleetOptions& fleet)
{
    for (const FaultCommand& command : fleet.faults)
    {
        bool bKnown = false;
        for (std::size_t number = 1; number <= fleet.controllers; ++number)
        {
            bKnown = bKnown || Apps::IsTarget(command.targets, std::to_string(number));
        }
        if (!bKnown)
        {
            return fmt::format(
                "fault '{} {}': no such controller; give one from 1 to {}, or * for all",
                command.targets,
                command.fault.text,
                fleet.controllers);
        }
    }
    return {};
}

void AddSessionOptions(CLI::App& app, HostOptions& host)
{
    constexpr std::size_t MAX_SESSIONS = 1'000;
    Apps::AddTextOption(
        app,
        "--sessions",
        [&host](const std::string& text) { return ReadCount(text, MAX_SESSIONS, host.sessions); },
        "Maximum number of Open Stream sessions of a controller. One more replaces the oldest session without a HANDSHAKE")
        .default_str("8")
        ->type_name("N");
    Apps::AddTextOption(
        app,
        "--handshake-timeout",
        [&host](const std::string& text) { return ReadTimeout(text, host.handshakeTimeout); },
        "Maximum time from an Open Stream connection to its HANDSHAKE; 0s disables the limit")
        .default_str("5s")
        ->type_name("DURATION");
}

void AddModelOptions(CLI::App& app, ControllerOptions& controller)
{
    Apps::AddTextOption(
        app,
        "--controller-version",
        [&controller](const std::string& text) { return ReadVersion(text, controller.version); },
        "Version of the controller, reported by sysver; from 60.30-00 on it serves r_code instead of reset and motor_off")
        .default_str(MakeText(controller.version))
        ->type_name("NN.NN-NN");
    Apps::AddTextOption(
        app,
        "--robot-model",
        [&controller](const std::string& text) { return ReadModel(text, controller.robotModel); },
        "Model of the robot, reported by rgen")
        .default_str(controller.robotModel)
        ->type_name("NAME");
}

/// "1=CR01"
std::string ReadRobot(std::string_view text, std::map<std::size_t, std::string>& robots)
{
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string_view name = text.substr(std::min(equals + 1, text.size()));
    std::size_t controller = 0;
    const bool bNumber = ReadCount(text.substr(0, equals), FleetOptions::MAX_CONTROLLERS, controller).empty();
    const Core::Result<Core::RobotID> robotID = Core::RobotID::Parse(name);
    if (!bNumber || !robotID.has_value() || robotID->IsAlias())
    {
        return fmt::format(
            "expected CONTROLLER=ROBOT with a number of at least 1 and a robot id (1=CR01), found {}",
            Core::QuoteForError(text));
    }
    if (!robots.emplace(controller, robotID->GetText()).second)
    {
        return fmt::format("controller {} is given twice", controller);
    }
    return {};
}

void AddFloorOptions(CLI::App& app, OpenStreamSimOptions& options)
{
    Apps::AddFileOption(
        app,
        "--programs",
        options.programFile,
        "TOML file of the programs: duration, echo and work with relays (docs/reference/openstream-sim.md). Without it a "
        "program takes its time and moves nothing (default)");
    Apps::AddFileOption(
        app,
        "--world",
        options.worldFile,
        "World file that the simulators share (docs/reference/world.md); needs --programs. Without it no carrier moves (default)");
    Apps::AddRepeatedOption(
        app,
        "--robot",
        [&options](const std::string& text) { return ReadRobot(text, options.fleet.robots); },
        "Robot that carries the arm of a controller (1=CR01); needed with --world and with {robot} in --programs. May be "
        "repeated")
        .type_name("CONTROLLER=ROBOT");
}

/// Adds the file's programs; the duration and the failure of --program take precedence.
void AddPrograms(const ProgramFile& file, ControllerOptions& controller)
{
    for (const auto& [number, spec] : file.programs)
    {
        const auto [entry, bNew] = controller.programs.emplace(number, spec);
        if (!bNew)
        {
            entry->second.echo = spec.echo;
            entry->second.work = spec.work;
        }
    }
}

/// Checks that each controller has a robot if one is needed, and each robot one controller.
std::string CheckRobots(const OpenStreamSimOptions& options, const ProgramFile& programs)
{
    const std::map<std::size_t, std::string>& robots = options.fleet.robots;
    if (!options.worldFile.empty() && options.programFile.empty())
    {
        return "--world needs --programs: without it no program moves anything";
    }
    std::set<std::string> names;
    for (const auto& [controller, robot] : robots)
    {
        if (controller > options.fleet.controllers)
        {
            return fmt::format(
                "--robot {}={}: no such controller; give one from 1 to {}",
                controller,
                robot,
                options.fleet.controllers);
        }
        if (!names.insert(robot).second)
        {
            return fmt::format("--robot: robot {} has two controllers; give each controller a different robot", robot);
        }
    }
    const bool bNamed = programs.HasRobotName();
    if (!robots.empty() && options.worldFile.empty() && !bNamed)
    {
        return "--robot has no effect without --world and without {robot} in --programs: leave it out, or give --world";
    }
    const std::string reason = !options.worldFile.empty() ? fmt::format("--world {}", options.worldFile)
        : bNamed                                          ? fmt::format("{{robot}} in {}", options.programFile)
                                                          : std::string();
    for (std::size_t controller = 1; !reason.empty() && controller <= options.fleet.controllers; ++controller)
    {
        if (!robots.contains(controller))
        {
            return fmt::format("{0} needs the robot of controller {1}: give --robot {1}=NAME", reason, controller);
        }
    }
    return {};
}

std::string MakeFooter()
{
    return fmt::format(
        "Faults, on the command line, in a file (one per line, # begins a comment) and by POST /faults to --control:\n"
        "  CONTROLLER FAULT [KEY=VALUE]...  begins a fault; CONTROLLER is 1, 2, ... or * for all\n"
        "      at=DURATION: begin after this time; program=NUMBER: begin when this program begins;\n"
        "      for=DURATION: end after this time; every=DURATION: repeat with this period\n"
        "  CONTROLLER end [FAULT]           ends this fault, or all faults (--control)\n"
        "{}"
        "Example: openstream-sim --fault '1 hole at=5s every=2s' --control 127.0.0.1:8890\n"
        "         curl --data-binary '* estop for=5s' http://127.0.0.1:8890/faults\n"
        "\n"
        "A program ends after its duration ({} s without --program and --programs). It reports in 32-bit words of relay\n"
        "m: when it begins it adds 1 at byte {} (ml{}), when it finishes at byte {}, when it fails or is abandoned at\n"
        "byte {}; byte {} has the number of the program that ended last. With --programs it also copies its job number\n"
        "to byte {} before it counts its beginning. When it finishes it does its work on the floor of --world, at the\n"
        "places that its relays named when it began; if the floor does not allow the work, the program fails.\n"
        "GET /project/plc/m/val_s32?st={}&len=5 reads all five.",
        Apps::MakeFaultHelp(GetFaultGrammar()),
        std::chrono::duration_cast<std::chrono::seconds>(ProgramSpec{}.duration).count(),
        STARTED_BYTE,
        STARTED_BYTE / sizeof(std::int32_t),
        FINISHED_BYTE,
        FAILED_BYTE,
        LAST_BYTE,
        ECHO_BYTE,
        STARTED_BYTE);
}

} // namespace

std::string ParseProgram(std::string_view text, ControllerOptions& options)
{
    std::string error = fmt::format(
        "expected NUMBER=DURATION[,fail] with a number from {} to {} (11=3s), found '{}'",
        FIRST_PROGRAM,
        LAST_PROGRAM,
        text);
    const std::size_t equals = text.find('=');
    const std::optional<int> number = ParseProgramNumberOrNull(text.substr(0, equals));
    if (equals == std::string_view::npos || !number.has_value())
    {
        return error;
    }
    ProgramSpec spec;
    std::string_view rest = text.substr(equals + 1);
    spec.bFails = rest.ends_with(FAIL_SUFFIX);
    rest.remove_suffix(spec.bFails ? FAIL_SUFFIX.size() : 0);
    const Core::Result<std::chrono::milliseconds> duration = Apps::ParseDuration(rest);
    if (!duration.has_value() || duration->count() == 0)
    {
        return error;
    }
    spec.duration = *duration;
    if (!options.programs.emplace(*number, spec).second)
    {
        return fmt::format("program {} is given twice", *number);
    }
    return {};
}

std::optional<int> ParseOptionsOrNull(int argc, const char* const* argv, OpenStreamSimOptions& options)
{
    CLI::App app{
        "Simulates Hi6 robot controllers: each serves Open Stream and the HTTP Open API for a six-axis arm.",
        std::string(PROGRAM_NAME)};
    app.footer(MakeFooter());
    Apps::AddEndpointOption(
        app,
        "--listen",
        options.fleet.first.stream,
        "Address of the Open Stream; port 0 selects a free one");
    Apps::AddEndpointOption(
        app,
        "--http",
        options.fleet.first.http,
        "Address of the HTTP Open API; port 0 selects a free one");
    Apps::AddTextOption(
        app,
        "--controllers",
        [&options](const std::string& text) {
            return ReadCount(text, FleetOptions::MAX_CONTROLLERS, options.fleet.controllers);
        },
        "Number of simulated controllers. Each uses the next port of --listen and of --http, or free ones if these are 0")
        .default_str("1")
        ->type_name("N");
    AddSessionOptions(app, options.fleet.first);
    AddModelOptions(app, options.fleet.first.controller);
    AddFloorOptions(app, options);
    Apps::AddTimeScaleOption(app, options.fleet.first.controller.timeScale);
    Apps::AddRepeatedOption(
        app,
        "--program",
        [&options](const std::string& text) { return ParseProgram(text, options.fleet.first.controller); },
        "Duration of a program, in simulated time, and whether it fails at its end: 11=3s or 12=500ms,fail (default 2s). May "
        "be repeated")
        .type_name("NUMBER=DURATION[,fail]");
    app.add_flag("--ready", options.fleet.first.controller.bMotorOn, "Start with the motor on (default: off)");
    app.add_flag(
        "--playing",
        options.fleet.first.controller.bWaiting,
        "Start with the motor on and a program in playback that waits for di1, so that trajectories are accepted");
    app.add_flag(
        "--realtime",
        options.bRealTime,
        "Use a real-time priority, precise timers and locked memory; what the system refuses is logged");
    Apps::AddFaultOptions(
        app,
        GetFaultGrammar(),
        options.fleet.faults,
        "Fault of a controller, see below; its times count from the ready line. May be repeated");
    Apps::Endpoint control;
    const CLI::Option& controlOption = Apps::AddEndpointOption(
        app,
        "--control",
        control,
        "Address of the HTTP interface that begins and ends faults; port 0 selects a free one (default: disabled)");
    Apps::AddTraceOptions(app, options.trace);
    Apps::AddCommonOptions(app, options.common);
    const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCode.has_value())
    {
        return exitCode;
    }
    if (controlOption.count() > 0)
    {
        options.fleet.control = control;
    }
    const ProgramFile programs = options.programFile.empty() ? ProgramFile() : ProgramFile::Read(options.programFile);
    if (!programs.errors.empty())
    {
        for (const std::string& error : programs.errors)
        {
            Apps::PrintError(PROGRAM_NAME, error);
        }
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    AddPrograms(programs, options.fleet.first.controller);
    std::string error = CheckPorts(options.fleet);
    error = error.empty() ? CheckFaults(options.fleet) : error;
    error = error.empty() ? CheckRobots(options, programs) : error;
    if (!error.empty())
    {
        Apps::PrintError(PROGRAM_NAME, fmt::format("{}; try {} --help", error, PROGRAM_NAME));
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    return std::nullopt;
}

} // namespace ACS::OpenStreamSim
