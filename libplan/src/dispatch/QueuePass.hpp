#pragma once

#include "dispatch/Dispatcher.hpp"
#include "dispatch/FreeRobots.hpp"
#include "dispatch/StationForecast.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace ACS::Planning
{

/// One pass over the queue: which plans begin now, and with which robots. The queue's order decides, except that a plan may be
/// overtaken within EngineOptions::queueOvertaking.
class QueuePass
{
public:
    struct Choice
    {
        ActivePlan& plan;
        Robot& robot;
    };

private:
    const PlanBook& _plans;
    const EngineOptions& _options;
    Dispatcher& _dispatcher;
    FreeRobots& _free;
    StationForecast _stations;
    std::vector<std::pair<const ActivePlan*, const Robot*>> _passedOver; ///< With the robots that they would have got.
    const ActivePlan* _lastOrNull = nullptr;                             ///< All plans up to this one are decided.
    std::size_t _searches = 0; ///< Number of plans for which a robot was looked for.
    std::size_t _taken = 0;    ///< Number of plans passed over although there was a robot.

public:
    /// All must outlive it.
    QueuePass(const EngineState& engine, const VisitForecast& visits, Dispatcher& dispatcher, FreeRobots& free);

    /// The next plan to begin. Its robot must have the plan (PlanAssignment::Offer) before the next call.
    [[nodiscard]] std::optional<Choice> FindNextOrNull();

private:
    /// The robot with which the plan can begin now; null: the plan is passed over.
    [[nodiscard]] Robot* FindRobotOrNull(ActivePlan& plan);
    /// A plan of another priority than this one does not get the robot of a plan that was passed over before it.
    void KeepRobots(const ActivePlan& plan);
    /// The first plan, or the one that overtakes it: whose first station is the nearest to the robot.
    [[nodiscard]] ActivePlan& ChoosePlan(ActivePlan& first, const Robot& robot);
    [[nodiscard]] bool CanOvertake(const ActivePlan& plan, const ActivePlan& first) const;
    /// Whether the plan can begin, and no other free robot is nearer to it.
    [[nodiscard]] bool IsBestWith(ActivePlan& plan, const Robot& robot);
    [[nodiscard]] std::int32_t GetPriority(const ActivePlan& plan) const;
};

} // namespace ACS::Planning
