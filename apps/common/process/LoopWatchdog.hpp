#pragma once

#include <acs/core/Now.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <functional>
#include <memory>

namespace ACS::Apps
{

/// Measures from inside the event loop how late it runs its timers, and so for how long something has blocked it.
class LoopWatchdog final
{
public:
    static constexpr std::chrono::milliseconds PERIOD{100};

    struct Options
    {
        /// Delays from here on are stalls.
        Core::Duration limit{};
        /// Time between two calls of OnAlive, at least PERIOD; 0: none.
        Core::Duration aliveInterval{};
    };

    /// Called on the executor; either may be empty.
    struct Handlers
    {
        /// With the duration for which the loop was blocked, as soon as it continues.
        std::function<void(Core::Duration)> onStall;
        std::function<void()> onAlive;
    };

private:
    struct Impl;
    std::shared_ptr<Impl> _impl;

public:
    LoopWatchdog(const boost::asio::any_io_executor& executor, Options options, Handlers handlers);
    LoopWatchdog(const LoopWatchdog&) = delete;
    LoopWatchdog& operator=(const LoopWatchdog&) = delete;
    ~LoopWatchdog();

    /// The first period begins now.
    void Start();
    /// No handler is called any more, and nothing keeps the loop running.
    void Stop();
};

} // namespace ACS::Apps
