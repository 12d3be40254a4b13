#include "EventQueue.hpp"

#include <boost/asio/post.hpp>

#include <utility>

namespace ACS::ProtocolBeast
{

EventQueue::EventQueue(boost::asio::any_io_executor executor, ISessionHandler& handler)
    : _executor(std::move(executor)),
      _handlerOrNull(&handler)
{
}

void EventQueue::Push(Protocol::SessionEvent event)
{
    _events.push_back(std::move(event));
    if (!_bPosted)
    {
        _bPosted = true;
        boost::asio::post(_executor, [self = shared_from_this()] { self->Drain(); });
    }
}

void EventQueue::Detach()
{
    _handlerOrNull = nullptr;
    _events.clear();
}

void EventQueue::Drain()
{
    _bPosted = false;
    std::deque<Protocol::SessionEvent> events = std::exchange(_events, {});
    for (const Protocol::SessionEvent& event : events)
    {
        // The handler may have destroyed the owner.
        if (_handlerOrNull == nullptr)
        {
            return;
        }
        _handlerOrNull->OnSessionEvent(event);
    }
}

} // namespace ACS::ProtocolBeast
