#pragma once

#include "Catch.hpp"
#include "CountingService.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include "SteadySystemClock.hpp"
#include <acs/openstream_asio/OpenStreamClient.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

namespace ACS::Testing
{

inline constexpr std::chrono::seconds LIMIT{10};

/// A server on a free port, its loop and its service.
class TcpFixture
{
public:
    boost::asio::io_context context;
    SteadySystemClock clock;
    SeededRandom random;
    RecordingLogSink log;
    CountingService service;
    std::vector<OpenStream::ClientEvent> events;

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamServer> MakeServer(
        const OpenStreamAsio::OpenStreamServerOptions& options)
    {
        return std::make_unique<OpenStreamAsio::OpenStreamServer>(
            context.get_executor(),
            clock,
            Core::Logger(log, "server"),
            options,
            service);
    }

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamServer> StartServer(
        const OpenStreamAsio::OpenStreamServerOptions& options = MakeOptions())
    {
        std::unique_ptr<OpenStreamAsio::OpenStreamServer> server = MakeServer(options);
        const auto started = server->Start();
        REQUIRE(started.has_value());
        REQUIRE(server->GetPort() != 0);
        return server;
    }

    [[nodiscard]] static OpenStreamAsio::OpenStreamServerOptions MakeOptions()
    {
        OpenStreamAsio::OpenStreamServerOptions options;
        options.port = 0;
        return options;
    }

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamClient> MakeClient(
        std::uint16_t port,
        OpenStreamAsio::OpenStreamClientOptions options = {})
    {
        options.port = port;
        options.session.controlWindow = std::chrono::milliseconds(100);
        options.session.reconnect.initial = std::chrono::milliseconds(20);
        options.session.reconnect.maximum = std::chrono::milliseconds(50);
        return std::make_unique<OpenStreamAsio::OpenStreamClient>(
            context.get_executor(),
            clock,
            random,
            Core::Logger(log, "client"),
            options,
            [this](const OpenStream::ClientEvent& event, Core::Now /*now*/) { events.push_back(event); });
    }

    /// Runs handlers until the condition holds; false where it did not in time.
    [[nodiscard]] bool TryRunUntil(const std::function<bool()>& isReached)
    {
        const auto end = std::chrono::steady_clock::now() + LIMIT;
        while (!isReached() && std::chrono::steady_clock::now() < end)
        {
            context.restart();
            context.run_one_for(std::chrono::milliseconds(100));
        }
        return isReached();
    }

    template <typename TEvent>
    [[nodiscard]] std::size_t Count() const
    {
        return static_cast<std::size_t>(std::ranges::count_if(events, [](const OpenStream::ClientEvent& event) {
            return std::holds_alternative<TEvent>(event);
        }));
    }
};

} // namespace ACS::Testing
