// Lesson 7: a robot of one's own under the plan engine. An IRobotAdapter joins a make of robot to the SDK: it takes the
// engine's commands and tells the robot's events. The one here stands in for its robot, too, in virtual time.

#include "ExampleFloor.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): an example reads better without the prefix
namespace Core = ACS::Core;

namespace
{

/// One second from node to node, two for a job. An adapter is pure: what it waits for is a timer that it asks for.
class SlowRobotAdapter final : public IRobotAdapter
{
    static constexpr AdapterTimerID DRIVE_TIMER = 1;
    static constexpr AdapterTimerID JOB_TIMER = 2;

    Drive _drive;
    std::size_t _node = 0; ///< Where it stands on the route.
    std::string _jobID;

public:
    void Connect(const std::string& nodeID, AdapterActions& out)
    {
        StateChanged state;
        state.lastNodeID = nodeID;
        out.emplace_back(RaiseEvent{LinkChanged{true}});
        out.emplace_back(RaiseEvent{std::move(state)});
    }

    void Handle(const RobotCommand& command, Core::Now /*now*/, AdapterActions& out) override
    {
        std::visit(
            Core::Overloaded{
                [this, &out](const Drive& drive) {
                    _drive = drive;
                    _node = 0;
                    out.emplace_back(RaiseEvent{NodePassed{drive.driveID, drive.route.nodes.front().nodeID}});
                    out.emplace_back(StartAdapterTimer{DRIVE_TIMER, std::chrono::seconds(1)});
                },
                [this, &out](const ExtendDrive& extend) {
                    _drive.releasedCount = extend.releasedCount;
                    out.emplace_back(StartAdapterTimer{DRIVE_TIMER, std::chrono::seconds(1)});
                },
                [this, &out](const StartJob& job) {
                    fmt::print("robot: {} from {} to {}\n", job.action, job.from.value_or("-"), job.to.value_or("-"));
                    _jobID = job.jobID;
                    out.emplace_back(RaiseEvent{JobStarted{job.jobID}});
                    out.emplace_back(StartAdapterTimer{JOB_TIMER, std::chrono::seconds(2)});
                },
                [](const auto& /*other*/) {
                }}, // A real one cancels and pauses, too.
            command);
    }

    void OnTimer(AdapterTimerID timer, Core::Now /*now*/, AdapterActions& out) override
    {
        if (timer == JOB_TIMER)
        {
            out.emplace_back(RaiseEvent{JobFinished{_jobID}});
        }
        else if (_node + 1 < _drive.releasedCount) // Never beyond what the engine has released.
        {
            const std::string& nodeID = _drive.route.nodes[++_node].nodeID;
            fmt::print("robot: at {}\n", nodeID);
            out.emplace_back(RaiseEvent{NodePassed{_drive.driveID, nodeID}});
            const bool bArrived = _node + 1 == _drive.route.nodes.size();
            out.emplace_back(
                bArrived ? AdapterAction(RaiseEvent{Arrived{_drive.driveID}})
                         : AdapterAction(StartAdapterTimer{DRIVE_TIMER, std::chrono::seconds(1)}));
        }
    }

    /// Asked once, at start: so the MCS is told why, and no plan fails half-way.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override
    {
        return action.starts_with("Cassette") ? std::nullopt : std::optional<std::string>("it carries cassettes only");
    }
};

/// Joins engine, store and robot; what an own program does with real timers and a real MCS.
class Host
{
    using Timer = std::variant<EngineTimer, AdapterTimerID>;

    Core::Now _now;
    MemoryPlanStore _store;
    PlanEngine _engine;
    SlowRobotAdapter _robot;
    EngineActions _fromEngine;
    AdapterActions _fromRobot;
    std::deque<AdapterAction> _waiting;        ///< For the engine to be done with what came before.
    std::map<Timer, Core::SteadyTime> _timers; ///< When each is due.

    void Execute(const EngineAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const StorePlans& store) { static_cast<void>(_store.Append(store.batch)); }, // Never fails.
                [this](const CommandRobot& typed) { _robot.Handle(typed.command, _now, _fromRobot); },
                [this](const StartEngineTimer& start) { _timers[start.timer] = _now.steady + start.delay; },
                [this](const CancelEngineTimer& cancel) { _timers.erase(cancel.timer); },
                [this](const SendReport& send) {
                    if (const auto* reportOrNull = std::get_if<PlanReport>(&send.entry.report))
                    {
                        fmt::print("report: {} {}\n", reportOrNull->planID, GetText(reportOrNull->state));
                        bCompleted = reportOrNull->state == EPlanState::Completed;
                    }
                },
                [](const ReplyCommand& reply) { fmt::print("plan {}\n", reply.bAccepted ? "accepted" : "refused"); },
                [](const RobotStatusChanged& typed) {
                    fmt::print("status: {}\n", GetText(typed.status.status));
                }},
            action);
    }

    void Execute(const AdapterAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const RaiseEvent& raise) {
                    _engine.Handle(ExampleFloor::ROBOT, raise.event, _now, _fromEngine);
                },
                [this](const StartAdapterTimer& start) { _timers[start.timer] = _now.steady + start.delay; },
                [this](const CancelAdapterTimer& cancel) {
                    _timers.erase(cancel.timer);
                }},
            action);
    }

    /// One event at a time: all actions of a call are carried out before the engine's next call.
    void Settle()
    {
        do
        {
            for (const EngineAction& action : std::exchange(_fromEngine, {}))
            {
                Execute(action);
            }
            std::ranges::move(std::exchange(_fromRobot, {}), std::back_inserter(_waiting));
            if (!_waiting.empty())
            {
                Execute(std::exchange(_waiting.front(), {}));
                _waiting.pop_front();
            }
        }
        while (!_fromEngine.empty() || !_waiting.empty());
    }

public:
    bool bCompleted = false;

    Host(EngineOptions options, SiteMap site, Core::IRandom& random)
        : _engine(std::move(options), std::move(site), random)
    {
        _robot.Connect("N-HOME", _fromRobot);
        Settle();
        _engine.Handle(SubmitPlan{ExampleFloor::MakePlan(), 1}, _now, _fromEngine);
        Settle();
    }

    /// Time jumps to the next timer.
    [[nodiscard]] bool TryAdvance()
    {
        const auto next = std::ranges::min_element(_timers, {}, &decltype(_timers)::value_type::second);
        if (next == _timers.end())
        {
            return false;
        }
        const Timer timer = next->first;
        _now.steady = next->second;
        _timers.erase(next);
        std::visit(
            Core::Overloaded{
                [this](const EngineTimer& typed) { _engine.OnTimer(typed, _now, _fromEngine); },
                [this](AdapterTimerID typed) {
                    _robot.OnTimer(typed, _now, _fromRobot);
                }},
            timer);
        Settle();
        return true;
    }
};

class CountingRandom final : public Core::IRandom
{
    std::uint64_t _last = 0;

public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        return ++_last;
    }
};

} // namespace

int main()
{
    Core::Result<SiteMap> site = ExampleFloor::MakeSite();
    Core::Result<EngineOptions> options = site.and_then(ExampleFloor::MakeOptions);
    if (!options.has_value())
    {
        fmt::print("{}\n", Core::Describe(options.error()));
        return 1;
    }
    CountingRandom random; // Ids that are the same in every run; a program takes a real source.
    Host host(std::move(*options), std::move(*site), random);
    while (!host.bCompleted && host.TryAdvance())
    {
    }
    return host.bCompleted ? 0 : 1;
}
