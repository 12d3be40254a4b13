#include "AcsdService.hpp"
#include "common/config/CommandLine.hpp"
#include "common/log/SpdlogSink.hpp"
#include "common/process/HangUpWaiter.hpp"
#include "common/process/ReadyLine.hpp"
#include "common/process/ServiceNotifier.hpp"
#include "common/process/SignalWaiter.hpp"
#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include "config/DriverConfig.hpp"
#include "drivers/BuiltInDrivers.hpp"
#include "operator/TokenCommand.hpp"
#include "replay/ReplayCommand.hpp"
#include "store/StoreCommand.hpp"
#include <acs/acsd/RunAcsd.hpp>

#include <boost/asio/io_context.hpp>
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <tuple>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

constexpr const char* NAME = "acsd";

constexpr const char* FOOTER =
    "Commands: acsd token ROLE NAME makes a token for the operator interface; acsd token --help explains it.\n"
    "          acsd store COMMAND checks, accepts, backs up or restores the store; acsd store --help explains it.\n"
    "          acsd replay TRACE repeats a recorded run and shows the first difference; acsd replay --help explains it.\n"
    "Signals: SIGTERM and SIGINT stop acsd after the MCS has acknowledged its reports (a second one stops it at once), "
    "SIGHUP reloads the configuration.\n"
    "Exit codes: 0 after a stop, --check-config without errors, --help or --version; 1 if acsd cannot run (store, port, "
    "trace);\n2 for an error in the command line or the configuration.";

struct ProgramOptions
{
    Apps::CommonOptions common;
    std::string configFile;
    std::vector<std::string> overrides;
    std::string traceFolder; ///< Empty: no trace.
    bool bCheckOnly = false;
};

void LogWarnings(const AcsdConfig& config, const Core::Logger& logger)
{
    for (const std::string& warning : config.warnings)
    {
        logger.Warning(warning);
    }
}

/// For SIGHUP. A file with errors changes nothing.
void ReadAgain(
    const ProgramOptions& options,
    const RobotDrivers& drivers,
    const Core::Logger& logger,
    Apps::SpdlogSink& sink,
    AcsdService& acsd)
{
    const AcsdConfig fresh = ReadAcsdConfig(options.configFile, options.overrides, drivers);
    if (!fresh.errors.empty())
    {
        for (const std::string& error : fresh.errors)
        {
            logger.Error("configuration not reloaded", {{"error", error}});
        }
        logger.Error("the configuration has errors, the previous one stays in effect", {{"file", options.configFile}});
        return;
    }
    sink.SetLevel(fresh.operations.logLevel);
    LogWarnings(fresh, logger);
    acsd.Reload(fresh);
}

int Serve(const ProgramOptions& options, const RobotDrivers& drivers, AcsdConfig config)
{
    Apps::SystemClock clock;
    Apps::SystemRandom random;
    Apps::SpdlogSink sink(config.operations.logLevel, Apps::ELogWriting::Queued);
    const Core::Logger logger(sink, NAME);
    LogWarnings(config, logger);
    std::unique_ptr<MessageTrace> trace; // outlives the handlers in the context
    boost::asio::io_context context(1);
    AcsdService* startedOrNull = nullptr;
    const Apps::HangUpWaiter hangUps(context.get_executor(), [&] {
        ReadAgain(options, drivers, logger, sink, *startedOrNull);
    });
    if (!options.traceFolder.empty())
    {
        auto created =
            MessageTrace::Create(options.traceFolder, config.operations.trace, clock, logger.MakeFor("trace"));
        if (!created)
        {
            Apps::PrintError(NAME, Core::Describe(created.error()));
            return 1;
        }
        trace = std::move(*created);
    }
    int exitCode = 0;
    const Apps::ServiceNotifier service(Apps::GetNotifyAddress());
    Acsd::Dependencies dependencies{
        context.get_executor(),
        clock,
        random,
        logger,
        trace.get(),
        [&sink] { return sink.GetDropped(); },
        [&service] { std::ignore = service.TryNotify("WATCHDOG=1"); },
        Apps::GetWatchdogTimeoutOrNull().value_or(std::chrono::microseconds(0)) / 2};
    AcsdService acsd(
        std::move(dependencies),
        std::move(config),
        {[&context] { context.stop(); },
         [&context, &exitCode] {
             exitCode = 1;
             context.stop();
         }});
    if (const Core::Result<void> started = acsd.Start(); !started.has_value())
    {
        Apps::PrintError(NAME, Core::Describe(started.error()));
        return 1;
    }
    startedOrNull = &acsd;
    if (trace != nullptr)
    {
        trace->Keep();
    }
    std::optional<Apps::SignalWaiter> signals;
    signals.emplace(context.get_executor(), [&](int) {
        std::ignore = service.TryNotify("STOPPING=1");
        acsd.StopAsync();
    });
    sink.Flush();
    Apps::PrintReadyLine(acsd.GetAddresses());
    std::ignore = service.TryNotify("READY=1");
    context.run();
    return exitCode;
}

