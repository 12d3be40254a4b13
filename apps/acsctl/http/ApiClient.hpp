#pragma once

#include "config/Connection.hpp"
#include "http/EventLoop.hpp"
#include "http/HostResolver.hpp"
#include "http/IApi.hpp"

#include <boost/asio/ssl/context.hpp>

#include <chrono>
#include <memory>
#include <string>

namespace ACS::Acsctl
{

/// The operator API over HTTP or HTTPS: a connection for each request.
class ApiClient final : public IApi
{
    EventLoop& _loop;
    const Connection _connection;
    const std::shared_ptr<boost::asio::ssl::context> _tlsOrNull;
    const std::chrono::milliseconds _timeout;
    HostResolver _resolver;

public:
    /// The context is that of MakeClientTLS. The loop must outlive the client.
    ApiClient(
        EventLoop& loop,
        Connection connection,
        std::shared_ptr<boost::asio::ssl::context> tlsOrNull,
        std::chrono::milliseconds timeout);

    [[nodiscard]] tl::expected<ApiAnswer, ApiFailure> Send(const ApiRequest& request) override;
    [[nodiscard]] tl::expected<ApiAnswer, ApiFailure> Stream(
        const ApiRequest& request,
        const std::function<bool(std::string_view)>& tryHandle) override;
};

} // namespace ACS::Acsctl
