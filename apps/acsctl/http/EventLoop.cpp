#include "http/EventLoop.hpp"

#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>

#include <csignal>
#include <utility>

namespace ACS::Acsctl
{

void EventLoop::CatchInterrupts()
{
    _signals.emplace(_context, SIGINT, SIGTERM);
    _signals->async_wait([this](const boost::system::error_code& error, int /*number*/) {
        if (!error.failed())
        {
            _bInterrupted = true;
            if (_cancel)
            {
                _cancel();
            }
        }
    });
}

boost::asio::io_context& EventLoop::GetContext() noexcept
{
    return _context;
}

bool EventLoop::IsInterrupted() const noexcept
{
    return _bInterrupted;
}

void EventLoop::Run(const bool& bDone, std::function<void()> cancel)
{
    _cancel = std::move(cancel);
    if (_bInterrupted)
    {
        _cancel();
    }
    _context.restart();
    while (!bDone && _context.run_one() != 0)
    {
    }
    _cancel = nullptr;
}

void EventLoop::Pause(std::chrono::milliseconds time)
{
    boost::asio::steady_timer timer(_context, time);
    bool bDone = false;
    timer.async_wait([&bDone](const boost::system::error_code& /*error*/) { bDone = true; });
    Run(bDone, [&timer] { timer.cancel(); });
}

} // namespace ACS::Acsctl
