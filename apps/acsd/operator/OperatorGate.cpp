#include "operator/OperatorGate.hpp"

#include "common/config/Endpoint.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr unsigned STATUS_OK = 200;
constexpr unsigned STATUS_BAD_REQUEST = 400;
constexpr unsigned STATUS_UNAUTHORIZED = 401;
constexpr unsigned STATUS_FORBIDDEN = 403;
/// Of GET /audit without a limit.
constexpr std::size_t DEFAULT_AUDIT_LINES = 100;

Apps::HttpResponse MakeGateError(unsigned status, std::string_view sentence)
{
    Apps::HttpResponse response{status, "application/json", R"({"error":)"};
    Core::JsonText::AppendString(sentence, response.body);
    response.body += "}\n";
    return response;
}

} // namespace

OperatorGate::OperatorGate(const Core::IClock& clock, Core::Logger logger, AccessPolicy policy, AuditLog& audit)
    : _clock(clock),
      _refusals(std::move(logger)),
      _policy(std::move(policy)),
      _audit(audit)
{
    _routes.Add("GET", "/audit", [this](const Apps::HttpRequest& request, const auto&) { return ShowAudit(request); });
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

Apps::HttpResponse OperatorGate::ShowAudit(const Apps::HttpRequest& request) const
{
    const std::string text = request.GetQueryOrNull("limit").value_or(std::to_string(DEFAULT_AUDIT_LINES));
    std::size_t lines = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), lines);
    if (error != std::errc() || end != text.data() + text.size() || lines == 0 || lines > AuditLog::MOST_LINES)
    {
        return MakeGateError(
            STATUS_BAD_REQUEST,
            fmt::format("Expected limit from 1 to {}, found {}.", AuditLog::MOST_LINES, Core::QuoteForError(text)));
    }
    return {STATUS_OK, "application/x-ndjson", _audit.GetNewest(lines)};
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
        MakeGateError(bUnidentified ? STATUS_UNAUTHORIZED : STATUS_FORBIDDEN, decision.reason);
    if (bUnidentified)
    {
        response.challenge = R"(Bearer realm="acsd")";
    }
    return response;
}

} // namespace ACS::Acsd
