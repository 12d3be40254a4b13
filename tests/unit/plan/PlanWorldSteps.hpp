#pragma once

#include "Catch.hpp"
#include "PlanWorld.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What tests in a PlanWorld do and ask again and again.
namespace ACS::Testing
{

using Lines = std::vector<std::string>;

[[nodiscard]] inline bool Contains(const Lines& lines, const std::string& line)
{
    return std::ranges::find(lines, line) != lines.end();
}

/// A world whose options were changed, with its robots at home.
[[nodiscard]] inline PlanWorld MakeWorld(const std::function<void(Planning::EngineOptions&)>& change)
{
    Planning::EngineOptions options = MakeTestOptions(false);
    change(options);
    return {1, options, MakeTestSite()};
}

/// Until the report is among the plan's.
[[nodiscard]] inline bool TryRunUntil(PlanWorld& world, const std::string& planID, const std::string& report)
{
    return world.TryRun([&world, planID, report] { return Contains(world.GetReportsOf(planID), report); });
}

[[nodiscard]] inline bool TryRunFor(PlanWorld& world, std::chrono::milliseconds time)
{
    const auto end = world.GetNow().steady + time;
    return world.TryRun([&world, end] { return world.GetNow().steady >= end; });
}

/// The plan alone, with the robots there, until the report.
inline void BeginPlan(PlanWorld& world, Planning::Plan plan, const std::string& report)
{
    const std::string planID = plan.planID;
    world.Connect();
    world.Submit(std::move(plan));
    REQUIRE(TryRunUntil(world, planID, report));
}

/// The engine is gone and another one begins on what the store holds, with the robots there.
inline void RestartEngine(PlanWorld& world, const std::function<void(Planning::EngineOptions&)>& change = {})
{
    Planning::EngineOptions options = MakeTestOptions(false);
    if (change)
    {
        change(options);
    }
    world.Restart(options, MakeTestSite());
    world.Connect();
}

/// P1, until that is told.
inline void PausePlan(PlanWorld& world)
{
    world.Control(Planning::EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
}

/// P1, to its good end.
inline void FinishPlan(PlanWorld& world)
{
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

/// The reports of the plan behind the first so many.
[[nodiscard]] inline Lines GetReportsAfter(const PlanWorld& world, const std::string& planID, std::size_t count)
{
    const Lines reports = world.GetReportsOf(planID);
    return {reports.begin() + static_cast<std::ptrdiff_t>(std::min(count, reports.size())), reports.end()};
}

/// How often a robot was commanded to start the job.
[[nodiscard]] inline std::size_t CountStarts(const PlanWorld& world, const std::string& jobID)
{
    return static_cast<std::size_t>(std::ranges::count_if(world.trace, [&jobID](const std::string& line) {
        return line.find("StartJob " + jobID + " ") != std::string::npos;
    }));
}

/// On the first port of the first robot.
[[nodiscard]] inline std::optional<std::string> GetCarrierOrNull(const PlanWorld& world)
{
    return world.engine->GetRobotStatuses().front().carrierIDs.front();
}

/// Where in the trace a line stands that begins so, from an index on; the trace's size where none does.
[[nodiscard]] inline std::size_t FindLine(const PlanWorld& world, const std::string& start, std::size_t from)
{
    const auto found = std::find_if(
        world.trace.begin() + static_cast<std::ptrdiff_t>(from),
        world.trace.end(),
        [&start](const std::string& line) { return line.starts_with(start); });
    return static_cast<std::size_t>(found - world.trace.begin());
}

} // namespace ACS::Testing
