#include "ServedStream.hpp"

#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include "ContextThread.hpp"
#include <acs/openstream_asio/OpenStreamClient.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
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
constexpr std::chrono::seconds STANDSTILL{30}; ///< The run is abandoned after this time without progress.
constexpr std::chrono::minutes TIME_LIMIT{5};  ///< Time limit of both ends, for delays of a busy machine.
constexpr std::uint64_t CONTROLS_AHEAD = 64;   ///< Maximum number of CONTROLs of a connection that are not served yet.
constexpr const char* URL = "/project/robot/joints/joint_states";

/// Data lines of 200 bytes; a CONTROL is counted.
class LoadService final : public IOpenApiService
{
    static constexpr std::string_view JOINT_STATES =
        R"({"_type":"JObject","position":[0.949533,90.949655,-1.5,0.25,45.125,3.75],)"
        R"("velocity":[-0.0,0.1,0.2,0.3,0.4,0.5],"effort":[0.0,93.98,94.02,0.5]})";

public:
    std::atomic<std::uint64_t> controls{0};

    void Call(const ApiRequest& request, Core::Now /*now*/, ApiResponse& response) override
    {
        if (request.method == EApiMethod::Get)
        {
            std::string text = response.TakeRoom();
            text = JOINT_STATES;
            response.body = Core::JsonText::FromTrusted(std::move(text));
            return;
        }
        controls.fetch_add(1, std::memory_order_relaxed);
        response = {};
    }

    void StopControl(Core::Now /*now*/) override
    {
    }
};

/// A client with its MONITOR and its measurements.
class LoadClient
{
    boost::asio::io_context& _context;
    StreamMetrics& _metrics;
    std::optional<Core::SteadyTime> _last;
    double _lastTs = 0.0;
    std::unique_ptr<OpenStreamAsio::OpenStreamClient> _client;

public:
    std::uint64_t received = 0;
    bool bRecording = false;
    std::size_t starts = 0; ///< Of a MONITOR.

    LoadClient(
        boost::asio::io_context& context,
        Core::IClock& clock,
        Core::IRandom& random,
        std::uint16_t port,
        StreamMetrics& metrics)
        : _context(context),
          _metrics(metrics)
    {
        OpenStreamAsio::OpenStreamClientOptions options;
        options.port = port;
        options.session.connectTimeout = TIME_LIMIT;
        options.session.answerTimeout = TIME_LIMIT;
        options.session.lostAfter = TIME_LIMIT;
        _client = std::make_unique<OpenStreamAsio::OpenStreamClient>(
            context.get_executor(),
            clock,
            random,
            Core::Logger(),
            options,
            [this](const ClientEvent& event, Core::Now /*now*/) { Take(event); });
        _client->SetMonitor(MonitorRequest{URL, PERIOD, {}, {}});
        _client->Start();
    }

    void SendControl(const ControlRequest& request)
    {
        static_cast<void>(_client->SendControl(request, EControlTracking::Streamed));
    }

    /// Continues the stream at its longest period, so that sent lines are not skipped as they would be after a STOP.
    void SlowDown()
    {
        _client->SetMonitor(MonitorRequest{URL, MAXIMUM_PERIOD, {}, {}});
    }

private:
    void NoteRefusal(std::string text)
    {
        ++_metrics.linesRefused;
        if (_metrics.firstRefusal.empty())
        {
            _metrics.firstRefusal = std::move(text);
        }
    }

    void Take(const ClientEvent& event)
    {
        if (const auto* data = std::get_if<ClientData>(&event))
        {
            ++received;
            _lastTs = data->line.ts;
            const Core::SteadyTime arrival = data->receivedAt.steady; // as in the bare reader
            if (bRecording && _last.has_value())
            {
                _metrics.frames.Note(*_last, arrival);
            }
            _last = bRecording ? std::optional(arrival) : std::nullopt;
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
            // No line of the old MONITOR comes after the ack of its successor.
            _metrics.framesAtPeriod += received;
            _metrics.periods += static_cast<std::int64_t>(std::floor(_lastTs / static_cast<double>(PERIOD.count())));
        }
        if (const auto* lost = std::get_if<ClientLost>(&event))
        {
            _metrics.failure = "a connection was lost: " + lost->detail;
            _context.stop();
        }
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

/// Sends one point for each client in each period, unless too many are not served yet: the server would have to serve all
/// that wait in the sockets before the clients' next command. Destroyed after the last handler has run.
class ControlLoop
{
    std::vector<std::unique_ptr<LoadClient>>& _clients;
    const LoadService& _service;
    StreamMetrics& _metrics;
    std::uint64_t _sent = 0;
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

public:
    ControlLoop(
        boost::asio::io_context& context,
        std::vector<std::unique_ptr<LoadClient>>& clients,
        const LoadService& service,
        StreamMetrics& metrics)
        : _clients(clients),
          _service(service),
          _metrics(metrics),
          _timer(context)
    {
        WaitAsync();
    }

    void Stop()
    {
        _bStopped = true;
        _timer.cancel();
    }

private:
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
            _metrics.controls.Note(*_last, now);
        }
        _last = now;
        _next = std::max(_next, now - PERIOD); // missed periods are skipped
        if (_sent - _service.controls.load(std::memory_order_relaxed) > CONTROLS_AHEAD * _clients.size())
        {
            _metrics.controlsHeldBack += _clients.size();
            return;
        }
        for (const std::unique_ptr<LoadClient>& client : _clients)
        {
            client->SendControl(_point);
        }
        _sent += _clients.size();
        _metrics.controlsSent += _clients.size();
    }
};

