#pragma once

#include "common/http/HttpMessage.hpp"
#include "common/http/HttpRoutes.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "operator/AccessPolicy.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

namespace ACS::Acsd
{

/// Passes the permitted requests of the operator interface to their routes and refuses the others: 401 without a valid token
/// or certificate, 403 for a role that is not sufficient.
class OperatorGate final
{
    const Core::IClock& _clock;
    Apps::LogRateLimiter _refusals;
    AccessPolicy _policy;
    Apps::HttpRoutes _routes;

public:
    /// The clock and the sink of the logger outlive the gate.
    OperatorGate(const Core::IClock& clock, Core::Logger logger, AccessPolicy policy);

    /// To be filled before the first request.
    [[nodiscard]] Apps::HttpRoutes& GetRoutes() noexcept;

    /// For all requests from now on.
    void SetPolicy(AccessPolicy policy);

    [[nodiscard]] Apps::HttpResponse Respond(const Apps::HttpRequest& request);

private:
    [[nodiscard]] Apps::HttpResponse Refuse(const Apps::HttpRequest& request, const AccessPolicy::Decision& decision);
};

} // namespace ACS::Acsd
