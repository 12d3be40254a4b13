#pragma once

#include "plan/PlanBook.hpp"
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/ReportOutbox.hpp>

#include <cstddef>

namespace ACS::Planning
{

/// Divides EngineOptions::maximumReports. Reports of plans and controls are never dropped: a plan is accepted only if there is
/// room for all reports that it and the plans before it can still cause, and a control only if there is room for its own. A tenth
/// is left to alarms, whose reports are merged when half of it is used, and a tenth to controls.
class OutboxRoom
{
    const EngineOptions& _options;
    const PlanBook& _plans;
    const ReportOutbox& _outbox;
    std::size_t _refused = 0; ///< Reports of the latest plan, if it was refused.

public:
    OutboxRoom(const EngineOptions& options, const PlanBook& plans, const ReportOutbox& outbox);

    /// Whether the plan may be accepted. If not, the outbox is full until it may.
    [[nodiscard]] bool TryReserve(const Plan& plan);
    [[nodiscard]] bool HasRoomForControl() const;
    /// Whether plans are refused.
    [[nodiscard]] bool IsFull() const;
    /// Whether the plan that was refused has room again, and a tenth more.
    [[nodiscard]] bool IsFree() const;

    /// Whether only the latest report of each alarm is kept.
    [[nodiscard]] bool ShouldMergeAlarms() const;
    /// Whether the share of the alarms is used: no more errors of robots become alarms of their own.
    [[nodiscard]] bool IsAlarmShareUsed() const;

private:
    [[nodiscard]] std::size_t GetShare() const;
    [[nodiscard]] std::size_t GetPlanLimit() const;
    /// Reports in the outbox, those that accepted plans can still cause, and what is left of the share of the alarms.
    [[nodiscard]] std::size_t GetUsed() const;
};

} // namespace ACS::Planning
