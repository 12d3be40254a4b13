#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Apps
{

/// A request as a handler sees it.
struct HttpRequest
{
    std::string method; ///< "GET", "POST" …
    std::string path;   ///< Percent-decoded, without the query: "/project/robot/tasks[0]".
    std::vector<std::pair<std::string, std::string>> query; ///< Decoded, in the order given; names may repeat.
    std::string body;                                       ///< At most 1 MiB.
    /// The segments of the path, each decoded by itself: %2F does not separate.
    std::vector<std::string> segments{};

    /// The value of the first query parameter of that name.
    [[nodiscard]] std::optional<std::string> GetQueryOrNull(std::string_view name) const;
};

struct HttpResponse
{
    unsigned status = 200;
    std::string contentType = "text/plain; charset=utf-8";
    std::string body;
    Core::Duration delay{}; ///< Before the server sends it; other connections do not wait.
    std::string allow{};    ///< Header Allow, of a 405: the methods that are served; empty: none.
};

/// Splits the target of a request line into path and query and decodes both; an invalid target is refused.
[[nodiscard]] Core::Result<HttpRequest> ParseHttpTarget(std::string_view target);

} // namespace ACS::Apps
