#include "EngineSteps.hpp"
#include "Scenarios.hpp"

#include <cstddef>

namespace ACS::AdapterTest
{

namespace
{

[[nodiscard]] bool TryDisconnect(ScenarioRun& run)
{
    run.SetLink(false);
    if (!run.TryAwait([&run] { return !run.GetStates().IsOnline(); }, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::LinkReported, "the link is cut, and no LinkChanged to offline was raised.");
        return false;
    }
    return true;
}

void LoseLink(ScenarioRun& run)
{
    if (!TryDisconnect(run))
    {
        return;
    }
    run.PassTime(run.GetOptions().answerLimit);
    run.SetLink(true);
    if (run.TryConnect())
    {
        VerifyAtRest(run);
    }
}

void CommandDriveOffline(ScenarioRun& run)
{
    if (!TryDisconnect(run))
    {
        return;
    }
    const std::size_t count = run.GetOptions().route.nodes.size();
    const Planning::Drive drive = run.MakeDrive(2);
    run.Command(drive);
    run.PassTime(run.GetOptions().answerLimit);
    run.Command(Planning::ExtendDrive{drive.driveID, count});
    run.PassTime(run.GetOptions().answerLimit);
    run.SetLink(true);
    if (run.TryConnect())
    {
        static_cast<void>(TryAwaitDriveEnd(run, ERule::CommandsKept));
    }
}

void CommandJobOffline(ScenarioRun& run)
{
    if (!TryDisconnect(run))
    {
        return;
    }
    const Planning::StartJob job = run.MakeJob(0);
    run.Command(job);
    run.PassTime(run.GetOptions().answerLimit);
    run.SetLink(true);
    if (run.TryConnect())
    {
        static_cast<void>(TryFinishJob(run, job, ERule::CommandsKept));
        run.PassTime(run.GetOptions().answerLimit);
    }
}

void CancelDriveOffline(ScenarioRun& run)
{
    const Planning::Drive drive = run.MakeDrive(run.GetOptions().route.nodes.size());
    run.Command(drive);
    if (!TryAwaitDriving(run) || !TryDisconnect(run))
    {
        return;
    }
    run.Command(Planning::CancelDrive{drive.driveID});
    run.SetLink(true);
    if (run.TryConnect())
    {
        static_cast<void>(TryAwaitDriveEnd(run, ERule::CommandsKept));
    }
}

void CancelJobOffline(ScenarioRun& run)
{
    const Planning::StartJob job = run.MakeJob(0);
    run.Command(job);
    static_cast<void>(run.TryAwait([&run] { return run.GetTruth().bWorking; }, run.GetOptions().answerLimit));
    if (!TryDisconnect(run))
    {
        return;
    }
    run.Command(Planning::CancelJob{job.jobID});
    run.SetLink(true);
    if (run.TryConnect() && TryAwaitJobEnd(run, ERule::CommandsKept))
    {
        run.PassTime(run.GetOptions().answerLimit);
    }
}

void Disturb(ScenarioRun& run, const Disturbance& disturbance)
{
    run.PassTime(disturbance.after);
    run.SetLink(false);
    run.PassTime(disturbance.lasts);
    run.SetLink(true);
}

} // namespace

void LoseLinkInJob(ScenarioRun& run, const Disturbance& disturbance)
{
    const Planning::StartJob job = run.MakeJob(0);
    run.Command(job);
    Disturb(run, disturbance);
    if (TryFinishJob(run, job, ERule::CommandsKept))
    {
        run.PassTime(run.GetOptions().answerLimit); // it may do the job again
    }
}

void LoseLinkInDrive(ScenarioRun& run, const Disturbance& disturbance)
{
    run.Command(run.MakeDrive(run.GetOptions().route.nodes.size()));
    Disturb(run, disturbance);
    if (TryAwaitDriveEnd(run, ERule::CommandsKept))
    {
        VerifyAtRest(run);
    }
}

void AddLinkScenarios(std::vector<Scenario>& scenarios)
{
    constexpr const char* NO_DRIVES = "the robot does not drive";
    scenarios.push_back({"link lost and restored", LoseLink});
    scenarios.push_back({"drive commanded while disconnected", CommandDriveOffline, &BenchOptions::bDrives, NO_DRIVES});
    scenarios.push_back({"job commanded while disconnected", CommandJobOffline});
    scenarios.push_back({"drive cancelled while disconnected", CancelDriveOffline, &BenchOptions::bDrives, NO_DRIVES});
    scenarios.push_back({"job cancelled while disconnected", CancelJobOffline});
}

} // namespace ACS::AdapterTest
