#include "WorkChecker.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Simulation
{

WorkChecker::WorkChecker(Trace& trace, const Planning::SiteMap& site, EHandling handling)
    : _trace(trace),
      _floor(trace, site, handling)
{
}

void WorkChecker::NotePlan(const Protocol::ExecutionPlan& plan)
{
    _floor.NotePlan(plan);
    for (const Protocol::PlanStep& step : plan.steps)
    {
        for (const Protocol::PlanJob& job : step.jobs)
        {
            _named.emplace(plan.planID, job.jobID);
        }
    }
}

FloorChecker& WorkChecker::GetFloor() noexcept
{
    return _floor;
}

JobKey WorkChecker::MakeKey(const std::string& planID, std::int32_t stepNo, const std::string& jobID) const
{
    return {planID, stepNo, _named.contains({planID, jobID}) ? jobID : std::string()};
}

void WorkChecker::NoteCommand(const Planning::StartJob& job)
{
    _commands.emplace(job.commandID, job);
}

const Planning::StartJob* WorkChecker::FindCommandOrNull(const std::string& commandID) const
{
    const auto found = _commands.find(commandID);
    return found == _commands.end() ? nullptr : &found->second;
}

void WorkChecker::OnPlaced(const std::string& robotID, std::vector<std::string> nodeIDs)
{
    for (const auto& [other, taken] : _places)
    {
        for (const std::string& nodeID : nodeIDs)
        {
            if (other != robotID && std::ranges::find(taken, nodeID) != taken.end())
            {
                _trace.Violate("two robots on one node: {} enters {}, which {} occupies", robotID, nodeID, other);
            }
        }
    }
    _trace.Add("{} is at {}", robotID, fmt::join(nodeIDs, " > "));
    _places[robotID] = std::move(nodeIDs);
}

void WorkChecker::OnJobBegun(const std::string& robotID, const Planning::StartJob& job)
{
    _trace.Add("{} begins job {} of {} step {}", robotID, job.jobID, job.planID, job.stepNo);
    const JobKey key = MakeKey(job.planID, job.stepNo, job.jobID);
    JobTruth& truth = _jobs[key];
    if (++truth.begun > 1 + std::min<std::size_t>(truth.interrupted, 1) || truth.finished > 0)
    {
        _trace.Violate("job {} of plan {} step {} is executed twice", job.jobID, job.planID, job.stepNo);
    }
    _floor.OnJobBegun(robotID, key);
}

void WorkChecker::OnJobInterrupted(const std::string& robotID, const Planning::StartJob& job)
{
    _trace.Add("{} interrupts job {} of {}", robotID, job.jobID, job.planID);
    ++_jobs[MakeKey(job.planID, job.stepNo, job.jobID)].interrupted;
    _floor.OnJobEnded(robotID);
}

void WorkChecker::OnJobFinished(const std::string& robotID, const Planning::StartJob& job)
{
    _trace.Add("{} has done job {} of {}", robotID, job.jobID, job.planID);
    ++_jobs[MakeKey(job.planID, job.stepNo, job.jobID)].finished;
    _floor.OnJobEnded(robotID);
}

WorkChecker::JobTruth WorkChecker::GetTruth(const std::string& planID, std::int32_t stepNo, const std::string& jobID)
    const
{
    const JobKey key = MakeKey(planID, stepNo, jobID);
    const auto found = _jobs.find(key);
    JobTruth truth = found == _jobs.end() ? JobTruth{} : found->second;
    truth.bMoved = _floor.IsMoved(key);
    return truth;
}

} // namespace ACS::Simulation
