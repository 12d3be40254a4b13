#pragma once

#include "api/ApiTypes.hpp"
#include "why/BlockedPlaces.hpp"
#include "why/Explanation.hpp"
#include <acs/core/Now.hpp>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsctl
{

/// Explains why plans and robots do not move, from one snapshot of acsd and its blocked places.
class WhyExplainer final
{
    const SnapshotAnswer& _snapshot;
    const SiteAnswer& _site;
    BlockedPlaces _places;
    Core::WallTime _now;

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
    /// Plans and robots of a chain that are explained already.
    struct Chain
    {
        std::vector<Cause> causes;
        std::set<std::string> plans;
        std::set<std::string> robots;
        std::set<std::string> blocks;
    };

    [[nodiscard]] Finding MakePlanFinding(const PlanInfo& plan) const;
    [[nodiscard]] Finding MakeRobotFinding(const RobotInfo& robot) const;
    [[nodiscard]] std::vector<Cause> ListCausesOfACSD() const;
    void AddLinks(std::size_t depth, std::vector<Cause>& causes) const;
    /// The last report that the MCS has refused; with a planID only if it is of that plan.
    void AddRefusedReport(std::string_view planID, std::vector<Cause>& causes) const;
    void AddTSC(std::size_t depth, std::vector<Cause>& causes) const;
    void AddPlanRecursive(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    void AddRobotOfPlanRecursive(const std::string& robotID, const std::string& reason, std::size_t depth, Chain& chain)
        const;
    static void AddState(const RobotInfo& robot, std::size_t depth, std::vector<Cause>& causes);
    /// Its alarms and the blocked places on its route.
    void AddRobot(const RobotInfo& robot, std::size_t depth, Chain& chain) const;
    void AddAlarms(std::string_view robotID, std::size_t depth, std::vector<Cause>& causes) const;
    /// The alarm of acsd that its store fails: plans are not started, and reports wait.
    void AddStoreAlarm(std::vector<Cause>& causes) const;
    void AddUnresolvedJobs(const PlanInfo& plan, std::size_t depth, std::vector<Cause>& causes) const;
    void AddBlocksOfPlan(const PlanInfo& plan, std::size_t depth, Chain& chain) const;
    void AddBlocksOfRoute(const RobotInfo& robot, std::size_t depth, Chain& chain) const;
    void AddBlock(const BlockInfo& block, std::size_t depth, Chain& chain) const;
    [[nodiscard]] Cause MakeAlarmCause(const AlarmInfo& alarm, std::size_t depth) const;
};

} // namespace ACS::Acsctl
