// Lesson 15: drives the first axis of a Hi6 arm along a trajectory over the Open Stream.
//
//     openstream-sim --playing
//     e15_trajectory 127.0.0.1 49000 30        (moves the first axis to 30 degrees)
//     e15_trajectory 127.0.0.1 49000 0 15      (towards 0 degrees, with a STOP on the way at 15 degrees)
//
// The wanted position jumps to the target. JointStepLimiter makes small steps of it, each a streamed CONTROL. The first and
// the last CONTROL are tracked, and the last one counts only when a sample of the MONITOR shows that the arm is at the
// target. STOP control discards the points that the controller has not driven yet. It is sent too when the program is
// interrupted and when it has taken too long; the program ends when the arm is stationary, or without a controller that
// confirms it. The controller must be in playback and wait: see docs/reference/openstream-sim.md. The lesson is longer than
// 150 lines because an arm that moves needs each of these ends.

#include "ExampleArm.hpp"
#include "ExampleClock.hpp"
#include "ExampleRandom.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/openstream/JointStepLimiter.hpp>
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS;             // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr std::chrono::milliseconds PERIOD = 20ms;
constexpr std::chrono::seconds ARRIVAL_TIMEOUT{2};
constexpr std::chrono::seconds STOP_TIMEOUT{5};
constexpr std::chrono::seconds LIMIT{60}; ///< Of the whole program.
constexpr std::size_t AXES = 6;
constexpr double LARGEST_STEP = 1.0; ///< Degrees in one period, for each axis: 50 degrees per second.
constexpr double TOLERANCE = 0.05;   ///< Degrees, and degrees per second.

[[nodiscard]] bool IsStationary(const DataLine& sample)
{
    const std::vector<double> speeds = ReadSample(sample, "velocity");
    return !speeds.empty() && std::ranges::all_of(speeds, [](double speed) { return std::abs(speed) < TOLERANCE; });
}

[[nodiscard]] bool IsAt(const DataLine& sample, double target)
{
    const std::vector<double> position = ReadSample(sample, "position");
    return !position.empty() && std::abs(position.front() - target) < TOLERANCE;
}

[[nodiscard]] ControlRequest MakeControl(std::string_view name, std::string body)
{
    return MakePost(fmt::format("/project/robot/trajectory/{}", name), std::move(body));
}

class Trajectory
{
    enum class EPhase : std::uint8_t
    {
        Starting,  ///< Waits for the first sample, then for the outcome of joint_traject_init.
        Streaming, ///< Sends a point in each period.
        Arriving,  ///< The last point was sent; waits for its outcome.
        Stopping,  ///< STOP control was sent.
        Stopped,   ///< It was acknowledged: the next sample without speed shows where the arm is.
        Ended,
    };

    EPhase _phase = EPhase::Starting;
    double _target;
    std::optional<double> _stopAt;
    double _start = 0;
    std::vector<double> _wanted; ///< Empty before the first sample.
    JointStepLimiter _limiter{std::vector<double>(AXES, LARGEST_STEP)};
    boost::asio::steady_timer _timer;
    boost::asio::steady_timer _limit;
    boost::asio::signal_set _signals;
    OpenStreamAsio::OpenStreamClient _client;

public:
    bool bDone = false;

    Trajectory(
        boost::asio::io_context& io,
        Core::IClock& clock,
        Core::IRandom& random,
        const OpenStreamAsio::OpenStreamClientOptions& controller,
        double target,
        std::optional<double> stopAtOrNull)
        : _target(target),
          _stopAt(stopAtOrNull),
          _timer(io),
          _limit(io, LIMIT),
          _signals(io, SIGINT, SIGTERM),
          _client(io.get_executor(), clock, random, {}, controller, [this](const auto& event, Core::Now) {
              OnEvent(event);
          })
    {
        _signals.async_wait([this](const boost::system::error_code& error, int /*number*/) {
            if (!error)
            {
                Stop("interrupted");
            }
        });
        _limit.async_wait([this](const boost::system::error_code& error) {
            if (!error)
            {
                Stop(fmt::format("not done within {} s", LIMIT.count()));
            }
        });
        _client.SetMonitor(MonitorRequest{"/project/robot/joints/joint_states", PERIOD, {}, {}});
        _client.Start();
    }

private:
    void OnEvent(const ClientEvent& event)
    {
        std::visit(
            Core::Overloaded{
                [this](const ClientData& data) { OnSample(data.line); },
                [this](const ClientControlSettled& settled) { OnSettled(settled); },
                [this](const ClientControlFault& fault) {
                    Stop(
                        "a point was refused: " + std::to_string(fault.status) + " "
                        + fault.body.value_or(Core::JsonText()).GetText());
                },
                [this](const ClientMonitorRefused& refused) { End(refused.error.message); },
                [this](const ClientStopped& stopped) {
                    _phase = stopped.target == EStopTarget::Control ? EPhase::Stopped : _phase;
                },
                [this](const ClientLost& lost) { End("connection lost: " + lost.detail); },
                [](const auto& /*other*/) {
                }},
            event);
    }

