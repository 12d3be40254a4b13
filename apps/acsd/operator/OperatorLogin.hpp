#pragma once

#include "common/http/HttpMessage.hpp"
#include "operator/OperatorToken.hpp"
#include "operator/SessionTable.hpp"
#include <acs/core/Now.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Opens a session for a browser that has shown a token, and ends it: the browser has a cookie with a random secret, which
/// scripts cannot read. A session is worth as much as its token is at the time of each request.
class OperatorLogin final
{
    SessionTable _sessions;

public:
    /// The SHA-256 of the token of the request's session; nullopt without a session.
    [[nodiscard]] std::optional<OperatorToken::Hash> FindTokenOrNull(
        const Apps::HttpRequest& request,
        Core::SteadyTime now) const;

    /// 204 with a new cookie, or 503 if the system has no random numbers.
    [[nodiscard]] Apps::HttpResponse Open(
        const Apps::HttpRequest& request,
        const OperatorToken::Hash& token,
        Core::SteadyTime now);

    /// 204; the browser forgets the cookie.
    [[nodiscard]] Apps::HttpResponse Close(const Apps::HttpRequest& request);
};

/// The token of the body of a login, {"token": "TOKEN"}; nullopt if it is anything else.
[[nodiscard]] std::optional<std::string> ReadLoginTokenOrNull(const std::string& body);

/// The value of a cookie of the header Cookie; nullopt if there is none.
[[nodiscard]] std::optional<std::string> FindCookieOrNull(const Apps::HttpRequest& request, std::string_view name);

} // namespace ACS::Acsd
