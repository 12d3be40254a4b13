#pragma once

#include "common/http/HttpMessage.hpp"
#include "common/http/HttpRoutes.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "operator/AccessPolicy.hpp"
#include "operator/AuditLog.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

namespace ACS::Acsd
{

/// Passes the permitted requests of the operator interface to their routes and refuses the others: 401 without a valid token
/// or certificate, 403 for a role that is not sufficient. Records each command of an identified client in the audit log.
class OperatorGate final
{
    const Core::IClock& _clock;
    Apps::LogRateLimiter _refusals;
    AccessPolicy _policy;
    AuditLog& _audit;
    Apps::HttpRoutes _routes;

public:
    /// The clock, the sink of the logger and the audit log outlive the gate. Adds the route GET /v1/audit.
    OperatorGate(const Core::IClock& clock, Core::Logger logger, AccessPolicy policy, AuditLog& audit);

    /// To be filled before the first request.
    [[nodiscard]] Apps::HttpRoutes& GetRoutes() noexcept;

    /// For all requests from now on.
    void SetPolicy(AccessPolicy policy);

    [[nodiscard]] Apps::HttpResponse Respond(const Apps::HttpRequest& request);

private:
    [[nodiscard]] Apps::HttpResponse Refuse(const Apps::HttpRequest& request, const AccessPolicy::Decision& decision);
};

} // namespace ACS::Acsd
