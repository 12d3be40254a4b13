#include "common/http/HttpGuard.hpp"

#include <acs/core/Result.hpp>

#include <boost/asio/ip/address.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Apps
{

namespace
{

bool IsSameText(std::string_view left, std::string_view right)
{
    const auto lower = [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    };
    return std::ranges::equal(left, right, {}, lower, lower);
}

/// "[::1]:80" is ::1.
std::string_view CutPort(std::string_view host)
{
    if (host.starts_with('['))
    {
        return host.substr(1, host.find(']') - 1);
    }
    return host.substr(0, host.find(':'));
}

bool IsAddress(std::string_view host)
{
    boost::system::error_code error;
    static_cast<void>(boost::asio::ip::make_address(std::string(host), error));
    return !error.failed();
}

/// Whether the page was served by this server.
bool IsOwnOrigin(std::string_view origin, std::string_view host)
{
    const std::size_t colon = origin.find("://");
    return colon != std::string_view::npos && IsSameText(origin.substr(colon + 3), host);
}

/// Whether the browser goes to the page, or to a file such as /metrics. A deeper path may cost more than the page that names it.
bool IsLink(const HttpRequest& request, const HttpSource& source)
{
    return source.fetchMode == "navigate" && request.method == "GET" && request.segments.size() == 1;
}

} // namespace

HttpGuard::HttpGuard(Options options)
    : _options(std::move(options))
{
}

bool HttpGuard::IsOwnName(std::string_view host) const
{
    const std::string_view name = CutPort(host);
    return _options.bAnyName || IsSameText(name, "localhost") || IsAddress(name)
        || std::ranges::any_of(_options.names, [name](const std::string& own) { return IsSameText(own, name); });
}

std::optional<std::string> HttpGuard::GetRejectionReasonOrNull(const HttpRequest& request, const HttpSource& source)
    const
{
    // HTTP/1.0 needs no Host, but every browser sends one.
    if (!source.host.empty() && !IsOwnName(source.host))
    {
        return fmt::format(
            "host name {} is not allowed: use the IP address, or add the name to the configuration",
            Core::QuoteForError(source.host));
    }
    if (source.fetchSite == "cross-site" && !IsLink(request, source))
    {
        return "a web page of another site may only link to this address";
    }
    if (request.method == "GET" || request.method == "HEAD")
    {
        return std::nullopt; // the browser hides the response from a page of another origin
    }
    if (!source.origin.empty() && !IsOwnOrigin(source.origin, source.host))
    {
        return fmt::format("a web page of {} may not send commands", Core::QuoteForError(source.origin));
    }
    if (!source.fetchSite.empty() && source.fetchSite != "same-origin" && source.fetchSite != "none")
    {
        return "a web page of another origin may not send commands";
    }
    return std::nullopt;
}

bool IsFromOwnPage(const HttpRequest& request)
{
    const std::string origin = request.GetHeaderOrNull("Origin").value_or("");
    const std::string host = request.GetHeaderOrNull("Host").value_or("");
    const bool bSameScheme = origin.starts_with("https://") || (origin.starts_with("http://") && !request.sender.bTLS);
    return bSameScheme && !host.empty() && IsOwnOrigin(origin, host);
}

} // namespace ACS::Apps
