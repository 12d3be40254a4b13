#pragma once

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::Apps
{

/// Calls its handler at the first SIGINT or SIGTERM, on the executor: the program then stops cleanly. A second signal
/// ends the process at once, with 130 or 143, even when the event loop hangs since before the first one. At most one instance exists at a time.
class SignalWaiter final
{
public:
    /// Receives the number of the signal.
    using Handler = std::function<void(int)>;

private:
    struct Impl;

    std::shared_ptr<Impl> _impl;

public:
    SignalWaiter(const boost::asio::any_io_executor& executor, Handler handler);
    SignalWaiter(const SignalWaiter&) = delete;
    SignalWaiter& operator=(const SignalWaiter&) = delete;
    ~SignalWaiter();

    /// Stops waiting, so that an otherwise idle event loop ends. The handler is not called any more.
    void Stop();
};

} // namespace ACS::Apps
