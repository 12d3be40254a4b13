#include "BoundLine.hpp"
#include "common/config/CommandLine.hpp"
#include "FleetMaster.hpp"
#include "MosquittoBroker.hpp"
#include "ProcessProbe.hpp"
#include "RingSite.hpp"

#include <boost/asio/io_context.hpp>
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <unistd.h>
#include <vector>

// A whole fleet: vda-sim on one core, a master control on the other, a real mosquitto on either.

namespace ACS::Load
{
namespace
{

using Clock = std::chrono::steady_clock;
using std::chrono::duration;
using std::chrono::seconds;

constexpr std::size_t SIMULATOR_CORE = 0;
constexpr std::size_t MASTER_CORE = 1;
constexpr seconds START_TIMEOUT{60};
constexpr seconds STOP_TIMEOUT{10};
constexpr seconds LONGEST_WARM_UP{10}; ///< While all drive.

// Bounds of the fleet.
constexpr double STATES_PER_SECOND = 1.0;
constexpr double VISUALIZATIONS_PER_SECOND = 5.0;
constexpr double TOLERANCE = 0.05;
constexpr double MOST_KIB = 64.0;
constexpr double ONE_CORE = 100.0;

struct Rate
{
    double slowest = 0.0; ///< Messages of one vehicle per second.
    double mean = 0.0;
    double fastest = 0.0;
    double longestPause = 0.0; ///< s
    std::uint64_t missing = 0;
};

struct FleetMetrics
{
    std::size_t vehicles = 0;
    double seconds = 0.0;
    Rate states;
    Rate visualizations;
    double simulatorCpu = 0.0; ///< % of a core.
    double masterCpu = 0.0;
    double brokerCpu = 0.0;
    std::int64_t residentKiB = 0;
    std::size_t driving = 0;
    MasterCount master;
};

Rate MakeRate(const std::vector<VehicleCount>& counts, const TopicCount VehicleCount::*topic, double measured)
{
    Rate rate;
    rate.slowest = static_cast<double>((counts.front().*topic).messages) / measured;
    std::uint64_t all = 0;
    for (const VehicleCount& count : counts)
    {
        const TopicCount& counted = count.*topic;
        const double perSecond = static_cast<double>(counted.messages) / measured;
        rate.slowest = std::min(rate.slowest, perSecond);
        rate.fastest = std::max(rate.fastest, perSecond);
        rate.longestPause = std::max(rate.longestPause, duration<double>(counted.longestPause).count());
        rate.missing += counted.missing;
        all += counted.messages;
    }
    rate.mean = static_cast<double>(all) / measured / static_cast<double>(counts.size());
    return rate;
}

/// A broker, a simulator and a master, until its destruction.
class FleetRun
{
    Testing::MosquittoBroker _broker{"allow_anonymous true\nmax_queued_messages 0\n"};
    boost::asio::io_context _context;
    FleetMaster _master;
    std::size_t _vehicles;
    std::optional<Testing::ChildProcess> _simulator;

public:
    explicit FleetRun(std::size_t vehicles)
        : _master(_context, _broker.GetPort()),
          _vehicles(vehicles)
    {
        const std::string site = (_broker.GetFolder() / "ring.lif.json").string();
        std::ofstream(site) << RingSite::WriteLIF();
        ProcessProbe::KeepOnCore(getpid(), MASTER_CORE);
        _context.run_for(std::chrono::milliseconds(200)); // the master listens before the fleet comes
        _simulator.emplace(std::vector<std::string>{
            ACS_VDA_SIM,
            "--broker",
            _broker.GetURL(),
            "--site",
            site,
            "--count",
            std::to_string(vehicles),
            "--no-control",
            "--seed",
            "1",
            "--log-level",
            "warning"});
        ProcessProbe::KeepOnCore(_simulator->GetProcessID(), SIMULATOR_CORE);
    }

    FleetRun(const FleetRun&) = delete;
    FleetRun& operator=(const FleetRun&) = delete;

    ~FleetRun()
    {
        _simulator->Signal(SIGTERM);
        std::ignore = _simulator->WaitForExitOrNull(STOP_TIMEOUT);
    }

