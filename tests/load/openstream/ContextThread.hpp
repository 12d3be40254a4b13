#pragma once

#include <acs/core/Now.hpp>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include <functional>
#include <thread>

namespace ACS::Load
{

/// An io_context that runs in a thread of its own until the end, and the processor time that it has taken.
class ContextThread
{
    boost::asio::io_context _context{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> _work;
    std::thread _thread;

public:
    ContextThread();
    ContextThread(const ContextThread&) = delete;
    ContextThread& operator=(const ContextThread&) = delete;
    ~ContextThread();

    [[nodiscard]] boost::asio::io_context& GetContext() noexcept;

    /// No handler runs any more. What they refer to may be destroyed then, before the context is.
    void Stop();

    /// Calls the function there, and returns when it has returned.
    void Call(const std::function<void()>& function);

    [[nodiscard]] Core::Duration GetProcessorTime();
};

/// Of the calling thread.
[[nodiscard]] Core::Duration GetOwnProcessorTime();

} // namespace ACS::Load
