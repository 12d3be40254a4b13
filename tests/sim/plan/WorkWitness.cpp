#include "WorkWitness.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Simulation
{

void WorkWitness::NoteNamed(const std::string& planID, const std::string& jobID)
{
    _named.emplace(planID, jobID);
}

WorkWitness::JobKey WorkWitness::MakeKey(const std::string& planID, std::int32_t stepNo, const std::string& jobID) const
{
    return {planID, stepNo, _named.contains({planID, jobID}) ? jobID : std::string()};
}

void WorkWitness::NoteCommand(const Planning::StartJob& job)
{
    _commands.emplace(job.commandID, job);
}

const Planning::StartJob* WorkWitness::FindCommandOrNull(const std::string& commandID) const
{
    const auto found = _commands.find(commandID);
    return found == _commands.end() ? nullptr : &found->second;
}

void WorkWitness::OnPlaced(const std::string& robotID, std::vector<std::string> nodeIDs)
{
    for (const auto& [other, taken] : _places)
    {
        for (const std::string& nodeID : nodeIDs)
        {
            if (other != robotID && std::ranges::find(taken, nodeID) != taken.end())
            {
                _trace.Violate("two robots in one place: {} comes to {}, where {} is", robotID, nodeID, other);
            }
        }
    }
    _trace.Tell("{} is at {}", robotID, fmt::join(nodeIDs, " > "));
    _places[robotID] = std::move(nodeIDs);
}

void WorkWitness::OnJobBegun(const std::string& robotID, const Planning::StartJob& job)
{
    _trace.Tell("{} begins job {} of {} step {}", robotID, job.jobID, job.planID, job.stepNo);
    if (++_jobs[MakeKey(job.planID, job.stepNo, job.jobID)].begun > 1)
    {
        _trace.Violate("job {} of {} step {} is executed twice", job.jobID, job.planID, job.stepNo);
    }
}

void WorkWitness::OnJobFinished(const std::string& robotID, const Planning::StartJob& job)
{
    _trace.Tell("{} has done job {} of {}", robotID, job.jobID, job.planID);
    ++_jobs[MakeKey(job.planID, job.stepNo, job.jobID)].finished;
}

WorkWitness::JobTruth WorkWitness::GetTruth(const std::string& planID, std::int32_t stepNo, const std::string& jobID)
    const
{
    const auto found = _jobs.find(MakeKey(planID, stepNo, jobID));
    return found == _jobs.end() ? JobTruth{} : found->second;
}

} // namespace ACS::Simulation
