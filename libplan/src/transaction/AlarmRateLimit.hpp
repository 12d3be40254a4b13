#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/Report.hpp>

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

/// Limits how often the alarm of a robot and code is set and cleared. An alarm that is set MOST_SETS times without a quiet
/// period in between stays set: a clear, or a fall of its level, waits until nothing has changed for QUIET_PERIOD. Alarms about a
/// plan are not limited, because plans limit their number.
class AlarmRateLimit
{
public:
    static constexpr std::size_t MOST_SETS = 5;
    static constexpr std::chrono::minutes QUIET_PERIOD{1};

    /// What waits for the quiet period.
    struct Delayed
    {
        Alarm alarm;         ///< The identity; the content if it is not cleared.
        bool bClear = false; ///< false: set again with the lower level.
    };

private:
    struct Entry
    {
        std::size_t sets = 0; ///< Without a quiet period in between.
        Core::SteadyTime changedAt;
        std::optional<Delayed> delayed;
    };

    std::map<std::pair<std::string, std::string>, Entry> _entries; ///< By robot and code; only what changed lately.

public:
    /// The alarm was set, or set again with another level.
    void OnSet(const Alarm& alarm, Core::SteadyTime now);
    void OnCleared(const Alarm& alarm, Core::SteadyTime now);
    /// Removed without regard to the limit. What was delayed is obsolete; its sets are still counted.
    void OnRemoved(const Alarm& alarm);
    /// Whether the alarm may be cleared, or its level may fall.
    [[nodiscard]] bool CanClear(const Alarm& alarm, Core::SteadyTime now) const;
    /// Only after CanClear was false. Replaces what was delayed before; the same again does not prolong the wait.
    void Delay(Delayed delayed, Core::SteadyTime now);
    /// The alarm was raised with the level that it has: what was delayed is obsolete.
    void OnRaisedAgain(const Alarm& alarm, Core::SteadyTime now);

    /// Removes and returns what has waited long enough.
    [[nodiscard]] std::vector<Delayed> CollectDue(Core::SteadyTime now);
    /// When CollectDue returns something next.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextOrNull() const;

private:
    [[nodiscard]] static bool IsLimited(const Alarm& alarm);
    [[nodiscard]] Entry* FindOrNull(const Alarm& alarm);
    [[nodiscard]] static bool IsQuiet(const Entry& entry, Core::SteadyTime now);
};

} // namespace ACS::Planning
