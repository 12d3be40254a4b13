#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>

#include <cstddef>
#include <string_view>

namespace ACS::Planning
{

/// Sees every change of state, each once, at the one place where it is made: for logs, metrics, audit. Called inside
/// the engine's calls, in the order of the changes; must not call the engine. transactionID: of the report that tells the
/// MCS of the change, by which its Ack and every repetition can be found; valid during the call.
class IPlanObserver
{
public:
    IPlanObserver() = default;
    IPlanObserver(const IPlanObserver&) = delete;
    IPlanObserver& operator=(const IPlanObserver&) = delete;
    virtual ~IPlanObserver() = default;

    /// The record already has the new state.
    virtual void OnPlanChanged(
        const PlanRecord& record,
        EPlanState from,
        std::string_view transactionID,
        Core::Now now) = 0;
    virtual void OnStepChanged(
        const PlanRecord& record,
        std::size_t stepIndex,
        EStepState from,
        std::string_view transactionID,
        Core::Now now) = 0;
    virtual void OnJobChanged(
        const PlanRecord& record,
        std::size_t stepIndex,
        std::size_t jobIndex,
        EJobState from,
        std::string_view transactionID,
        Core::Now now) = 0;
    virtual void OnAlarmChanged(const Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now) = 0;
    virtual void OnRobotStatusChanged(const RobotStatus& status, Core::Now now) = 0;
    virtual void OnTscChanged(ETscState state, ETscState from, Core::Now now) = 0;
    /// Something that was tolerated and is worth a line.
    virtual void OnNote(std::string_view robotID, std::string_view text, Core::Now now) = 0;
};

} // namespace ACS::Planning
