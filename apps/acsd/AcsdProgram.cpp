#include "AcsdProgram.hpp"

#include "Acsd.hpp"
#include "common/config/CommandLine.hpp"
#include "common/log/SpdlogSink.hpp"
#include "common/process/HangUpWaiter.hpp"
#include "common/process/ReadyLine.hpp"
#include "common/process/SignalWaiter.hpp"
#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"

#include <boost/asio/io_context.hpp>
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

constexpr const char* NAME = "acsd";

constexpr const char* FOOTER =
    "Signals: SIGTERM and SIGINT stop it once its reports are told (a second one at once), SIGHUP reads the "
    "configuration again.\n"
    "Exit codes: 0 after a stop, --check-config without mistakes, --help or --version; 1 when it cannot run (store, port, "
    "trace);\n2 for a mistake of the command line or the configuration.";

struct ProgramOptions
{
    Apps::CommonOptions common;
    std::string configFile;
    std::vector<std::string> overrides;
    std::string traceFolder; ///< Empty: no trace.
    bool bLogLevelGiven = false;
    bool bCheckOnly = false;
};

/// SIGHUP. A file with mistakes changes nothing.
void ReadAgain(const ProgramOptions& options, const Core::Logger& logger, Apps::SpdlogSink& sink, Acsd& acsd)
{
    const AcsdConfig fresh = ReadAcsdConfig(options.configFile, options.overrides);
    if (!fresh.mistakes.empty())
    {
        for (const std::string& mistake : fresh.mistakes)
        {
            logger.Error("not taken", {{"mistake", mistake}});
        }
        logger.Error("the configuration has mistakes, all stays as it was", {{"file", options.configFile}});
        return;
    }
    if (!options.bLogLevelGiven)
    {
        sink.SetLevel(fresh.operations.logLevel);
    }
    acsd.Reload(fresh);
}

int Serve(const ProgramOptions& options, AcsdConfig config)
{
    Apps::SystemClock clock;
    Apps::SystemRandom random;
    Apps::SpdlogSink sink(options.bLogLevelGiven ? options.common.logLevel : config.operations.logLevel);
    const Core::Logger logger(sink, NAME);
    for (const std::string& warning : config.warnings)
    {
        logger.Warning(warning);
    }
    std::unique_ptr<MessageTrace> trace;
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
    boost::asio::io_context context(1);
    Core::Result<std::unique_ptr<Acsd>> acsd =
        Acsd::Create(Acsd::Dependencies{context.get_executor(), clock, random, logger, trace.get()}, std::move(config));
    if (!acsd)
    {
        Apps::PrintError(NAME, Core::Describe(acsd.error()));
        return 1;
    }
    std::optional<Apps::SignalWaiter> signals;
    signals.emplace(context.get_executor(), [&](int) { (*acsd)->StopAsync([&context] { context.stop(); }); });
    const Apps::HangUpWaiter hangUps(context.get_executor(), [&] { ReadAgain(options, logger, sink, **acsd); });
    (*acsd)->Start();
    Apps::PrintReadyLine({{"http", (*acsd)->GetHttpEndpoint()}});
    context.run();
    return 0;
}

} // namespace

int RunAcsd(int argc, const char* const* argv)
{
    ProgramOptions options;
    CLI::App app{
        "Takes ExecutionPlans from an MCS (MCS-ACS), drives robots over VDA5050 and arms over Open Stream, and reports "
        "every state back.",
        NAME};
    app.add_option("--config", options.configFile, "TOML file; examples/site/acsd.toml explains every key")
        ->required()
        ->type_name("FILE");
    app.add_option("--set", options.overrides, "override one key, for example --set mcs.url=ws://10.0.0.1:9001/acs/")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->allow_extra_args(false);
    app.add_option(
           "--trace",
           options.traceFolder,
           "write every message of every link into this folder (NDJSON; [trace] in the configuration bounds its size)")
        ->type_name("DIR");
    app.add_flag("--check-config", options.bCheckOnly, "tell every mistake of the configuration and end");
    Apps::AddCommonOptions(app, options.common);
    app.footer(FOOTER);
    const std::optional<int> exitCodeOrNull = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCodeOrNull.has_value())
    {
        return *exitCodeOrNull;
    }

    options.bLogLevelGiven = app.count("--log-level") > 0;
    AcsdConfig config = options.bCheckOnly ? CheckAcsdConfig(options.configFile, options.overrides)
                                           : ReadAcsdConfig(options.configFile, options.overrides);
    if (!config.mistakes.empty())
    {
        for (const std::string& mistake : config.mistakes)
        {
            fmt::print(stderr, "{}\n", mistake);
        }
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    if (options.bCheckOnly)
    {
        for (const std::string& warning : config.warnings)
        {
            fmt::print(stderr, "warning: {}\n", warning);
        }
        fmt::print("{}: no mistakes\n", options.configFile);
        return 0;
    }
    return Serve(options, std::move(config));
}

} // namespace ACS::Acsd
