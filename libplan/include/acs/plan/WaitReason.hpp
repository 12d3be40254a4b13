#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Why a robot that is able to execute a plan cannot start it now.
struct RobotUnavailability
{
    std::string robotID;
    /// For the operator: "busy with plan PLAN_7", "battery 12 % is below 20 %", "LR01.CP01 is taken by CASSETTE_01".
    std::string reason;

    bool operator==(const RobotUnavailability&) const = default;
};

/// In the reasons of all plans (PlanEngine::GetWaitReasons) the plan that reaches this number of robots is the last one in the
/// queue with a list of robots.
inline constexpr std::size_t MAXIMUM_LISTED_ROBOTS = 1'000;

/// Why a plan makes no progress, in a sentence for the operator.
struct WaitReason
{
    std::string planID;
    std::string message;                      ///< What the plan waits for.
    std::optional<std::size_t> queuePosition; ///< From 1; nullopt if a robot has the plan.
    /// The robots that are able to execute the plan but are unavailable now; empty if a robot has the plan, or beyond
    /// MAXIMUM_LISTED_ROBOTS.
    std::vector<RobotUnavailability> robots;

    bool operator==(const WaitReason&) const = default;
};

} // namespace ACS::Planning
