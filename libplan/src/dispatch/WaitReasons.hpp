#pragma once

#include "control/StallWatch.hpp"
#include "control/TscControl.hpp"
#include "dispatch/Dispatcher.hpp"
#include "dispatch/PortCheck.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include <acs/plan/WaitReason.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Why plans wait.
class WaitReasons
{
    const EngineOptions& _options;
    const PlanBook& _plans;
    const Fleet& _fleet;
    const StoreBacklog& _backlog;
    const StartupBarrier& _startup;
    const TscControl& _tsc;
    const StallWatch& _stalls;
    const WaitingRobots& _waiting;
    const TrafficCoordinator& _coordinator;
    const Dispatcher& _dispatcher;

public:
    WaitReasons(
        EngineState& engine,
        const TscControl& tsc,
        const StallWatch& stalls,
        const WaitingRobots& waiting,
        const TrafficCoordinator& coordinator,
        const Dispatcher& dispatcher);

    [[nodiscard]] std::vector<WaitReason> GetWaitReasons() const;
    [[nodiscard]] std::optional<WaitReason> GetWaitReasonOrNull(std::string_view planID) const;
    /// Of a plan that is paused, or whose robot has it and stands.
    [[nodiscard]] std::optional<WaitReason> DescribeBegunOrNull(const ActivePlan& plan) const;

private:
    /// Why the robot is not given the plan now; nullopt where it is.
    [[nodiscard]] std::optional<std::string> DescribeUnavailabilityOrNull(const ActivePlan& plan, const Robot& robot)
        const;
    [[nodiscard]] WaitReason DescribeWaiting(const ActivePlan& plan, std::size_t position) const;
    /// A robot with a plan that has no way yet, or has come to the end of what others leave it.
    [[nodiscard]] std::string DescribeStanding(const Robot& robot) const;
    [[nodiscard]] std::string DescribeUnfree(const Robot& robot) const;
};

} // namespace ACS::Planning
