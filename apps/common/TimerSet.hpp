#pragma once

#include <acs/core/Now.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <functional>
#include <memory>

namespace ACS::Apps
{

/// The timers that a pure machine asks for (StartTimer, CancelTimer), kept by key. The driver feeds the handler's key
/// back as OnTimer. The handler may start and cancel timers and even destroy the set; it is never called for a timer
/// that was cancelled or started anew, nor after destruction. One thread: the executor's.
class TimerSet final
{
    struct Impl;
    std::shared_ptr<Impl> _impl;

public:
    using Handler = std::function<void(std::uint64_t key)>;

    TimerSet(const boost::asio::any_io_executor& executor, Handler handler);
    TimerSet(const TimerSet&) = delete;
    TimerSet& operator=(const TimerSet&) = delete;
    ~TimerSet();

    /// Starts the timer, anew where it runs already.
    void Start(std::uint64_t key, Core::Duration delay);

    /// Nothing happens where it does not run.
    void Cancel(std::uint64_t key);
    void CancelAll();

    [[nodiscard]] bool IsRunning(std::uint64_t key) const;
};

} // namespace ACS::Apps
