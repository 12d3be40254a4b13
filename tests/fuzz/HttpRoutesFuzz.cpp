#include "common/http/HttpGuard.hpp"
#include "common/http/HttpRoutes.hpp"
#include "FuzzCheck.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace
{

using namespace ACS; // NOLINT(google-build-using-namespace)

Apps::HttpRoutes MakeRoutes()
{
    Apps::HttpRoutes routes;
    const auto respond = [](const Apps::HttpRequest& request, const Apps::HttpRoutes::Captures& captures) {
        for (const std::string& capture : captures)
        {
            Fuzz::Require(!capture.empty(), "a captured segment is not empty");
        }
        return Apps::HttpResponse{200, "text/plain", request.GetQueryOrNull("reason").value_or("done")};
    };
    routes.Add("GET", "/v1/status", respond);
    routes.Add("POST", "/v1/robots/{ID}/maintenance", respond);
    routes.Add("POST", "/v1/plans/{ID}/steps/{NO}/skip", respond);
    return routes;
}

bool EndsWith(std::string_view text, std::string_view end)
{
    const auto lower = [](unsigned char letter) {
        return std::tolower(letter);
    };
    return text.size() >= end.size()
        && std::ranges::equal(text.substr(text.size() - end.size()), end, {}, lower, lower);
}

} // namespace

/// The target of a request line, and the headers that show where it comes from, separated by line feeds.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Apps::HttpRoutes ROUTES = MakeRoutes();
    static const Apps::HttpGuard GUARD({{"acsd.example"}, false});
    const std::string_view text = Fuzz::AsText(data, size);
    std::array<std::string_view, 4> parts;
    std::size_t begin = 0;
    for (std::string_view& part : parts)
    {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        part = text.substr(begin, end - begin);
        begin = std::min(end + 1, text.size());
    }
    Core::Result<Apps::HttpRequest> request = Apps::ParseHttpTarget(parts[0]);
    if (!request.has_value())
    {
        return 0;
    }
    const Apps::HttpSource source{parts[1], parts[2], parts[3]};
    for (const char* method : {"GET", "POST"})
    {
        request->method = method;
        const bool bAllowed = !GUARD.GetRejectionReasonOrNull(*request, source).has_value();
        const bool bOwnPage = source.origin.empty() || EndsWith(source.origin, source.host);
        Fuzz::Require(!bAllowed || bOwnPage || request->method == "GET", "a page of another origin changes nothing");
        const Apps::HttpResponse response = ROUTES.Respond(*request);
        Fuzz::Require(response.status == 200 || !response.body.empty(), "a refusal has a reason");
        Fuzz::Require((response.status == 405) == !response.allow.empty(), "a 405 names the allowed methods");
    }
    return 0;
}
