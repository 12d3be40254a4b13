#include "SessionTimers.hpp"

#include <cstddef>
#include <utility>

namespace ACS::ProtocolBeast
{

SessionTimers::SessionTimers(
    const boost::asio::any_io_executor& executor,
    std::function<void(Protocol::ESessionTimer)> onTimer)
    : _onTimer(std::move(onTimer))
{
    _timers.reserve(Protocol::TIMER_COUNT);
    for (std::size_t index = 0; index < Protocol::TIMER_COUNT; ++index)
    {
        _timers.emplace_back(executor);
    }
}

void SessionTimers::Start(const Protocol::StartTimer& action)
{
    const auto index = static_cast<std::size_t>(action.timer);
    // A wait that has expired cannot be cancelled any more: the round tells whether it still counts.
    const std::uint64_t round = ++_rounds[index];
    _timers[index].expires_after(action.delay);
    _timers[index].async_wait(
        [weak = weak_from_this(), timer = action.timer, index, round](const boost::system::error_code& error) {
            const std::shared_ptr<SessionTimers> self = weak.lock();
            if (!error && self != nullptr && self->_rounds[index] == round && self->_onTimer)
            {
                self->_onTimer(timer);
            }
        });
}

void SessionTimers::Cancel(Protocol::ESessionTimer timer)
{
    const auto index = static_cast<std::size_t>(timer);
    ++_rounds[index];
    _timers[index].cancel();
}

void SessionTimers::Detach()
{
    _onTimer = nullptr;
    for (boost::asio::steady_timer& timer : _timers)
    {
        timer.cancel();
    }
}

} // namespace ACS::ProtocolBeast
