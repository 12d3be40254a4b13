#include "common/http/HttpStaticFile.hpp"

#include "Catch.hpp"

#include <algorithm>
#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)

namespace
{

std::string FindHeader(const Apps::HttpResponse& response, const std::string& name)
{
    const auto found = std::ranges::find(response.headers, name, [](const auto& header) -> const std::string& {
        return header.first;
    });
    return found == response.headers.end() ? std::string() : found->second;
}

} // namespace

TEST_CASE("A static file has an ETag of its contents; a client that has it gets 304 without a body")
{
    const Apps::HttpStaticFile file("text/html; charset=utf-8", "<html>");
    Apps::HttpRequest request;
    const Apps::HttpResponse first = file.Respond(request);
    CHECK(first.status == 200);
    CHECK(first.body == "<html>");
    CHECK(first.contentType == "text/html; charset=utf-8");
    CHECK(FindHeader(first, "Cache-Control") == "no-cache");
    CHECK(FindHeader(first, "Content-Security-Policy").starts_with("default-src 'none'; script-src 'self'"));
    const std::string tag = FindHeader(first, "ETag");
    CHECK(tag.size() == 34);
    for (const std::string& known : {tag, "W/" + tag, "\"other\", " + tag, std::string("*")})
    {
        CAPTURE(known);
        request.headers = {{"If-None-Match", known}};
        const Apps::HttpResponse again = file.Respond(request);
        CHECK(again.status == 304);
        CHECK(again.body.empty());
        CHECK(FindHeader(again, "ETag") == tag);
    }
    CHECK(Apps::HttpStaticFile("text/html", "<html2>").Respond(request).status == 304); // *
    request.headers = {{"If-None-Match", tag}};
    CHECK(Apps::HttpStaticFile("text/html", "<html2>").Respond(request).status == 200);
}
