#pragma once

#include "FloorChecker.hpp"
#include "Trace.hpp"
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

/// The real state of the robots: their positions and the jobs that they have done, independent of acsd.
class WorkChecker final
{
public:
    struct JobTruth
    {
        std::size_t begun = 0;
        std::size_t interrupted = 0; ///< Ended by a mode switch or a restart, before anything was moved.
        std::size_t finished = 0;
        bool bMoved = false; ///< What it moves is where the plan requires it, or was moved on from there.
    };

private:
    Trace& _trace;
    std::map<JobKey, JobTruth> _jobs;
    std::map<std::string, std::vector<std::string>> _places;
    std::set<std::pair<std::string, std::string>> _named; ///< planID and jobID of the jobs that the MCS has named.

    std::map<std::string, Planning::StartJob> _commands;
    FloorChecker _floor;

public:
    WorkChecker(Trace& trace, const Planning::SiteMap& site, EHandling handling);

    /// The MCS will send the plan.
    void NotePlan(const Protocol::ExecutionPlan& plan);

    /// acsd has sent the job under this commandID: identifies the job for a robot that knows only the commandID.
    void NoteCommand(const Planning::StartJob& job);
    [[nodiscard]] const Planning::StartJob* FindCommandOrNull(const std::string& commandID) const;

    /// The robot occupies these nodes: one, or both ends of its edge.
    void OnPlaced(const std::string& robotID, std::vector<std::string> nodeIDs);
    void OnJobBegun(const std::string& robotID, const Planning::StartJob& job);
    /// The robot has ended the job before it was done, without a fault: it may be executed once more.
    void OnJobInterrupted(const std::string& robotID, const Planning::StartJob& job);
    void OnJobFinished(const std::string& robotID, const Planning::StartJob& job);

    [[nodiscard]] FloorChecker& GetFloor() noexcept;

    /// The jobID of a step without jobs is ignored.
    [[nodiscard]] JobTruth GetTruth(const std::string& planID, std::int32_t stepNo, const std::string& jobID) const;

private:
    /// The engine makes up the job of a step without jobs, and its jobID has no meaning.
    [[nodiscard]] JobKey MakeKey(const std::string& planID, std::int32_t stepNo, const std::string& jobID) const;
};

} // namespace ACS::Simulation
