#pragma once

#include <acs/plan/Report.hpp>

#include <functional>
#include <vector>

namespace ACS::Planning
{

/// The alarms that are set, by identity (Alarm::IsSameAs). Each change returns the reports for the MCS, in order; empty if
/// nothing has changed.
class AlarmBook
{
    std::vector<Alarm> _alarms;

public:
    AlarmBook() = default;

    /// Replaces all alarms without a report: these were reported before the restart.
    void Restore(std::vector<Alarm> alarms);

    /// Sets the alarm. If it is set already with another level, it is cleared and set again: a report cannot change an alarm.
    [[nodiscard]] std::vector<ErrorReport> Raise(Alarm alarm);
    /// As Raise, but also replaces an alarm with another message.
    [[nodiscard]] std::vector<ErrorReport> Update(Alarm alarm);
    /// Clears the alarm of this identity. The report repeats the message with which it was set.
    [[nodiscard]] std::vector<ErrorReport> Clear(const Alarm& alarm);
    [[nodiscard]] std::vector<ErrorReport> ClearIf(const std::function<bool(const Alarm&)>& isCleared);

    /// Whether the alarm is set with this level and text.
    [[nodiscard]] bool Contains(const Alarm& alarm) const;
    /// In the order in which they were set.
    [[nodiscard]] const std::vector<Alarm>& GetAlarms() const noexcept;
};

} // namespace ACS::Planning
