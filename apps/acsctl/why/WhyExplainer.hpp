#pragma once

#include "api/ApiTypes.hpp"
#include "why/BlockedPlaces.hpp"
#include "why/Explanation.hpp"
#include <acs/core/Now.hpp>

#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

/// Explains why plans and robots do not move, from one snapshot of acsd and its blocked places. Each plan, robot, alarm and blocked
/// place is explained once; after that a line refers to it. The number of causes is thus bounded by the size of the snapshot.
class WhyExplainer final
{
    const SnapshotAnswer& _snapshot;
    const SiteAnswer& _site;
    BlockedPlaces _places;
    Core::WallTime _now;
    std::map<std::string_view, const PlanInfo*> _plans;
    std::map<std::string_view, const RobotInfo*> _robots;

public:
    /// Both answers must outlive it.
    WhyExplainer(const SnapshotAnswer& snapshot, const SiteAnswer& site, Core::WallTime now);

    /// Everything that does not move; acsd itself first. If all moves, one finding states this.
    [[nodiscard]] Explanation ExplainAll() const;

    /// One plan, which may be finished.
    [[nodiscard]] Explanation ExplainPlan(const PlanInfo& plan) const;
    [[nodiscard]] Explanation ExplainRobot(const RobotInfo& robot) const;

    /// nullptr: not in the snapshot.
    [[nodiscard]] const PlanInfo* FindPlanOrNull(std::string_view planID) const;
    [[nodiscard]] const RobotInfo* FindRobotOrNull(std::string_view robotID) const;

private:
    /// No cause of the list.
    static constexpr std::size_t NO_CAUSE = std::numeric_limits<std::size_t>::max();

    /// What an explanation has explained already, and the causes of its current finding.
    struct Chain
    {
        std::vector<Cause> causes;
        std::set<std::string> plans;
        std::map<std::string, bool> robots; ///< Whether it has causes of its own.
        std::set<std::string> blocks;
        std::set<std::string> named; ///< Blocks that the current finding has.
        std::set<const AlarmInfo*> alarms;
        std::map<std::string, std::string> lists; ///< The reasons of the robots of a plan, and that plan.
        bool bTSC = false;
    };

    /// The causes of the finding, which is complete.
    [[nodiscard]] static std::vector<Cause> TakeCauses(Chain& chain);
    [[nodiscard]] Finding MakePlanFinding(const PlanInfo& plan, Chain& chain) const;
    /// Its own causes and those of its plan. Leaves them in the chain.
    void AddCausesOfRobot(const RobotInfo& robot, Chain& chain) const;
    /// Takes the causes of the chain; with one the robot needs attention.
    [[nodiscard]] static Finding MakeRobotFinding(const RobotInfo& robot, Chain& chain);
    /// Leaves them in the chain.
    void AddCausesOfACSD(Chain& chain) const;
    void AddLinks(std::size_t depth, std::vector<Cause>& causes) const;
    /// The last report that the MCS has refused; with a planID only if it is of that plan.
    void AddRefusedReport(std::string_view planID, std::vector<Cause>& causes) const;
    void AddTSC(std::size_t depth, Chain& chain) const;
    void AddPlanRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    /// Its pause and its wait reason. Returns the cause that has the wait reason, or NO_CAUSE.
    std::size_t AddWaits(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    /// The cause `stated` is its wait reason, which may be about its robot.
    void AddRobotsOfPlanRecursive(const PlanInfo& plan, std::size_t stated, std::size_t depth, Chain& chain) const;
    /// The robots that its wait reason names, such as those that block its robot.
    void AddNamedRobotsRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    /// The robots that the reason of a robot without a plan names.
    void AddNamedRobots(const RobotInfo& robot, Chain& chain) const;
    /// A robot that could execute the plan, or that it waits for. Without a planID it is a robot without a plan that waits.
    void AddRobotOfPlanRecursive(std::string_view planID, const RobotReason& reason, std::size_t depth, Chain& chain)
        const;
    /// The plan of the robot that another plan waits for.
    void AddOtherPlanRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    [[nodiscard]] std::vector<const RobotInfo*> ListNamedRobots(std::string_view text) const;
    /// Its plan, if that plan does not move either; nullptr otherwise.
    [[nodiscard]] const PlanInfo* FindStoppedPlanOrNull(const RobotInfo& robot) const;
    static void AddState(const RobotInfo& robot, std::size_t depth, std::vector<Cause>& causes);
    /// Its alarms, the blocked places on its route and its maintenance. The cause `stated` has its state; NO_CAUSE: none has.
    void AddRobot(const RobotInfo& robot, std::size_t stated, std::size_t depth, Chain& chain) const;
    void AddAlarms(std::string_view robotID, std::size_t depth, Chain& chain) const;
    void AddAlarm(const AlarmInfo& alarm, std::size_t depth, Chain& chain) const;
    /// The alarm of acsd that its store fails: plans are not started, and reports wait.
    void AddStoreAlarm(Chain& chain) const;
    void AddUnresolvedJobs(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    void AddBlocksOfPlan(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    void AddBlocksOfRoute(const RobotInfo& robot, std::size_t depth, Chain& chain) const;
    void AddBlock(const BlockInfo& block, std::size_t depth, Chain& chain) const;
    [[nodiscard]] Cause MakeAlarmCause(const AlarmInfo& alarm, std::size_t depth) const;
};

} // namespace ACS::Acsctl
