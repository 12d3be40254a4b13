#pragma once

#include "common/http/HttpRoutes.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "operator/HttpAddresses.hpp"

#include <functional>
#include <string>

namespace ACS::Acsd
{

/// What a process that does not lead answers at its HTTP addresses: /livez, /readyz with 503 and the reason, /metrics, and the live
/// page, which shows the reason. All else is answered with 503. One thread: the executor's.
class StandbyRoutes final
{
public:
    /// Return why the process does not lead, as one sentence.
    struct Reasons
    {
        std::function<std::string()> getReason;       ///< For monitoring.
        std::function<std::string()> getPublicReason; ///< For clients that are not identified.
    };

private:
    Reasons _reasons;
    Apps::MetricsEndpoint _metrics;
    Apps::HttpRoutes _monitoringRoutes;
    Apps::HttpRoutes _pageRoutes;

public:
    explicit StandbyRoutes(Reasons reasons);
    StandbyRoutes(const StandbyRoutes&) = delete;
    StandbyRoutes& operator=(const StandbyRoutes&) = delete;
    ~StandbyRoutes() = default;

    /// They refer to the routes.
    [[nodiscard]] HttpAddresses::Handlers MakeHandlers();
};

} // namespace ACS::Acsd
