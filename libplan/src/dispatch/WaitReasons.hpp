#pragma once

#include "control/StallWatch.hpp"
#include "control/TscControl.hpp"
#include "dispatch/Dispatcher.hpp"
#include "dispatch/PortCheck.hpp"
#include "dispatch/StationForecast.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include <acs/plan/WaitReason.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Describes for the operator why a plan makes no progress. Owns no data and changes none.
class WaitReasons
{
    const EngineOptions& _options;
    const PlanBook& _plans;
    const Fleet& _fleet;
    const BlockBook& _blocks;
    const StoreBacklog& _backlog;
    const StartupBarrier& _startup;
    const RestartHold& _hold;
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

    /// Assigned plans first, then the queue in its order.
    [[nodiscard]] std::vector<WaitReason> GetWaitReasons() const;
    [[nodiscard]] std::optional<WaitReason> GetWaitReasonOrNull(std::string_view planID) const;
    /// Of a paused plan, or of an assigned plan whose robot makes no progress.
    [[nodiscard]] std::optional<WaitReason> DescribeBegunOrNull(const ActivePlan& plan) const;
    /// Of an available robot without a plan that waits on its way to its parking position or charger; empty: it does not.
    [[nodiscard]] std::string DescribeIdle(const Robot& robot) const;

private:
    /// By station: the first plan of the queue that uses it.
    using FirstPlans = std::map<std::string_view, const ActivePlan*>;

    [[nodiscard]] std::string DescribeHold() const;
    /// Why the plan is not assigned to the robot now.
    [[nodiscard]] std::optional<std::string> DescribeUnavailabilityOrNull(const ActivePlan& plan, const Robot& robot)
        const;
    [[nodiscard]] std::vector<RobotUnavailability> ListUnavailable(const ActivePlan& plan) const;
    /// Of a plan in the queue: what it waits for.
    [[nodiscard]] std::string DescribeWaiting(
        const ActivePlan& plan,
        bool bCanStart,
        const StationForecast& stations,
        const FirstPlans& firstPlans) const;
    /// Of a plan for which a robot is free.
    [[nodiscard]] std::string DescribeStart(
        const ActivePlan& plan,
        const StationForecast& stations,
        const FirstPlans& firstPlans) const;
    static void AddStations(const ActivePlan& plan, FirstPlans& firstPlans);
    /// Of a robot that waits to start its drive, or at the end of its base.
    [[nodiscard]] std::string DescribeStanding(const Robot& robot) const;
    /// Of the first station of the plan that is blocked.
    [[nodiscard]] const Block* FindBlockOrNull(const ActivePlan& plan) const;
    [[nodiscard]] std::string DescribeUnfree(const Robot& robot) const;
};

} // namespace ACS::Planning
