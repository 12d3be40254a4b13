#pragma once

#include "common/HttpMessage.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// What a request's header says of where it comes from; empty where it does not say.
struct HttpSource
{
    std::string_view host;      ///< Host
    std::string_view origin;    ///< Origin
    std::string_view fetchSite; ///< Sec-Fetch-Site
};

/// Keeps web pages from using a program by the browser of somebody who may reach it: any page may have a POST sent, and
/// may have its own name resolve to the program's address (DNS rebinding), for which what it reads is its own then.
/// A program that is no browser sends neither Origin nor Sec-Fetch-Site and gives the Host that it was told. Pure.
class HttpGuard
{
public:
    struct Options
    {
        /// By which the server may be called, without port, besides localhost and IP addresses, which no page can take.
        std::vector<std::string> names;
        bool bAnyName = false;
        /// GET and HEAD of these are served under any name: there is nothing to hide in them.
        std::vector<std::string> openPaths;
    };

private:
    Options _options;

    [[nodiscard]] bool IsOwnName(std::string_view host) const;

public:
    explicit HttpGuard(Options options);

    /// Why the request is refused, as a sentence.
    [[nodiscard]] std::optional<std::string> GetObjectionOrNull(const HttpRequest& request, const HttpSource& source)
        const;
};

} // namespace ACS::Apps
