#include "common/process/SignalWaiter.hpp"

#include <boost/asio/signal_set.hpp>

#include <csignal>
#include <cstdlib>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr int EXIT_BY_SIGNAL = 128;

/// Runs as a signal handler: the event loop may hang.
void ExitAtOnce(int signalNumber)
{
    std::_Exit(EXIT_BY_SIGNAL + signalNumber);
}

} // namespace

struct SignalWaiter::Impl
{
    boost::asio::signal_set signals;
    Handler handler;
    bool bStopped = false;

    Impl(const boost::asio::any_io_executor& executor, Handler handlerToCall)
        : signals(executor, SIGINT, SIGTERM),
          handler(std::move(handlerToCall))
    {
    }

    void OnSignal(const boost::system::error_code& error, int signalNumber)
    {
        if (bStopped || error.failed())
        {
            return;
        }
        Stop();
        std::signal(SIGINT, ExitAtOnce);
        std::signal(SIGTERM, ExitAtOnce);
        handler(signalNumber);
    }

    void Stop()
    {
        bStopped = true;
        boost::system::error_code ignored;
        signals.clear(ignored);
        signals.cancel(ignored);
    }
};

SignalWaiter::SignalWaiter(const boost::asio::any_io_executor& executor, Handler handler)
    : _impl(std::make_shared<Impl>(executor, std::move(handler)))
{
    _impl->signals.async_wait(
        [weak = std::weak_ptr<Impl>(_impl)](const boost::system::error_code& error, int signalNumber) {
            if (const std::shared_ptr<Impl> impl = weak.lock())
            {
                impl->OnSignal(error, signalNumber);
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
