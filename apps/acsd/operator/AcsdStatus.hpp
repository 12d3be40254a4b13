#pragma once

#include "common/http/HttpGuard.hpp"
#include "common/http/HttpMessage.hpp"
#include "common/http/HttpRoutes.hpp"
#include "config/AcsdConfig.hpp"
#include "mcs/RefusedReports.hpp"
#include <acs/plan/PlanEngine.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// One link of acsd, as the status page shows it.
struct LinkStatus
{
    std::string name; ///< "mcs", "mqtt"
    bool bUp = false;
    std::string obstacle{}; ///< Why not, as a line of /readyz; empty: there is no connection.
};

/// What /status shows besides the engine's own state.
struct ProgramStatus
{
    std::vector<LinkStatus> links;
    std::vector<std::string> obstacles;            ///< Sentences: what besides the links keeps plans from being taken.
    std::map<std::string, bool, std::less<>> arms; ///< By robotID, of robots with an arm: whether it can be commanded.
    RefusedReports refusedReports{};
};

/// GET /livez: the process serves.
[[nodiscard]] Apps::HttpResponse MakeLiveResponse();

/// GET /readyz: 200 when every link is up and nothing else is in the way, else 503 with a line for each. Obstacles are sentences.
[[nodiscard]] Apps::HttpResponse MakeReadyResponse(
    const std::vector<LinkStatus>& links,
    const std::vector<std::string>& obstacles);

/// GET /status: links, obstacles, the outbox, robots, active plans (with why those that wait do so) and alarms as JSON.
[[nodiscard]] Apps::HttpResponse MakeStatusResponse(const ProgramStatus& program, const Planning::PlanEngine& engine);

/// These three. The engine must outlive the routes.
void AddStatusRoutes(
    Apps::HttpRoutes& routes,
    const Planning::PlanEngine& engine,
    const std::function<ProgramStatus()>& getStatus);

/// Who may ask acsd for anything but its health and figures.
[[nodiscard]] Apps::HttpGuard MakeHttpGuard(const AcsdConfig& config);

} // namespace ACS::Acsd
