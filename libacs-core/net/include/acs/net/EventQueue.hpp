#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/post.hpp>

#include <deque>
#include <functional>
#include <memory>
#include <utility>

namespace ACS::Net
{

/// Passes the events of a session to its user one by one on the executor, never during a call of the user.
template <typename TEvent>
class EventQueue final : public std::enable_shared_from_this<EventQueue<TEvent>>
{
public:
    /// May destroy the owner of the queue.
    using Handler = std::function<void(const TEvent& event)>;

private:
    boost::asio::any_io_executor _executor;
    Handler _handler;
    std::deque<TEvent> _events;
    bool _bPosted = false;
    bool _bDetached = false;

public:
    EventQueue(boost::asio::any_io_executor executor, Handler handler)
        : _executor(std::move(executor)),
          _handler(std::move(handler))
    {
    }

    void Push(TEvent event)
    {
        _events.push_back(std::move(event));
        if (!std::exchange(_bPosted, true))
        {
            boost::asio::post(_executor, [self = this->shared_from_this()] { self->Drain(); });
        }
    }

    /// The handler is not called any more.
    void Detach()
    {
        _bDetached = true;
        _events.clear();
    }

private:
    void Drain()
    {
        _bPosted = false;
        const std::deque<TEvent> events = std::exchange(_events, {});
        for (const TEvent& event : events)
        {
            if (_bDetached)
            {
                return;
            }
            _handler(event);
        }
    }
};

} // namespace ACS::Net
