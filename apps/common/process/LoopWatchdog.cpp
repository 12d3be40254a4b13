#include "common/process/LoopWatchdog.hpp"

#include <boost/asio/steady_timer.hpp>

#include <utility>

namespace ACS::Apps
{

struct LoopWatchdog::Impl : public std::enable_shared_from_this<LoopWatchdog::Impl>
{
    boost::asio::steady_timer timer;
    Options options;
    Handlers handlers;
    std::chrono::steady_clock::time_point aliveAt; ///< The last call of OnAlive.
    bool bStopped = false;

    Impl(const boost::asio::any_io_executor& executor, Options optionsToUse, Handlers handlersToCall)
        : timer(executor),
          options(optionsToUse),
          handlers(std::move(handlersToCall))
    {
    }

    void WaitAsync()
    {
        timer.expires_after(PERIOD);
        timer.async_wait([weak = weak_from_this()](const boost::system::error_code& error) {
            const std::shared_ptr<Impl> impl = weak.lock();
            if (impl != nullptr && !error.failed() && !impl->bStopped)
            {
                impl->OnPeriod();
            }
        });
    }

    void OnPeriod()
    {
        const auto now = std::chrono::steady_clock::now();
        const auto late = std::chrono::duration_cast<Core::Duration>(now - timer.expiry());
        if (late >= options.limit && handlers.onStall)
        {
            handlers.onStall(late);
        }
        if (handlers.onAlive && options.aliveInterval > Core::Duration::zero()
            && now - aliveAt + PERIOD > options.aliveInterval)
        {
            aliveAt = now;
            handlers.onAlive();
        }
        if (!bStopped)
        {
            WaitAsync();
        }
    }
};

LoopWatchdog::LoopWatchdog(const boost::asio::any_io_executor& executor, Options options, Handlers handlers)
    : _impl(std::make_shared<Impl>(executor, options, std::move(handlers)))
{
}

LoopWatchdog::~LoopWatchdog()
{
    Stop();
}

void LoopWatchdog::Start()
{
    _impl->WaitAsync();
}

void LoopWatchdog::Stop()
{
    _impl->bStopped = true;
    boost::system::error_code ignored;
    _impl->timer.cancel(ignored);
}

} // namespace ACS::Apps
