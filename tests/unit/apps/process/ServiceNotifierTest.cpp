#include "common/process/ServiceNotifier.hpp"

#include "Catch.hpp"
#include "TemporaryFolder.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace Apps = ACS::Apps;
using namespace std::chrono_literals;

namespace
{

/// A socket like systemd's, at a path or, with a NUL in front, at an abstract name.
class Receiver
{
    int _descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);

public:
    explicit Receiver(const std::string& name)
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        REQUIRE(name.size() < sizeof(address.sun_path));
        name.copy(static_cast<char*>(address.sun_path), name.size());
        const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
        REQUIRE(bind(_descriptor, reinterpret_cast<const sockaddr*>(&address), length) == 0); // NOLINT
    }

    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

    ~Receiver()
    {
        close(_descriptor);
    }

    [[nodiscard]] std::string Receive() const
    {
        std::array<char, 256> buffer{};
        const ssize_t bytes = recv(_descriptor, buffer.data(), buffer.size(), 0);
        return bytes < 0 ? std::string("nothing") : std::string(buffer.data(), static_cast<std::size_t>(bytes));
    }
};

} // namespace

TEST_CASE("A state is one datagram to the socket at a path or at an abstract name")
{
    const ACS::Testing::TemporaryFolder folder;
    const std::string path = (folder.GetPath() / "notify").string();
    const std::string name = fmt::format("acs-notifier-test-{}", getpid());
    const Receiver atPath(path);
    const Receiver atName('\0' + name);
    CHECK(Apps::ServiceNotifier(path).TryNotify("READY=1"));
    CHECK(Apps::ServiceNotifier('@' + name).TryNotify("WATCHDOG=1"));
    CHECK(atPath.Receive() == "READY=1");
    CHECK(atName.Receive() == "WATCHDOG=1");
}

TEST_CASE("A receiver that is absent, or does not take the datagram, delays nothing")
{
    const ACS::Testing::TemporaryFolder folder;
    const std::string path = (folder.GetPath() / "notify").string();
    for (const std::string& address : {std::string(), std::string("relative"), path, std::string(500, '/')})
    {
        CHECK_FALSE(Apps::ServiceNotifier(address).TryNotify("READY=1"));
    }
    const Receiver full(path);
    const Apps::ServiceNotifier notifier(path);
    int taken = 0;
    while (notifier.TryNotify("WATCHDOG=1"))
    {
        ++taken;
    }
    CHECK(taken > 0);
}

TEST_CASE("The watchdog's time is that of this process")
{
    setenv("WATCHDOG_USEC", "3000000", 1);
    CHECK(Apps::GetWatchdogTimeoutOrNull() == 3s);
    setenv("WATCHDOG_PID", fmt::format("{}", getpid()).c_str(), 1);
    CHECK(Apps::GetWatchdogTimeoutOrNull() == 3s);
    setenv("WATCHDOG_PID", "1", 1);
    CHECK_FALSE(Apps::GetWatchdogTimeoutOrNull().has_value());
    unsetenv("WATCHDOG_PID");
    for (const char* const text : {"0", "", "3s", "-1"})
    {
        setenv("WATCHDOG_USEC", text, 1);
        CHECK_FALSE(Apps::GetWatchdogTimeoutOrNull().has_value());
    }
    unsetenv("WATCHDOG_USEC");
    CHECK_FALSE(Apps::GetWatchdogTimeoutOrNull().has_value());
}
