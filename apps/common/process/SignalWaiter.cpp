#include "common/process/SignalWaiter.hpp"

#include <boost/asio/posix/stream_descriptor.hpp>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <sys/eventfd.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr int EXIT_BY_SIGNAL = 128;

/// What the signal handler can reach: the first signal, 0 before it, and the descriptor that wakes the loop.
std::atomic<int> firstSignal{0};     // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<int> wakeDescriptor{-1}; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<int>::is_always_lock_free);

/// Runs as a signal handler, so that the second signal does not need the loop, which may hang since before the first.
void HandleSignal(int signalNumber)
{
    int none = 0;
    if (!firstSignal.compare_exchange_strong(none, signalNumber))
    {
        std::_Exit(EXIT_BY_SIGNAL + signalNumber);
    }
    const int errorOfLoop = errno;
    const std::uint64_t count = 1;
    [[maybe_unused]] const ssize_t written = write(wakeDescriptor, &count, sizeof(count));
    errno = errorOfLoop;
}

boost::asio::posix::stream_descriptor MakeWakeDescriptor(const boost::asio::any_io_executor& executor)
{
    const int descriptor = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (descriptor < 0)
    {
        throw std::system_error(errno, std::system_category(), "cannot wait for signals");
    }
    return {executor, descriptor};
}

void SetDisposition(void (*handler)(int))
{
    std::signal(SIGINT, handler);
    std::signal(SIGTERM, handler);
}

} // namespace

struct SignalWaiter::Impl
{
    boost::asio::posix::stream_descriptor wake;
    Handler handler;
    bool bStopped = false;

    Impl(const boost::asio::any_io_executor& executor, Handler handlerToCall)
        : wake(MakeWakeDescriptor(executor)),
          handler(std::move(handlerToCall))
    {
        firstSignal = 0;
        wakeDescriptor = wake.native_handle();
        SetDisposition(HandleSignal);
    }

    void OnWake(const boost::system::error_code& error)
    {
        if (!bStopped && !error.failed())
        {
            Stop();
            handler(firstSignal);
        }
    }

    /// After the first signal the next one still ends the process.
    void Stop()
    {
        if (std::exchange(bStopped, true))
        {
            return;
        }
        if (firstSignal == 0)
        {
            SetDisposition(SIG_DFL);
        }
        wakeDescriptor = -1;
        boost::system::error_code ignored;
        wake.close(ignored); // NOLINT(bugprone-unused-return-value): nothing to do about it
    }
};

SignalWaiter::SignalWaiter(const boost::asio::any_io_executor& executor, Handler handler)
    : _impl(std::make_shared<Impl>(executor, std::move(handler)))
{
    _impl->wake.async_wait(
        boost::asio::posix::stream_descriptor::wait_read,
        [weak = std::weak_ptr<Impl>(_impl)](const boost::system::error_code& error) {
            if (const std::shared_ptr<Impl> impl = weak.lock())
            {
                impl->OnWake(error);
            }
        });
}

SignalWaiter::~SignalWaiter()
{
    _impl->Stop();
}

void SignalWaiter::Stop()
{
    _impl->Stop();
}

} // namespace ACS::Apps
