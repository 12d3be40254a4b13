#pragma once

#include "common/config/Endpoint.hpp"
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Apps
{

class HttpBodyStream;
class HttpPendingResponse;

/// Names and values.
using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

/// Who sends a request, for handlers that decide by it.
struct HttpSender
{
    Endpoint peer;
    std::string authorization{};   ///< Header Authorization; empty if absent.
    std::string certificateName{}; ///< CN of the verified client certificate; empty without one.
    bool bTLS = false;
};

/// A request as it is passed to a handler.
struct HttpRequest
{
    std::string method; ///< "GET", "POST" …
    std::string path;   ///< Percent-decoded, without the query: "/project/robot/tasks[0]".
    std::vector<std::pair<std::string, std::string>> query; ///< Decoded, in the order given; names may repeat.
    std::string body;                                       ///< At most 1 MiB.
    /// The segments of the path, each decoded separately: %2F is not a separator.
    std::vector<std::string> segments{};
    std::string target{}; ///< As it was sent: path and query.
    HttpSender sender{};
    HttpHeaders headers{};   ///< In the order sent; names may repeat.
    bool bCanStream = false; ///< Whether a response with a stream is within the limits of the server.

    /// The value of the first query parameter of that name; nullopt if there is none.
    [[nodiscard]] std::optional<std::string> GetQueryOrNull(std::string_view name) const;

    /// The value of the first header of that name, whose case does not matter; nullopt if there is none.
    [[nodiscard]] std::optional<std::string> GetHeaderOrNull(std::string_view name) const;
};

struct HttpResponse
{
    unsigned status = 200;
    std::string contentType = "text/plain; charset=utf-8"; ///< Empty: no header.
    std::string body{};
    Core::Duration delay{};            ///< Delay before it is sent; other connections are not delayed.
    std::string allow{};               ///< Header Allow of a 405: the allowed methods; empty: no header.
    std::chrono::seconds retryAfter{}; ///< Header Retry-After of a 503; 0: no header.
    std::string challenge{};           ///< Header WWW-Authenticate of a 401; empty: no header.
    HttpHeaders headers{};             ///< Further ones, such as Set-Cookie.
    /// Instead of `body`: the response continues until the stream ends or the peer closes the connection.
    std::shared_ptr<HttpBodyStream> stream{};
    /// Instead of all other members: the response follows when it is complete.
    std::shared_ptr<HttpPendingResponse> pending{};
};

/// Splits the target of a request line into path and query and decodes both. Fails if the target is invalid.
[[nodiscard]] Core::Result<HttpRequest> ParseHttpTarget(std::string_view target);

} // namespace ACS::Apps