/// Else reports that standard output could not be written.
bool TryFlushOutput()
{
    const bool bWritten = std::fflush(stdout) == 0;
    if (!bWritten)
    {
        Apps::PrintError(NAME, "the output could not be written");
    }
    return bWritten;
}

int Run(int argc, const char* const* argv, const RobotDrivers& drivers)
{
    ::umask(S_IRWXG | S_IRWXO); // the store and the trace are for the user of acsd only
    if (argc > 1 && std::string_view(argv[1]) == "store")
    {
        return RunStoreCommand(argc - 1, argv + 1);
    }
    if (argc > 1 && std::string_view(argv[1]) == "token")
    {
        return RunTokenCommand(argc - 1, argv + 1);
    }
    if (const std::optional<std::string> fault = FindDriverFaultOrNull(drivers))
    {
        Apps::PrintError(NAME, *fault);
        return 1;
    }
    if (argc > 1 && std::string_view(argv[1]) == "replay")
    {
        return RunReplayCommand(argc - 1, argv + 1, drivers);
    }
    ProgramOptions options;
    CLI::App app{
        "Executes the ExecutionPlans of an MCS (MCS-ACS): drives robots over VDA5050, controls arms over Open Stream, and "
        "reports every change of state to the MCS.",
        NAME};
    app.add_option(
           "--config",
           options.configFile,
           "configuration (TOML); /etc/acsd/acsd.toml of the package, or examples/site/acsd.toml of the sources, explains every key")
        ->required()
        ->type_name("FILE");
    app.add_option(
           "--set",
           options.overrides,
           "override one key, for example --set mcs.url=ws://10.0.0.1:9001/acs/; may be repeated, each time with one KEY=VALUE")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1);
    app.add_option(
           "--trace",
           options.traceFolder,
           "write every message of every link to files in this folder (NDJSON; [trace] in the configuration limits their size)")
        ->type_name("DIR");
    app.add_flag("--check-config", options.bCheckOnly, "report every error in the configuration and exit");
    Apps::AddCommonOptions(app, options.common);
    app.footer(FOOTER);
    const std::optional<int> exitCodeOrNull = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCodeOrNull.has_value())
    {
        return *exitCodeOrNull;
    }

    if (const CLI::Option& level = *app.get_option("--log-level"); level.count() > 0)
    {
        options.overrides.push_back("log.level=" + level.as<std::string>());
    }
    if (!options.bCheckOnly)
    {
        Apps::HangUpWaiter::Postpone(); // one that comes now is answered after the start
    }
    AcsdConfig config = options.bCheckOnly ? CheckAcsdConfig(options.configFile, options.overrides, drivers)
                                           : ReadAcsdConfig(options.configFile, options.overrides, drivers);
    if (!config.errors.empty())
    {
        for (const std::string& error : config.errors)
        {
            fmt::print(stderr, "{}\n", error);
        }
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    if (options.bCheckOnly)
    {
        for (const std::string& warning : config.warnings)
        {
            fmt::print(stderr, "warning: {}\n", warning);
        }
        for (const std::string& note : config.notes)
        {
            fmt::print(stderr, "note: {}\n", note);
        }
        fmt::print("{}: no errors\n", options.configFile);
        return TryFlushOutput() ? 0 : 1;
    }
    return Serve(options, drivers, std::move(config));
}

} // namespace

int RunAcsd(int argc, char** argv, RobotDrivers drivers)
{
    return Apps::RunProgram(NAME, [argc, argv, &drivers] {
        RobotDrivers all = MakeBuiltInDrivers();
        std::ranges::move(drivers, std::back_inserter(all));
        return Run(argc, argv, all);
    });
}

} // namespace ACS::Acsd
