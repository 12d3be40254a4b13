#include "EngineSteps.hpp"
#include "Scenarios.hpp"

#include <chrono>

namespace ACS::AdapterTest
{

namespace
{

using EAnswer = JobChecker::EAnswer;

/// A robot that obeys does the job.
[[nodiscard]] bool TryDoJob(ScenarioRun& run, const Planning::StartJob& job)
{
    run.Command(job);
    if (!TryFinishJob(run, job, ERule::JobAnswered))
    {
        return false;
    }
    if (run.GetJobs().GetAnswer() != EAnswer::Finished)
    {
        run.AddFinding(ERule::JobAnswered, "a job that the robot can do has ended without JobFinished.");
        return false;
    }
    return true;
}

void DoJobs(ScenarioRun& run)
{
    if (TryDoJob(run, run.MakeJob(0)))
    {
        VerifyAtRest(run);
        run.GetStates().VerifyEvidence();
        static_cast<void>(TryDoJob(run, run.MakeJob(1)));
    }
}

void DoJobAndDrive(ScenarioRun& run)
{
    if (TryDoJob(run, run.MakeJob(0)))
    {
        static_cast<void>(TryDriveToEnd(run, ERule::DriveAnswered));
    }
}

/// The MCS may use a jobID again in another plan.
void RepeatJobID(ScenarioRun& run)
{
    const Planning::StartJob first = run.MakeJob(0);
    if (!TryDoJob(run, first))
    {
        return;
    }
    Planning::StartJob second = run.MakeJob(1);
    second.planID = "plan-2";
    second.jobID = first.jobID;
    static_cast<void>(TryDoJob(run, second));
}

void RefuseJob(ScenarioRun& run)
{
    run.SetConduct(EConduct::Refuses);
    const Planning::StartJob job = run.MakeJob(0);
    run.Command(job);
    if (!TryAwaitJobEnd(run, ERule::JobAnswered))
    {
        return;
    }
    if (run.GetJobs().GetAnswer() != EAnswer::Rejected)
    {
        run.AddFinding(ERule::JobAnswered, "the robot has refused the job, and JobRejected was not raised.");
        return;
    }
    run.PassTime(run.GetOptions().answerLimit);
    run.SetConduct(EConduct::Obeys);
    static_cast<void>(TryDoJob(run, job)); // with the same commandID
}

void FailJob(ScenarioRun& run)
{
    run.SetConduct(EConduct::Fails);
    run.Command(run.MakeJob(0));
    if (TryAwaitJobEnd(run, ERule::JobAnswered))
    {
        VerifyAtRest(run);
    }
}

void DoJobSlowly(ScenarioRun& run)
{
    run.SetConduct(EConduct::Slow);
    static_cast<void>(TryDoJob(run, run.MakeJob(0)));
    run.PassTime(run.GetOptions().answerLimit);
}

void DoJobWithRepeats(ScenarioRun& run)
{
    run.SetConduct(EConduct::Repeats);
    if (TryDoJob(run, run.MakeJob(0)))
    {
        run.PassTime(run.GetOptions().answerLimit);
        static_cast<void>(TryDoJob(run, run.MakeJob(1)));
    }
}

void CancelJob(ScenarioRun& run)
{
    const Planning::StartJob job = run.MakeJob(0);
    run.Command(job);
    if (!run.TryAwait([&run] { return run.GetTruth().bWorking; }, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::JobAnswered, "the robot does not begin the job.");
        return;
    }
    run.Command(Planning::CancelJob{job.jobID});
    if (!TryAwaitJobEnd(run, ERule::CancelJobAnswered))
    {
        return;
    }
    const EAnswer answer = run.GetJobs().GetAnswer();
    if (answer == EAnswer::Finished && run.GetOptions().bCancelsJobs)
    {
        run.AddFinding(ERule::CancelJobAnswered, "the robot has finished the job, although it was cancelled early.");
    }
    else if (answer != EAnswer::Finished && answer != EAnswer::Failed && answer != EAnswer::Unresolved)
    {
        run.AddFinding(ERule::CancelJobAnswered, "the job was ended by an event that makes the engine repeat it.");
    }
    run.PassTime(run.GetOptions().answerLimit);
}

void CancelJobLate(ScenarioRun& run)
{
    const Planning::StartJob job = run.MakeJob(0);
    if (!TryDoJob(run, job))
    {
        return;
    }
    run.Command(Planning::CancelJob{job.jobID});
    run.PassTime(std::chrono::seconds(1));
    const Planning::StartJob next = run.MakeJob(1);
    run.Command(next);
    if (TryFinishJob(run, next, ERule::LateCommandsIgnored) && run.GetJobs().GetAnswer() != EAnswer::Finished)
    {
        run.AddFinding(ERule::LateCommandsIgnored, "CancelJob of a job that has ended has cancelled the next one.");
    }
}

} // namespace

void AddJobScenarios(std::vector<Scenario>& scenarios)
{
    scenarios.push_back({"two jobs", DoJobs});
    scenarios.push_back({"job and drive", DoJobAndDrive, &BenchOptions::bDrives, "the robot does not drive"});
    scenarios.push_back({"two jobs with the same jobID", RepeatJobID});
    scenarios.push_back({"refused job", RefuseJob, &BenchOptions::bRefuses, "the robot cannot refuse"});
    scenarios.push_back({"failed job", FailJob, &BenchOptions::bFails, "no job can fail"});
    scenarios.push_back({"slow job", DoJobSlowly, &BenchOptions::bSlow, "the robot cannot be slow"});
    scenarios.push_back(
        {"jobs with repeated messages", DoJobWithRepeats, &BenchOptions::bRepeats, "no message is repeated"});
    scenarios.push_back({"cancelled job", CancelJob});
    scenarios.push_back({"job cancelled after its end", CancelJobLate});
}

} // namespace ACS::AdapterTest
