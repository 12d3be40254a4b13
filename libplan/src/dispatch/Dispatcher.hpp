#pragma once

#include "dispatch/PortCheck.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Which robot gets a plan: the nearest of those that are free, can do its jobs and whose ports fit.
class Dispatcher
{
    const PlanAdmission& _admission;
    const PlanBook& _plans;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    const TrafficCoordinator& _coordinator;
    const Router& _router;
    PortCheck _ports;

public:
    Dispatcher(EngineState& engine, const TrafficCoordinator& coordinator);

    /// Of the robots that are free, can do the jobs and whose ports fit, the nearest; one that is known to have the carriers
    /// before one of which that is only supposed.
    [[nodiscard]] Robot* FindNearestOrNull(const ActivePlan& plan);
    [[nodiscard]] const PortCheck& GetPorts() const noexcept;
    /// To the plan's first place. By the times that the router keeps for it: the whole route of each robot would be searched
    /// for nothing.
    [[nodiscard]] bool HasWay(const ActivePlan& plan, const Robot& robot) const;
    /// A plan that a robot has stays with it: the adapter refuses its jobs itself.
    void OnJobCheck(Robot& robot, const JobCheckChanged& event);
    /// The plan's first job that the robot cannot do keeps the plan from the robot.
    void CheckJobs(ActivePlan& plan, const Robot& robot) const;
    /// What a robot that is out of reach would reject is not known for certain.
    [[nodiscard]] bool IsRejectedByAll(const ActivePlan& plan) const;
    [[nodiscard]] std::string DescribeRejections(const ActivePlan& plan) const;

private:
    /// Of these, the one with the shortest way to the plan's first place; null where none has a way.
    [[nodiscard]] Robot* FindQuickestOrNull(const ActivePlan& plan, const std::vector<Robot*>& robots) const;
};

} // namespace ACS::Planning
