#pragma once

#include "dispatch/FreeRobots.hpp"
#include "dispatch/PortCheck.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Chooses the robot for a plan, and checks plans against what the robots can do (IJobCheck).
class Dispatcher
{
    /// The free robots among the candidates of a plan.
    struct Choice
    {
        std::vector<Robot*> left;     ///< Not judged yet.
        std::vector<Robot*> supposed; ///< Their record lacks a carrier that the plan takes from them.
        bool bAll = false;            ///< No candidate is busy or unsuitable, as far as they were judged.
    };

    const PlanAdmission& _admission;
    const PlanBook& _plans;
    const BlockBook& _blocks;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    const TrafficCoordinator& _coordinator;
    const Router& _router;
    PortCheck _ports;
    std::map<std::size_t, QueueKey> _kept; ///< By robot: the plan for which it is kept.

public:
    Dispatcher(EngineState& engine, const TrafficCoordinator& coordinator);

    /// The nearest robot that is free, can do the jobs and has suitable ports. Robots whose record has the carriers come before
    /// those where they are only assumed. The robot of the plan is not free: for a plan that has one, the robot that can take over.
    [[nodiscard]] Robot* FindNearestOrNull(ActivePlan& plan);
    /// As above, with the list of FreeRobots for the plan's candidates.
    [[nodiscard]] Robot* FindNearestOrNull(ActivePlan& plan, const std::vector<Robot*>& freeRobots);
    /// False: FindNearestOrNull finds none of these robots, because of a blocked station or of known rejections.
    [[nodiscard]] bool IsPromising(const ActivePlan& plan, const std::vector<Robot*>& freeRobots) const;
    [[nodiscard]] const PortCheck& GetPorts() const noexcept;
    /// Whether a route leads to the plan's first station, as if nothing was blocked.
    [[nodiscard]] bool HasWay(const ActivePlan& plan, const Robot& robot) const;
    /// Driving time to the plan's first station around the blocks; null without a route, or if the vehicle type has no dock there.
    [[nodiscard]] std::optional<double> GetTravelSecondsOrNull(const ActivePlan& plan, const Robot& robot) const;
    /// A pass over the queue begins: which robots it keeps is not known yet.
    void ForgetKeptRobots() noexcept;
    /// The free robot gets no plan in this pass because the plan is more urgent and waits for a station.
    void KeepRobot(const Robot& robot, const ActivePlan& plan);
    /// For which plan the last pass kept the robot from less urgent ones such as this plan; null: for none.
    [[nodiscard]] const ActivePlan* FindKeeperOrNull(const ActivePlan& plan, const Robot& robot) const;
    /// Unassigned plans are checked again when the robot is chosen. An assigned plan stays with its robot, whose adapter refuses
    /// the job.
    void OnJobCheck(Robot& robot, const JobCheckChanged& event);
    /// Why the robot rejects the first job of the plan that it rejects.
    [[nodiscard]] static std::optional<std::string> DescribeRejectionOrNull(const ActivePlan& plan, const Robot& robot);
    /// Rejections of disconnected robots do not count: they may be outdated.
    [[nodiscard]] bool IsRejectedByAll(const ActivePlan& plan) const;
    [[nodiscard]] std::string DescribeRejections(const ActivePlan& plan) const;

private:
    /// Whether a station of the plan is blocked, or its dock for this vehicle type.
    [[nodiscard]] bool IsBlocked(const ActivePlan& plan, std::string_view vehicleTypeID) const;
    /// Whether the robot has rejected a job of the plan and its check has not changed since.
    [[nodiscard]] static bool HasKnownRejection(const ActivePlan& plan, const Robot& robot);
    /// False: notes the robot among the supposed ones, or that not all are suitable.
    [[nodiscard]] bool IsKnownToHaveCarriers(const ActivePlan& plan, Robot& robot, Choice& choice) const;
    /// Leaves only robots that are known to have the carriers.
    void JudgeAll(const ActivePlan& plan, Choice& choice) const;
    [[nodiscard]] bool HasPorts(const ActivePlan& plan, const Robot& robot) const;
    /// Whether robots that cannot move leave the way free, and the robot rejects no job. Records a rejection.
    [[nodiscard]] bool CanExecute(ActivePlan& plan, const Robot& robot) const;
    /// Uses the router's cached times instead of a route search.
    [[nodiscard]] std::optional<double> FindTravelSecondsOrNull(
        const Router& router,
        const ActivePlan& plan,
        const Robot& robot) const;
    /// The robot with the quickest route to the plan's first station; null without a route.
    [[nodiscard]] Robot* FindQuickestOrNull(const ActivePlan& plan, const std::vector<Robot*>& robots) const;
};

} // namespace ACS::Planning
