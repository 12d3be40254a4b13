#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// Reports the state of the service to systemd as sd_notify(3) describes it: one datagram for each report. A report that the
/// receiver does not take at once is dropped, so that it never blocks. Without NOTIFY_SOCKET it does nothing.
class ServiceNotifier final
{
    int _descriptor = -1;
    std::string _address; ///< Of an abstract socket, with a NUL as its first byte; empty without a receiver.

public:
    /// Takes the value of NOTIFY_SOCKET: a path, or the name of an abstract socket with "@".
    explicit ServiceNotifier(std::string_view address);
    ServiceNotifier(const ServiceNotifier&) = delete;
    ServiceNotifier& operator=(const ServiceNotifier&) = delete;
    ~ServiceNotifier();

    /// "READY=1", "STOPPING=1" or "WATCHDOG=1". Whether the receiver has taken it.
    [[nodiscard]] bool TryNotify(std::string_view state) const;
};

/// Of the environment: empty without systemd.
[[nodiscard]] std::string GetNotifyAddress();

/// The time within which systemd wants a "WATCHDOG=1" of this process: WATCHDOG_USEC, if WATCHDOG_PID is absent or this
/// process. nullopt without a watchdog.
[[nodiscard]] std::optional<std::chrono::microseconds> GetWatchdogTimeoutOrNull();

} // namespace ACS::Apps
