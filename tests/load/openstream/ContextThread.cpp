#include "ContextThread.hpp"

#include <boost/asio/post.hpp>

#include <ctime>
#include <future>
#include <pthread.h>

namespace ACS::Load
{

namespace
{

Core::Duration ReadClock(clockid_t clock)
{
    timespec time{};
    static_cast<void>(clock_gettime(clock, &time));
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

} // namespace

ContextThread::ContextThread()
    : _work(_context.get_executor()),
      _thread([this]() { _context.run(); })
{
}

ContextThread::~ContextThread()
{
    Stop();
}

void ContextThread::Stop()
{
    if (_thread.joinable())
    {
        _context.stop();
        _thread.join();
    }
}

boost::asio::io_context& ContextThread::GetContext() noexcept
{
    return _context;
}

void ContextThread::Call(const std::function<void()>& function)
{
    std::promise<void> done;
    boost::asio::post(_context, [&function, &done]() {
        function();
        done.set_value();
    });
    done.get_future().wait();
}

Core::Duration ContextThread::GetProcessorTime()
{
    clockid_t clock{};
    return pthread_getcpuclockid(_thread.native_handle(), &clock) == 0 ? ReadClock(clock) : Core::Duration::zero();
}

Core::Duration GetOwnProcessorTime()
{
    return ReadClock(CLOCK_THREAD_CPUTIME_ID);
}

} // namespace ACS::Load
