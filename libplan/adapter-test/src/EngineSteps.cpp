#include "EngineSteps.hpp"

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace ACS::AdapterTest
{

namespace
{

using EAnswer = JobChecker::EAnswer;

/// A robot that rejects, interrupts or loses a job more often has no end in sight.
constexpr std::size_t MAXIMUM_COMMANDS = 20;

[[nodiscard]] bool IsToBeRepeated(EAnswer answer)
{
    return answer == EAnswer::Rejected || answer == EAnswer::Unknown || answer == EAnswer::Interrupted;
}

} // namespace

bool TryAwaitJobEnd(ScenarioRun& run, ERule rule)
{
    if (run.TryAwait([&run] { return run.GetJobs().HasEnded(); }, 2 * run.GetOptions().answerLimit))
    {
        return true;
    }
    const bool bStarted = run.GetJobs().GetAnswer() == EAnswer::Started;
    run.AddFinding(rule, bStarted ? "JobStarted was raised, and no end of the job." : "the job was not answered.");
    return false;
}

bool TryFinishJob(ScenarioRun& run, Planning::StartJob job, ERule rule)
{
    for (std::size_t count = 0; count < MAXIMUM_COMMANDS; ++count)
    {
        if (!TryAwaitJobEnd(run, rule))
        {
            return false;
        }
        const EAnswer answer = run.GetJobs().GetAnswer();
        if (!IsToBeRepeated(answer))
        {
            return true;
        }
        run.PassTime(std::chrono::seconds(1));
        job.commandID = answer == EAnswer::Interrupted ? run.MakeID() : job.commandID;
        run.Command(job);
    }
    run.AddFinding(
        rule,
        "the job is not executed, however often it is commanded: " + run.GetJobs().GetLastText() + ".");
    return false;
}

bool TryAwaitDriveEnd(ScenarioRun& run, ERule rule)
{
    const auto edges = static_cast<int>(run.GetOptions().route.edges.size());
    const Core::Duration limit = (1 + edges) * run.GetOptions().answerLimit;
    if (run.TryAwait([&run] { return run.GetDrives().GetEnd() != DriveChecker::EEnd::Open; }, limit))
    {
        return true;
    }
    run.AddFinding(
        rule,
        run.GetDrives().GetPassedCount() == 0 ? "the drive was not answered." : "the drive has no end.");
    return false;
}

bool TryDriveToEnd(ScenarioRun& run, ERule rule)
{
    run.Command(run.MakeDrive(run.GetOptions().route.nodes.size()));
    if (!TryAwaitDriveEnd(run, rule))
    {
        return false;
    }
    if (run.GetDrives().GetEnd() != DriveChecker::EEnd::Arrived)
    {
        run.AddFinding(rule, "a drive that the robot can drive has not arrived.");
        return false;
    }
    return true;
}

bool TryAwaitDriving(ScenarioRun& run)
{
    const auto condition = [&run] {
        return run.GetTruth().bDriving && run.GetDrives().GetPassedCount() > 0;
    };
    if (run.TryAwait(condition, run.GetOptions().answerLimit))
    {
        return true;
    }
    run.AddFinding(ERule::DriveAnswered, "the robot does not begin its drive.");
    return false;
}

void VerifyAtRest(ScenarioRun& run)
{
    run.PassTime(run.GetOptions().answerLimit);
    run.GetStates().VerifyAtRest(run.GetTruth());
}

} // namespace ACS::AdapterTest
