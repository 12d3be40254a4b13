#include "operator/OperatorGate.hpp"

#include "common/config/Endpoint.hpp"
#include "common/http/HttpGuard.hpp"
#include "operator/CommandBodies.hpp"
#include "operator/LinesRoute.hpp"
#include "operator/OperatorAnswer.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned STATUS_DONE = 204;
constexpr unsigned STATUS_INVALID = 400;
constexpr unsigned STATUS_UNAUTHORIZED = 401;
constexpr unsigned STATUS_FORBIDDEN = 403;
constexpr std::string_view LOGIN = "/v1/login";
constexpr std::string_view LOGOUT = "/v1/logout";

/// These decide themselves who may send them.
bool IsOfSession(const Apps::HttpRequest& request)
{
    return request.path == LOGIN || request.path == LOGOUT;
}

} // namespace

OperatorGate::OperatorGate(const Core::IClock& clock, Core::Logger logger, AccessPolicy policy, AuditLog& audit)
    : _clock(clock),
      _refusals(std::move(logger)),
      _policy(std::move(policy)),
      _audit(audit),
      _routes(MakeOperatorError)
{
    _routes.Add("GET", "/v1/audit", [this](const Apps::HttpRequest& request, const auto&) {
        return RespondWithLines(request, _audit.GetNewest());
    });
    _routes.Add("POST", LOGIN, [this](const Apps::HttpRequest& request, const auto&) { return Login(request); });
    _routes.Add("POST", LOGOUT, [this](const Apps::HttpRequest& request, const auto&) { return Logout(request); });
}

Apps::HttpRoutes& OperatorGate::GetRoutes() noexcept
{
    return _routes;
}

void OperatorGate::SetPolicy(AccessPolicy policy)
{
    _policy = std::move(policy);
}

void OperatorGate::Restore(const std::vector<Planning::CommandReceipt>& receipts)
{
    _keys.Restore(receipts, _clock.GetNow());
}

void OperatorGate::Forget(const Planning::CommandReceipt& receipt)
{
    _keys.Forget(receipt);
}

std::optional<Planning::CommandReceipt> OperatorGate::MakeReceiptOrNull(const Apps::HttpResponse& answer) const
{
    return _keys.MakeReceiptOrNull(answer, _clock.GetNow().wall);
}

void OperatorGate::SetLogoutHandler(std::function<void()> onLogout)
{
    _onLogout = std::move(onLogout);
}

Apps::HttpResponse OperatorGate::Respond(const Apps::HttpRequest& request)
{
    if (AccessPolicy::IsPublic(request) || IsOfSession(request))
    {
        return _routes.Respond(request);
    }
    const AccessPolicy::Decision decision = _policy.Decide(request, FindSessionOrNull(request));
    const bool bReads = request.method == "GET" || request.method == "HEAD";
    IdempotencyKeys::Answer answer;
    if (decision.access != AccessPolicy::EAccess::Permitted)
    {
        answer.response = Refuse(request, decision);
    }
    else if (request.method == "POST")
    {
        answer = _keys.Respond(request, *decision.identity, _clock.GetNow().steady, [&] {
            return _routes.Respond(request);
        });
    }
    else
    {
        answer.response = _routes.Respond(request);
    }
    // Requests of unknown clients are only logged: they could push all others out of the audit log.
    if (decision.identity.has_value() && !bReads)
    {
        _audit.Write({request, *decision.identity, answer.response, answer.key});
    }
    return answer.response;
}

std::optional<OperatorToken::Hash> OperatorGate::FindSessionOrNull(const Apps::HttpRequest& request) const
{
    return _login.FindTokenOrNull(request, _clock.GetNow().steady);
}

/// Without tokens a browser needs no session, only what other clients need.
Apps::HttpResponse OperatorGate::Login(const Apps::HttpRequest& request)
{
    Apps::HttpResponse response{STATUS_DONE, {}};
    AccessPolicy::Decision decision;
    if (_policy.HasTokens())
    {
        const std::optional<std::string> token = ReadLoginTokenOrNull(request.body);
        if (!token.has_value() || !request.query.empty())
        {
            return MakeOperatorError(STATUS_INVALID, R"(Expected the body {"token": "TOKEN"} and no parameter.)");
        }
        const OperatorToken::Hash hash = HashToken(*token);
        decision = _policy.IdentifyByHash(hash, OperatorIdentity::EProof::Token);
        if (decision.access == AccessPolicy::EAccess::Permitted)
        {
            response = _login.Open(request, hash, _clock.GetNow().steady);
        }
    }
    else
    {
        decision = _policy.Identify(request.sender, std::nullopt);
    }
    if (decision.access != AccessPolicy::EAccess::Permitted)
    {
        return Refuse(request, decision);
    }
    _audit.Write({request, *decision.identity, response});
    return response;
}

Apps::HttpResponse OperatorGate::Logout(const Apps::HttpRequest& request)
{
    if (!request.query.empty() || !ReadBody<EmptyBody>(request.body).has_value())
    {
        return MakeOperatorError(STATUS_INVALID, "Expected no body and no parameter.");
    }
    const std::optional<OperatorToken::Hash> session = FindSessionOrNull(request);
    if (!session.has_value())
    {
        return _login.Close(request);
    }
    AccessPolicy::Decision decision = _policy.Identify({}, session);
    if (!Apps::IsFromOwnPage(request))
    {
        decision.access = AccessPolicy::EAccess::Forbidden;
        decision.reason = "A logout needs the Origin of this address.";
        return Refuse(request, decision);
    }
    Apps::HttpResponse response = _login.Close(request);
    if (decision.identity.has_value())
    {
        _audit.Write({request, *decision.identity, response});
    }
    if (_onLogout)
    {
        _onLogout();
    }
    return response;
}

Apps::HttpResponse OperatorGate::Refuse(const Apps::HttpRequest& request, const AccessPolicy::Decision& decision)
{
    _refusals.Write(
        _clock.GetNow().steady,
        Core::ELogLevel::Warning,
        request.sender.peer.host,
        "Refused a request to the operator interface",
        {{"peer", Apps::MakeText(request.sender.peer)}, {"method", request.method}, {"reason", decision.reason}});
    const bool bUnidentified = decision.access == AccessPolicy::EAccess::Unidentified;
    Apps::HttpResponse response =
        MakeOperatorError(bUnidentified ? STATUS_UNAUTHORIZED : STATUS_FORBIDDEN, decision.reason);
    if (bUnidentified)
    {
        response.challenge = R"(Bearer realm="acsd")";
    }
    return response;
}

} // namespace ACS::Acsd
