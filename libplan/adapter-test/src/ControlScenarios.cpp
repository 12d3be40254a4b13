#include "EngineSteps.hpp"
#include "Scenarios.hpp"

#include <cstddef>

namespace ACS::AdapterTest
{

namespace
{

[[nodiscard]] bool IsReportedPaused(ScenarioRun& run)
{
    const Planning::StateChanged* const stateOrNull = run.GetStates().GetStateOrNull();
    return stateOrNull != nullptr && stateOrNull->bPaused;
}

[[nodiscard]] bool IsReportedCharging(ScenarioRun& run)
{
    const Planning::StateChanged* const stateOrNull = run.GetStates().GetStateOrNull();
    return stateOrNull != nullptr && stateOrNull->bCharging;
}

/// Pauses the robot and has it stay so.
[[nodiscard]] bool TryPause(ScenarioRun& run)
{
    run.Command(Planning::Pause{});
    if (!run.TryAwait([&run] { return IsReportedPaused(run); }, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::PauseObeyed, "Pause was commanded, and bPaused is not reported.");
        return false;
    }
    return true;
}

void VerifyPaused(ScenarioRun& run)
{
    const auto moves = [&run] {
        const RobotTruth truth = run.GetTruth();
        return truth.bDriving || truth.bWorking || !IsReportedPaused(run);
    };
    if (run.TryAwait(moves, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::PauseObeyed, "the robot continues, or reports no bPaused, before Resume.");
    }
}

[[nodiscard]] bool TryResume(ScenarioRun& run)
{
    run.Command(Planning::Resume{});
    if (!run.TryAwait([&run] { return !IsReportedPaused(run); }, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::ResumeObeyed, "Resume was commanded, and bPaused is still reported.");
        return false;
    }
    return true;
}

/// The base is extended while the robot is paused.
void PauseDrive(ScenarioRun& run)
{
    const std::size_t count = run.GetOptions().route.nodes.size();
    const Planning::Drive drive = run.MakeDrive(count - 1);
    run.Command(drive);
    if (!TryAwaitDriving(run) || !TryPause(run))
    {
        return;
    }
    run.Command(Planning::ExtendDrive{drive.driveID, count});
    VerifyPaused(run);
    if (TryResume(run) && TryAwaitDriveEnd(run, ERule::ResumeObeyed))
    {
        VerifyAtRest(run);
    }
}

/// The engine repeats a Pause that the robot does not show after the connection.
void LoseLinkInPause(ScenarioRun& run)
{
    const std::size_t count = run.GetOptions().route.nodes.size();
    run.Command(run.MakeDrive(count));
    if (!TryAwaitDriving(run) || !TryPause(run))
    {
        return;
    }
    run.SetLink(false);
    run.PassTime(run.GetOptions().answerLimit);
    run.SetLink(true);
    if (!run.TryConnect() || (!IsReportedPaused(run) && !TryPause(run)))
    {
        return;
    }
    VerifyPaused(run);
    if (TryResume(run))
    {
        static_cast<void>(TryAwaitDriveEnd(run, ERule::ResumeObeyed));
    }
}

void PauseJob(ScenarioRun& run)
{
    const Planning::StartJob job = run.MakeJob(0);
    run.Command(job);
    if (!run.TryAwait([&run] { return run.GetTruth().bWorking; }, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::JobAnswered, "the robot does not begin the job.");
        return;
    }
    if (!TryPause(run))
    {
        return;
    }
    VerifyPaused(run);
    if (TryResume(run))
    {
        static_cast<void>(TryFinishJob(run, job, ERule::ResumeObeyed));
    }
}

[[nodiscard]] bool TryCharge(ScenarioRun& run)
{
    run.Command(Planning::StartCharging{});
    if (!run.TryAwait([&run] { return IsReportedCharging(run); }, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::ChargingReported, "StartCharging was commanded, and bCharging is not reported.");
        return false;
    }
    run.PassTime(run.GetOptions().answerLimit);
    run.Command(Planning::StopCharging{});
    return true;
}

void Charge(ScenarioRun& run)
{
    if (TryCharge(run) && !run.TryAwait([&run] { return !IsReportedCharging(run); }, run.GetOptions().answerLimit))
    {
        run.AddFinding(ERule::ChargingReported, "StopCharging was commanded, and bCharging is still reported.");
    }
}

/// The engine does not wait for the end of charging.
void DriveFromCharger(ScenarioRun& run)
{
    if (TryCharge(run) && run.GetOptions().bDrives)
    {
        static_cast<void>(TryDriveToEnd(run, ERule::DriveAnswered));
    }
}

} // namespace

void AddControlScenarios(std::vector<Scenario>& scenarios)
{
    constexpr const char* NO_PAUSE = "the robot does not pause drives";
    scenarios.push_back({"paused drive", PauseDrive, &BenchOptions::bPausesDrives, NO_PAUSE});
    scenarios.push_back({"link lost during a pause", LoseLinkInPause, &BenchOptions::bPausesDrives, NO_PAUSE});
    scenarios.push_back({"paused job", PauseJob, &BenchOptions::bPausesJobs, "the robot does not pause jobs"});
    scenarios.push_back({"charging", Charge, &BenchOptions::bCharges, "the robot does not charge"});
    scenarios.push_back(
        {"drive after charging", DriveFromCharger, &BenchOptions::bCharges, "the robot does not charge"});
}

} // namespace ACS::AdapterTest
