#pragma once

#include <acs/plan/Report.hpp>

#include <functional>
#include <vector>

namespace ACS::Planning
{

/// The alarms that are set, by identity (Alarm::IsSameAs). What changes the book returns the reports that the MCS is owed, in
/// this order; empty where nothing has changed.
class AlarmBook
{
    std::vector<Alarm> _alarms;

public:
    AlarmBook() = default;

    /// Replaces all alarms without a report: these were reported before the restart.
    void Restore(std::vector<Alarm> alarms);

    /// Sets the alarm. One that is set already is only replaced where its level differs: it is cleared and set again, as a
    /// set alarm has no other way to change.
    [[nodiscard]] std::vector<ErrorReport> Raise(Alarm alarm);
    /// As Raise, but replaces an alarm that differs in anything.
    [[nodiscard]] std::vector<ErrorReport> Update(Alarm alarm);
    /// Clears the alarm of this identity. Its report repeats the text with which it was set.
    [[nodiscard]] std::vector<ErrorReport> Clear(const Alarm& alarm);
    [[nodiscard]] std::vector<ErrorReport> ClearIf(const std::function<bool(const Alarm&)>& isCleared);

    /// Whether the alarm is set with this level and text.
    [[nodiscard]] bool Contains(const Alarm& alarm) const;
    /// In the order in which they were set.
    [[nodiscard]] const std::vector<Alarm>& GetAlarms() const noexcept;
};

} // namespace ACS::Planning
