#pragma once

#include "common/http/HttpStream.hpp"
#include "config/Connection.hpp"
#include "http/ApiFailure.hpp"
#include "http/ApiRequest.hpp"
#include "http/EventLoop.hpp"
#include "http/HostResolver.hpp"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>
#include <tl/expected.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// One connection to acsd with one request.
class ApiConnection final
{
    EventLoop& _loop;
    const Connection& _target;
    std::chrono::milliseconds _timeout;
    Apps::HttpStream _stream;
    boost::beast::flat_buffer _buffer;
    bool _bSent = false;

public:
    ApiConnection(
        EventLoop& loop,
        const Connection& target,
        std::shared_ptr<boost::asio::ssl::context> tlsOrNull,
        std::chrono::milliseconds timeout);

    /// Resolves the name of the target, connects, and with TLS makes the handshake.
    [[nodiscard]] tl::expected<void, ApiFailure> Open(HostResolver& resolver);
    [[nodiscard]] tl::expected<void, ApiFailure> Write(const ApiRequest& request);
    [[nodiscard]] tl::expected<ApiAnswer, ApiFailure> Read();
    [[nodiscard]] tl::expected<ApiAnswer, ApiFailure> ReadStream(
        const std::function<bool(std::string_view)>& tryHandle);

private:
    using Message = boost::beast::http::request<boost::beast::http::string_body>;

    [[nodiscard]] Message MakeMessage(const ApiRequest& request) const;
    [[nodiscard]] ApiFailure MakeFailure(const boost::system::error_code& error) const;
    [[nodiscard]] ApiFailure MakeOpenFailure(const boost::system::error_code& error);
    /// Starts an operation with a time limit and returns its error when it is done.
    template <typename TStart>
    [[nodiscard]] boost::system::error_code Await(TStart start);
    /// The same for a transfer over the stream, with or without TLS. The handler receives the number of bytes too.
    template <typename TStart>
    [[nodiscard]] boost::system::error_code AwaitTransfer(TStart start);
};

} // namespace ACS::Acsctl
