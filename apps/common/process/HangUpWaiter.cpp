#include "common/process/HangUpWaiter.hpp"

#include <boost/asio/signal_set.hpp>

#include <csignal>
#include <utility>

namespace ACS::Apps
{

namespace
{

void ChangeSignalMask(int how)
{
    sigset_t signals{};
    sigemptyset(&signals);
    sigaddset(&signals, SIGHUP);
    pthread_sigmask(how, &signals, nullptr);
}

} // namespace

struct HangUpWaiter::Impl : public std::enable_shared_from_this<HangUpWaiter::Impl>
{
    boost::asio::signal_set signals;
    Handler handler;
    bool bStopped = false;

    Impl(const boost::asio::any_io_executor& executor, Handler handlerToCall)
        : signals(executor, SIGHUP),
          handler(std::move(handlerToCall))
    {
    }

    void WaitAsync()
    {
        signals.async_wait([weak = weak_from_this()](const boost::system::error_code& error, int /*signalNumber*/) {
            const std::shared_ptr<Impl> impl = weak.lock();
            if (impl == nullptr || impl->bStopped || error.failed())
            {
                return;
            }
            impl->handler();
            impl->WaitAsync();
        });
    }
};

void HangUpWaiter::Postpone()
{
    ChangeSignalMask(SIG_BLOCK);
}

HangUpWaiter::HangUpWaiter(const boost::asio::any_io_executor& executor, Handler handler)
    : _impl(std::make_shared<Impl>(executor, std::move(handler)))
{
    _impl->WaitAsync();
    ChangeSignalMask(SIG_UNBLOCK);
}

HangUpWaiter::~HangUpWaiter()
{
    _impl->bStopped = true;
    boost::system::error_code ignored;
    _impl->signals.clear(ignored);
    _impl->signals.cancel(ignored);
    std::signal(SIGHUP, SIG_IGN); // the default action, which clear has restored, would end the process
}

} // namespace ACS::Apps
