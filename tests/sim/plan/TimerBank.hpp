#pragma once

#include "Timeline.hpp"

#include <map>
#include <memory>
#include <set>
#include <utility>

namespace ACS::Simulation
{

/// The timers and posted tasks of one owner, which end with it.
template <typename TKey>
class TimerBank final
{
    Timeline& _timeline;
    std::map<TKey, Timeline::Ticket> _timers;
    std::set<Timeline::Ticket> _posted;

public:
    explicit TimerBank(Timeline& timeline)
        : _timeline(timeline)
    {
    }

    TimerBank(const TimerBank&) = delete;
    TimerBank& operator=(const TimerBank&) = delete;

    ~TimerBank()
    {
        CancelAll();
    }

    /// A running timer of this key starts again.
    void Start(const TKey& key, Core::Duration delay, Timeline::Task task)
    {
        Cancel(key);
        _timers[key] = _timeline.Post(delay, [this, key, task = std::move(task)] {
            _timers.erase(key);
            task();
        });
    }

    void Cancel(const TKey& key)
    {
        if (const auto found = _timers.find(key); found != _timers.end())
        {
            _timeline.Withdraw(found->second);
            _timers.erase(found);
        }
    }

    [[nodiscard]] bool IsRunning(const TKey& key) const
    {
        return _timers.contains(key);
    }

    void Post(Core::Duration delay, Timeline::Task task)
    {
        // The task reads its own ticket from there.
        auto place = std::make_shared<Timeline::Ticket>();
        *place = _timeline.Post(delay, [this, place, task = std::move(task)] {
            _posted.erase(*place);
            task();
        });
        _posted.insert(*place);
    }

    void CancelAll()
    {
        for (const auto& [key, ticket] : std::exchange(_timers, {}))
        {
            _timeline.Withdraw(ticket);
        }
        for (const Timeline::Ticket& ticket : std::exchange(_posted, {}))
        {
            _timeline.Withdraw(ticket);
        }
    }
};

} // namespace ACS::Simulation
