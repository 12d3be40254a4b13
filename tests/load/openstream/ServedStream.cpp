#include "ServedStream.hpp"

#include "common/SystemClock.hpp"
#include "common/SystemRandom.hpp"
#include "ContextThread.hpp"
#include <acs/openstream_asio/OpenStreamClient.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/steady_timer.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Load
{

namespace
{

using namespace OpenStream; // NOLINT(google-build-using-namespace)

constexpr std::chrono::milliseconds WARM_UP{200};
constexpr std::chrono::seconds LIMIT{10};
constexpr const char* URL = "/project/robot/joints/joint_states";

/// Data lines of 200 bytes; a CONTROL is counted.
class LoadService final : public IOpenApiService
{
    static constexpr std::string_view JOINT_STATES =
        R"({"_type":"JObject","position":[0.949533,90.949655,-1.5,0.25,45.125,3.75],)"
        R"("velocity":[-0.0,0.1,0.2,0.3,0.4,0.5],"effort":[0.0,93.98,94.02,0.5]})";

public:
    std::uint64_t controls = 0;

    void Call(const ApiRequest& request, Core::Now /*now*/, ApiResponse& response) override
    {
        if (request.method == EApiMethod::Get)
        {
            std::string text = response.TakeRoom();
            text = JOINT_STATES;
            response.body = Core::JsonText::FromTrusted(std::move(text));
            return;
        }
        ++controls;
        response = {};
    }

    void StopControl(Core::Now /*now*/) override
    {
    }
};

/// A client with its MONITOR, and what it notes.
class LoadClient
{
    StreamFigures& _figures;
    std::optional<Core::SteadyTime> _last;
    double _lastTs = 0.0;
    std::unique_ptr<OpenStreamAsio::OpenStreamClient> _client;

    void NoteRefusal(std::string text)
    {
        ++_figures.linesRefused;
        if (_figures.firstRefusal.empty())
        {
            _figures.firstRefusal = std::move(text);
        }
    }

    void Take(const ClientEvent& event, Core::Now now)
    {
        if (const auto* data = std::get_if<ClientData>(&event))
        {
            ++received;
            _lastTs = data->line.ts;
            if (bRecording && _last.has_value())
            {
                _figures.frames.Note(*_last, now.steady);
            }
            _last = bRecording ? std::optional(now.steady) : std::nullopt;
            return;
        }
        if (const auto* fault = std::get_if<ClientControlFault>(&event))
        {
            NoteRefusal(fault->detail);
        }
        else if (const auto* error = std::get_if<ClientErrorReported>(&event))
        {
            NoteRefusal(error->error.codeText + ": " + error->error.message);
        }
        else if (std::holds_alternative<ClientMonitorStarted>(event) && ++starts == 2)
        {
            // No line of the old MONITOR comes behind its successor's ack.
            _figures.framesAtPeriod += received;
            _figures.periods += static_cast<std::int64_t>(std::floor(_lastTs / static_cast<double>(PERIOD.count())));
        }
        if (const auto* lost = std::get_if<ClientLost>(&event))
        {
            throw std::runtime_error("the connection was lost: " + lost->detail);
        }
    }

public:
    std::uint64_t received = 0;
    bool bRecording = false;
    std::size_t starts = 0; ///< Of a MONITOR.

    LoadClient(
        boost::asio::io_context& context,
        Core::IClock& clock,
        Core::IRandom& random,
        std::uint16_t port,
        StreamFigures& figures)
        : _figures(figures)
    {
        OpenStreamAsio::OpenStreamClientOptions options;
        options.port = port;
        _client = std::make_unique<OpenStreamAsio::OpenStreamClient>(
            context.get_executor(),
            clock,
            random,
            Core::Logger(),
            options,
            [this](const ClientEvent& event, Core::Now now) { Take(event, now); });
        _client->SetMonitor(MonitorRequest{URL, PERIOD, {}, {}});
        _client->Start();
    }

    void SendControl(const ControlRequest& request)
    {
        static_cast<void>(_client->SendControl(request, EControlTracking::Streamed));
    }

    /// The stream goes on at its longest period, so that what has been sent is not passed over as after a STOP.
    void SlowDown()
    {
        _client->SetMonitor(MonitorRequest{URL, MAXIMUM_PERIOD, {}, {}});
    }
};

std::uint64_t CountReceived(const std::vector<std::unique_ptr<LoadClient>>& clients)
{
    return std::transform_reduce(
        clients.begin(),
        clients.end(),
        std::uint64_t{0},
        std::plus<>(),
        [](const auto& client) { return client->received; });
}

/// One point for each client at each period. Destroyed after the last handler has run.
class ControlLoop
{
    std::vector<std::unique_ptr<LoadClient>>& _clients;
    StreamFigures& _figures;
    boost::asio::steady_timer _timer;
    Core::SteadyTime _next = std::chrono::steady_clock::now();
    std::optional<Core::SteadyTime> _last;
    bool _bStopped = false;
    ControlRequest _point{
        EApiMethod::Post,
        "/project/robot/trajectory/joint_traject_insert_point",
        std::nullopt,
        Core::JsonText::FromTrusted(R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0.01,)"
                                    R"("point":[0.1,90.2,-1.5,0.25,45.1,3.7]})")};

    void WaitAsync()
    {
        _next += PERIOD;
        _timer.expires_at(_next);
        _timer.async_wait([this](const boost::system::error_code& error) {
            if (!error && !_bStopped)
            {
                Send();
                WaitAsync();
            }
        });
    }

    void Send()
    {
        const Core::SteadyTime now = std::chrono::steady_clock::now();
        if (_last.has_value())
        {
            _figures.controls.Note(*_last, now);
        }
        _last = now;
        _next = std::max(_next, now - PERIOD); // what was missed is not made up for
        for (const std::unique_ptr<LoadClient>& client : _clients)
        {
            client->SendControl(_point);
            ++_figures.controlsSent;
        }
    }

public:
    ControlLoop(
        boost::asio::io_context& context,
        std::vector<std::unique_ptr<LoadClient>>& clients,
        StreamFigures& figures)
        : _clients(clients),
          _figures(figures),
          _timer(context)
    {
        WaitAsync();
    }

    void Stop()
    {
        _bStopped = true;
        _timer.cancel();
    }
};

/// Of this program; 0 where the system does not tell.
std::uint64_t ReadResidentBytes()
{
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0;
    std::uint64_t resident = 0;
    file >> pages >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void RunUntil(boost::asio::io_context& context, const std::function<bool()>& isReached, const char* what)
{
    const Core::SteadyTime end = std::chrono::steady_clock::now() + LIMIT;
    while (!isReached())
    {
        if (std::chrono::steady_clock::now() > end)
        {
            throw std::runtime_error(what);
        }
        context.run_one_for(LIMIT);
    }
}

} // namespace

void RunServedTurn(const StreamKind& kind, std::chrono::milliseconds duration, StreamFigures& figures)
{
    Apps::SystemClock clock;
    Apps::SystemRandom random;
    LoadService service;
    ContextThread server;
    std::unique_ptr<OpenStreamAsio::OpenStreamServer> stream;
    Core::Result<void> started;
    server.Call([&]() {
        OpenStreamAsio::OpenStreamServerOptions options;
        options.port = 0;
        options.maximumSessions = kind.connections;
        stream = std::make_unique<OpenStreamAsio::OpenStreamServer>(
            server.GetContext().get_executor(),
            clock,
            Core::Logger(),
            options,
            service);
        started = stream->Start();
    });
    if (!started.has_value())
    {
        throw std::runtime_error(Core::Describe(started.error()));
    }

    boost::asio::io_context context(1);
    std::vector<std::unique_ptr<LoadClient>> clients;
    for (std::size_t index = 0; index < kind.connections; ++index)
    {
        clients.push_back(std::make_unique<LoadClient>(context, clock, random, stream->GetPort(), figures));
    }
    const auto haveStarted = [&clients](std::size_t times) {
        return std::ranges::all_of(clients, [times](const auto& client) { return client->starts == times; });
    };
    RunUntil(
        context,
        [&haveStarted]() { return haveStarted(1); },
        "not every MONITOR began in time");
    std::optional<ControlLoop> controls;
    if (kind.bControls)
    {
        controls.emplace(context, clients, figures);
    }
    context.run_for(WARM_UP);

    const Core::Duration serverBefore = server.GetProcessorTime();
    const Core::Duration clientBefore = GetOwnProcessorTime();
    std::ranges::for_each(clients, [](const auto& client) { client->bRecording = true; });
    figures.residentBefore = ReadResidentBytes();
    context.run_for(duration);
    figures.residentAfter = ReadResidentBytes();
    figures.elapsed += duration;
    figures.serverTime += server.GetProcessorTime() - serverBefore;
    figures.clientTime += GetOwnProcessorTime() - clientBefore;

    if (controls.has_value())
    {
        controls->Stop();
    }
    std::ranges::for_each(clients, [](const auto& client) {
        client->bRecording = false;
        client->SlowDown();
    });
    RunUntil(
        context,
        [&haveStarted]() { return haveStarted(2); },
        "not every MONITOR slowed down in time");
    ServerSessionStats stats;
    const auto hasAllArrived = [&]() {
        server.Call([&]() { stats = stream->GetStats(); });
        return stats.dataLines == CountReceived(clients);
    };
    // The tick that was due when the MONITOR changed still comes.
    context.run_for(2 * PERIOD);
    const Core::SteadyTime end = std::chrono::steady_clock::now() + LIMIT;
    while (!hasAllArrived() && std::chrono::steady_clock::now() < end)
    {
        context.run_for(PERIOD);
    }
    figures.framesSent += stats.dataLines;
    figures.framesReplaced += stats.replacedLines;
    figures.ticksSkipped += stats.skippedTicks;
    figures.framesReceived += CountReceived(clients);
    server.Call([&]() { figures.controlsServed += service.controls; });
    server.Stop();
}

} // namespace ACS::Load
