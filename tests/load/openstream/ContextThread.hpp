#pragma once

#include <acs/core/Now.hpp>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include <functional>
#include <thread>

namespace ACS::Load
{

/// An io_context that runs in its own thread until the end, and the CPU time of that thread.
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

    /// Afterwards no handler runs, and what they refer to may be destroyed before the context.
    void Stop();

    /// Calls the function in the thread and waits for its return.
    void Call(const std::function<void()>& function);

    [[nodiscard]] Core::Duration GetProcessorTime();
};

/// Of the calling thread.
[[nodiscard]] Core::Duration GetOwnProcessorTime();

} // namespace ACS::Load
