#include "transaction/AlarmBook.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

void AlarmBook::Restore(std::vector<Alarm> alarms)
{
    _alarms = std::move(alarms);
}

std::vector<ErrorReport> AlarmBook::Raise(Alarm alarm)
{
    const bool bKnown = std::ranges::any_of(_alarms, [&alarm](const Alarm& other) {
        return other.IsSameAs(alarm) && other.level == alarm.level;
    });
    return bKnown ? std::vector<ErrorReport>() : Update(std::move(alarm));
}

std::vector<ErrorReport> AlarmBook::Update(Alarm alarm)
{
    if (Contains(alarm))
    {
        return {};
    }
    std::vector<ErrorReport> reports = Clear(alarm);
    reports.push_back({alarm, true});
    _alarms.push_back(std::move(alarm));
    return reports;
}

std::vector<ErrorReport> AlarmBook::Clear(const Alarm& alarm)
{
    return ClearIf([&alarm](const Alarm& other) { return other.IsSameAs(alarm); });
}

std::vector<ErrorReport> AlarmBook::ClearIf(const std::function<bool(const Alarm&)>& isCleared)
{
    std::vector<ErrorReport> reports;
    std::erase_if(_alarms, [&reports, &isCleared](const Alarm& alarm) {
        const bool bCleared = isCleared(alarm);
        if (bCleared)
        {
            reports.push_back({alarm, false});
        }
        return bCleared;
    });
    return reports;
}

bool AlarmBook::Contains(const Alarm& alarm) const
{
    return std::ranges::count(_alarms, alarm) > 0;
}

const std::vector<Alarm>& AlarmBook::GetAlarms() const noexcept
{
    return _alarms;
}

} // namespace ACS::Planning
