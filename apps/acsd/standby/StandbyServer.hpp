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
    HttpInterfaces _http;
    Apps::MetricsEndpoint _metrics;
    Apps::HttpRoutes _pageRoutes;

public:
    /// getReason returns why the process does not lead, as one sentence.
    StandbyServer(
        HttpInterfaces::Dependencies dependencies,
        const HttpConfig& config,
        std::unique_ptr<AuditLog> audit,
        const std::function<std::string()>& getReason);

    [[nodiscard]] Core::Result<void> Listen(const HttpConfig& config);
    void Stop();

    [[nodiscard]] const std::vector<Apps::ReadyAddress>& GetAddresses() const noexcept;
};

} // namespace ACS::Acsd
