#pragma once

#include "view/AlarmView.hpp"
#include "view/PlanView.hpp"
#include "view/RobotView.hpp"
#include "view/StatusView.hpp"

#include <optional>
#include <vector>

namespace ACS::Acsd
{

/// Everything that changes while acsd runs, at one moment.
struct StateView
{
    StatusView status;
    std::vector<PlanView> plans;   ///< Unfinished ones; in progress first, then the queue in its order.
    std::vector<RobotView> robots; ///< In the order of the configuration.
    std::vector<AlarmView> alarms;

    bool operator==(const StateView&) const = default;
};

/// What is different between two states.
struct StateChanges
{
    std::optional<StatusView> status;
    std::vector<PlanView> plans;           ///< New ones, and those that differ.
    std::vector<std::string> endedPlanIDs; ///< Not among the unfinished ones any more.
    std::vector<RobotView> robots;
    std::optional<std::vector<AlarmView>> alarms; ///< All of them, if any differs.

    bool operator==(const StateChanges&) const = default;

    [[nodiscard]] bool IsEmpty() const noexcept;
};

[[nodiscard]] StateChanges FindChanges(const StateView& before, const StateView& after);

} // namespace ACS::Acsd
