#include "common/process/ServiceNotifier.hpp"

#include <acs/core/ParseNumber.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace ACS::Apps
{

namespace
{

std::string_view GetEnvironment(const char* name)
{
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string_view() : std::string_view(value);
}

} // namespace

ServiceNotifier::ServiceNotifier(std::string_view address)
{
    const bool bUsable = address.starts_with('/') || address.starts_with('@');
    if (!bUsable || address.size() >= sizeof(sockaddr_un::sun_path))
    {
        return;
    }
    _address = address;
    if (_address.front() == '@')
    {
        _address.front() = '\0';
    }
    _descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
}

ServiceNotifier::~ServiceNotifier()
{
    if (_descriptor >= 0)
    {
        close(_descriptor);
    }
}

bool ServiceNotifier::TryNotify(std::string_view state) const
{
    if (_descriptor < 0)
    {
        return false;
    }
    sockaddr_un receiver{};
    receiver.sun_family = AF_UNIX;
    std::copy(_address.begin(), _address.end(), std::begin(receiver.sun_path));
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + _address.size());
    const auto* const target = reinterpret_cast<const sockaddr*>(&receiver); // NOLINT: the interface of sockets
    return sendto(_descriptor, state.data(), state.size(), MSG_DONTWAIT | MSG_NOSIGNAL, target, length)
        == static_cast<ssize_t>(state.size());
}

std::string GetNotifyAddress()
{
    return std::string(GetEnvironment("NOTIFY_SOCKET"));
}

std::optional<std::chrono::microseconds> GetWatchdogTimeoutOrNull()
{
    const std::string_view process = GetEnvironment("WATCHDOG_PID");
    if (!process.empty() && Core::ParseNumberOrNull<std::uint64_t>(process) != static_cast<std::uint64_t>(getpid()))
    {
        return std::nullopt;
    }
    const std::optional<std::uint64_t> timeoutOrNull =
        Core::ParseNumberOrNull<std::uint64_t>(GetEnvironment("WATCHDOG_USEC"));
    if (!timeoutOrNull.has_value() || *timeoutOrNull == 0)
    {
        return std::nullopt;
    }
    return std::chrono::microseconds(*timeoutOrNull);
}

} // namespace ACS::Apps
