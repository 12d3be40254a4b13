#include "common/http/HttpGuard.hpp"

#include "Catch.hpp"

#include <optional>
#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)

namespace
{

std::optional<std::string> AskOrNull(const std::string& method, const std::string& path, const Apps::HttpSource& source)
{
    const Apps::HttpGuard guard({{"acs.example"}, false});
    Apps::HttpRequest request = *Apps::ParseHttpTarget(path);
    request.method = method;
    return guard.GetRejectionReasonOrNull(request, source);
}

} // namespace

TEST_CASE("Requests of programs are allowed: by address, localhost, configured name, and without Host")
{
    for (const char* host :
         {"127.0.0.1:8080",
          "127.0.0.1",
          "[::1]:8080",
          "[::1]",
          "10.1.2.3:80",
          "localhost:8080",
          "LOCALHOST",
          "acs.example:8080",
          "ACS.Example",
          ""})
    {
        INFO(host);
        CHECK(AskOrNull("POST", "/v1/tsc/pause", {host, {}, {}}) == std::nullopt);
        CHECK(AskOrNull("GET", "/v1/status", {host, {}, {}}) == std::nullopt);
    }
}

TEST_CASE("A foreign host name is refused on every path (DNS rebinding)")
{
    for (const char* host :
         {"evil.example:8080", "127.0.0.1.evil.example", "localhost.evil", "acs.example.evil", "[evil", ":"})
    {
        INFO(host);
        CHECK(AskOrNull("POST", "/v1/tsc/pause", {host, {}, {}}).has_value());
        CHECK(AskOrNull("POST", "/metrics", {host, {}, {}}).has_value());
        CHECK(AskOrNull("GET", "/v1/status", {host, {}, {}}).has_value());
        CHECK(AskOrNull("HEAD", "/metrics", {host, {}, {}}).has_value());
    }
    CHECK(
        AskOrNull("GET", "/v1/status", {"evil.example:8080", {}, {}})
        == "host name \"evil.example:8080\" is not allowed: use the IP address, or add the name to the configuration");
}

TEST_CASE("A page may send commands only to its own origin")
{
    for (const char* origin : {"http://127.0.0.1:8080", "https://127.0.0.1:8080"})
    {
        CHECK(AskOrNull("POST", "/x", {"127.0.0.1:8080", origin, "same-origin"}) == std::nullopt);
    }
    CHECK(AskOrNull("POST", "/x", {"127.0.0.1:8080", {}, "none"}) == std::nullopt);
    for (const char* origin :
         {"http://evil.example", "http://127.0.0.1:3000", "http://127.0.0.1", "null", "127.0.0.1:8080"})
    {
        INFO(origin);
        CHECK(AskOrNull("POST", "/x", {"127.0.0.1:8080", origin, {}}).has_value());
        CHECK(AskOrNull("DELETE", "/x", {"127.0.0.1:8080", origin, {}}).has_value());
        CHECK(AskOrNull("GET", "/x", {"127.0.0.1:8080", origin, {}}) == std::nullopt);
    }
    CHECK(AskOrNull("POST", "/x", {{}, "http://evil.example", {}}).has_value());
    for (const char* site : {"cross-site", "same-site"})
    {
        INFO(site);
        CHECK(AskOrNull("POST", "/x", {"127.0.0.1:8080", {}, site}).has_value());
    }
    CHECK(AskOrNull("GET", "/x", {"127.0.0.1:8080", {}, "same-site"}) == std::nullopt);
}

TEST_CASE("If any host name is allowed, pages of other origins are still refused")
{
    const Apps::HttpGuard guard({{}, true});
    Apps::HttpRequest request = *Apps::ParseHttpTarget("/fault");
    request.method = "POST";
    CHECK(guard.GetRejectionReasonOrNull(request, {"simulator:8890", {}, {}}) == std::nullopt);
    CHECK(guard.GetRejectionReasonOrNull(request, {"simulator:8890", "http://evil.example", {}}).has_value());
}

TEST_CASE("A request of a browser comes from the server's own page only with its Origin")
{
    const auto isOwn = [](bool bTLS, const std::string& origin, const std::string& host) {
        Apps::HttpRequest request;
        request.sender.bTLS = bTLS;
        request.headers = {{"Host", host}, {"Origin", origin}};
        return Apps::IsFromOwnPage(request);
    };
    CHECK(isOwn(false, "http://acs.example:8081", "acs.example:8081"));
    CHECK(isOwn(false, "https://acs.example", "acs.example")); // behind a proxy
    CHECK(isOwn(true, "https://acs.example:8081", "acs.example:8081"));
    CHECK_FALSE(isOwn(true, "http://acs.example:8081", "acs.example:8081"));
    CHECK_FALSE(isOwn(false, "http://acs.example:8082", "acs.example:8081"));
    CHECK_FALSE(isOwn(false, "http://evil.example:8081", "acs.example:8081"));
    CHECK_FALSE(isOwn(false, "ftp://acs.example", "acs.example"));
    CHECK_FALSE(isOwn(false, "null", "acs.example:8081"));
    CHECK_FALSE(isOwn(false, "http://", ""));
    CHECK_FALSE(Apps::IsFromOwnPage({}));
}

TEST_CASE("A page of another site may link to the page and to files beside it, and load nothing")
{
    for (const char* path : {"/", "/?plan=P1", "/metrics"})
    {
        INFO(path);
        CHECK(AskOrNull("GET", path, {"127.0.0.1:8080", {}, "cross-site", "navigate"}) == std::nullopt);
        for (const char* mode : {"no-cors", "cors", "websocket", ""})
        {
            INFO(mode);
            CHECK(AskOrNull("GET", path, {"127.0.0.1:8080", {}, "cross-site", mode}).has_value());
        }
        CHECK(AskOrNull("HEAD", path, {"127.0.0.1:8080", {}, "cross-site", "navigate"}).has_value());
        CHECK(AskOrNull("POST", path, {"127.0.0.1:8080", {}, "cross-site", "navigate"}).has_value());
    }
    for (const char* path : {"/v1/trace?plan=P1", "/v1/status", "/page/main.js"})
    {
        INFO(path);
        CHECK(AskOrNull("GET", path, {"127.0.0.1:8080", {}, "cross-site", "navigate"}).has_value());
        for (const char* site : {"same-origin", "same-site", "none", ""})
        {
            CHECK(AskOrNull("GET", path, {"127.0.0.1:8080", {}, site, "cors"}) == std::nullopt);
        }
    }
}
