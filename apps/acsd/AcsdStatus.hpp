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

/// GET /readyz: 200 when every link is up and nothing else is in the way, else 503 with a line for each. Obstacles are sentences.
[[nodiscard]] Apps::HttpResponse MakeReadyResponse(
    const std::vector<LinkStatus>& links,
    const std::vector<std::string>& obstacles);

/// GET /status: links, robots, active plans (with why those that wait do so) and alarms as JSON.
[[nodiscard]] Apps::HttpResponse MakeStatusResponse(
    const std::vector<LinkStatus>& links,
    const Planning::PlanEngine& engine);

} // namespace ACS::Acsd
