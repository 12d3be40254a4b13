#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>

#include <cstddef>
#include <string_view>

namespace ACS::Planning
{

/// Called once for every change of state, for logs, metrics and audits. Called inside the engine's calls, in the order of the
/// changes; must not call the engine. transactionID is that of the report of the change, with which its Ack and its replays
/// can be found. References and string views are valid during the call only.
class ACS_API IPlanObserver
{
public:
    IPlanObserver() = default;
    IPlanObserver(const IPlanObserver&) = delete;
    IPlanObserver& operator=(const IPlanObserver&) = delete;
    virtual ~IPlanObserver() = default;

    /// The record has the new state already.
    virtual void OnPlanChanged(
        const PlanRecord& record,
        EPlanState from,
        std::string_view transactionID,
        Core::Now now) = 0;
    /// A step of the plan has changed. stepIndex is that of record.plan.steps.
    virtual void OnStepChanged(
        const PlanRecord& record,
        std::size_t stepIndex,
        EStepState from,
        std::string_view transactionID,
        Core::Now now) = 0;
    /// A job of the plan has changed. jobIndex is that of the step's jobs.
    virtual void OnJobChanged(
        const PlanRecord& record,
        std::size_t stepIndex,
        std::size_t jobIndex,
        EJobState from,
        std::string_view transactionID,
        Core::Now now) = 0;
    /// An alarm was set (bSet) or cleared.
    virtual void OnAlarmChanged(const Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now) = 0;
    /// The status of a robot has changed. It has no report that is stored, so no transactionID.
    virtual void OnRobotStatusChanged(const RobotStatus& status, Core::Now now) = 0;
    /// The TSC has changed to state.
    virtual void OnTscChanged(ETscState state, ETscState from, Core::Now now) = 0;
    /// An event without a state of its own, for the log: a tolerated deviation, or a decision of the engine.
    virtual void OnNote(std::string_view robotID, std::string_view text, Core::Now now) = 0;
};

} // namespace ACS::Planning
