#pragma once

#include "why/ExplanationView.hpp"
#include "why/WhyExplainer.hpp"
#include <acs/core/Timestamp.hpp>

#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsctl::Test
{

/// A line that works: no plan, one robot that is Idle.
class WhyFixture
{
public:
    SnapshotAnswer snapshot;
    SiteAnswer site;

    WhyFixture()
    {
        snapshot.status.bReady = true;
        snapshot.status.tsc = "Auto";
        AddRobot("LR01", "Idle");
    }

    RobotInfo& AddRobot(std::string id, std::string status)
    {
        RobotInfo& robot = snapshot.robots.emplace_back();
        robot.robotID = std::move(id);
        robot.status = std::move(status);
        return robot;
    }

    PlanInfo& AddPlan(std::string id, std::string status)
    {
        PlanInfo& plan = snapshot.plans.emplace_back();
        plan.planID = std::move(id);
        plan.status = std::move(status);
        return plan;
    }

    PlanInfo& AddWaitingPlan(std::string id, std::string message, std::vector<RobotReason> robots = {})
    {
        PlanInfo& plan = AddPlan(std::move(id), "Pending");
        plan.waits = WaitsInfo{std::move(message), "2026-11-27T23:05:00.000Z", 1, std::move(robots)};
        return plan;
    }

    [[nodiscard]] WhyExplainer Make() const
    {
        return {snapshot, site, Core::ParseTimestamp("2026-11-27T23:10:00.000Z")->time};
    }
};

inline AlarmInfo MakeAlarm(std::string robotID, std::string code, std::string title)
{
    AlarmInfo alarm;
    alarm.robotID = std::move(robotID);
    alarm.errorCode = std::move(code);
    alarm.level = "heavy";
    alarm.title = std::move(title);
    return alarm;
}

inline std::string PrintText(const Explanation& explanation)
{
    return PrintExplanation(explanation, {200, false});
}

} // namespace ACS::Acsctl::Test
