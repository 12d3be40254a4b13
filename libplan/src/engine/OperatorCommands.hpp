#pragma once

#include "control/ControlAnswers.hpp"
#include "control/LoadWatch.hpp"
#include "control/RejectionWatch.hpp"
#include "control/StallWatch.hpp"
#include "traffic/BlockControl.hpp"
#include "traffic/PlaceTracker.hpp"
#include "transaction/EngineState.hpp"
#include "work/JobOutcomes.hpp"
#include "work/PlanWork.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Handles the operator's commands: maintenance, alarms, carriers, skipped steps, priorities, blocks and the
/// outcome of jobs.
class OperatorCommands
{
    PlanBook& _plans;
    Fleet& _fleet;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;
    const StoreBacklog& _backlog;
    LoadWatch& _loads;
    const StallWatch& _stalls;
    RejectionWatch& _rejections;
    PlaceTracker& _places;
    PlanWork& _work;
    JobOutcomes& _jobs;
    BlockControl _blocks;

public:
    OperatorCommands(
        EngineState& engine,
        LoadWatch& loads,
        const StallWatch& stalls,
        RejectionWatch& rejections,
        PlaceTracker& places,
        TrafficCoordinator& coordinator,
        PlanWork& work,
        JobOutcomes& jobs);

    /// Takes a robot out of service, or returns it.
    void Maintain(const SetMaintenance& command);
    /// Clears alarms. Those whose cause remains are set again.
    void ClearByOperator(const ClearAlarms& command);
    /// Replaces the record of a robot's ports.
    void CorrectCarriers(const SetCarriers& command);
    /// Why the command would be refused now.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetCarriers& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const ResolveJob& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SkipStep& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetPlanPriority& command) const;
    /// Skips a step (section 6.13).
    void Skip(const SkipStep& command);
    /// Moves a plan in the queue.
    void ChangePriority(const SetPlanPriority& command);
    [[nodiscard]] BlockControl& GetBlocks() noexcept;
    [[nodiscard]] const BlockControl& GetBlocks() const noexcept;
    /// Resolves a job whose outcome is unknown.
    void Resolve(const ResolveJob& command);

private:
    /// Whether the cause of the alarm remains, as far as the engine knows.
    [[nodiscard]] bool HasCause(const Alarm& alarm) const;
    /// Why a plan that is not active is refused.
    [[nodiscard]] std::string DescribeInactive(const std::string& planID) const;
    /// The outcome of the job stays unknown; the record of the ports is not changed.
    void SkipUnresolved(Robot& robot);
    /// Index of the robot that has the job.
    [[nodiscard]] std::optional<std::size_t> FindWorkerOrNull(const ResolveJob& command) const;
    void ApplyAnswer(Robot& robot, EJobResolution answer);
    /// The plan of the job has not ended.
    void ApplyToPlan(Robot& robot, const std::string& jobID, EJobResolution answer);
    /// Reports a job from its beginning that was done but never stored as commanded.
    void CatchUp(Robot& robot);
};

} // namespace ACS::Planning
