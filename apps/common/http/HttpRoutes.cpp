#include "common/http/HttpRoutes.hpp"

#include <cassert>
#include <optional>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr unsigned HTTP_NOT_FOUND = 404;
constexpr unsigned HTTP_NOT_ALLOWED = 405;
constexpr const char* PLAIN_TEXT = "text/plain; charset=utf-8";

bool IsCapture(std::string_view segment)
{
    return segment.size() > 1 && segment.front() == '{' && segment.back() == '}';
}

std::optional<HttpRoutes::Captures> MatchOrNull(
    const std::vector<std::string>& pattern,
    const std::vector<std::string>& segments)
{
    if (pattern.size() != segments.size())
    {
        return std::nullopt;
    }
    HttpRoutes::Captures captures;
    for (std::size_t i = 0; i < pattern.size(); ++i)
    {
        if (IsCapture(pattern[i]) && !segments[i].empty())
        {
            captures.push_back(segments[i]);
        }
        else if (pattern[i] != segments[i])
        {
            return std::nullopt;
        }
    }
    return captures;
}

HttpResponse MakePlainRefusal(unsigned status, const std::string& text)
{
    return {status, PLAIN_TEXT, text + "\n"};
}

} // namespace

HttpRoutes::HttpRoutes()
    : HttpRoutes(MakePlainRefusal)
{
}

HttpRoutes::HttpRoutes(RefusalMaker makeRefusal)
    : _makeRefusal(std::move(makeRefusal))
{
}

void HttpRoutes::Add(std::string_view method, std::string_view pattern, Handler handler)
{
    Core::Result<HttpRequest> parsed = ParseHttpTarget(pattern);
    assert(parsed.has_value());
    _routes.push_back({std::string(method), std::string(pattern), std::move(parsed->segments), std::move(handler)});
}

HttpResponse HttpRoutes::Respond(const HttpRequest& request) const
{
    std::string allowed;
    for (const Route& route : _routes)
    {
        const std::optional<Captures> captures = MatchOrNull(route.segments, request.segments);
        if (!captures.has_value())
        {
            continue;
        }
        // The handler of GET serves HEAD: the server omits the body.
        if (route.method == request.method || (route.method == "GET" && request.method == "HEAD"))
        {
            return route.handler(request, *captures);
        }
        allowed += (allowed.empty() ? "" : ", ") + route.method + (route.method == "GET" ? ", HEAD" : "");
    }
    return Refuse(allowed);
}

HttpResponse HttpRoutes::Refuse(const std::string& allowedMethods) const
{
    if (!allowedMethods.empty())
    {
        HttpResponse response = _makeRefusal(HTTP_NOT_ALLOWED, "allowed methods: " + allowedMethods);
        response.allow = allowedMethods;
        return response;
    }
    std::string text = "not found; available paths:";
    for (const Route& route : _routes)
    {
        text += "\n" + route.method + " " + route.pattern;
    }
    return _makeRefusal(HTTP_NOT_FOUND, text);
}

} // namespace ACS::Apps
