#pragma once

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::Apps
{

/// Calls its handler at each SIGHUP, on the executor: the program then reads its configuration again. Signals that come
/// while the handler runs become one more call.
class HangUpWaiter final
{
public:
    using Handler = std::function<void()>;

private:
    struct Impl;

    std::shared_ptr<Impl> _impl;

public:
    /// Handles a signal that Postpone has kept, too.
    HangUpWaiter(const boost::asio::any_io_executor& executor, Handler handler);
    HangUpWaiter(const HangUpWaiter&) = delete;
    HangUpWaiter& operator=(const HangUpWaiter&) = delete;

    /// The handler is not called any more, and SIGHUP is ignored: the process may still have lines to write.
    ~HangUpWaiter();

    /// A SIGHUP from now on waits for a HangUpWaiter, instead of ending the process. Call it before other threads exist.
    static void Postpone();
};

} // namespace ACS::Apps
