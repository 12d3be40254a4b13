#include "JobChecker.hpp"

#include "EventText.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::AdapterTest
{

JobChecker::JobChecker(FindingSink sink)
    : _sink(std::move(sink))
{
}

void JobChecker::OnStart(const Planning::StartJob& job, const RobotTruth& truth)
{
    Begin(job, true, truth);
}

void JobChecker::OnRecover(const Planning::RecoverJob& recover, const RobotTruth& truth)
{
    Begin(recover.job, false, truth);
}

void JobChecker::OnStarted(const Planning::JobStarted& event)
{
    Record* const recordOrNull = FindOpenOrNull(event.jobID, event);
    if (recordOrNull == nullptr)
    {
        return;
    }
    recordOrNull->answer = EAnswer::Started;
    if (!recordOrNull->bSent)
    {
        _sink(ERule::OutcomeTrue, fmt::format("{} was raised; the robot never received it.", DescribeEvent(event)));
    }
}

void JobChecker::OnFinished(const Planning::JobFinished& event, const RobotTruth& truth)
{
    Record* const recordOrNull = FindOpenOrNull(event.jobID, event);
    if (recordOrNull == nullptr)
    {
        return;
    }
    recordOrNull->answer = EAnswer::Finished;
    if (CountDone(*recordOrNull, truth) == 0)
    {
        _sink(ERule::OutcomeTrue, fmt::format("{} was raised; the robot has not done it.", DescribeEvent(event)));
    }
}

void JobChecker::OnFailed(const Planning::JobFailed& event, const RobotTruth& truth)
{
    EndUndone(event.jobID, event, EAnswer::Failed, truth);
}

void JobChecker::OnRejected(const Planning::JobRejected& event, const RobotTruth& truth)
{
    EndUndone(event.jobID, event, EAnswer::Rejected, truth);
}

void JobChecker::OnInterrupted(const Planning::JobInterrupted& event, const RobotTruth& truth)
{
    EndUndone(event.jobID, event, EAnswer::Interrupted, truth);
}

void JobChecker::OnUnknown(const Planning::JobUnknown& event, const RobotTruth& truth)
{
    EndUndone(event.jobID, event, EAnswer::Unknown, truth);
}

void JobChecker::OnUnresolved(const Planning::JobUnresolved& event)
{
    if (Record* const recordOrNull = FindOpenOrNull(event.jobID, event); recordOrNull != nullptr)
    {
        recordOrNull->answer = EAnswer::Unresolved;
    }
}

void JobChecker::Sample(const RobotTruth& truth)
{
    for (const auto& [jobID, record] : _records)
    {
        const std::size_t done = CountDone(record, truth);
        if (!record.bSent && done > 0)
        {
            _sink(
                ERule::RecoveryStartsNothing,
                fmt::format("{} was only asked for, and the robot has done it.", jobID));
        }
        else if (done > 1)
        {
            _sink(ERule::JobOnce, fmt::format("the robot has done {} {} times.", jobID, done));
        }
        else if (record.bNotDone && done > 0)
        {
            _sink(ERule::OutcomeTrue, fmt::format("{} was reported as not done, and the robot does it later.", jobID));
        }
    }
}

JobChecker::EAnswer JobChecker::GetAnswer() const
{
    const auto found = _records.find(_currentID);
    return found == _records.end() ? EAnswer::None : found->second.answer;
}

bool JobChecker::HasEnded() const
{
    return IsEnd(GetAnswer());
}

const std::string& JobChecker::GetLastText() const noexcept
{
    return _lastText;
}

std::size_t JobChecker::CountDone(const Record& record, const RobotTruth& truth)
{
    return record.doneEnd.value_or(truth.doneJobs) - record.doneBefore;
}

bool JobChecker::IsEnd(EAnswer answer) noexcept
{
    return answer != EAnswer::None && answer != EAnswer::Started;
}

void JobChecker::Begin(const Planning::StartJob& job, bool bSent, const RobotTruth& truth)
{
    Record& record = _records[job.jobID];
    const bool bRepeats = !record.commandID.empty()
        && (!bSent || record.answer == EAnswer::Rejected || record.answer == EAnswer::Interrupted
            || record.answer == EAnswer::Unknown);
    if (!bRepeats)
    {
        if (const auto former = _records.find(_currentID); former != _records.end() && _currentID != job.jobID)
        {
            former->second.doneEnd = former->second.doneEnd.value_or(truth.doneJobs);
        }
        record = {};
        record.doneBefore = truth.doneJobs;
    }
    record.commandID = job.commandID;
    record.bSent = record.bSent || bSent;
    record.answer = EAnswer::None;
    record.bNotDone = false;
    _currentID = job.jobID;
}

JobChecker::Record* JobChecker::FindOpenOrNull(const std::string& jobID, const Planning::RobotEvent& event)
{
    _lastText = DescribeEvent(event);
    const auto found = _records.find(jobID);
    if (found == _records.end())
    {
        _sink(ERule::KnownIDs, fmt::format("{} was raised, of a job that was not commanded.", DescribeEvent(event)));
        return nullptr;
    }
    if (IsEnd(found->second.answer))
    {
        _sink(ERule::OneEnd, fmt::format("{} was raised after the end of the job.", DescribeEvent(event)));
        return nullptr;
    }
    return &found->second;
}

void JobChecker::EndUndone(
    const std::string& jobID,
    const Planning::RobotEvent& event,
    EAnswer answer,
    const RobotTruth& truth)
{
    Record* const recordOrNull = FindOpenOrNull(jobID, event);
    if (recordOrNull == nullptr)
    {
        return;
    }
    recordOrNull->answer = answer;
    recordOrNull->bNotDone = true;
    if (CountDone(*recordOrNull, truth) > 0)
    {
        recordOrNull->bNotDone = false;
        _sink(ERule::OutcomeTrue, fmt::format("{} was raised; the robot has done it.", DescribeEvent(event)));
    }
}

} // namespace ACS::AdapterTest
