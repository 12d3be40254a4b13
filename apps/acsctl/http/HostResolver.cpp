#include "http/HostResolver.hpp"

#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/error.hpp>

#include <string>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

using ErrorCode = boost::system::error_code;

} // namespace

HostResolver::HostResolver(EventLoop& loop, Apps::Endpoint host)
    : _loop(loop),
      _host(std::move(host)),
      _lookup(loop.GetContext().get_executor())
{
}

tl::expected<HostResolver::Addresses, ErrorCode> HostResolver::Resolve(std::chrono::milliseconds timeout)
{
    boost::asio::io_context& context = _loop.GetContext();
    bool bDone = false;
    tl::expected<Addresses, ErrorCode> answer = tl::make_unexpected(ErrorCode(boost::beast::error::timeout));
    boost::asio::steady_timer timer(context, timeout);
    timer.async_wait([&bDone](const ErrorCode& /*error*/) { bDone = true; });
    _lookup.ResolveAsync(
        _host.host,
        std::to_string(_host.port),
        [&bDone, &answer](const ErrorCode& error, const Addresses& found) {
            bDone = true;
            if (error != boost::asio::error::operation_aborted)
            {
                answer = error.failed() ? tl::make_unexpected(error) : tl::expected<Addresses, ErrorCode>(found);
            }
        });
    _loop.Run(bDone, [&timer] { timer.cancel(); });
    _lookup.Cancel();
    timer.cancel();
    context.poll(); // the handlers that have references
    return answer;
}

} // namespace ACS::Acsctl
