#pragma once

#include "common/http/HttpMessage.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// Maps methods and paths to handlers. An unknown path is answered with 404 and a list of the known ones, a path that exists
/// for another method only with 405.
class HttpRoutes
{
public:
    /// The decoded segments of the path that match a {NAME} of the pattern, in order.
    using Captures = std::vector<std::string>;
    using Handler = std::function<HttpResponse(const HttpRequest& request, const Captures& captures)>;
    /// The response with this status (404 or 405) and text.
    using RefusalMaker = std::function<HttpResponse(unsigned status, const std::string& text)>;

private:
    struct Route
    {
        std::string method;
        std::string pattern;
        std::vector<std::string> segments; ///< Of the pattern.
        Handler handler;
    };

    RefusalMaker _makeRefusal;
    std::vector<Route> _routes;

public:
    /// Refusals are plain text.
    HttpRoutes();
    explicit HttpRoutes(RefusalMaker makeRefusal);

    /// A pattern is a path, with {NAME} for any segment that is not empty: "/v1/robots/{ID}/maintenance".
    void Add(std::string_view method, std::string_view pattern, Handler handler);

    [[nodiscard]] HttpResponse Respond(const HttpRequest& request) const;

private:
    [[nodiscard]] HttpResponse Refuse(const std::string& allowedMethods) const;
};

} // namespace ACS::Apps
