#pragma once

#include "trace/MessageTrace.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/IPlanObserver.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Adds each change of state and each decision of the engine to the trace, and passes it to the next observer.
class TraceObserver final : public Planning::IPlanObserver
{
    struct Entry
    {
        std::string_view kind;
        std::string_view robotID;
        std::string_view planID;
        std::string_view transactionID;
    };

    MessageTrace* _traceOrNull;
    Planning::IPlanObserver& _next;

public:
    /// The trace, which may be null, and the next observer outlive it.
    TraceObserver(MessageTrace* traceOrNull, Planning::IPlanObserver& next);

    void OnPlanChanged(
        const Planning::PlanRecord& record,
        Planning::EPlanState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnStepChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        Planning::EStepState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnJobChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        std::size_t jobIndex,
        Planning::EJobState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnAlarmChanged(const Planning::Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now)
        override;
    void OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now) override;
    void OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now now) override;
    void OnNote(std::string_view robotID, std::string_view text, Core::Now now) override;

private:
    void Write(const Entry& entry, const std::string& text);
};

} // namespace ACS::Acsd
