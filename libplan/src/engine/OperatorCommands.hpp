#pragma once

#include "control/ControlAnswers.hpp"
#include "control/LoadWatch.hpp"
#include "control/StallWatch.hpp"
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

/// What an operator asks for: maintenance, alarms, carriers, skipped steps and the outcome of jobs.
class OperatorCommands
{
    const PlanBook& _plans;
    Fleet& _fleet;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;
    const StoreBacklog& _backlog;
    LoadWatch& _loads;
    const StallWatch& _stalls;
    PlaceTracker& _places;
    PlanWork& _work;
    JobOutcomes& _jobs;

public:
    OperatorCommands(
        EngineState& engine,
        LoadWatch& loads,
        const StallWatch& stalls,
        PlaceTracker& places,
        PlanWork& work,
        JobOutcomes& jobs);

    void Maintain(const SetMaintenance& command);
    void ClearByOperator(const ClearAlarms& command);
    void CorrectCarriers(const SetCarriers& command);
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetCarriers& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SettleJob& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SkipStep& command) const;
    /// Section 6.13.
    void Skip(const SkipStep& command);
    void Settle(const SettleJob& command);

private:
    /// Whether what it tells of lasts, as far as the engine knows.
    [[nodiscard]] bool HasCause(const Alarm& alarm) const;
    /// What became of the job stays unknown, and what is on the robot's ports as it is on record.
    void SkipUnresolved(Robot& robot);
    /// The robot that has the job, by its index.
    [[nodiscard]] std::optional<std::size_t> FindWorkerOrNull(const SettleJob& command) const;
    void ApplyAnswer(Robot& robot, EJobAnswer answer);
    /// A job that was done and never stored as commanded is reported from its beginning.
    void CatchUp(Robot& robot);
};

} // namespace ACS::Planning
