#pragma once

#include <acs/core/Now.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace ACS::Net
{

/// The timers of a session, one per enumerator. Only its owner holds it, so that the handler, which may destroy the owner,
/// is never called afterwards. Runs on the single thread of the executor.
template <typename TTimer, std::size_t COUNT>
class TimerArray final : public std::enable_shared_from_this<TimerArray<TTimer, COUNT>>
{
public:
    using Handler = std::function<void(TTimer timer)>;

private:
    std::vector<boost::asio::steady_timer> _timers;
    /// An expired wait cannot be cancelled any more; with another round it is ignored.
    std::array<std::uint64_t, COUNT> _rounds{};
    Handler _handler;

public:
    TimerArray(const boost::asio::any_io_executor& executor, Handler handler)
        : _handler(std::move(handler))
    {
        _timers.reserve(COUNT);
        for (std::size_t index = 0; index < COUNT; ++index)
        {
            _timers.emplace_back(executor);
        }
    }

    /// Restarts a running timer.
    void Start(TTimer timer, Core::Duration delay)
    {
        const auto index = static_cast<std::size_t>(timer);
        const std::uint64_t round = ++_rounds[index];
        _timers[index].expires_after(delay);
        _timers[index].async_wait(
            [weak = this->weak_from_this(), timer, index, round](const boost::system::error_code& error) {
                const std::shared_ptr<TimerArray> self = weak.lock();
                if (!error && self != nullptr && self->_rounds[index] == round)
                {
                    self->_handler(timer);
                }
            });
    }

    void Cancel(TTimer timer)
    {
        const auto index = static_cast<std::size_t>(timer);
        ++_rounds[index];
        boost::system::error_code ignored;
        static_cast<void>(_timers[index].cancel(ignored));
    }

    /// No timer that was started before fires any more.
    void CancelAll()
    {
        for (std::size_t index = 0; index < COUNT; ++index)
        {
            Cancel(static_cast<TTimer>(index));
        }
    }
};

} // namespace ACS::Net
