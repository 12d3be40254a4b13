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

/// The robots' own truth: where they are and which jobs they have really done. Nothing that acsd believes enters here.
class WorkChecker final
{
public:
    struct JobTruth
    {
        std::size_t begun = 0;
        std::size_t finished = 0;
        bool bMoved = false; ///< What it moves is where the plan demanded, or was brought on from there.
    };

private:
    Trace& _trace;
    std::map<JobKey, JobTruth> _jobs;
    std::map<std::string, std::vector<std::string>> _places;
    std::set<std::pair<std::string, std::string>> _named; ///< planID and jobID of what the MCS has called a job.

    std::map<std::string, Planning::StartJob> _commands;
    FloorChecker _floor;

public:
    WorkChecker(Trace& trace, const Planning::SiteMap& site, EHandling handling);

    /// The MCS is about to send the plan.
    void NotePlan(const Protocol::ExecutionPlan& plan);

    /// Under this commandID acsd has sent the job: a robot that knows no more than that can be understood.
    void NoteCommand(const Planning::StartJob& job);
    [[nodiscard]] const Planning::StartJob* FindCommandOrNull(const std::string& commandID) const;

    /// The robot takes these nodes: one, or both ends of the edge on which it is.
    void OnPlaced(const std::string& robotID, std::vector<std::string> nodeIDs);
    void OnJobBegun(const std::string& robotID, const Planning::StartJob& job);
    void OnJobFinished(const std::string& robotID, const Planning::StartJob& job);

    [[nodiscard]] FloorChecker& GetFloor() noexcept;

    /// Of a step without jobs the jobID does not matter.
    [[nodiscard]] JobTruth GetTruth(const std::string& planID, std::int32_t stepNo, const std::string& jobID) const;

private:
    /// A step without jobs has one that the engine makes up: its jobID says nothing.
    [[nodiscard]] JobKey MakeKey(const std::string& planID, std::int32_t stepNo, const std::string& jobID) const;
};

} // namespace ACS::Simulation
