#include "http/HostResolver.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/error.hpp>

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

using ErrorCode = boost::system::error_code;
using Tcp = boost::asio::ip::tcp;

} // namespace

/// One question to the name server. Asio's async_resolve() cannot be used: io_context waits for its thread, also when it is destroyed.
class HostResolver::Lookup final
{
    const Apps::Endpoint _host;
    std::mutex _mutex;
    std::function<void()> _notify; ///< Empty: nothing waits for the answer.
    std::optional<tl::expected<Addresses, ErrorCode>> _answer;

public:
    explicit Lookup(Apps::Endpoint host)
        : _host(std::move(host))
    {
    }

    /// On the thread of its own.
    void Run()
    {
        boost::asio::io_context context;
        ErrorCode error;
        Addresses found = Tcp::resolver(context).resolve(_host.host, std::to_string(_host.port), error);
        const std::lock_guard lock(_mutex);
        _answer = error.failed() ? tl::make_unexpected(error) : tl::expected<Addresses, ErrorCode>(std::move(found));
        if (_notify)
        {
            _notify();
        }
    }

    /// Calls the function on the other thread when the answer arrives, or now if it has arrived; until StopWaiting().
    void WaitAsync(std::function<void()> notify)
    {
        const std::lock_guard lock(_mutex);
        _notify = std::move(notify);
        if (_answer.has_value())
        {
            _notify();
        }
    }

    /// The answer, or nullopt if it has not arrived.
    [[nodiscard]] std::optional<tl::expected<Addresses, ErrorCode>> StopWaitingOrNull()
    {
        const std::lock_guard lock(_mutex);
        _notify = nullptr;
        return _answer;
    }
};

HostResolver::HostResolver(EventLoop& loop, Apps::Endpoint host)
    : _loop(loop),
      _host(std::move(host))
{
}

tl::expected<HostResolver::Addresses, ErrorCode> HostResolver::Resolve(std::chrono::milliseconds timeout)
{
    if (_lookupOrNull == nullptr)
    {
        _lookupOrNull = std::make_shared<Lookup>(_host);
        std::thread([lookup = _lookupOrNull] { lookup->Run(); }).detach();
    }
    boost::asio::io_context& context = _loop.GetContext();
    bool bDone = false;
    boost::asio::steady_timer timer(context, timeout);
    timer.async_wait([&bDone](const ErrorCode& /*error*/) { bDone = true; });
    _lookupOrNull->WaitAsync([&context, &bDone] { boost::asio::post(context, [&bDone] { bDone = true; }); });
    _loop.Run(bDone, [&timer] { timer.cancel(); });
    std::optional<tl::expected<Addresses, ErrorCode>> answer = _lookupOrNull->StopWaitingOrNull();
    timer.cancel();
    context.poll(); // the handlers that have the flag
    if (!answer.has_value())
    {
        return tl::make_unexpected(ErrorCode(boost::beast::error::timeout));
    }
    _lookupOrNull = nullptr;
    return std::move(*answer);
}

} // namespace ACS::Acsctl
