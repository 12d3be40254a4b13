#pragma once

#include "common/http/HttpGuard.hpp"
#include "common/http/HttpMessage.hpp"
#include "common/http/HttpRoutes.hpp"
#include "config/HttpConfig.hpp"
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
    std::string obstacle{}; ///< Why it is not up, as a line of /readyz; empty: there is no connection.
};

/// The links of a robot, as the status page shows them.
struct VehicleStatus
{
    std::string topic;                   ///< Its topic prefix: "uagv/v2/ACME/0001"; empty: it has none.
    std::vector<std::string> warnings{}; ///< What its messages contradict, without an alarm.
};

/// What /status shows besides the engine's own state.
struct ProgramStatus
{
    std::vector<LinkStatus> links;
    std::vector<std::string> obstacles;            ///< Not-ready reasons besides the links.
    std::map<std::string, bool, std::less<>> arms; ///< By robotID, for robots with an arm: whether it can be commanded.
    RefusedReports refusedReports{};
    std::map<std::string, VehicleStatus, std::less<>> vehicles{}; ///< By robotID.
};

/// GET /livez: the process is running.
[[nodiscard]] Apps::HttpResponse MakeLiveResponse();

/// GET /readyz: 200 if every link is up and there is no other not-ready reason, else 503 with a line for each reason.
[[nodiscard]] Apps::HttpResponse MakeReadyResponse(
    const std::vector<LinkStatus>& links,
    const std::vector<std::string>& obstacles);

/// GET /status: links, not-ready reasons, outbox, robots, active plans (with their wait reasons) and alarms as JSON.
[[nodiscard]] Apps::HttpResponse MakeStatusResponse(const ProgramStatus& program, const Planning::PlanEngine& engine);

/// Adds /livez and /readyz.
void AddHealthRoutes(Apps::HttpRoutes& routes, const std::function<ProgramStatus()>& getStatus);

/// Adds /status. The engine must outlive the routes.
void AddStatusRoute(
    Apps::HttpRoutes& routes,
    const Planning::PlanEngine& engine,
    const std::function<ProgramStatus()>& getStatus);

/// The host names under which acsd answers requests at this address.
[[nodiscard]] Apps::HttpGuard MakeHttpGuard(const HttpListenConfig& config);

} // namespace ACS::Acsd
