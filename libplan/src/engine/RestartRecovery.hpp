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

/// Restores robots and plans after a start, and waits for the robots' positions.
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

    void Restore(StoredState state);
    void UpdateStartup();
    void EndStartup();
    /// Section 9: silence from the start on is an alarm, too.
    void RaiseMissing();

private:
    /// The row of a robot that is no longer configured is kept in case the robot returns.
    void RestoreRobot(const RobotWorkChanged& work);
    void RestorePlan(PlanRecord record);
    /// The plan stays with its robot. The robot is asked for the outcome of an unfinished job; everything else resumes.
    void RestoreWork(ActivePlan& plan, Robot& robot);
    /// An outcome that was open is still owed, once; and what was paused stays so.
    void RestoreControl(ActivePlan& plan, Robot& robot);
    /// An alarm about a robot that was removed would never be cleared, and drives start again.
    void RestoreAlarms(std::vector<Alarm> alarms);
    /// Of a plan that is over.
    void RestoreOverdue(Robot& robot);
    /// What was planned does not fit what there is now. Where a robot had it, an alarm says where to look.
    void EndUnfit(ActivePlan& plan, const std::string& reason);
    void RequestJobOutcome(Robot& robot);
    /// Whether it has still to tell where it stands. One that is out of service may be switched off for days.
    [[nodiscard]] static bool IsPositionAwaited(const Robot& robot);
    void BeginStartup(bool bHasWork);
};

} // namespace ACS::Planning
