#include "operator/OperatorLogin.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::HashToken;
using Acsd::OperatorLogin;

namespace
{

Apps::HttpRequest MakeRequestWithCookies(const std::string& cookies)
{
    Apps::HttpRequest request;
    request.headers = {{"cookie", cookies}};
    return request;
}

/// "acs_session=…" of the header Set-Cookie.
std::string FindCookiePair(const Apps::HttpResponse& response)
{
    const std::string& header = response.headers.at(0).second;
    return header.substr(0, header.find(';'));
}

} // namespace

TEST_CASE("A login has a cookie that scripts and other pages cannot use, and that leads to its token")
{
    const Core::SteadyTime now = Testing::ManualClock().GetNow().steady;
    OperatorLogin login;
    Apps::HttpRequest request;
    const Apps::HttpResponse plain = login.Open(request, HashToken("token"), now);
    CHECK(plain.status == 204);
    CHECK(plain.body.empty());
    const std::string cookie = FindCookiePair(plain);
    CHECK(plain.headers.at(0).second == cookie + "; Path=/; Max-Age=43200; HttpOnly; SameSite=Strict");
    CHECK(cookie.size() == std::string("acs_session=").size() + 43);
    request.sender.bTLS = true;
    const Apps::HttpResponse second = login.Open(request, HashToken("token"), now);
    CHECK(second.headers.at(0).second.ends_with("; SameSite=Strict; Secure"));
    CHECK(FindCookiePair(second) != cookie);
    const Apps::HttpRequest later = MakeRequestWithCookies("a=1; " + cookie + "; b=2");
    CHECK(login.FindTokenOrNull(later, now) == HashToken("token"));
    CHECK(login.FindTokenOrNull(request, now) == std::nullopt);
    CHECK(login.FindTokenOrNull(MakeRequestWithCookies("acs_session="), now) == std::nullopt);
    const Apps::HttpResponse closed = login.Close(later);
    CHECK(closed.status == 204);
    CHECK(closed.headers.at(0).second == "acs_session=; Path=/; Max-Age=0; HttpOnly; SameSite=Strict");
    CHECK(login.FindTokenOrNull(later, now) == std::nullopt);
    CHECK(login.FindTokenOrNull(MakeRequestWithCookies(FindCookiePair(second)), now).has_value());
    // A further login replaces the session of the browser.
    CHECK(login.Open(MakeRequestWithCookies(FindCookiePair(second)), HashToken("token"), now).status == 204);
    CHECK(login.FindTokenOrNull(MakeRequestWithCookies(FindCookiePair(second)), now) == std::nullopt);
}

TEST_CASE("The logins at two ports of a host do not end each other")
{
    const Core::SteadyTime now = Testing::ManualClock().GetNow().steady;
    const auto openAt = [now](OperatorLogin& login, const std::string& host) {
        Apps::HttpRequest request;
        request.headers = {{"Host", host}};
        return FindCookiePair(login.Open(request, HashToken("token"), now));
    };
    OperatorLogin one;
    OperatorLogin other;
    const std::string cookies = openAt(one, "line:8081") + "; " + openAt(other, "line:8082");
    CHECK(cookies.starts_with("acs_session_8081="));
    for (const char* host : {"line:8081", "line:8082"})
    {
        Apps::HttpRequest request = MakeRequestWithCookies(cookies);
        request.headers.emplace_back("Host", host);
        CHECK(one.FindTokenOrNull(request, now).has_value() == (std::string_view(host) == "line:8081"));
        CHECK(other.FindTokenOrNull(request, now).has_value() == (std::string_view(host) == "line:8082"));
    }
    CHECK(openAt(one, "[::1]:8083").starts_with("acs_session_8083="));
    for (const char* host : {"line", "[::1]", "line:", "line:x", "8081"})
    {
        CHECK(openAt(one, host).starts_with("acs_session="));
    }
}

TEST_CASE("The body of a login is an object with the token and nothing else")
{
    CHECK(Acsd::ReadLoginTokenOrNull(R"({"token": "abc"})") == "abc");
    for (const char* body :
         {"",
          "abc",
          "{}",
          R"({"token":1})",
          R"({"token":null})",
          R"({"token":"a","x":1})",
          R"(["token"])",
          R"("token")"})
    {
        CAPTURE(body);
        CHECK(Acsd::ReadLoginTokenOrNull(body) == std::nullopt);
    }
}

TEST_CASE("A cookie is found by its whole name")
{
    const auto find = [](const std::string& cookies) {
        return Acsd::FindCookieOrNull(MakeRequestWithCookies(cookies), "a");
    };
    CHECK(find("a=1") == "1");
    CHECK(find("b=2;a=1=2 ") == "1=2 ");
    CHECK(find("aa=2; ba=3; a; =a") == std::nullopt);
    CHECK(find("; ;a=") == "");
    CHECK(find("") == std::nullopt);
}
