#include "EngineSteps.hpp"
#include "Scenarios.hpp"

#include <cstddef>
#include <string>

namespace ACS::AdapterTest
{

namespace
{

void DriveStepByStep(ScenarioRun& run)
{
    const std::size_t count = run.GetOptions().route.nodes.size();
    const Planning::Drive drive = run.MakeDrive(2);
    run.Command(drive);
    for (std::size_t released = 2; released < count; ++released)
    {
        const auto passed = [&run, released] {
            return run.GetDrives().GetPassedCount() >= released;
        };
        if (!run.TryAwait(passed, 2 * run.GetOptions().answerLimit))
        {
            run.AddFinding(ERule::DriveAnswered, "the robot does not reach the end of its base.");
            return;
        }
        run.PassTime(released == 2 ? run.GetOptions().answerLimit : Core::Duration::zero()); // it waits there
        run.Command(Planning::ExtendDrive{drive.driveID, released + 1});
    }
    if (TryAwaitDriveEnd(run, ERule::DriveAnswered))
    {
        VerifyAtRest(run);
        run.GetStates().VerifyEvidence();
    }
}

void DriveAtOnce(ScenarioRun& run)
{
    const Planning::Drive drive = run.MakeDrive(2);
    run.Command(drive);
    // Released before the robot can have accepted the drive.
    run.Command(Planning::ExtendDrive{drive.driveID, run.GetOptions().route.nodes.size()});
    if (TryAwaitDriveEnd(run, ERule::DriveAnswered))
    {
        VerifyAtRest(run);
    }
}

void CancelDrive(ScenarioRun& run)
{
    Planning::Drive drive = run.MakeDrive(run.GetOptions().route.nodes.size());
    run.Command(drive);
    if (!TryAwaitDriving(run))
    {
        return;
    }
    const std::size_t visited = run.GetDrives().GetVisited().size();
    run.Command(Planning::CancelDrive{drive.driveID});
    if (!TryAwaitDriveEnd(run, ERule::CancelStops))
    {
        return;
    }
    if (run.GetDrives().GetVisited().size() > visited + 1)
    {
        run.AddFinding(ERule::CancelStops, "the robot has passed more than one node after CancelDrive.");
    }
    VerifyAtRest(run);
    run.Command(run.MakeDrive(run.GetOptions().route.nodes.size()));
    static_cast<void>(TryAwaitDriveEnd(run, ERule::DriveAnswered));
}

/// The end of the drive and its cancellation cross: the engine has not processed the end yet.
void CancelDriveLate(ScenarioRun& run)
{
    Planning::Drive drive = run.MakeDrive(2);
    drive.route.nodes.resize(2);
    drive.route.edges.resize(1);
    run.Command(drive);
    if (!TryAwaitDriveEnd(run, ERule::DriveAnswered))
    {
        return;
    }
    run.Command(Planning::ExtendDrive{drive.driveID, 2});
    run.Command(Planning::CancelDrive{drive.driveID});
    static_cast<void>(TryDriveToEnd(run, ERule::LateCommandsIgnored));
}

void RefuseDrive(ScenarioRun& run)
{
    run.SetConduct(EConduct::Refuses);
    run.Command(run.MakeDrive(2));
    if (!TryAwaitDriveEnd(run, ERule::DriveAnswered))
    {
        return;
    }
    run.SetConduct(EConduct::Obeys);
    run.PassTime(std::chrono::seconds(1));
    static_cast<void>(TryDriveToEnd(run, ERule::DriveAnswered));
}

void DriveSlowly(ScenarioRun& run)
{
    run.SetConduct(EConduct::Slow);
    static_cast<void>(TryDriveToEnd(run, ERule::DriveAnswered));
}

void DriveWithRepeats(ScenarioRun& run)
{
    run.SetConduct(EConduct::Repeats);
    static_cast<void>(TryDriveToEnd(run, ERule::DriveAnswered));
}

} // namespace

void AddDriveScenarios(std::vector<Scenario>& scenarios)
{
    constexpr const char* NO_DRIVES = "the robot does not drive";
    scenarios.push_back({"drive that is released node by node", DriveStepByStep, &BenchOptions::bDrives, NO_DRIVES});
    scenarios.push_back({"drive that is released at once", DriveAtOnce, &BenchOptions::bDrives, NO_DRIVES});
    scenarios.push_back({"cancelled drive", CancelDrive, &BenchOptions::bDrives, NO_DRIVES});
    scenarios.push_back({"drive cancelled after its end", CancelDriveLate, &BenchOptions::bDrives, NO_DRIVES});
    scenarios.push_back({"refused drive", RefuseDrive, &BenchOptions::bRefuses, "the robot cannot refuse"});
    scenarios.push_back({"slow drive", DriveSlowly, &BenchOptions::bSlow, "the robot cannot be slow"});
    scenarios.push_back(
        {"drive with repeated messages", DriveWithRepeats, &BenchOptions::bRepeats, "no message is repeated"});
}

} // namespace ACS::AdapterTest
