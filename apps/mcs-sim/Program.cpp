#include "Program.hpp"

#include "common/config/LocalOffset.hpp"
#include "common/log/SpdlogSink.hpp"
#include "common/process/ReadyLine.hpp"
#include "common/process/SignalWaiter.hpp"
#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include "console/InputLines.hpp"
#include "console/Screen.hpp"
#include "console/ScreenLogSink.hpp"
#include "McsSimulator.hpp"
#include "plans/PlanBatch.hpp"
#include "plans/PlanFile.hpp"
#include "scenario/ScenarioFile.hpp"
#include "wire/TraceFile.hpp"
#include "world/WorldFile.hpp"
#include <acs/core/Timestamp.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/io_context.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::McsSim
{

namespace
{

/// 20261121
std::string MakeDate(Core::WallTime wall, std::chrono::minutes offset)
{
    const std::string text = Core::FormatLocal(wall, offset);
    return text.substr(0, 4) + text.substr(5, 2) + text.substr(8, 2);
}

/// All plans of the run, or a sentence about the first thing that is wrong.
tl::expected<std::vector<PlannedPlan>, std::string> LoadPlans(
    const McsSimOptions& options,
    const std::string& date,
    Core::IRandom& random)
{
    std::vector<PlannedPlan> files;
    for (const std::string& path : options.planFiles)
    {
        tl::expected<PlannedPlan, std::string> planned = ReadPlanFile(path);
        if (!planned.has_value())
        {
            return tl::make_unexpected(std::move(planned.error()));
        }
        files.push_back(std::move(*planned));
    }
    const bool bCarriersKept = !options.worldFile.empty() && !options.bRestock;
    const ECarrierNames carrierNames = bCarriersKept ? ECarrierNames::Kept : ECarrierNames::Fresh;
    std::vector<PlannedPlan> plans = MakeBatch(files, {options.repeat, options.bFreshIDs, date, carrierNames}, random);
    const std::optional<std::string> shared = FindSharedTransactionOrNull(plans);
    if (shared.has_value())
    {
        return tl::make_unexpected("two plans have the transactionId " + *shared + ": use --fresh-ids");
    }
    return plans;
}

/// The option that an error of the server is about; nullopt: it is about no file for TLS.
std::optional<std::string_view> FindOptionOrNull(const Core::Error& error)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> OPTIONS{
        {{"tls.certificate", "--tls-certificate"}, {"tls.key", "--tls-key"}, {"tls.ca", "--tls-client-ca"}}};
    const auto* const found = std::find_if(OPTIONS.begin(), OPTIONS.end(), [&error](const auto& option) {
        return option.first == error.path;
    });
    return found == OPTIONS.end() ? std::nullopt : std::optional(found->second);
}

/// Prints why the server cannot start; returns the exit code.
int TellStartFailure(Core::Error error)
{
    const std::optional<std::string_view> option = FindOptionOrNull(error);
    error.path = option.value_or(error.path);
    Apps::PrintError(PROGRAM_NAME, Describe(error));
    return option.has_value() ? Apps::EXIT_BAD_COMMAND_LINE : EXIT_FAILURE;
}

bool NeedsHelp(const std::vector<Scenario>& scenarios)
{
    return std::any_of(scenarios.begin(), scenarios.end(), [](const Scenario& scenario) {
        return std::any_of(scenario.steps.begin(), scenario.steps.end(), [](const ScenarioStep& step) {
            return std::holds_alternative<AskStep>(step.kind);
        });
    });
}

/// All scenarios of the run, or a sentence about the first thing that is wrong.
tl::expected<std::vector<Scenario>, std::string> LoadScenarios(const McsSimOptions& options)
{
    std::vector<Scenario> scenarios;
    for (const std::string& path : options.scenarioFiles)
    {
        tl::expected<Scenario, std::string> scenario = ReadScenarioFile(path);
        if (!scenario.has_value())
        {
            return tl::make_unexpected(std::move(scenario.error()));
        }
        scenarios.push_back(std::move(*scenario));
    }
    return scenarios;
}

/// What standard input is for; nothing where it is not read.
std::unique_ptr<InputLines> MakeInput(
    const McsSimOptions& options,
    const boost::asio::any_io_executor& executor,
    const std::string& work,
    McsSimulator& simulator)
{
    const auto release = [&simulator] {
        simulator.Release();
    };
    if (options.bWaitForEnter)
    {
        if (::isatty(STDIN_FILENO) != 0)
        {
            std::cout << fmt::format("Press Enter to {}.", work) << std::endl;
        }
        return std::make_unique<InputLines>(
            executor,
            [release](const std::string& /*line*/) { release(); },
            release);
    }
    release();
    return !options.bConsole ? nullptr
                             : std::make_unique<InputLines>(
                                 executor,
                                 [&simulator](const std::string& line) { simulator.Execute(line); },
                                 [&simulator] { simulator.Interrupt(); });
}

/// Some terminals only print: an editor's, a log's.
bool CanTerminalDraw()
{
    const char* const typeOrNull = std::getenv("TERM"); // NOLINT(concurrency-mt-unsafe): one thread
    const std::string_view type = typeOrNull == nullptr ? "" : typeOrNull;
    return ::isatty(STDOUT_FILENO) != 0 && !type.empty() && type != "dumb";
}

bool ShouldDraw(ELiveMode mode)
{
    return mode == ELiveMode::Always || (mode == ELiveMode::Auto && CanTerminalDraw());
}

} // namespace

