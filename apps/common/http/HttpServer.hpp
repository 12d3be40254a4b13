#pragma once

#include "common/config/Endpoint.hpp"
#include "common/http/HttpGuard.hpp"
#include "common/http/HttpLimits.hpp"
#include "common/http/HttpMessage.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace boost::asio::ssl // NOLINT(readability-identifier-naming): the name that Boost gives it
{
class context;
} // namespace boost::asio::ssl

namespace ACS::Apps
{

/// A small HTTP/1.1 server: status and metrics of a program, the Open API of the simulated controller. Keeps
/// connections alive; answers 400, 413 and 431 itself, 403 if its guard refuses the request, 503 for a stream beyond the limit,
/// and closes after what is not HTTP. One thread: the executor's.
class HttpServer final
{
public:
    /// Called on the executor, one request after the other; must not block and must not throw.
    using Handler = std::function<HttpResponse(const HttpRequest&)>;

private:
    struct Impl;

    std::shared_ptr<Impl> _impl;

public:
    HttpServer(
        const boost::asio::any_io_executor& executor,
        Handler handler,
        Core::Logger logger,
        HttpLimits limits = {},
        std::optional<HttpGuard> guardOrNull = std::nullopt);
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    /// Stops.
    ~HttpServer();

    /// Connections that are accepted from now on use TLS.
    void UseTLS(std::shared_ptr<boost::asio::ssl::context> context);

    /// Starts to listen. Returns the same host with the actual port. Fails if the address is not one of this machine or the
    /// port is in use; it may be called again then.
    [[nodiscard]] Core::Result<Endpoint> Listen(const Endpoint& endpoint);

    /// Later requests are for this handler; empty: they are answered with 503. Connections that wait for a delayed response or
    /// have a stream of the former handler are closed. Not to be called by a handler.
    void SetHandler(Handler handler);

    /// Closes the port and all connections. The handler is not called any more.
    void Stop();
};

} // namespace ACS::Apps
