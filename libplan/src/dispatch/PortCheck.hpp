#pragma once

#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Whether a robot's ports fit a plan.
struct PortVerdict
{
    std::optional<std::string> unavailabilityOrNull;
    bool bSupposed = false; ///< A carrier that the plan unloads is not on record: it was put on by hand, if at all.
};

/// Compares plans with what the ports of robots hold.
class PortCheck
{
    const EngineOptions& _options;
    const Fleet& _fleet;

public:
    explicit PortCheck(EngineState& engine);

    /// The plan's first load or unload of each port, checked against what the robot is known to have there, and the trays that
    /// its memory jobs need. What a plan does to a port afterwards is its own affair: if it is wrong, no other robot does it
    /// better.
    [[nodiscard]] PortVerdict JudgePorts(const ActivePlan& plan, const Robot& robot) const;
    [[nodiscard]] static std::optional<std::string> DescribeMissingTrayOrNull(
        const Robot& robot,
        const ResolvedJob& job,
        const PortLedger::Contents& planned);
    [[nodiscard]] static std::optional<std::string> DescribeMissingTrayOrNull(const Robot& robot);

private:
    /// Which of the robot's carrier ports the place is; nullopt where it is none.
    [[nodiscard]] std::optional<std::size_t> FindPortOrNull(
        const Robot& robot,
        const std::optional<Core::Location>& placeOrNull) const;
    void JudgeJob(
        const Robot& robot,
        const ResolvedStep& step,
        std::size_t job,
        const std::string& carrierID,
        PortLedger::Contents& planned,
        PortVerdict& verdict) const;
    [[nodiscard]] std::optional<std::string> DescribeLoadConflictOrNull(const Robot& robot, std::size_t port) const;
    /// A carrier is only where it is known to be. One that no robot is known to carry may have been loaded by hand.
    [[nodiscard]] std::optional<std::string> DescribeUnloadConflictOrNull(
        const Robot& robot,
        std::size_t port,
        const std::string& carrierID) const;
};

} // namespace ACS::Planning
