#include "RobotsRun.hpp"

#include "CellSite.hpp"
#include "common/process/SignalWaiter.hpp"
#include "MosquittoBroker.hpp"
#include "ProcessProbe.hpp"

#include <boost/asio/io_context.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <unistd.h>
#include <utility>
#include <vector>

namespace ACS::Load
{

namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::size_t LEAST_CELLS = 100;
constexpr std::chrono::seconds TIME_LIMIT{60};
constexpr std::chrono::seconds STOP_TIMEOUT{10};
constexpr std::chrono::seconds WARM_UP{2}; ///< With all plans running.
constexpr std::chrono::milliseconds POSITION_PERIOD{200};
constexpr std::chrono::milliseconds STALL{4}; ///< 2 % of that.
constexpr double ONE_CORE = 100.0;

std::string GetRobotID(std::size_t number)
{
    return fmt::format("LR{:03}", number);
}

std::string MakeConfig(std::size_t robots, std::uint16_t mcsPort, const std::string& brokerURL)
{
    std::string text = fmt::format(
        R"([mcs]
url = "ws://127.0.0.1:{}/acs/"
[mqtt]
url = "{}"
[site]
map = "cells.lif.json"
[store]
directory = "store"
[http]
listen = "127.0.0.1:0"
[operator]
listen = "127.0.0.1:0"
[queue]
max_plans = {}
[position]
interval = "{}ms"
[actions.CassetteLoad]
robot = "LR"
vehicle_action = "pick"
[actions.CassetteUnload]
robot = "LR"
vehicle_action = "drop"
)",
        mcsPort,
        brokerURL,
        2 * robots,
        POSITION_PERIOD.count());
    for (std::size_t number = 1; number <= robots; ++number)
    {
        text += fmt::format(
            R"([robots.{0}]
type = "LR"
manufacturer = "ACS"
serial = "{0}"
vehicle_type = "{1}"
start_node = "{2}"
ports = ["CP01"]
)",
            GetRobotID(number),
            CellSite::VEHICLE_TYPE,
            CellSite::GetStartNode(number));
    }
    return text;
}

/// Everything that runs, until its destruction.
class RobotsRun
{
    std::size_t _robots;
    boost::asio::io_context _context;
    bool _bEnding = false; ///< A signal has come.
    Apps::SignalWaiter _signals;
    Testing::MosquittoBroker _broker{"allow_anonymous true\nmax_queued_messages 0\n"};
    PlanKeeper _keeper;
    std::optional<Testing::ChildProcess> _acsd;
    std::optional<Testing::ChildProcess> _simulator;

    struct CpuSeconds
    {
        double acsd = 0.0;
        double simulator = 0.0;
        double broker = 0.0;
        double own = 0.0;
    };

public:
    explicit RobotsRun(std::size_t robots)
        : _robots(robots),
          _context(1),
          _signals(
              _context.get_executor(),
              [this](int /*signal*/) {
                  _bEnding = true;
                  _context.stop();
              }),
          _keeper(_context, robots)
    {
        WriteFile("cells.lif.json", CellSite::WriteLIF(std::max(robots, LEAST_CELLS)));
        WriteFile("acsd.toml", MakeConfig(robots, _keeper.GetPort(), _broker.GetURL()));
        _acsd.emplace(std::vector<std::string>{ACS_ACSD, "--config", GetPath("acsd.toml"), "--log-level", "error"});
        if (!_acsd->TryWaitForText("ready:", TIME_LIMIT))
        {
            throw std::runtime_error("acsd did not start: " + _acsd->GetText());
        }
        StartSimulator();
    }

    RobotsRun(const RobotsRun&) = delete;
    RobotsRun& operator=(const RobotsRun&) = delete;

    ~RobotsRun()
    {
        // acsd first: otherwise it would report the loss of all vehicles.
        for (std::optional<Testing::ChildProcess>* child : {&_acsd, &_simulator})
        {
            if (child->has_value())
            {
                (*child)->Signal(SIGTERM);
                std::ignore = (*child)->WaitForExitOrNull(STOP_TIMEOUT);
            }
        }
    }

