#pragma once

#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <optional>

namespace ACS::Planning
{

/// How many errors of a robot became alarms lately.
class ErrorBudget
{
public:
    static constexpr std::size_t MOST_IN_PERIOD = 60; ///< Errors that become alarms within a PERIOD.
    static constexpr std::chrono::minutes PERIOD{1};

private:
    std::optional<Core::SteadyTime> _begin; ///< Of the present period.
    std::size_t _count = 0;
    std::optional<Core::SteadyTime> _updatedAt;

public:
    /// One more error becomes an alarm. False: not in the present period.
    [[nodiscard]] bool TryCount(Core::SteadyTime now)
    {
        if (!_begin.has_value() || now - *_begin >= PERIOD)
        {
            _begin = now;
            _count = 0;
        }
        if (_count == MOST_IN_PERIOD)
        {
            return false;
        }
        ++_count;
        return true;
    }

    /// The message of the alarm about the other errors changes, at most once in a PERIOD.
    [[nodiscard]] bool TryUpdate(Core::SteadyTime now)
    {
        if (_updatedAt.has_value() && now - *_updatedAt < PERIOD)
        {
            return false;
        }
        _updatedAt = now;
        return true;
    }
};

} // namespace ACS::Planning
