#include "operator/PageRoutes.hpp"

#include "Catch.hpp"

#include <algorithm>
#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)

namespace
{

Apps::HttpResponse GetPage(const std::string& target, const std::string& knownTag = "")
{
    Apps::HttpRoutes routes;
    Acsd::AddPageRoutes(routes);
    Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
    request.method = "GET";
    request.headers = {{"If-None-Match", knownTag}};
    return routes.Respond(request);
}

std::string GetPageHeader(const Apps::HttpResponse& response, const std::string& name)
{
    const auto header = std::ranges::find(response.headers, name, &Apps::HttpHeaders::value_type::first);
    return header == response.headers.end() ? "" : header->second;
}

} // namespace

TEST_CASE("The live page is served with its modules and Leaflet", "[page]")
{
    const Apps::HttpResponse page = GetPage("/");
    CHECK(page.status == 200);
    CHECK(page.contentType == "text/html; charset=utf-8");
    CHECK(page.body.find("/page/main.js") != std::string::npos);
    CHECK(GetPageHeader(page, "Content-Security-Policy").find("script-src 'self'") != std::string::npos);

    CHECK(GetPage("/page/main.js").contentType == "text/javascript; charset=utf-8");
    CHECK(GetPage("/page/style.css").contentType == "text/css; charset=utf-8");
    CHECK(GetPage("/page/icon.svg").contentType == "image/svg+xml");
    CHECK(GetPage("/page/alarms.ko.json").contentType == "application/json");
    CHECK(GetPage("/page/leaflet.js").body.find("CloudMade") != std::string::npos);
    CHECK(GetPage("/page/leaflet-copyright.txt").contentType == "text/plain; charset=utf-8");
}

TEST_CASE("A browser that has a file of the live page is not sent it again", "[page]")
{
    const std::string tag = GetPageHeader(GetPage("/page/main.js"), "ETag");
    REQUIRE_FALSE(tag.empty());
    const Apps::HttpResponse known = GetPage("/page/main.js", tag);
    CHECK(known.status == 304);
    CHECK(known.body.empty());
    CHECK(GetPage("/page/style.css", tag).status == 200);
}

TEST_CASE("The live page has no other files", "[page]")
{
    CHECK(GetPage("/page/secret").status == 404);
    CHECK(GetPage("/page/..%2Facsd.toml").status == 404);
}
