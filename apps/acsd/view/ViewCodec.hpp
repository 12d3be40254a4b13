#pragma once

#include "view/ChangeObserver.hpp"
#include "view/SiteView.hpp"
#include "view/StateView.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace ACS::Acsd
{

/// The views as JSON texts of the operator API (docs/reference/openapi.json), each with a line end.
[[nodiscard]] std::string EncodeStatus(const StatusView& status, Core::WallTime now);
[[nodiscard]] std::string EncodeSnapshot(const StateView& state, std::uint64_t eventID, Core::WallTime now);
[[nodiscard]] std::string EncodePlans(const std::vector<PlanView>& plans);
[[nodiscard]] std::string EncodePlan(const PlanView& plan);
[[nodiscard]] std::string EncodeQueue(const StateView& state);
[[nodiscard]] std::string EncodeRobots(const std::vector<RobotView>& robots);
[[nodiscard]] std::string EncodeRobot(const RobotView& robot);
[[nodiscard]] std::string EncodeAlarms(const std::vector<AlarmView>& alarms);
[[nodiscard]] std::string EncodeLinks(const std::vector<LinkView>& links);
[[nodiscard]] std::string EncodeSite(const SiteView& site);

/// The data of an event `changes`: members only for what has changed. Without a line end.
[[nodiscard]] std::string EncodeChanges(const StateChanges& changes, const std::vector<PlanView>& endedPlans);

/// The data of an event `entry`. Without a line end.
[[nodiscard]] std::string EncodeEntry(const ChangeEntry& entry, Core::WallTime time);

} // namespace ACS::Acsd
