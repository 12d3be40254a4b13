#include "operator/OperatorGate.hpp"

#include "common/config/Endpoint.hpp"
#include "operator/LinesRoute.hpp"
#include "operator/OperatorAnswer.hpp"

#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned STATUS_UNAUTHORIZED = 401;
constexpr unsigned STATUS_FORBIDDEN = 403;

} // namespace

OperatorGate::OperatorGate(const Core::IClock& clock, Core::Logger logger, AccessPolicy policy, AuditLog& audit)
    : _clock(clock),
      _refusals(std::move(logger)),
      _policy(std::move(policy)),
      _audit(audit)
{
    _routes.Add("GET", "/v1/audit", [this](const Apps::HttpRequest& request, const auto&) {
        return RespondWithLines(request, _audit.GetNewest());
    });
}

Apps::HttpRoutes& OperatorGate::GetRoutes() noexcept
{
    return _routes;
}

void OperatorGate::SetPolicy(AccessPolicy policy)
{
    _policy = std::move(policy);
}

Apps::HttpResponse OperatorGate::Respond(const Apps::HttpRequest& request)
{
    const AccessPolicy::Decision decision = _policy.Decide(request);
    const bool bPermitted = decision.access == AccessPolicy::EAccess::Permitted;
    Apps::HttpResponse response = bPermitted ? _routes.Respond(request) : Refuse(request, decision);
    // Requests of unknown clients are only logged: they could push all others out of the audit log.
    if (decision.identity.has_value() && request.method != "GET" && request.method != "HEAD")
    {
        _audit.Write({request, *decision.identity, response});
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
