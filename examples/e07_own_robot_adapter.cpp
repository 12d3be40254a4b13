// Lesson 7: a robot of one's own under the plan engine. An IRobotAdapter joins a make of robot to the SDK: it takes the
// engine's commands and reports the robot's events. The one here stands in for its robot, too, in virtual time. ExampleACS.hpp carries out what both want.

#include "ExampleACS.hpp"
#include "ExampleFloor.hpp"
#include "ExampleRandom.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

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
    std::size_t _node = 0; ///< Its position on the route.
    std::string _jobID;

public:
    /// What a robot reports when it is connected.
    static void Connect(const std::string& nodeID, AdapterActions& out)
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
                }}, // A real one cancels and pauses, too, and reports after a restart what it carries (RecoverJob).
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

    /// Called at start (ExampleACS): the MCS gets the reason, and no plan fails half-way.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override
    {
        return action.starts_with("Cassette") ? std::nullopt : std::optional<std::string>("it carries cassettes only");
    }
};

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    Core::Result<SiteMap> site = ExampleFloor::MakeSite();
    Core::Result<EngineOptions> options = site.and_then(ExampleFloor::MakeOptions);
    if (!options.has_value())
    {
        fmt::print("{}\n", Core::Describe(options.error()));
        return 1;
    }
    ExampleRandom random;
    SlowRobotAdapter robot;
    ExampleACS host(std::move(*options), std::move(*site), random, ExampleFloor::ROBOT, robot);
    AdapterActions actions;
    SlowRobotAdapter::Connect("N-HOME", actions);
    host.Run(actions);
    host.Submit(ExampleFloor::MakePlan());
    while (!host.IsCompleted() && host.TryAdvance())
    {
    }
    return host.IsCompleted() ? 0 : 1;
}
