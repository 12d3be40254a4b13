#pragma once

#include "Catch.hpp"
#include "common/http/HttpServer.hpp"
#include "RawHttpClient.hpp"
#include "RecordingLogSink.hpp"

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// A server whose handler records the requests and gives the answer that the test has set.
struct HttpServerFixture
{
    static constexpr const char* LOOPBACK = "127.0.0.1";
    static constexpr std::chrono::seconds LIMIT{10};

    boost::asio::io_context context;
    RecordingLogSink log;
    std::vector<Apps::HttpRequest> requests;
    Apps::HttpResponse answer;
    std::function<Apps::HttpResponse(const Apps::HttpRequest&)> respond; ///< Instead of `answer`, if set.
    std::unique_ptr<Apps::HttpServer> server;
    std::uint16_t port = 0;

    explicit HttpServerFixture(Apps::HttpLimits limits = {}, std::optional<Apps::HttpGuard> guardOrNull = std::nullopt)
    {
        const auto handler = [this](const Apps::HttpRequest& request) {
            requests.push_back(request);
            return respond ? respond(request) : answer;
        };
        server = std::make_unique<Apps::HttpServer>(
            context.get_executor(),
            handler,
            Core::Logger(log, "http"),
            limits,
            std::move(guardOrNull));
        const auto endpoint = server->Listen({LOOPBACK, 0});
        REQUIRE(endpoint.has_value());
        REQUIRE(endpoint->host == LOOPBACK);
        REQUIRE(endpoint->port != 0);
        port = endpoint->port;
        answer.body = "<answer>";
    }

    /// Runs the loop until the condition holds, or the time limit expires.
    [[nodiscard]] bool IsReached(const std::function<bool()>& isReached)
    {
        const auto deadline = std::chrono::steady_clock::now() + LIMIT;
        while (!isReached() && std::chrono::steady_clock::now() < deadline)
        {
            context.restart();
            context.run_one_for(std::chrono::milliseconds(100));
        }
        return isReached();
    }
};

} // namespace ACS::Testing
