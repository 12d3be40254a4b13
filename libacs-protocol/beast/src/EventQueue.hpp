#pragma once

#include <acs/protocol/SessionEvent.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <deque>
#include <memory>

namespace ACS::ProtocolBeast
{

/// Passes the events of a session to its user one by one on the executor, never during a call of the user.
class EventQueue : public std::enable_shared_from_this<EventQueue>
{
    boost::asio::any_io_executor _executor;
    ISessionHandler* _handlerOrNull;
    std::deque<Protocol::SessionEvent> _events;
    bool _bPosted = false;

public:
    EventQueue(boost::asio::any_io_executor executor, ISessionHandler& handler);

    void Push(Protocol::SessionEvent event);

    /// The handler is not called any more.
    void Detach();

private:
    void Drain();
};

} // namespace ACS::ProtocolBeast