    void OnSample(const DataLine& sample)
    {
        const std::vector<double> position = ReadSample(sample, "position");
        if (position.size() != AXES)
        {
            return; // A sample with a status: the controller did not answer the GET.
        }
        if (_wanted.empty())
        {
            _start = position.front();
            _wanted = position;
            _wanted.front() = _target;
            _limiter.Begin(position);
            _client.SendControl(MakeControl("joint_traject_init", R"({"agility_mode":false})"));
        }
        else if (
            _phase == EPhase::Streaming && _stopAt
            && std::abs(position.front() - _start) >= std::abs(*_stopAt - _start))
        {
            bDone = true;
            Stop(fmt::format("STOP at {:.2f} degrees", position.front()));
        }
        else if (_phase == EPhase::Stopped && IsStationary(sample))
        {
            End(fmt::format("stopped at {:.2f} degrees", position.front()));
        }
    }

    void OnSettled(const ClientControlSettled& settled)
    {
        if (_phase == EPhase::Starting && settled.outcome == EControlOutcome::Accepted)
        {
            _phase = EPhase::Streaming;
            _timer.expires_after(0ms);
            SendPointsAsync();
        }
        else if (_phase == EPhase::Arriving && settled.outcome == EControlOutcome::Accepted)
        {
            bDone = true;
            End(fmt::format("arrived at {:.2f} degrees", _target));
        }
        else if (_phase == EPhase::Starting || _phase == EPhase::Arriving)
        {
            Stop("not accepted: " + settled.detail);
        }
    }

    /// At fixed times: a late point does not delay the later ones.
    void SendPointsAsync()
    {
        _timer.expires_at(_timer.expiry() + PERIOD);
        _timer.async_wait([this](const boost::system::error_code& error) {
            if (error || _phase != EPhase::Streaming)
            {
                return;
            }
            const std::span<const double> point = _limiter.Limit(_wanted);
            const std::string body = fmt::format(
                R"({{"interval":{},"look_ahead_time":0.1,"point":[{}]}})",
                std::chrono::duration<double>(PERIOD).count(),
                fmt::join(point, ","));
            ControlCall call;
            call.request = MakeControl("joint_traject_insert_point", body);
            if (_limiter.WasLimited())
            {
                call.tracking = EControlTracking::Streamed;
                SendPointsAsync();
            }
            else
            {
                _phase = EPhase::Arriving;
                call.confirmWithin = ARRIVAL_TIMEOUT;
                call.isConfirmed = [target = _target](const DataLine& sample) {
                    return IsAt(sample, target) && IsStationary(sample);
                };
            }
            _client.SendControlCall(std::move(call));
        });
    }

    /// Sent before everything that waits. The arm brakes; ClientStopped follows.
    void Stop(const std::string& reason)
    {
        if (_phase != EPhase::Stopping && _phase != EPhase::Stopped && _phase != EPhase::Ended)
        {
            _phase = EPhase::Stopping;
            fmt::print("{}\n", reason);
            _client.StopControl();
            _timer.expires_after(STOP_TIMEOUT);
            _timer.async_wait([this](const boost::system::error_code& error) {
                if (!error)
                {
                    End("the controller does not confirm that the arm is stationary");
                }
            });
        }
    }

    void End(const std::string& how)
    {
        if (std::exchange(_phase, EPhase::Ended) != EPhase::Ended)
        {
            fmt::print("{}\n", how);
            _timer.cancel();
            _limit.cancel();
            _signals.cancel();
            _client.Stop(); // Now the io_context runs out of work and main continues.
        }
    }
};

[[nodiscard]] std::optional<double> ReadDegreesOrNull(std::string_view text)
{
    const std::optional<double> degrees = Core::ParseNumberOrNull<double>(text); // Accepts "nan" and "inf".
    return degrees && std::isfinite(*degrees) ? degrees : std::nullopt;
}

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    const auto controllerOrNull = argc > 3 ? ReadControllerOrNull(arguments[1], arguments[2]) : std::nullopt;
    const std::optional<double> target = argc > 3 ? ReadDegreesOrNull(arguments[3]) : std::nullopt;
    const std::optional<double> stopAt = argc > 4 ? ReadDegreesOrNull(arguments[4]) : std::nullopt;
    if (!controllerOrNull || !target || argc > 5 || (argc == 5 && !stopAt))
    {
        fmt::print("Usage: e15_trajectory HOST PORT DEGREES [STOP_AT]\n");
        return 2;
    }
    boost::asio::io_context io;
    ExampleClock clock;
    ExampleRandom random;
    Trajectory trajectory(io, clock, random, *controllerOrNull, *target, stopAt);
    io.run();
    return trajectory.bDone ? 0 : 1;
}
