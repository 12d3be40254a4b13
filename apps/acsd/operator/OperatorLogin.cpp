#include "operator/OperatorLogin.hpp"

#include "operator/OperatorAnswer.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned LOGIN_DONE = 204;
constexpr unsigned LOGIN_IMPOSSIBLE = 503;

/// With the port that the browser uses: it sends a cookie to all ports of a host, and each may be that of another acsd.
std::string MakeCookieName(const Apps::HttpRequest& request)
{
    const std::string host = request.GetHeaderOrNull("Host").value_or("");
    const std::optional<std::uint16_t> port =
        Core::ParseNumberOrNull<std::uint16_t>(std::string_view(host).substr(host.rfind(':') + 1));
    return port.has_value() && host.find(':') != std::string::npos ? fmt::format("acs_session_{}", *port)
                                                                   : "acs_session";
}

Apps::HttpResponse MakeCookieResponse(
    const Apps::HttpRequest& request,
    std::string_view value,
    std::chrono::seconds age)
{
    Apps::HttpResponse response{LOGIN_DONE, {}};
    response.headers = {
        {"Set-Cookie",
         fmt::format(
             "{}={}; Path=/; Max-Age={}; HttpOnly; SameSite=Strict{}",
             MakeCookieName(request),
             value,
             age.count(),
             request.sender.bTLS ? "; Secure" : "")},
        {"Cache-Control", "no-store"}};
    return response;
}

} // namespace

std::optional<OperatorToken::Hash> OperatorLogin::FindTokenOrNull(
    const Apps::HttpRequest& request,
    Core::SteadyTime now) const
{
    const std::optional<std::string> secret = FindCookieOrNull(request, MakeCookieName(request));
    return secret.has_value() ? _sessions.FindTokenOrNull(HashToken(*secret), now) : std::nullopt;
}

Apps::HttpResponse OperatorLogin::Open(
    const Apps::HttpRequest& request,
    const OperatorToken::Hash& token,
    Core::SteadyTime now)
{
    std::array<std::uint8_t, OperatorToken::HASH_BYTES> random{};
    if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
    {
        return MakeOperatorError(LOGIN_IMPOSSIBLE, "The system has no random numbers.");
    }
    if (const std::optional<std::string> former = FindCookieOrNull(request, MakeCookieName(request)))
    {
        _sessions.Remove(HashToken(*former));
    }
    const std::string secret = MakeTokenText(random);
    _sessions.Add(HashToken(secret), token, now);
    return MakeCookieResponse(request, secret, SessionTable::LIFETIME);
}

Apps::HttpResponse OperatorLogin::Close(const Apps::HttpRequest& request)
{
    if (const std::optional<std::string> secret = FindCookieOrNull(request, MakeCookieName(request)))
    {
        _sessions.Remove(HashToken(*secret));
    }
    return MakeCookieResponse(request, {}, std::chrono::seconds(0));
}

std::optional<std::string> ReadLoginTokenOrNull(const std::string& body)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(body, Json::ParseLimits{});
    if (!root.has_value() || !(*root)->IsObject() || (*root)->MemberCount() != 1)
    {
        return std::nullopt;
    }
    const Json::Value* const tokenOrNull = Json::FindFirstOrNull(**root, "token");
    if (tokenOrNull == nullptr || !tokenOrNull->IsString())
    {
        return std::nullopt;
    }
    return std::string(tokenOrNull->GetString(), tokenOrNull->GetStringLength());
}

std::optional<std::string> FindCookieOrNull(const Apps::HttpRequest& request, std::string_view name)
{
    const std::string header = request.GetHeaderOrNull("Cookie").value_or("");
    std::string_view rest = header;
    while (!rest.empty())
    {
        const std::size_t end = std::min(rest.find(';'), rest.size());
        std::string_view cookie = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
        const std::size_t equals = cookie.find('=');
        if (equals != std::string_view::npos && cookie.substr(0, equals) == name)
        {
            return std::string(cookie.substr(equals + 1));
        }
    }
    return std::nullopt;
}

} // namespace ACS::Acsd
