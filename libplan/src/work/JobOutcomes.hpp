#pragma once

#include "control/LoadWatch.hpp"
#include "transaction/EngineState.hpp"
#include "work/PlanWork.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// What robots report of their jobs.
class JobOutcomes
{
    EngineTransaction& _transaction;
    LoadWatch& _loads;
    PlanWork& _work;

public:
    JobOutcomes(EngineState& engine, LoadWatch& loads, PlanWork& work);

    void OnJobStarted(Robot& robot, const JobStarted& event);
    /// Its plan is over, but what it did to the robot's ports counts. The robot's word is as good as an operator's.
    [[nodiscard]] bool TryEndOverdueJob(Robot& robot, const std::string& jobID, bool bDone);
    /// The robot cannot be used until an operator resolves the job.
    void OnJobEndTimeout(Robot& robot);
    void OnJobFinished(Robot& robot, const JobFinished& event);
    void OnJobFailed(Robot& robot, const JobFailed& event);
    void OnJobTimeout(Robot& robot);
    void OnJobUnknown(Robot& robot, const JobUnknown& event);
    void OnJobUncertain(Robot& robot, const JobUncertain& event);
};

} // namespace ACS::Planning
