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

/// Chooses the robot for a plan, and checks plans against what the robots can do (IJobCheck).
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

    /// The nearest robot that is free, can do the jobs and has suitable ports. Robots whose record has the carriers come before
    /// those where they are only assumed.
    [[nodiscard]] Robot* FindNearestOrNull(const ActivePlan& plan);
    /// The nearest robot that can take over a plan from its robot, which is not free.
    [[nodiscard]] Robot* FindSuccessorOrNull(ActivePlan& plan);
    [[nodiscard]] const PortCheck& GetPorts() const noexcept;
    /// Whether a route leads to the plan's first station. Uses the router's cached times instead of a route search.
    [[nodiscard]] bool HasWay(const ActivePlan& plan, const Robot& robot) const;
    /// Checks the unassigned plans again. An assigned plan stays with its robot, whose adapter refuses the job.
    void OnJobCheck(Robot& robot, const JobCheckChanged& event);
    /// Records the first job of the plan that the robot rejects.
    static void CheckJobs(ActivePlan& plan, const Robot& robot);
    /// Rejections of disconnected robots do not count: they may be outdated.
    [[nodiscard]] bool IsRejectedByAll(const ActivePlan& plan) const;
    [[nodiscard]] std::string DescribeRejections(const ActivePlan& plan) const;

private:
    /// The robot with the quickest route to the plan's first station; null without a route.
    [[nodiscard]] Robot* FindQuickestOrNull(const ActivePlan& plan, const std::vector<Robot*>& robots) const;
};

} // namespace ACS::Planning
