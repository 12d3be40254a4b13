#include "RobotsRun.hpp"

#include "CellSite.hpp"
#include "common/process/SignalWaiter.hpp"
#include "MosquittoBroker.hpp"
#include "ProcessProbe.hpp"
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <boost/asio/io_context.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
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

constexpr std::size_t VEHICLES_TOGETHER = 250; ///< In one vda-sim.
constexpr std::size_t PLANS_TOGETHER = 1000;   ///< In one transaction.
constexpr std::chrono::seconds TIME_LIMIT{120};
constexpr std::chrono::seconds STOP_TIMEOUT{10};
constexpr std::chrono::seconds WARM_UP{2}; ///< With all plans running.
constexpr std::chrono::milliseconds POSITION_PERIOD{200};
constexpr std::chrono::milliseconds STALL{4}; ///< 2 % of that.
constexpr double ONE_CORE = 100.0;

std::string GetRobotID(std::size_t number)
{
    return fmt::format("LR{:03}", number);
}

/// Of a robot, from 1: its cell, and its place in the cell, from 1.
std::pair<std::size_t, std::size_t> FindCell(const RobotsSetup& setup, std::size_t number)
{
    const std::size_t together = std::max<std::size_t>(setup.parking, 1);
    return {(number - 1) / together + 1, (number - 1) % together + 1};
}

std::string GetStartNode(const RobotsSetup& setup, std::size_t number)
{
    const auto [cell, place] = FindCell(setup, number);
    return setup.parking == 0 ? CellSite::GetStartNode(cell) : CellSite::GetParkingNode(cell, place);
}

std::string MakeConfig(const RobotsSetup& setup, std::uint16_t mcsPort, const std::string& brokerURL)
{
    std::string text = fmt::format(
        R"([mcs]
url = "ws://127.0.0.1:{}/acs/"
tx_warn_bytes = 0
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
[outbox]
max = 1000000
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
        2 * setup.robots + setup.storedPlans,
        POSITION_PERIOD.count());
    for (std::size_t number = 1; number <= setup.robots; ++number)
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
            GetStartNode(setup, number));
        if (setup.parking > 0)
        {
            const auto [cell, place] = FindCell(setup, number);
            text += fmt::format("home = \"{}\"\n", CellSite::GetParking(cell, place));
        }
    }
    return text;
}

/// A plan that waits in the queue of a store.
Planning::PlanAdded MakeStored(const RobotsSetup& setup, std::size_t number)
{
    const std::size_t cell = number % setup.cells + 1;
    const auto makeID = [](std::size_t job) {
        return fmt::format("c0a80101-0000-4000-9000-{:012}", job);
    };
    Planning::PlanAdded added;
    Planning::PlanRecord& record = added.record;
    record.sequence = number;
    record.acceptedAt = std::chrono::system_clock::now();
    record.plan.planID = fmt::format("STORED-{:06}", number);
    record.plan.steps = {
        {1,
         "CassetteLoad",
         CellSite::GetSource(cell),
         {"CASSETTE-1"},
         {{makeID(2 * number), CellSite::GetSource(cell), "AMR.CP01"}}},
        {2,
         "CassetteUnload",
         CellSite::GetTarget(cell),
         {"CASSETTE-1"},
         {{makeID(2 * number + 1), "AMR.CP01", CellSite::GetTarget(cell)}}}};
    const Planning::StepProgress pending{Planning::EStepState::Pending, {Planning::EJobState::Pending}};
    record.progress.steps.assign(record.plan.steps.size(), pending);
    return added;
}

void StorePlans(const RobotsSetup& setup, const std::string& directory)
{
    const auto store = Planning::SqlitePlanStore::Open(directory);
    if (!store)
    {
        throw std::runtime_error(Core::Describe(store.error()));
    }
    Planning::StoreBatch batch;
    for (std::size_t number = 1; number <= setup.storedPlans; ++number)
    {
        batch.changes.emplace_back(MakeStored(setup, number));
        if (batch.changes.size() < PLANS_TOGETHER && number < setup.storedPlans)
        {
            continue;
        }
        if (const Core::Result<void> stored = (*store)->Append(batch); !stored)
        {
            throw std::runtime_error(Core::Describe(stored.error()));
        }
        batch.changes.clear();
    }
}

/// Everything that runs, until its destruction.
class RobotsRun
{
    const RobotsSetup _setup;
    boost::asio::io_context _context;
    bool _bEnding = false; ///< A signal has come.
    Apps::SignalWaiter _signals;
    Testing::MosquittoBroker _broker{"allow_anonymous true\nmax_queued_messages 0\n"};
    PlanKeeper _keeper;
    std::optional<Testing::ChildProcess> _acsd;
    std::deque<Testing::ChildProcess> _simulators;
    Clock::time_point _begin; ///< Of acsd.
    StartMetrics _start;

