#pragma once

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <system_error>

namespace ACS::Sample
{

/// Ten lines of Asio, optimised and with every warning: a flag that Asio does not compile with fails here first.
class AsioTimer final
{
public:
    using Handler = std::function<void(std::error_code)>;

private:
    struct Impl;

    std::shared_ptr<Impl> _impl;

public:
    explicit AsioTimer(const boost::asio::any_io_executor& executor);
    AsioTimer(const AsioTimer&) = delete;
    AsioTimer& operator=(const AsioTimer&) = delete;
    ~AsioTimer();

    /// The handler is called once, unless the timer is destroyed before.
    void WaitAsync(std::chrono::milliseconds duration, Handler handler);
};

} // namespace ACS::Sample
