#pragma once

#include "plan/PlanAdmission.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/IJobCheck.hpp>
#include <acs/plan/PlanRecord.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

namespace ACS::Planning
{

/// The lower rank first, then the order of acceptance.
struct QueueKey
{
    std::int64_t rank = 0;
    std::uint64_t sequence = 0;

    bool operator<(const QueueKey& other) const noexcept
    {
        return std::tie(rank, sequence) < std::tie(other.rank, other.sequence);
    }
};

/// What an assigned plan continues with.
enum class EContinuation : std::uint8_t
{
    Job,  ///< The present job of the present step.
    Step, ///< The present step, which is not begun.
    End,  ///< All steps are done: the end is reported when the pause ends.
};

/// The present job is commanded again.
struct JobRepetition
{
    std::string commandID;     ///< Of a job that the robot never had: it is sent again with it. Empty: another one.
    bool bInterrupted = false; ///< The robot has interrupted the job before. It is repeated only once.
};

/// Why a robot cannot do a job of a plan. Outdated when the robot has another check.
struct JobRejection
{
    std::shared_ptr<const IJobCheck> check; ///< That rejected it.
    std::string reason;
};

/// A robot that can do all jobs of a plan: one is kept, so that a plan that waits is not checked again and again. Outdated when
/// the robot has another check.
struct JobAcceptance
{
    std::shared_ptr<const IJobCheck> check; ///< That accepted them; null: none yet.
    std::size_t robot = 0;
};

/// What is known of the robots and the jobs of a plan.
struct JobVerdicts
{
    std::map<std::size_t, JobRejection> rejections; ///< By robot, of those that were to have the plan.
    mutable JobAcceptance acceptance;
};

/// Of the present job.
struct JobClock
{
    std::optional<Core::SteadyTime> begunAt; ///< When it was commanded.
    std::optional<Core::SteadyTime> deadline;
    std::optional<Core::Duration> timeLeft; ///< While it is paused.
};

/// A plan that is not finished.
struct ActivePlan
{
    PlanRecord record;
    ResolvedPlan resolved;
    QueueKey key;
    std::size_t step = 0;
    std::size_t job = 0;
    EContinuation next = EContinuation::Job;
    std::string madeJobID; ///< Of a step without jobs.
    std::optional<std::size_t> robot;
    bool bStepArrived = false; ///< Arrival was reported for the present step and its drive.
    bool bJobBegun = false;    ///< Any of its jobs.
    bool bUnstored = false;    ///< Its start is not stored yet: the first job waits for that.
    JobRepetition repetition;
    JobClock jobClock;
    JobVerdicts verdicts;
};

/// Whether it has a robot that has not accepted its first command yet.
[[nodiscard]] bool IsOffered(const ActivePlan& plan);
/// Whether the present step has jobs. Without them the engine makes one, whose id the MCS does not know.
[[nodiscard]] bool HasJob(const ActivePlan& plan);
/// Of the present job.
[[nodiscard]] const std::string& GetJobID(const ActivePlan& plan);
/// State of the present job; Pending of a step without jobs.
[[nodiscard]] EJobState GetJobState(const ActivePlan& plan);
[[nodiscard]] std::optional<std::size_t> FindStepOrNull(const Plan& plan, std::int32_t stepNo);
/// The first step from this one on that is not in a final state.
[[nodiscard]] std::optional<std::size_t> FindOpenStepOrNull(const ActivePlan& plan, std::size_t from);
/// Sets the present step and job: the first ones that are not in a final state.
void FindPosition(ActivePlan& plan);

} // namespace ACS::Planning
