// Lesson 6: Hi6 Open Stream from both sides, over TCP on a free port: five samples of a MONITOR, then one CONTROL.
//
// The server stands in for the controller; what it serves is an IOpenApiService, here of one value that can be read and
// set. The client is what an integrator writes against the real controller.

#include "ExampleRandom.hpp"
#include <acs/openstream_asio/OpenStreamClient.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/io_context.hpp>
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <variant>

using namespace ACS::OpenStream;     // NOLINT(google-build-using-namespace): an example reads better
using namespace ACS::OpenStreamAsio; // NOLINT(google-build-using-namespace): without the prefixes
namespace Core = ACS::Core;
using namespace std::chrono_literals;

namespace
{

constexpr int WANTED_SAMPLES = 5;

class SystemClock final : public Core::IClock
{
public:
    [[nodiscard]] Core::Now GetNow() const override
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }
};

/// One counter: a GET of any path reads it and counts on, a POST sets it to 0. Others get a 404 from a real one.
class CounterService final : public IOpenApiService
{
    std::int64_t _counter = 0;

public:
    void Call(const ApiRequest& request, Core::Now /*now*/, ApiResponse& response) override
    {
        response = ApiResponse{};
        if (request.method == EApiMethod::Get)
        {
            response.body = Core::JsonText::FromInteger(++_counter);
            return;
        }
        _counter = 0;
        fmt::print("server: the counter is {}\n", _counter);
    }

    void StopControl(Core::Now /*now*/) override
    {
    }
};

/// Runs the lesson: each step follows from the event before it, nothing waits for time to pass.
class Monitor
{
    OpenStreamServer& _server;
    OpenStreamClient _client;
    int _samples = 0;

public:
    bool bAccepted = false;
    bool bEnded = false;

    Monitor(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        Core::IRandom& random,
        const OpenStreamClientOptions& options,
        OpenStreamServer& server)
        : _server(server),
          _client(executor, clock, random, {}, options, [this](const auto& event, Core::Now) { OnEvent(event); })
    {
        // Not sent at once: the client establishes the MONITOR after this handshake and after every reconnect.
        _client.SetMonitor(MonitorRequest{"/demo/counter", 20ms, std::nullopt, std::nullopt});
        _client.Start();
    }

private:
    void OnEvent(const ClientEvent& event)
    {
        if (const auto* dataOrNull = std::get_if<ClientData>(&event))
        {
            OnData(dataOrNull->line);
        }
        else if (const auto* settledOrNull = std::get_if<ClientControlSettled>(&event))
        {
            // Success is not answered on the wire: Accepted means that no refusal came within the window.
            bAccepted = settledOrNull->outcome == EControlOutcome::Accepted;
            fmt::print("client: the CONTROL was {}\n", bAccepted ? "accepted" : "not accepted");
            _client.Stop();
        }
        else if (std::holds_alternative<ClientEnded>(event))
        {
            bEnded = true;
            _server.Stop(); // Now the io_context runs out of work and main continues.
        }
    }

    void OnData(const DataLine& line)
    {
        if (++_samples > WANTED_SAMPLES)
        {
            return; // It was under way when the MONITOR was ended.
        }
        fmt::print("client: sample {} is {}\n", _samples, line.result.has_value() ? line.result->GetText() : "missing");
        if (_samples == WANTED_SAMPLES)
        {
            _client.SetMonitor(std::nullopt);
            _client.SendControl({EApiMethod::Post, "/demo/counter", std::nullopt, std::nullopt});
        }
    }
};

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    boost::asio::io_context io; // Everything runs on its one thread, hence no locks anywhere.
    SystemClock clock;
    ExampleRandom random;
    CounterService service;

    OpenStreamServerOptions serverOptions;
    serverOptions.port = 0; // One that is free. A controller listens on 49000.
    OpenStreamServer server(io.get_executor(), clock, {}, serverOptions, service);
    if (const Core::Result<void> started = server.Start(); !started.has_value())
    {
        fmt::print("{}\n", Core::Describe(started.error()));
        return 1;
    }

    OpenStreamClientOptions clientOptions;
    clientOptions.port = server.GetPort();
    Monitor monitor(io.get_executor(), clock, random, clientOptions, server);

    io.run_for(10s); // Never needed where all goes well.
    return monitor.bAccepted && monitor.bEnded ? 0 : 1;
}
