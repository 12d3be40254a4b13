#pragma once

#include "transaction/AlarmRateLimit.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/Report.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

/// The alarms that are set, by identity (Alarm::IsSameAs). Each change returns the reports for the MCS, in order; empty if
/// nothing has changed. An alarm that comes and goes stays set until it has been quiet (AlarmRateLimit).
class AlarmBook
{
public:
    using McsCodes = std::optional<std::map<std::string, std::string, std::less<>>>;

private:
    McsCodes _mcsCodes;
    std::vector<Alarm> _alarms;
    AlarmRateLimit _limit;

public:
    /// The codes are those of EngineOptions.
    explicit AlarmBook(McsCodes mcsCodes = std::nullopt)
        : _mcsCodes(std::move(mcsCodes))
    {
    }

    /// Replaces all alarms without a report: these were reported before the restart.
    void Restore(std::vector<Alarm> alarms);

    /// Sets the alarm, with its mcsCode. If it is set already with another level, it is cleared and set again: a report cannot
    /// change an alarm.
    [[nodiscard]] std::vector<ErrorReport> Raise(Alarm alarm, Core::SteadyTime now);
    /// As Raise, but also replaces an alarm with another message. The caller limits how often.
    [[nodiscard]] std::vector<ErrorReport> Update(Alarm alarm, Core::SteadyTime now);
    /// Clears the alarm of this identity. The report repeats the message with which it was set.
    [[nodiscard]] std::vector<ErrorReport> Clear(const Alarm& alarm, Core::SteadyTime now);
    /// Clears alarms at once, without the rate limit.
    [[nodiscard]] std::vector<ErrorReport> ClearIf(const std::function<bool(const Alarm&)>& isCleared);
    /// Clears the alarms that have been quiet, and lowers their levels.
    [[nodiscard]] std::vector<ErrorReport> ApplyDelayed(Core::SteadyTime now);
    /// When ApplyDelayed has something to do.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextDelayedOrNull() const;

    /// Whether the alarm is set with this level and text.
    [[nodiscard]] bool Contains(const Alarm& alarm) const;
    [[nodiscard]] const Alarm* FindOrNull(const Alarm& alarm) const;
    /// In the order in which they were set.
    [[nodiscard]] const std::vector<Alarm>& GetAlarms() const noexcept;

private:
    /// Clears the alarm if it is set, and sets this one.
    [[nodiscard]] std::vector<ErrorReport> Replace(Alarm alarm);
};

} // namespace ACS::Planning