int Run(const McsSimOptions& options)
{
    const Apps::SystemClock clock;
    Apps::SystemRandom random;
    const Core::WallTime wall = clock.GetNow().wall;
    const std::chrono::minutes offset = Apps::LocalOffset().GetAt(wall);
    const std::string date = MakeDate(wall, offset);
    tl::expected<std::vector<PlannedPlan>, std::string> plans = LoadPlans(options, date, random);
    tl::expected<std::vector<Scenario>, std::string> scenarios = LoadScenarios(options);
    if (!plans.has_value() || !scenarios.has_value())
    {
        Apps::PrintError(PROGRAM_NAME, plans.has_value() ? scenarios.error() : plans.error());
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    const tl::expected<std::unique_ptr<Sim::IWorld>, std::string> world = Sim::OpenWorldOption(options.worldFile);
    if (!world.has_value())
    {
        Apps::PrintError(PROGRAM_NAME, world.error());
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    const std::string work = scenarios->empty() ? fmt::format("send {} plans", plans->size())
                                                : fmt::format("play {} scenarios", scenarios->size());

    const TerminalSize size = ReadTerminalSize();
    Screen screen(std::cout, size.columns);
    // A request to the operator must be a line of its own.
    const bool bLive = !options.bConsole && !NeedsHelp(*scenarios) && ShouldDraw(options.liveMode);
    Apps::SpdlogSink plainSink(options.common.logLevel);
    ScreenLogSink screenSink(plainSink, screen);
    const bool bMixed = bLive && ::isatty(STDERR_FILENO) != 0;
    Core::ILogSink& sink = bMixed ? static_cast<Core::ILogSink&>(screenSink) : plainSink;

    const Core::Logger logger(sink, std::string(PROGRAM_NAME));
    SimulatorOptions simulated{
        options.listen,
        options.path,
        offset,
        options.bKeep,
        size.columns,
        size.rows,
        options.tls,
        {},
        std::move(*scenarios),
        date,
        options.profile,
        options.bFreshIDs || options.repeat > 1,
        options.bConsole,
        world->get(),
        options.bRestock ? EStocking::Restock : EStocking::Leave};
    std::unique_ptr<TraceFile> trace;
    if (!options.traceFile.empty())
    {
        auto created = TraceFile::Create(options.traceFile, clock, logger);
        if (!created.has_value())
        {
            Apps::PrintError(PROGRAM_NAME, created.error());
            return Apps::EXIT_BAD_COMMAND_LINE;
        }
        trace = std::move(*created);
        simulated.onWire = [&trace](auto direction, auto connection, std::string_view text) {
            trace->Write(direction, connection, text);
        };
    }

    boost::asio::io_context context(1);
    int exitCode = EXIT_FAILURE;
    McsSimulator simulator(
        context.get_executor(),
        clock,
        random,
        logger,
        simulated,
        std::move(*plans),
        std::cout,
        bLive ? &screen : nullptr,
        [&context, &exitCode](int code) {
            exitCode = code;
            context.stop();
        });
    const Apps::SignalWaiter signals(context.get_executor(), [&simulator](int) { simulator.Interrupt(); });
    const Core::Result<Apps::Endpoint> endpoint = simulator.Start();
    if (!endpoint.has_value())
    {
        return TellStartFailure(endpoint.error());
    }
    Apps::PrintReadyLine({{options.tls.has_value() ? "wss" : "ws", *endpoint}});
    const std::unique_ptr<InputLines> input = MakeInput(options, context.get_executor(), work, simulator);
    context.run();
    if (trace != nullptr && !trace->TryClose())
    {
        Apps::PrintError(PROGRAM_NAME, "the trace file " + options.traceFile + " is incomplete");
        return exitCode == EXIT_SUCCESS ? EXIT_FAILURE : exitCode;
    }
    return exitCode;
}

} // namespace ACS::McsSim