/// Of this program; 0 if the system does not report it.
std::uint64_t ReadResidentBytes()
{
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0;
    std::uint64_t resident = 0;
    file >> pages >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// One run of a kind of traffic, from the server's start to the last line.
class ServedTurn
{
    const StreamKind& _kind;
    StreamMetrics& _metrics;
    Apps::SystemClock _clock;
    Apps::SystemRandom _random;
    LoadService _service;
    ContextThread _server;
    std::unique_ptr<OpenStreamAsio::OpenStreamServer> _stream;
    boost::asio::io_context _context{1};
    std::vector<std::unique_ptr<LoadClient>> _clients;
    std::optional<ControlLoop> _controls;

public:
    ServedTurn(const StreamKind& kind, StreamMetrics& metrics)
        : _kind(kind),
          _metrics(metrics)
    {
    }

    ServedTurn(const ServedTurn&) = delete;
    ServedTurn& operator=(const ServedTurn&) = delete;

    ~ServedTurn()
    {
        _server.Stop();
    }

    bool TryRun(std::chrono::milliseconds duration)
    {
        if (!TryStartServer())
        {
            return false;
        }
        StartClients();
        if (!TryRunUntil([this]() { return HasEachStarted(1); }, "not every MONITOR began"))
        {
            return false;
        }
        if (_kind.bControls)
        {
            _controls.emplace(_context, _clients, _service, _metrics);
        }
        _context.run_for(WARM_UP);
        Measure(duration);
        return TryFinish();
    }

private:
    /// Runs while there is progress. False if there is none, or a connection was lost; the failure is recorded.
    bool TryRunUntil(const std::function<bool()>& isReached, const char* what)
    {
        std::uint64_t moved = GetProgress();
        Core::SteadyTime end = std::chrono::steady_clock::now() + STANDSTILL;
        while (!isReached())
        {
            _context.run_for(PERIOD);
            if (!_metrics.failure.empty())
            {
                return false;
            }
            const std::uint64_t progress = GetProgress();
            const Core::SteadyTime now = std::chrono::steady_clock::now();
            if (std::exchange(moved, progress) != progress)
            {
                end = now + STANDSTILL;
            }
            else if (now > end)
            {
                _metrics.failure = fmt::format("{}: no progress for {} s", what, STANDSTILL.count());
                return false;
            }
        }
        return true;
    }

    [[nodiscard]] std::uint64_t GetProgress() const
    {
        std::uint64_t progress = CountReceived(_clients) + _service.controls.load(std::memory_order_relaxed);
        for (const std::unique_ptr<LoadClient>& client : _clients)
        {
            progress += client->starts;
        }
        return progress;
    }

    [[nodiscard]] bool HasEachStarted(std::size_t times) const
    {
        return std::ranges::all_of(_clients, [times](const auto& client) { return client->starts == times; });
    }

    bool TryStartServer()
    {
        Core::Result<void> started;
        _server.Call([this, &started]() {
            OpenStreamAsio::OpenStreamServerOptions options;
            options.port = 0;
            options.maximumSessions = _kind.connections;
            options.session.handshakeTimeout = TIME_LIMIT;
            options.session.streamingTimeout = TIME_LIMIT;
            _stream = std::make_unique<OpenStreamAsio::OpenStreamServer>(
                _server.GetContext().get_executor(),
                _clock,
                Core::Logger(),
                options,
                _service);
            started = _stream->Start();
        });
        if (!started.has_value())
        {
            _metrics.failure = Core::Describe(started.error());
        }
        return started.has_value();
    }

    void StartClients()
    {
        for (std::size_t index = 0; index < _kind.connections; ++index)
        {
            _clients.push_back(std::make_unique<LoadClient>(_context, _clock, _random, _stream->GetPort(), _metrics));
        }
    }

    void Measure(std::chrono::milliseconds duration)
    {
        const Core::Duration serverBefore = _server.GetProcessorTime();
        const Core::Duration clientBefore = GetOwnProcessorTime();
        std::ranges::for_each(_clients, [](const auto& client) { client->bRecording = true; });
        _metrics.residentBefore = ReadResidentBytes();
        _context.run_for(duration);
        const std::uint64_t lists = _metrics.frames.GetListBytes() + _metrics.controls.GetListBytes();
        _metrics.residentAfter = ReadResidentBytes() - lists;
        _metrics.elapsed += duration;
        _metrics.serverTime += _server.GetProcessorTime() - serverBefore;
        _metrics.clientTime += GetOwnProcessorTime() - clientBefore;
    }

    /// Ends the traffic and waits for the last line.
    bool TryFinish()
    {
        if (_controls.has_value())
        {
            _controls->Stop();
        }
        std::ranges::for_each(_clients, [](const auto& client) {
            client->bRecording = false;
            client->SlowDown();
        });
        if (!TryRunUntil([this]() { return HasEachStarted(2); }, "not every MONITOR slowed down"))
        {
            return false;
        }
        ServerSessionStats stats;
        const auto hasAllArrived = [this, &stats]() {
            _server.Call([this, &stats]() { stats = _stream->GetStats(); });
            return stats.dataLines == CountReceived(_clients);
        };
        // The tick that was due when the MONITOR changed is still sent.
        _context.run_for(2 * PERIOD);
        if (!TryRunUntil(hasAllArrived, "not every line arrived"))
        {
            return false;
        }
        _metrics.framesSent += stats.dataLines;
        _metrics.framesReplaced += stats.replacedLines;
        _metrics.ticksSkipped += stats.skippedTicks;
        _metrics.framesReceived += CountReceived(_clients);
        _metrics.controlsServed += _service.controls.load();
        return true;
    }
};

} // namespace

bool TryRunServedTurn(const StreamKind& kind, std::chrono::milliseconds duration, StreamMetrics& metrics)
{
    return ServedTurn(kind, metrics).TryRun(duration);
}

} // namespace ACS::Load
