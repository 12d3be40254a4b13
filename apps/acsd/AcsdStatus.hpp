#pragma once

#include "common/HttpMessage.hpp"
#include <acs/plan/PlanEngine.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// One link of acsd, as the status page shows it.
struct LinkStatus
{
    std::string name; ///< "mcs", "mqtt"
    bool bUp = false;
};

/// GET /livez: the process serves.
[[nodiscard]] Apps::HttpResponse MakeLiveResponse();

/// GET /readyz: 200 when every link is up, else 503 with the names of those that are not.
[[nodiscard]] Apps::HttpResponse MakeReadyResponse(const std::vector<LinkStatus>& links);

/// GET /status: links, robots, active plans and alarms as JSON.
[[nodiscard]] Apps::HttpResponse MakeStatusResponse(
    const std::vector<LinkStatus>& links,
    const Planning::PlanEngine& engine);

} // namespace ACS::Acsd