    struct CpuSeconds
    {
        double acsd = 0.0;
        double simulator = 0.0;
        double broker = 0.0;
        double own = 0.0;
    };

public:
    explicit RobotsRun(const RobotsSetup& setup)
        : _setup(setup),
          _context(1),
          _signals(
              _context.get_executor(),
              [this](int /*signal*/) {
                  _bEnding = true;
                  _context.stop();
              }),
          _keeper(_context, {setup.robots, setup.plans, setup.parking > 0})
    {
        WriteFile("cells.lif.json", CellSite::WriteLIF(setup.cells, setup.parking));
        WriteFile("acsd.toml", MakeConfig(setup, _keeper.GetPort(), _broker.GetURL()));
        StorePlans(setup, GetPath("store"));
        StartSimulators();
        _begin = Clock::now();
        _acsd.emplace(std::vector<std::string>{ACS_ACSD, "--config", GetPath("acsd.toml"), "--log-level", "warning"});
        if (!_acsd->TryWaitForText("ready:", TIME_LIMIT))
        {
            throw std::runtime_error("acsd did not start: " + _acsd->GetText());
        }
        _start.ready = GetSeconds();
    }

    RobotsRun(const RobotsRun&) = delete;
    RobotsRun& operator=(const RobotsRun&) = delete;

    ~RobotsRun()
    {
        // acsd first: otherwise it would report the loss of all vehicles.
        if (_acsd.has_value())
        {
            End(*_acsd);
        }
        std::ranges::for_each(_simulators, &RobotsRun::End);
    }

    [[nodiscard]] std::optional<RobotsMetrics> MeasureOrNull(std::chrono::seconds howLong)
    {
        RunUntil([this]() { return _keeper.IsEveryoneOnline(); }, "not every robot is online");
        _start.online = GetSeconds();
        RunUntil([this]() { return _keeper.IsEveryonePlaced(); }, "not every robot has a position");
        _start.placed = GetSeconds();
        _start.cpu = ProcessProbe::GetCpuSeconds(_acsd->GetProcessID());
        if (_setup.storedPlans == 0)
        {
            RunUntil([this]() { return _keeper.IsEveryoneIdle(); }, "not every robot is idle");
            if (!_bEnding)
            {
                _keeper.SendFirstPlans();
            }
            RunUntil([this]() { return _keeper.CountRunning() == _setup.plans; }, "not every plan is running");
            _context.run_for(WARM_UP);
        }
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
        metrics.robots = _setup.robots;
        metrics.start = _start;
        metrics.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        metrics.acsdCpu = (after.acsd - before.acsd) / metrics.seconds * ONE_CORE;
        metrics.simulatorCpu = (after.simulator - before.simulator) / metrics.seconds * ONE_CORE;
        metrics.brokerCpu = (after.broker - before.broker) / metrics.seconds * ONE_CORE;
        metrics.ownCpu = (after.own - before.own) / metrics.seconds * ONE_CORE;
        metrics.residentKiB = ProcessProbe::GetResidentKiB(_acsd->GetProcessID());
        metrics.running = _keeper.CountRunning();
        metrics.positions = _keeper.GetPositions().Evaluate(POSITION_PERIOD, watch.Stop());
        metrics.count = _keeper.GetCount();
        End(*_acsd); // with all of its log
        metrics.unsent = CountLines(_acsd->GetText(), "a message to the vehicle could not be sent");
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

    [[nodiscard]] double GetSeconds() const
    {
        return std::chrono::duration<double>(Clock::now() - _begin).count();
    }

    [[nodiscard]] static std::size_t CountLines(const std::string& text, std::string_view part)
    {
        std::size_t count = 0;
        for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        {
            ++count;
        }
        return count;
    }

    static void End(Testing::ChildProcess& child)
    {
        child.Signal(SIGTERM);
        std::ignore = child.WaitForExitOrNull(STOP_TIMEOUT);
    }

    /// Returns when all vehicles are connected to the broker.
    void StartSimulators()
    {
        for (std::size_t first = 1; first <= _setup.robots; first += VEHICLES_TOGETHER)
        {
            StartSimulator(first, std::min(first + VEHICLES_TOGETHER - 1, _setup.robots));
        }
        for (Testing::ChildProcess& simulator : _simulators)
        {
            if (!simulator.TryWaitForText("ready:", TIME_LIMIT))
            {
                throw std::runtime_error("vda-sim did not start: " + simulator.GetText());
            }
        }
    }

    void StartSimulator(std::size_t first, std::size_t last)
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
        for (std::size_t number = first; number <= last; ++number)
        {
            arguments.emplace_back("--vehicle");
            arguments.push_back(fmt::format("{},node={}", GetRobotID(number), GetStartNode(_setup, number)));
        }
        _simulators.emplace_back(std::move(arguments));
    }

    [[nodiscard]] CpuSeconds Probe() const
    {
        double simulators = 0.0;
        for (const Testing::ChildProcess& simulator : _simulators)
        {
            simulators += ProcessProbe::GetCpuSeconds(simulator.GetProcessID());
        }
        return {
            ProcessProbe::GetCpuSeconds(_acsd->GetProcessID()),
            simulators,
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
                    _simulators.front().GetText()));
            }
        }
    }
};

} // namespace

std::optional<RobotsMetrics> MeasureRobotsOrNull(const RobotsSetup& setup, std::chrono::seconds howLong)
{
    return RobotsRun(setup).MeasureOrNull(howLong);
}

} // namespace ACS::Load
