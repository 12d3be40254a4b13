#pragma once

#include "robot/Robot.hpp"
#include "traffic/RoutePlanner.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <vector>

namespace ACS::Planning
{

/// When a robot is expected at the station of a step, in seconds from now.
struct Visit
{
    double arrival = 0;
    double departure = 0; ///< Infinite: it cannot move.
};

/// Estimates when robots arrive at the stations of their plans and leave them: on quickest routes, with jobs that take the time of the
/// last ones there. Owns no data.
class VisitForecast
{
public:
    /// Of a plan, from its present one: where the robot drives, and where it drives next.
    static constexpr std::size_t STEPS = 2;

private:
    const PlanAdmission& _admission;
    const JobTimes& _jobTimes;
    const EngineTransaction& _transaction;
    const RoutePlanner& _routes;

public:
    VisitForecast(const EngineState& engine, const RoutePlanner& routes);

    /// Of the robot that has the plan, or is to have it: at the stations of the present step and the next ones, STEPS at most.
    [[nodiscard]] std::vector<Visit> ListVisits(const Robot& robot, const ActivePlan& plan) const;
    /// When the robot leaves the dock; 0: it is not on its way there, or is leaving it now; infinite: unknown.
    [[nodiscard]] double GetDeparture(const Robot& robot, std::size_t dock) const;
    /// 0 if there is no route.
    [[nodiscard]] double GetTravelSeconds(const Robot& robot, std::size_t from, std::size_t to) const;

private:
    /// Of the jobs of the step that have not ended.
    [[nodiscard]] double GetJobSeconds(const ActivePlan& plan, std::size_t step) const;
};

} // namespace ACS::Planning
