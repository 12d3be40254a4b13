#pragma once

#include "api/ApiTypes.hpp"
#include "view/ViewContext.hpp"

#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// Each returns the lines that a command prints for an answer.

[[nodiscard]] std::string PrintStatus(const StatusInfo& status, const ViewContext& context);
[[nodiscard]] std::string PrintPlans(const std::vector<PlanInfo>& plans, const ViewContext& context);
[[nodiscard]] std::string PrintPlan(const PlanInfo& plan, const ViewContext& context);
[[nodiscard]] std::string PrintRobots(const std::vector<RobotInfo>& robots, const ViewContext& context);
[[nodiscard]] std::string PrintRobot(const RobotInfo& robot, const ViewContext& context);
[[nodiscard]] std::string PrintAlarms(const std::vector<AlarmInfo>& alarms, const ViewContext& context);
[[nodiscard]] std::string PrintLinks(const std::vector<LinkInfo>& links, const ViewContext& context);
[[nodiscard]] std::string PrintQueue(const QueueAnswer& queue, const ViewContext& context);
[[nodiscard]] std::string PrintSite(const SiteAnswer& site, const ViewContext& context);

/// Whether acsd is ready, all links are up, the TSC is Auto and no heavy alarm is active.
[[nodiscard]] bool IsHealthy(const StatusInfo& status);

/// "up", "down"
[[nodiscard]] std::string_view GetLinkText(const LinkInfo& link);

} // namespace ACS::Acsctl
