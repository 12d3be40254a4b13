#include "EngineSteps.hpp"
#include "Scenarios.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace ACS::AdapterTest
{

namespace
{

using EAnswer = JobChecker::EAnswer;

/// The robot has never received the job.
void RecoverUnknownJob(ScenarioRun& run)
{
    run.Crash();
    run.Restart();
    run.Command(run.MakeRecovery(run.MakeJob(0)));
    if (run.TryConnect() && TryAwaitJobEnd(run, ERule::JobAnswered))
    {
        run.PassTime(run.GetOptions().answerLimit);
    }
}

void RecoverUnknownJobOnline(ScenarioRun& run)
{
    run.Crash();
    run.Restart();
    if (!run.TryConnect())
    {
        return;
    }
    run.Command(run.MakeRecovery(run.MakeJob(0)));
    if (TryAwaitJobEnd(run, ERule::JobAnswered))
    {
        run.PassTime(run.GetOptions().answerLimit);
    }
}

/// The robot was disconnected when the job was commanded, so it has certainly not received it.
void RecoverUnsentJobAfter(ScenarioRun& run, std::size_t earlierJobs)
{
    run.SetLink(false);
    static_cast<void>(run.TryAwait([&run] { return !run.GetStates().IsOnline(); }, run.GetOptions().answerLimit));
    const Planning::StartJob job = run.MakeJob(earlierJobs);
    run.Command(job);
    run.PassTime(run.GetOptions().answerLimit / 10);
    if (run.GetTruth().bWorking || run.GetTruth().doneJobs > earlierJobs)
    {
        return; // a robot with several links, one of which is not lost
    }
    run.Crash();
    run.Restart();
    run.Command(run.MakeRecovery(job));
    run.PassTime(run.GetOptions().answerLimit / 10);
    run.SetLink(true);
    if (!run.TryConnect() || !TryAwaitJobEnd(run, ERule::JobAnswered))
    {
        return;
    }
    run.PassTime(run.GetOptions().answerLimit);
    if (run.GetTruth().doneJobs > earlierJobs)
    {
        run.AddFinding(ERule::RecoveryStartsNothing, "the robot has done a job that was only asked for.");
        return;
    }
    if (run.GetJobs().GetAnswer() == EAnswer::Unknown)
    {
        run.Command(job);
        static_cast<void>(TryFinishJob(run, job, ERule::JobAnswered));
    }
}

void RecoverUnsentJob(ScenarioRun& run)
{
    RecoverUnsentJobAfter(run, 0);
}

/// The robot shows the job before.
void RecoverUnsentSecondJob(ScenarioRun& run)
{
    const Planning::StartJob first = run.MakeJob(0);
    run.Command(first);
    if (TryFinishJob(run, first, ERule::JobAnswered))
    {
        RecoverUnsentJobAfter(run, 1);
    }
}

/// The ACS has lost the commands after the job, because its store failed. The robot shows the latest one only.
void RecoverEarlierJob(ScenarioRun& run)
{
    const Planning::StartJob first = run.MakeJob(0);
    run.Command(first);
    if (!TryFinishJob(run, first, ERule::JobAnswered))
    {
        return;
    }
    const Planning::StartJob second = run.MakeJob(1);
    run.Command(second);
    if (!TryFinishJob(run, second, ERule::JobAnswered))
    {
        return;
    }
    run.Crash();
    run.Restart();
    run.Command(run.MakeRecovery(first));
    if (run.TryConnect())
    {
        static_cast<void>(TryAwaitJobEnd(run, ERule::JobAnswered));
    }
}

} // namespace

void CrashInJob(ScenarioRun& run, const Disturbance& disturbance)
{
    const Planning::StartJob job = run.MakeJob(0);
    run.Command(job);
    run.PassTime(disturbance.after);
    run.Crash();
    run.PassTime(disturbance.lasts);
    run.Restart();
    run.Command(run.MakeRecovery(job)); // it comes before the connection
    if (!run.TryConnect() || !TryAwaitJobEnd(run, ERule::JobAnswered))
    {
        return;
    }
    run.PassTime(run.GetOptions().answerLimit); // a job that was reported as unknown may be done later
    const EAnswer answer = run.GetJobs().GetAnswer();
    if (answer == EAnswer::Unknown || answer == EAnswer::Rejected || answer == EAnswer::Interrupted)
    {
        Planning::StartJob repeated = job;
        repeated.commandID = answer == EAnswer::Interrupted ? run.MakeID() : job.commandID;
        run.Command(repeated);
        static_cast<void>(TryFinishJob(run, repeated, ERule::JobAnswered));
        run.PassTime(run.GetOptions().answerLimit);
    }
}

void CrashInDrive(ScenarioRun& run, const Disturbance& disturbance)
{
    run.Command(run.MakeDrive(run.GetOptions().route.nodes.size()));
    run.PassTime(disturbance.after);
    run.Crash();
    run.PassTime(disturbance.lasts);
    run.Restart();
    if (!run.TryConnect())
    {
        return;
    }
    run.PassTime(2 * run.GetOptions().answerLimit);
    const Planning::StateChanged* const stateOrNull = run.GetStates().GetStateOrNull();
    if (stateOrNull == nullptr || stateOrNull->bOccupied || run.GetTruth().bDriving)
    {
        return; // it completes its drive
    }
    run.GetStates().VerifyAtRest(run.GetTruth());
    if (run.GetTruth().nodeID != run.GetOptions().route.nodes.back().nodeID)
    {
        run.Command(run.MakeDrive(run.GetOptions().route.nodes.size()));
        static_cast<void>(TryAwaitDriveEnd(run, ERule::DriveAnswered));
    }
}

void AddRestartScenarios(std::vector<Scenario>& scenarios)
{
    scenarios.push_back({"recovery of a job that was never commanded", RecoverUnknownJob});
    scenarios.push_back({"recovery of such a job while connected", RecoverUnknownJobOnline});
    scenarios.push_back({"recovery of a job that was commanded while disconnected", RecoverUnsentJob});
    scenarios.push_back({"recovery of a second job that was commanded while disconnected", RecoverUnsentSecondJob});
    scenarios.push_back({"recovery of an earlier job", RecoverEarlierJob});
}

} // namespace ACS::AdapterTest
