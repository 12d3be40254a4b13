#pragma once

#include "common/http/HttpRoutes.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "common/process/ReadyLine.hpp"
#include "config/HttpConfig.hpp"
#include "operator/HttpInterfaces.hpp"
#include <acs/core/Result.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The HTTP addresses of a process that does not lead: /livez, /readyz with 503 and the reason, /metrics, and the live page, which
/// shows the reason. All else is answered with 503. One thread: the executor's.
class StandbyServer final
{
public:
    /// Return why the process does not lead, as one sentence.
    struct Reasons
    {
        std::function<std::string()> getReason;       ///< For monitoring.
        std::function<std::string()> getPublicReason; ///< For clients that are not identified.
    };

private:
    HttpInterfaces _http;
    Apps::MetricsEndpoint _metrics;
    Apps::HttpRoutes _pageRoutes;

public:
    StandbyServer(
        HttpInterfaces::Dependencies dependencies,
        const HttpConfig& config,
        std::unique_ptr<AuditLog> audit,
        const Reasons& reasons);

    [[nodiscard]] Core::Result<void> Listen(const HttpConfig& config);
    void Stop();

    /// As HttpInterfaces::Reload.
    void Reload(const OperatorConfig& fresh, OperatorConfig& present);

    [[nodiscard]] const std::vector<Apps::ReadyAddress>& GetAddresses() const noexcept;
};

} // namespace ACS::Acsd
