#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/messages/ExecutionPlan.hpp>
#include <acs/protocol/messages/RobotStatus.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::AcsSim
{

/// The plan that a robot executes, and how far it is.
struct RobotWork
{
    Protocol::ExecutionPlan plan; ///< Steps in ascending order.
    std::size_t step = 0;
    std::optional<std::size_t> job{}; ///< None: it drives to the position of the step.
    bool bPaused = false;
    std::size_t aborts = 0;     ///< AbortPlans without a result; if there is one, the job in progress is the last.
    Core::SteadyTime due{};     ///< When the drive or the job ends.
    Core::Duration remaining{}; ///< While it is paused.

    [[nodiscard]] const Protocol::PlanStep& GetStep() const
    {
        return plan.steps.at(step);
    }

    /// Nullptr: it drives, or the step has no jobs.
    [[nodiscard]] const Protocol::PlanJob* GetJobOrNull() const
    {
        return job.has_value() && *job < GetStep().jobs.size() ? &GetStep().jobs[*job] : nullptr;
    }
};

/// A simulated robot.
struct RobotModel
{
    std::string name;
    Protocol::ERobotType type = Protocol::ERobotType::Logistics;
    Protocol::ERobotStatus status = Protocol::ERobotStatus::Idle;
    std::optional<std::string> position{};
    std::vector<std::optional<std::string>> carriers; ///< By port.
    std::optional<RobotWork> work{};
};

} // namespace ACS::AcsSim
