#include "transaction/OutboxRoom.hpp"

#include "plan/ReportForecast.hpp"

#include <algorithm>

namespace ACS::Planning
{

namespace
{

constexpr std::size_t TENTH = 10;
/// Of a control: its result, the state of its plan, and the state of the plan after it.
constexpr std::size_t CONTROL_REPORTS = 3;

} // namespace

OutboxRoom::OutboxRoom(const EngineOptions& options, const PlanBook& plans, const ReportOutbox& outbox)
    : _options(options),
      _plans(plans),
      _outbox(outbox)
{
}

bool OutboxRoom::TryReserve(const Plan& plan)
{
    const std::size_t count = CountReportsAhead(plan);
    if (GetUsed() + count <= GetPlanLimit())
    {
        _refused = 0;
        return true;
    }
    const bool bTooLong = GetShare() + count > GetPlanLimit(); // waiting does not help
    _refused = bTooLong ? 0 : count;
    return false;
}

bool OutboxRoom::HasRoomForControl() const
{
    std::size_t owed = 0;
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        owed += plan->record.progress.controlCount;
    }
    return GetUsed() + owed + CONTROL_REPORTS <= _options.maximumReports;
}

bool OutboxRoom::IsFull() const
{
    return GetUsed() + std::max<std::size_t>(_refused, 1) > GetPlanLimit();
}

bool OutboxRoom::IsFree() const
{
    return GetUsed() + _refused <= GetPlanLimit() - GetPlanLimit() / TENTH
        || (_outbox.GetUnacknowledged().empty() && _plans.GetReportsAhead() == 0);
}

bool OutboxRoom::ShouldMergeAlarms() const
{
    return _outbox.CountAlarms() >= GetShare() / 2;
}

bool OutboxRoom::IsAlarmShareUsed() const
{
    return _outbox.CountAlarms() >= GetShare();
}

std::size_t OutboxRoom::GetShare() const
{
    return _options.maximumReports / TENTH;
}

std::size_t OutboxRoom::GetPlanLimit() const
{
    return _options.maximumReports - GetShare();
}

std::size_t OutboxRoom::GetUsed() const
{
    const std::size_t alarms = _outbox.CountAlarms();
    return _outbox.GetUnacknowledged().size() - alarms + std::max(alarms, GetShare()) + _plans.GetReportsAhead();
}

} // namespace ACS::Planning
