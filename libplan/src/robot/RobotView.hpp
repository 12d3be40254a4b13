#pragma once

#include "robot/ErrorBudget.hpp"
#include "robot/RejectionTracker.hpp"
#include <acs/plan/IJobCheck.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <memory>
#include <optional>
#include <string>

namespace ACS::Planning
{

/// What the robot and the operator reported last.
struct RobotView
{
    bool bOnline = false;
    std::optional<StateChanged> state;         ///< Since the connection; nullopt until the first.
    bool bHadPose = false;                     ///< A state had a pose, also one before the connection.
    std::shared_ptr<const IJobCheck> jobCheck; ///< Null: no job is rejected.
    bool bInMaintenance = false;
    std::string incompatibility; ///< Empty: the robot can carry out what it is commanded.
    RejectionTracker rejections;
    ErrorBudget errors; ///< How many of its errors became alarms lately.
};

} // namespace ACS::Planning
