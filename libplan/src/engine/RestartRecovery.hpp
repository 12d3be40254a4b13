#pragma once

#include "control/ControlAnswers.hpp"
#include "control/TscControl.hpp"
#include "dispatch/StatusPublisher.hpp"
#include "traffic/PlaceTracker.hpp"
#include "transaction/EngineState.hpp"
#include "work/PlanWork.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Restores robots, plans, controls and alarms after a start, and ends the startup barrier. Owns no data.
class RestartRecovery
{
    const EngineOptions& _options;
    const SiteMap& _site;
    const PlanAdmission& _admission;
    PlanBook& _plans;
    Fleet& _fleet;
    AlarmBook& _alarms;
    ReportOutbox& _outbox;
    EngineTransaction& _transaction;
    StoreBacklog& _backlog;
    StartupBarrier& _startup;
    RestartHold& _hold;
    TscControl& _tsc;
    ControlAnswers& _answers;
    PlaceTracker& _places;
    StatusPublisher& _status;
    PlanWork& _work;

public:
    RestartRecovery(
        EngineState& engine,
        TscControl& tsc,
        ControlAnswers& answers,
        PlaceTracker& places,
        StatusPublisher& status,
        PlanWork& work);

    /// Restores the stored state; called once, before all else.
    void Restore(StoredState state);
    /// Ends the startup barrier once all robots have reported their positions.
    void UpdateStartup();
    /// The time limit has expired: ends the startup barrier and raises an alarm for each robot that has not reported.
    void OnStartupDue();

private:
    /// The barrier ends: all positions are known, or the time limit has expired.
    void EndStartup();
    void RaiseMissing();
    /// Carriers whose ports are no longer configured raise ACS-1004.
    void RestoreCarriers(const CarriersChanged& stored);
    /// The row of a robot that is no longer configured is kept in case the robot returns.
    void RestoreRobot(const RobotWorkChanged& work);
    void RestorePlan(PlanRecord record);
    /// The plan stays with its robot. The robot is asked for the outcome of an unfinished job; everything else is resumed.
    void RestoreWork(ActivePlan& plan, Robot& robot);
    /// An open control still gets its result, and a paused plan stays paused.
    void RestoreControl(ActivePlan& plan, Robot& robot);
    /// Clears alarms of robots that are no longer configured, and of stalled drives, which start again.
    void RestoreAlarms(std::vector<Alarm> alarms);
    /// Restores a job whose plan has ended, or that an operator has resolved.
    void RestoreOverdue(Robot& robot);
    /// Ends a plan that no longer fits the site or the robots, with an alarm if a robot had it.
    void EndUnfit(ActivePlan& plan, const std::string& reason);
    void RequestJobOutcome(Robot& robot);
    /// Whether the robot has not reported its position. Robots in maintenance may be off for days and are not awaited.
    [[nodiscard]] static bool IsPositionAwaited(const Robot& robot);
    void BeginStartup(bool bHasWork);
};

} // namespace ACS::Planning
