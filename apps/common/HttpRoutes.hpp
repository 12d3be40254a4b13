#pragma once

#include "common/HttpMessage.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// Which handler serves which method and path of a program. A path that is not there is answered with 404 and a list of
/// what is, one that is there for another method only with 405.
class HttpRoutes
{
public:
    /// The segments of the path that stand where the pattern has {}, decoded, in order.
    using Captures = std::vector<std::string>;
    using Handler = std::function<HttpResponse(const HttpRequest& request, const Captures& captures)>;

private:
    struct Route
    {
        std::string method;
        std::string pattern;
        std::vector<std::string> segments; ///< Of the pattern; {}: any.
        Handler handler;
    };

    std::vector<Route> _routes;

public:
    /// A pattern is a path, with {NAME} for a segment that may be anything but empty: "/robots/{ID}/maintenance/on".
    void Add(std::string_view method, std::string_view pattern, Handler handler);

    [[nodiscard]] HttpResponse Respond(const HttpRequest& request) const;

private:
    [[nodiscard]] HttpResponse Refuse(const std::string& allowedMethods) const;
};

} // namespace ACS::Apps
