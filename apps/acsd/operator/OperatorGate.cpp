#include "operator/OperatorGate.hpp"

#include "common/config/Endpoint.hpp"
#include <acs/core/JsonText.hpp>

#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned HTTP_UNAUTHORIZED = 401;
constexpr unsigned HTTP_FORBIDDEN = 403;

} // namespace

OperatorGate::OperatorGate(const Core::IClock& clock, Core::Logger logger, AccessPolicy policy)
    : _clock(clock),
      _refusals(std::move(logger)),
      _policy(std::move(policy))
{
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
    return decision.access == AccessPolicy::EAccess::Permitted ? _routes.Respond(request) : Refuse(request, decision);
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
    Apps::HttpResponse response{bUnidentified ? HTTP_UNAUTHORIZED : HTTP_FORBIDDEN, "application/json", R"({"error":)"};
    Core::JsonText::AppendString(decision.reason, response.body);
    response.body += "}\n";
    if (bUnidentified)
    {
        response.challenge = R"(Bearer realm="acsd")";
    }
    return response;
}

} // namespace ACS::Acsd
