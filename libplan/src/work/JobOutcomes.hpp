#pragma once

#include "control/LoadWatch.hpp"
#include "control/RejectionWatch.hpp"
#include "transaction/EngineState.hpp"
#include "work/PlanWork.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Handles what robots report of their jobs. Owns no data.
class JobOutcomes
{
    EngineTransaction& _transaction;
    LoadWatch& _loads;
    RejectionWatch& _rejections;
    PlanWork& _work;

public:
    JobOutcomes(EngineState& engine, LoadWatch& loads, RejectionWatch& rejections, PlanWork& work);

    void OnJobStarted(Robot& robot, const JobStarted& event);
    /// Ends a job whose plan has ended, by the robot's report or an operator. The moved carrier is recorded. False: no such job.
    [[nodiscard]] bool TryEndOverdueJob(Robot& robot, const std::string& jobID, bool bDone);
    /// The robot has not reported the end of an overdue job: an operator must resolve it.
    void OnJobEndTimeout(Robot& robot);
    void OnJobFinished(Robot& robot, const JobFinished& event);
    void OnJobFailed(Robot& robot, const JobFailed& event);
    /// The job has exceeded the time limit of its action: it is cancelled and the plan fails.
    void OnJobTimeout(Robot& robot);
    void OnJobRejected(Robot& robot, const JobRejected& event);
    void OnJobInterrupted(Robot& robot, const JobInterrupted& event);
    void OnJobUnknown(Robot& robot, const JobUnknown& event);
    void OnJobUnresolved(Robot& robot, const JobUnresolved& event);

private:
    /// The robot no longer has the job. After a restart it is then asked for a resolved job, unless this is the one.
    void EndAtRobot(Robot& robot, const std::string& jobID);
    /// The robot has the job, it is the present one of its plan, and no operator must resolve it.
    [[nodiscard]] static bool IsPresent(const Robot& robot, const std::string& jobID);
};

} // namespace ACS::Planning
