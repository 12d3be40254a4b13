#pragma once

#include "common/http/HttpMessage.hpp"
#include "common/http/HttpRoutes.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "operator/AccessPolicy.hpp"
#include "operator/AuditLog.hpp"
#include "operator/IdempotencyKeys.hpp"
#include "operator/OperatorLogin.hpp"
#include "operator/OperatorToken.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/CommandReceipt.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace ACS::Acsd
{

/// Passes the permitted requests of the operator interface to their routes and refuses the others: 401 without a valid token
/// or certificate, 403 for a role that is not sufficient. Opens and ends sessions of browsers. Executes a repeated
/// command once (Idempotency-Key). Records each command of an identified client in the audit log.
class OperatorGate final
{
    const Core::IClock& _clock;
    Apps::LogRateLimiter _refusals;
    AccessPolicy _policy;
    AuditLog& _audit;
    OperatorLogin _login;
    IdempotencyKeys _keys;
    Apps::HttpRoutes _routes;
    std::function<void()> _onLogout;

public:
    /// The clock, the sink of the logger and the audit log outlive the gate. Adds the routes of the audit log and of sessions.
    OperatorGate(const Core::IClock& clock, Core::Logger logger, AccessPolicy policy, AuditLog& audit);
    OperatorGate(const OperatorGate&) = delete;
    OperatorGate& operator=(const OperatorGate&) = delete;
    ~OperatorGate() = default;

    /// To be filled before the first request.
    [[nodiscard]] Apps::HttpRoutes& GetRoutes() noexcept;

    /// For all requests from now on.
    void SetPolicy(AccessPolicy policy);

    /// The commands that a former process accepted.
    void Restore(const std::vector<Planning::CommandReceipt>& receipts);

    /// Of the command that is being answered; nullopt if it has no Idempotency-Key.
    [[nodiscard]] std::optional<Planning::CommandReceipt> MakeReceiptOrNull(const Apps::HttpResponse& answer) const;

    /// The command of this receipt was not executed: its answer is not repeated.
    void Forget(const Planning::CommandReceipt& receipt);

    /// Called after the end of a session.
    void SetLogoutHandler(std::function<void()> onLogout);

    [[nodiscard]] Apps::HttpResponse Respond(const Apps::HttpRequest& request);

private:
    [[nodiscard]] std::optional<OperatorToken::Hash> FindSessionOrNull(const Apps::HttpRequest& request) const;
    [[nodiscard]] Apps::HttpResponse Login(const Apps::HttpRequest& request);
    [[nodiscard]] Apps::HttpResponse Logout(const Apps::HttpRequest& request);
    [[nodiscard]] Apps::HttpResponse Refuse(const Apps::HttpRequest& request, const AccessPolicy::Decision& decision);
};

} // namespace ACS::Acsd
