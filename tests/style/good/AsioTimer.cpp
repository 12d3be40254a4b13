#include "AsioTimer.hpp"

#include <boost/asio/steady_timer.hpp>

#include <utility>

namespace ACS::Sample
{

struct AsioTimer::Impl
{
    boost::asio::steady_timer timer;

    explicit Impl(const boost::asio::any_io_executor& executor)
        : timer(executor)
    {
    }
};

AsioTimer::AsioTimer(const boost::asio::any_io_executor& executor)
    : _impl(std::make_shared<Impl>(executor))
{
}

AsioTimer::~AsioTimer() = default;

void AsioTimer::WaitAsync(std::chrono::milliseconds duration, Handler handler)
{
    _impl->timer.expires_after(duration);
    const std::weak_ptr<Impl> weakImpl = _impl;
    _impl->timer.async_wait([weakImpl, handler = std::move(handler)](const boost::system::error_code& error) {
        if (!weakImpl.expired())
        {
            handler(error);
        }
    });
}

} // namespace ACS::Sample
