// Lesson 16: records the joint angles of a Hi6 arm as CSV and plots them in the terminal.
//
//     openstream-sim --ready
//     e16_joint_plot 127.0.0.1 49000 joints.csv 500       (500 samples; Ctrl-C ends it earlier)
//
// Each sample is a line of the file, with the controller's time in ms. The terminal is redrawn ten times a second from the
// newest sample, however fast the samples arrive: GetLatestOrNull needs no event. The last line counts the periods without
// a sample, according to the controller's time. The lesson is longer than 150 lines because it writes, plots and counts.

#include "ExampleArm.hpp"
#include "ExampleClock.hpp"
#include "ExampleRandom.hpp"
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
#include <cstdio>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <unistd.h>
#include <variant>
#include <vector>

using namespace ACS;             // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr std::size_t WIDTH = 60;     ///< Characters of an axis.
constexpr double LARGEST_ANGLE = 180; ///< Degrees at both ends of an axis.
constexpr std::chrono::milliseconds PERIOD = 20ms;
constexpr std::chrono::milliseconds REDRAW = 100ms;

/// "J1  -12.34 |          *        |         |": the star is the angle, the bar in the middle is 0.
std::string PlotAxis(std::size_t axis, double angle)
{
    std::string scale(WIDTH + 1, ' ');
    scale[WIDTH / 2] = '|';
    const double share = std::clamp((angle + LARGEST_ANGLE) / (2 * LARGEST_ANGLE), 0.0, 1.0);
    scale[static_cast<std::size_t>(std::lround(share * static_cast<double>(WIDTH)))] = '*';
    return fmt::format("J{} {:8.2f} |{}|\n", axis + 1, angle, scale);
}

class JointRecorder
{
    boost::asio::io_context& _io;
    std::ofstream _csv;
    std::uint64_t _wanted;
    std::uint64_t _samples = 0;
    bool _bTerminal = ::isatty(STDOUT_FILENO) == 1; ///< In a pipe or a file only the last plot is written.
    boost::asio::steady_timer _redraw;
    OpenStreamAsio::OpenStreamClient _client;

public:
    JointRecorder(
        boost::asio::io_context& io,
        Core::IClock& clock,
        Core::IRandom& random,
        const OpenStreamAsio::OpenStreamClientOptions& controller,
        const std::string& csv,
        std::uint64_t samples)
        : _io(io),
          _csv(csv),
          _wanted(samples),
          _redraw(io),
          _client(io.get_executor(), clock, random, {}, controller, [this](const auto& event, Core::Now) {
              OnEvent(event);
          })
    {
        _csv << "ts_ms,j1,j2,j3,j4,j5,j6\n";
        _client.SetMonitor(MonitorRequest{"/project/robot/joints/joint_states", PERIOD, {}, {}});
        _client.Start();
        RedrawAsync();
    }

    void Stop()
    {
        Draw();
        _redraw.cancel();
        _client.Stop(); // ClientEnded follows.
    }

    [[nodiscard]] bool IsComplete() const
    {
        return _samples == _wanted && _csv.good();
    }

private:
    void OnEvent(const ClientEvent& event)
    {
        if (const auto* const dataOrNull = std::get_if<ClientData>(&event); dataOrNull != nullptr && _samples < _wanted)
        {
            const std::vector<double> angles = ReadSample(dataOrNull->line, "position");
            _csv << fmt::format("{:.0f},{:.4f}\n", dataOrNull->line.ts, fmt::join(angles, ","));
            if (++_samples == _wanted || !_csv.flush())
            {
                Stop();
            }
        }
        else if (const auto* const lostOrNull = std::get_if<ClientLost>(&event))
        {
            fmt::print("connection lost: {}; trying again\n", lostOrNull->detail);
        }
        else if (std::holds_alternative<ClientEnded>(event))
        {
            _io.stop(); // Which still waits for signals.
        }
        else if (const auto* const refusedOrNull = std::get_if<ClientMonitorRefused>(&event))
        {
            fmt::print("the MONITOR was refused: {}\n", refusedOrNull->error.message);
            Stop();
        }
    }

    void RedrawAsync()
    {
        _redraw.expires_after(REDRAW);
        _redraw.async_wait([this](const boost::system::error_code& error) {
            if (!error)
            {
                if (_bTerminal)
                {
                    fmt::print("\x1b[H\x1b[J"); // Clears the terminal.
                    Draw();
                }
                RedrawAsync();
            }
        });
    }

    void Draw() const
    {
        const ClientData* const latestOrNull = _client.GetLatestOrNull();
        const std::vector<double> angles =
            latestOrNull != nullptr ? ReadSample(latestOrNull->line, "position") : std::vector<double>();
        for (std::size_t i = 0; i < angles.size(); ++i)
        {
            fmt::print("{}", PlotAxis(i, angles[i]));
        }
        fmt::print("{} of {} samples, {} missing\n", _samples, _wanted, _client.GetStats().missingLines);
        std::fflush(stdout); // NOLINT(cert-err33-c): a plot that does not appear does no harm
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    const auto controllerOrNull = argc == 5 ? ReadControllerOrNull(arguments[1], arguments[2]) : std::nullopt;
    const auto samples = argc == 5 ? Core::ParseNumberOrNull<std::uint64_t>(arguments[4]) : std::nullopt;
    if (!controllerOrNull.has_value() || samples.value_or(0) == 0)
    {
        fmt::print("Usage: e16_joint_plot HOST PORT CSV SAMPLES\n");
        return 2;
    }
    boost::asio::io_context io;
    ExampleClock clock;
    ExampleRandom random;
    JointRecorder recorder(io, clock, random, *controllerOrNull, arguments[3], *samples);
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&recorder](const boost::system::error_code& error, int /*number*/) {
        if (!error)
        {
            recorder.Stop();
        }
    });
    io.run();
    return recorder.IsComplete() ? 0 : 1;
}
