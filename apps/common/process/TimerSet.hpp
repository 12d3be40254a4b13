#pragma once

#include <acs/core/Now.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace ACS::Apps
{

/// Timers by a key of the caller: an enum, a number, any ordered type. The handler may start and cancel timers and destroy the
/// set. It is not called for a timer that was cancelled or restarted, nor after the destruction. Used on the executor's
/// thread only.
template <typename TKey>
class TimerSet final
{
public:
    using Handler = std::function<void(const TKey& key)>;

private:
    /// An expired wait cannot be cancelled: its handler compares the run to detect that it is obsolete.
    struct Timer
    {
        boost::asio::steady_timer timer;
        std::uint64_t run = 0;
    };

    struct State
    {
        boost::asio::any_io_executor executor;
        Handler handler;
        std::map<TKey, Timer> timers{};
        std::uint64_t lastRun = 0;
    };

    std::shared_ptr<State> _state;

public:
    TimerSet(const boost::asio::any_io_executor& executor, Handler handler)
        : _state(std::make_shared<State>(State{executor, std::move(handler)}))
    {
    }

    TimerSet(const TimerSet&) = delete;
    TimerSet& operator=(const TimerSet&) = delete;

    ~TimerSet()
    {
        CancelAll();
    }

    /// Starts the timer, or restarts it if it is running.
    void Start(const TKey& key, Core::Duration delay)
    {
        _state->timers.erase(key);
        const std::uint64_t run = ++_state->lastRun;
        Timer started{boost::asio::steady_timer(_state->executor, delay), run};
        Timer& entry = _state->timers.emplace(key, std::move(started)).first->second;
        entry.timer.async_wait([weak = std::weak_ptr(_state), key, run](const boost::system::error_code&) {
            const std::shared_ptr<State> state = weak.lock();
            if (state == nullptr)
            {
                return;
            }
            const auto found = state->timers.find(key);
            if (found != state->timers.end() && found->second.run == run)
            {
                state->timers.erase(found);
                state->handler(key);
            }
        });
    }

    void Cancel(const TKey& key)
    {
        _state->timers.erase(key);
    }

    void CancelAll()
    {
        _state->timers.clear();
    }

    [[nodiscard]] bool IsRunning(const TKey& key) const
    {
        return _state->timers.contains(key);
    }
};

} // namespace ACS::Apps