    [[nodiscard]] FleetMetrics Measure(seconds howLong)
    {
        RunUntil([this]() { return _master.CountDriving() == _vehicles; });
        _context.run_for(std::min(howLong, LONGEST_WARM_UP));
        _master.ResetCounts();
        const pid_t simulator = _simulator->GetProcessID();
        const double simulatorBefore = ProcessProbe::GetCpuSeconds(simulator);
        const double masterBefore = ProcessProbe::GetCpuSeconds(getpid());
        const double brokerBefore = ProcessProbe::GetCpuSeconds(_broker.GetProcessID());
        const Clock::time_point begin = Clock::now();
        _context.run_for(howLong);
        const double measured = duration<double>(Clock::now() - begin).count();

        FleetMetrics metrics;
        metrics.vehicles = _vehicles;
        metrics.seconds = measured;
        metrics.simulatorCpu = (ProcessProbe::GetCpuSeconds(simulator) - simulatorBefore) / measured * ONE_CORE;
        metrics.masterCpu = (ProcessProbe::GetCpuSeconds(getpid()) - masterBefore) / measured * ONE_CORE;
        metrics.brokerCpu = (ProcessProbe::GetCpuSeconds(_broker.GetProcessID()) - brokerBefore) / measured * ONE_CORE;
        metrics.residentKiB = ProcessProbe::GetResidentKiB(simulator);
        metrics.states = MakeRate(_master.GetCounts(), &VehicleCount::states, measured);
        metrics.visualizations = MakeRate(_master.GetCounts(), &VehicleCount::visualizations, measured);
        metrics.driving = _master.CountDriving();
        metrics.master = _master.GetTotal();
        return metrics;
    }

private:
    void RunUntil(const std::function<bool()>& isTrue)
    {
        const Clock::time_point deadline = Clock::now() + START_TIMEOUT;
        while (!isTrue())
        {
            if (Clock::now() > deadline)
            {
                throw std::runtime_error(fmt::format(
                    "{} of {} vehicles drive after {} s; {}; output of vda-sim: {}",
                    _master.CountDriving(),
                    _vehicles,
                    START_TIMEOUT.count(),
                    _master.GetTotal().firstError,
                    _simulator->GetText()));
            }
            _context.run_for(std::chrono::milliseconds(100));
        }
    }
};

std::string Describe(const Rate& rate)
{
    return fmt::format(
        "{:.3f}, slowest {:.3f}, fastest {:.3f}, pause {:.2f} s",
        rate.mean,
        rate.slowest,
        rate.fastest,
        rate.longestPause);
}

void PrintTable(const FleetMetrics& fleet, const FleetMetrics& single)
{
    const double perVehicle = static_cast<double>(fleet.residentKiB - single.residentKiB)
        / static_cast<double>(std::max<std::size_t>(fleet.vehicles - single.vehicles, 1));
    fmt::print("\nvda-sim, {} vehicles driving, measured for {:.0f} s\n", fleet.vehicles, fleet.seconds);
    // A vehicle also sends a state at each node: states may come more often than each second.
    PrintBound(
        "state, a vehicle's per s",
        Describe(fleet.states),
        fleet.states.slowest >= STATES_PER_SECOND * (1.0 - TOLERANCE),
        "1.0 or more, less 5 %");
    PrintBound(
        "visualization, a vehicle's per s",
        Describe(fleet.visualizations),
        fleet.visualizations.slowest >= VISUALIZATIONS_PER_SECOND * (1.0 - TOLERANCE)
            && fleet.visualizations.fastest <= VISUALIZATIONS_PER_SECOND * (1.0 + TOLERANCE),
        "5.0, 5 % more or less");
    const std::uint64_t missing = fleet.states.missing + fleet.visualizations.missing;
    PrintBound("messages lost on the way", fmt::format("{}", missing), missing == 0, "none");
    PrintBound(
        "memory of vda-sim, a vehicle",
        fmt::format("{:.1f} KiB (all {} KiB, one alone {} KiB)", perVehicle, fleet.residentKiB, single.residentKiB),
        perVehicle < MOST_KIB,
        fmt::format("{:.0f} KiB", MOST_KIB));
    PrintBound(
        "CPU of vda-sim",
        fmt::format("{:.1f} % of a core", fleet.simulatorCpu),
        fleet.simulatorCpu < ONE_CORE,
        "one core");
    PrintBound(
        "CPU of the master",
        fmt::format("{:.1f} % of a core", fleet.masterCpu),
        fleet.masterCpu < ONE_CORE,
        "one core");
    PrintValue("CPU of mosquitto", fmt::format("{:.1f} % of a core", fleet.brokerCpu));
    PrintBound(
        "vehicles driven by the master",
        fmt::format("{}; {} nodes reached", fleet.driving, fleet.master.nodesReached),
        fleet.driving * 100 >= fleet.vehicles * 95,
        "95 %: some have ended an order");
    PrintValue("orders and updates sent", fmt::format("{} and {}", fleet.master.ordersSent, fleet.master.updatesSent));
    PrintBound(
        "errors seen by the master",
        fmt::format("{} {}", fleet.master.errors, fleet.master.firstError),
        fleet.master.errors == 0,
        "none");
}

struct Options
{
    std::size_t vehicles = 500;
    int seconds = 60;
};

int Run(const Options& options)
{
    const FleetMetrics single = FleetRun(1).Measure(seconds(1));
    const FleetMetrics fleet = FleetRun(options.vehicles).Measure(seconds(options.seconds));
    PrintTable(fleet, single);
    // Conditions that hold however busy the machine is.
    const bool bWell = fleet.states.missing + fleet.visualizations.missing == 0 && fleet.master.errors == 0;
    return bWell ? 0 : 1;
}

} // namespace
} // namespace ACS::Load

int main(int argc, char** argv)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    return Apps::RunProgram("fleet_load", [argc, argv]() {
        Load::Options options;
        CLI::App app{
            "Measures a driving fleet of vda-sim and its master control on their own broker; "
            "fails if a message is lost or refused",
            "fleet_load"};
        app.add_option("--vehicles", options.vehicles, "Number of driving vehicles")
            ->check(CLI::Range(1, 5000))
            ->capture_default_str();
        app.add_option("--seconds", options.seconds, "Measuring time in seconds")
            ->check(CLI::Range(1, 100'000))
            ->capture_default_str();
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Load::Run(options);
    });
}
