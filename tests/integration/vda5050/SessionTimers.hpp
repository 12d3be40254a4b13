#pragma once

#include <acs/core/Now.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace ACS::Testing
{

/// The system's clocks: real sockets have no virtual time.
[[nodiscard]] inline Core::Now ReadClock()
{
    return Core::Now{std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
}

/// The timers of one session on the loop.
template <typename TTimer>
class SessionTimers
{
    boost::asio::io_context& _context;
    std::map<TTimer, boost::asio::steady_timer> _timers;
    std::shared_ptr<bool> _alive = std::make_shared<bool>(true); ///< A timer that was over already looks for it.

public:
    explicit SessionTimers(boost::asio::io_context& context)
        : _context(context)
    {
    }

    void Start(TTimer timer, Core::Duration delay, std::function<void()> whenOver)
    {
        boost::asio::steady_timer& running = _timers.try_emplace(timer, _context).first->second;
        running.expires_after(delay);
        running.async_wait(
            [alive = std::weak_ptr(_alive), whenOver = std::move(whenOver)](const boost::system::error_code& error) {
                if (!error && !alive.expired())
                {
                    whenOver();
                }
            });
    }

    void Cancel(TTimer timer)
    {
        _timers.erase(timer);
    }
};

} // namespace ACS::Testing