    [[nodiscard]] std::optional<RobotsMetrics> MeasureOrNull(std::chrono::seconds howLong)
    {
        RunUntil([this]() { return _keeper.IsEveryoneIdle(); }, "not every robot is online");
        if (!_bEnding)
        {
            _keeper.SendFirstPlans();
        }
        RunUntil([this]() { return _keeper.CountRunning() == _robots; }, "not every plan is running");
        _context.run_for(WARM_UP);
        _keeper.ResetCounts();
        StallWatch watch(STALL);
        const CpuSeconds before = Probe();
        const Clock::time_point begin = Clock::now();
        _context.run_for(howLong);
        const CpuSeconds after = Probe();
        if (_bEnding)
        {
            return std::nullopt;
        }

        RobotsMetrics metrics;
        metrics.robots = _robots;
        metrics.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        metrics.acsdCpu = (after.acsd - before.acsd) / metrics.seconds * ONE_CORE;
        metrics.simulatorCpu = (after.simulator - before.simulator) / metrics.seconds * ONE_CORE;
        metrics.brokerCpu = (after.broker - before.broker) / metrics.seconds * ONE_CORE;
        metrics.ownCpu = (after.own - before.own) / metrics.seconds * ONE_CORE;
        metrics.residentKiB = ProcessProbe::GetResidentKiB(_acsd->GetProcessID());
        metrics.running = _keeper.CountRunning();
        metrics.positions = _keeper.GetPositions().Evaluate(POSITION_PERIOD, watch.Stop());
        metrics.count = _keeper.GetCount();
        return metrics;
    }

private:
    [[nodiscard]] std::string GetPath(std::string_view name) const
    {
        return (_broker.GetFolder() / name).string();
    }

    void WriteFile(std::string_view name, const std::string& text) const
    {
        std::ofstream(GetPath(name)) << text;
    }

    void StartSimulator()
    {
        std::vector<std::string> arguments{
            ACS_VDA_SIM,
            "--broker",
            _broker.GetURL(),
            "--site",
            GetPath("cells.lif.json"),
            "--no-control",
            "--action-time",
            "pick=1s",
            "--action-time",
            "drop=1s",
            "--seed",
            "1",
            "--log-level",
            "warning"};
        for (std::size_t number = 1; number <= _robots; ++number)
        {
            arguments.emplace_back("--vehicle");
            arguments.push_back(fmt::format("{},node={}", GetRobotID(number), CellSite::GetStartNode(number)));
        }
        _simulator.emplace(std::move(arguments));
    }

    [[nodiscard]] CpuSeconds Probe() const
    {
        return {
            ProcessProbe::GetCpuSeconds(_acsd->GetProcessID()),
            ProcessProbe::GetCpuSeconds(_simulator->GetProcessID()),
            ProcessProbe::GetCpuSeconds(_broker.GetProcessID()),
            ProcessProbe::GetCpuSeconds(getpid())};
    }

    /// Also returns when a signal comes.
    void RunUntil(const std::function<bool()>& isTrue, std::string_view what)
    {
        const Clock::time_point deadline = Clock::now() + TIME_LIMIT;
        while (!_bEnding && !isTrue())
        {
            if (_context.run_one_until(deadline) == 0 && !_bEnding)
            {
                throw std::runtime_error(fmt::format(
                    "{} after {} s {}\n{}{}",
                    what,
                    TIME_LIMIT.count(),
                    _keeper.GetCount().firstError,
                    _acsd->GetText(),
                    _simulator->GetText()));
            }
        }
    }
};

} // namespace

std::optional<RobotsMetrics> MeasureRobotsOrNull(std::size_t robots, std::chrono::seconds howLong)
{
    return RobotsRun(robots).MeasureOrNull(howLong);
}

} // namespace ACS::Load
