#include "OpenStreamSimProgram.hpp"

#include "common/log/SpdlogSink.hpp"
#include "common/process/FileLimit.hpp"
#include "common/process/ReadyLine.hpp"
#include "common/process/SignalWaiter.hpp"
#include "common/process/SystemClock.hpp"
#include "common/trace/SimulatorTrace.hpp"
#include "controller/ControllerFleet.hpp"
#include "OpenStreamSimOptions.hpp"
#include "world/WorldFile.hpp"
#include <acs/openstream_asio/RealTime.hpp>

#include <boost/asio/io_context.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ACS::OpenStreamSim
{

int RunOpenStreamSim(int argc, const char* const* argv)
{
    OpenStreamSimOptions options;
    const std::optional<int> exitCode = ParseOptionsOrNull(argc, argv, options);
    if (exitCode.has_value())
    {
        return *exitCode;
    }
    Apps::SystemClock clock;
    Apps::SpdlogSink sink(options.common.logLevel);
    boost::asio::io_context context(1);
    const Core::Logger logger(sink, std::string(PROGRAM_NAME));
    if (options.bRealTime)
    {
        for (const std::string& refusal : OpenStreamAsio::TuneThread(OpenStreamAsio::RealTimeOptions::MakeAll()))
        {
            logger.Warning(refusal);
        }
    }
    const tl::expected<std::unique_ptr<Sim::IWorld>, std::string> world = Sim::OpenWorldOption(options.worldFile);
    if (!world.has_value())
    {
        Apps::PrintError(PROGRAM_NAME, world.error());
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    options.fleet.first.controller.world = world->get();
    std::unique_ptr<Apps::SimulatorTrace> trace;
    if (!options.trace.folder.empty())
    {
        auto created = Apps::SimulatorTrace::Create(std::string(PROGRAM_NAME), options.trace, clock, logger);
        if (!created.has_value())
        {
            Apps::PrintError(PROGRAM_NAME, created.error());
            return Apps::EXIT_BAD_COMMAND_LINE;
        }
        trace = std::move(*created);
        options.fleet.first.traceOrNull = trace.get();
    }
    Apps::RaiseFileLimit(); // Each controller has two ports, and each client a connection.
    ControllerFleet fleet(context.get_executor(), clock, logger, options.fleet);
    const Core::Result<void> started = fleet.Start();
    if (!started.has_value())
    {
        Apps::PrintError(PROGRAM_NAME, Core::Describe(started.error()));
        return EXIT_FAILURE;
    }
    const Apps::SignalWaiter signals(context.get_executor(), [&](int) {
        fleet.Stop();
        context.stop();
    });
    Apps::PrintReadyLine(fleet.GetAddresses());
    context.run();
    return EXIT_SUCCESS;
}

} // namespace ACS::OpenStreamSim
