#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Why a robot that could do a plan does not do it now.
struct RobotUnavailability
{
    std::string robotID;
    std::string reason; ///< "busy with plan PLAN_7", "battery 12 % is below 20 %", "LR01.CP01 is taken by CASSETTE_01"

    bool operator==(const RobotUnavailability&) const = default;
};

/// Why a plan does not go on, in words for an operator.
struct WaitReason
{
    std::string planID;
    std::string message;
    std::optional<std::size_t> queuePosition; ///< From 1; of a plan that no robot has.
    std::vector<RobotUnavailability> robots;  ///< All that could do a plan that no robot has, but not at this moment.

    bool operator==(const WaitReason&) const = default;
};

} // namespace ACS::Planning
