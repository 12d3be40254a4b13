#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <functional>
#include <utility>

namespace ACS::ProtocolBeast
{

/// The layer below the WebSocket. Reports when Beast begins to wait for the end of the connection.
template <typename TStream>
class LinkStream : public TStream
{
public:
    std::function<void()> onTeardown;

    explicit LinkStream(TStream&& lower)
        : TStream(std::move(lower))
    {
    }
};

/// Found and called by Beast after the last close frame, in a read as well. An error of the socket is not passed on: Beast
/// would report it in place of the reason why it closes.
template <typename TStream, typename THandler>
// NOLINTNEXTLINE(readability-identifier-naming): Beast's own
void async_teardown(boost::beast::role_type role, LinkStream<TStream>& stream, THandler&& handler)
{
    if (stream.onTeardown)
    {
        stream.onTeardown();
    }
    using boost::beast::websocket::async_teardown;
    async_teardown(
        role,
        static_cast<TStream&>(stream),
        [handler = std::forward<THandler>(handler)](boost::beast::error_code /*error*/) mutable {
            handler(boost::beast::error_code());
        });
}

} // namespace ACS::ProtocolBeast
