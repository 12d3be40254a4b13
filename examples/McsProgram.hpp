#pragma once

#include "ExampleClock.hpp"
#include "ExampleLines.hpp"
#include "ExampleRandom.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <utility>

/// The program around an McsServer: prints the address where it listens, passes on the lines of standard input, and ends at
/// Ctrl-C. Returns the exit code.
/// @param server Where the handler expects its server; empty again at the end.
[[nodiscard]] inline int RunMCS(
    const ACS::ProtocolBeast::ServerOptions& options,
    ACS::ProtocolBeast::ISessionHandler& handler,
    std::unique_ptr<ACS::ProtocolBeast::McsServer>& server,
    std::function<void(const std::string& line)> onLine)
{
    boost::asio::io_context io;
    const ExampleClock clock;
    ExampleRandom random;
    const ACS::Core::Logger logger;
    auto created = ACS::ProtocolBeast::McsServer::Create(io.get_executor(), clock, random, logger, options, handler);
    if (!created.has_value())
    {
        fmt::print("{}\n", ACS::Core::Describe(created.error()));
        return 2;
    }
    server = std::move(*created);
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // Each line at once, also into a pipe.
    fmt::print("ready: ws={}:{}\n", options.address, server->GetPort());
    const ExampleLines lines(io, std::move(onLine), []() { /* without further lines the MCS continues */ });
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&io](const boost::system::error_code& error, int /*number*/) {
        if (!error)
        {
            io.stop(); // Like a kill: what must not be lost is on the disk at any time.
        }
    });
    io.run();
    server.reset();
    return 0;
}
