#include "Program.hpp"

#include "AcsRunner.hpp"
#include "common/config/LocalOffset.hpp"
#include "common/log/SpdlogSink.hpp"
#include "common/process/SignalWaiter.hpp"
#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/ShownURL.hpp>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <utility>

namespace ACS::AcsSim
{

namespace
{

/// Above the time limit of the judge: it sees that an Ack is missing before the session closes the connection.
constexpr std::chrono::milliseconds SESSION_EXTRA{500};
constexpr std::chrono::milliseconds ACTIVITY{1'000};
constexpr std::chrono::milliseconds FAULT_INTERVAL{500};
constexpr std::chrono::milliseconds FAULT_TIME{3'000};

Core::Duration Scale(std::chrono::milliseconds time, double scale)
{
    return std::chrono::duration_cast<Core::Duration>(time / scale);
}

AcsRunner::Options MakeRunnerOptions(const AcsSimOptions& options, std::chrono::minutes offset)
{
    AcsRunner::Options made;
    made.client.url = Apps::MakeText(options.url);
    made.client.headers = options.headers;
    made.client.tls = options.tls;
    made.client.session.ackTimeout = options.ackTimeout + SESSION_EXTRA;
    made.client.session.codec.siteOffset = offset;
    PlanExecutor::Options& executor = made.acs.executor;
    if (!options.robots.empty())
    {
        executor.robots = options.robots;
    }
    executor.driveTime = Scale(ACTIVITY, options.timeScale);
    executor.jobTime = Scale(ACTIVITY, options.timeScale);
    executor.maximumQueued = options.queue;
    executor.siteOffset = offset;
    made.acs.faults = options.faults;
    made.acs.faultInterval = Scale(FAULT_INTERVAL, options.timeScale);
    made.acs.faultTime = Scale(FAULT_TIME, options.timeScale);
    made.acs.plans = options.plans;
    made.ackTimeout = options.ackTimeout;
    made.duration = options.duration;
    return made;
}

} // namespace

int Run(const AcsSimOptions& options)
{
    const Apps::SystemClock clock;
    Apps::SystemRandom random;
    Apps::SpdlogSink sink(options.common.logLevel);
    const Core::Logger logger(sink, std::string(PROGRAM_NAME));
    const std::chrono::minutes offset = Apps::LocalOffset().GetAt(clock.GetNow().wall);
    boost::asio::io_context context(1);
    int exitCode = EXIT_FAILURE;
    AcsRunner runner(
        context.get_executor(),
        clock,
        random,
        logger,
        MakeRunnerOptions(options, offset),
        std::cout,
        [&context, &exitCode](int code) {
            exitCode = code;
            context.stop();
        });
    const Apps::SignalWaiter signals(context.get_executor(), [&runner](int) { runner.Stop(); });
    const Core::Result<void> started = runner.Start();
    if (!started.has_value())
    {
        Apps::PrintError(PROGRAM_NAME, Describe(started.error()));
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    std::cout << "connecting to " << Core::MakeShownURL(Apps::MakeText(options.url)) << std::endl;
    context.run();
    return exitCode;
}

} // namespace ACS::AcsSim
