#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>

#include <chrono>
#include <functional>
#include <optional>

namespace ACS::Acsctl
{

/// Runs one operation at a time until it is done, or until the operator interrupts the program.
class EventLoop final
{
    boost::asio::io_context _context{1};
    std::optional<boost::asio::signal_set> _signals;
    std::function<void()> _cancel;
    bool _bInterrupted = false;

public:
    /// From now on SIGINT and SIGTERM cancel the current operation instead of ending the program.
    void CatchInterrupts();

    [[nodiscard]] boost::asio::io_context& GetContext() noexcept;
    [[nodiscard]] bool IsInterrupted() const noexcept;

    /// Returns when the flag is set. The function makes the operation end soon.
    void Run(const bool& bDone, std::function<void()> cancel);

    /// Waits; less after an interrupt.
    void Pause(std::chrono::milliseconds time);
};

} // namespace ACS::Acsctl
