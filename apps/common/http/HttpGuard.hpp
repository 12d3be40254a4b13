#pragma once

#include "common/http/HttpMessage.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// The headers that show where a request comes from; empty if absent.
struct HttpSource
{
    std::string_view host;        ///< Host
    std::string_view origin;      ///< Origin
    std::string_view fetchSite;   ///< Sec-Fetch-Site
    std::string_view fetchMode{}; ///< Sec-Fetch-Mode
};

/// Protects a program from web pages in the browser of a user who can reach it. Any page can send a POST (cross-site request
/// forgery), and can make its own name resolve to the address of the program (DNS rebinding). Clients other than browsers
/// send neither Origin nor Sec-Fetch-Site, and the configured Host. Pure.
class HttpGuard
{
public:
    struct Options
    {
        /// Allowed host names, without port. localhost and IP addresses are always allowed: a page cannot spoof them.
        std::vector<std::string> names;
        bool bAnyName = false;
    };

private:
    Options _options;

public:
    explicit HttpGuard(Options options);

    /// Why the request is refused, for the body of the 403; nullopt if it is allowed.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(
        const HttpRequest& request,
        const HttpSource& source) const;

private:
    [[nodiscard]] bool IsOwnName(std::string_view host) const;
};

/// Whether the request states that a page of this server has sent it: for requests that a browser identifies by itself. A
/// program in front of the server may add TLS, but not remove it.
[[nodiscard]] bool IsFromOwnPage(const HttpRequest& request);

} // namespace ACS::Apps
