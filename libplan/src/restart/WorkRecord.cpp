#include "restart/WorkRecord.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// An arm shows no counters while its motor is off. Its robot gets no work until then, so the check can wait for them.
bool IsTokenAwaited(const StateChanged& state)
{
    return state.restartEvidence.progressToken.empty()
        && std::ranges::count(state.errors, EAlarmLevel::Heavy, &RobotError::level) > 0;
}

} // namespace

void WorkRecord::Restore(const RobotWorkChanged& work)
{
    _commandID = work.commandID;
    _earlierIDs = work.earlierIDs;
    _jobNumber = work.jobNumber;
    _bCommandTaken = work.bCommandTaken;
    _bUnresolved = work.bUnresolved;
    _evidence = work;
    _stored = work;
}

void WorkRecord::BeginPlan(const std::optional<std::string>& evidentCommandIDOrNull)
{
    if (_commandID.empty())
    {
        _commandID = evidentCommandIDOrNull.value_or(std::string()); // of the previous master
    }
    _bTokenDue = true;
}

void WorkRecord::AddCommand(const std::string& commandID)
{
    constexpr std::size_t MOST_REMEMBERED = 8;
    if (_commandID == commandID)
    {
        return;
    }
    if (!_commandID.empty())
    {
        _earlierIDs.insert(_earlierIDs.begin(), _commandID);
        _earlierIDs.resize(std::min(_earlierIDs.size(), MOST_REMEMBERED));
    }
    _commandID = commandID;
}

void WorkRecord::ForgetCommand(const std::string& commandID)
{
    if (_commandID != commandID)
    {
        return;
    }
    _commandID.clear();
    if (!_earlierIDs.empty())
    {
        _commandID = std::move(_earlierIDs.front());
        _earlierIDs.erase(_earlierIDs.begin());
    }
}

std::int32_t WorkRecord::NumberJob(bool bRepeated, Core::IRandom& random)
{
    constexpr std::int32_t MAXIMUM = std::numeric_limits<std::int32_t>::max();
    if (!bRepeated || _jobNumber == 0)
    {
        const auto drawn = static_cast<std::int32_t>(random.GetNext() % static_cast<std::uint64_t>(MAXIMUM)) + 1;
        _jobNumber = drawn == _jobNumber ? _jobNumber % MAXIMUM + 1 : drawn;
    }
    return _jobNumber;
}

void WorkRecord::MarkCommandTaken() noexcept
{
    _bCommandTaken = true;
}

void WorkRecord::MarkUnresolved() noexcept
{
    _bUnresolved = true;
}

bool WorkRecord::TryResolve() noexcept
{
    return std::exchange(_bUnresolved, false);
}

bool WorkRecord::TryCheckEvidence(const StateChanged& state, bool bHasPlan)
{
    if (_evidence.has_value() && bHasPlan && !_evidence->progressToken.empty() && IsTokenAwaited(state))
    {
        return false;
    }
    const std::optional<RobotWorkChanged> evidence = std::exchange(_evidence, std::nullopt);
    if (!evidence.has_value() || !bHasPlan)
    {
        return false;
    }
    bool bMore = false;
    if (!state.restartEvidence.progressToken.empty() && !evidence->progressToken.empty())
    {
        // The adapter reports what became of a commanded job, and of a resolved one whose program may have ended.
        bMore = !evidence->job.has_value() && !evidence->resolvedJob.has_value()
            && state.restartEvidence.progressToken != evidence->progressToken;
    }
    else if (state.restartEvidence.commandID.has_value())
    {
        // The robot shows no command: it never had one, or it was switched off.
        const bool bNeverHadAny =
            state.restartEvidence.commandID->empty() && evidence->earlierIDs.empty() && !evidence->bCommandTaken;
        bMore = !bNeverHadAny && *state.restartEvidence.commandID != evidence->commandID
            && std::ranges::count(evidence->earlierIDs, *state.restartEvidence.commandID) == 0;
    }
    _bUnresolved = _bUnresolved || bMore;
    return true;
}

RobotWorkChanged WorkRecord::Make(const std::string& robotID) const
{
    RobotWorkChanged work;
    work.robotID = robotID;
    work.commandID = _commandID;
    work.earlierIDs = _earlierIDs;
    work.progressToken = _stored.progressToken;
    work.bUnresolved = _bUnresolved;
    work.nodeIDs = _stored.nodeIDs;
    work.bCommandTaken = _bCommandTaken;
    work.jobNumber = _jobNumber;
    return work;
}

bool WorkRecord::TryBeginStore(const RobotWorkChanged& work)
{
    const bool bNothing =
        _stored.robotID.empty() && work.commandID.empty() && !work.bPauseAsked && work.nodeIDs.empty();
    std::string token = std::exchange(_stored.progressToken, work.progressToken);
    const bool bChanged = work != _stored;
    _stored.progressToken = std::move(token);
    return !bNothing && (std::exchange(_bTokenDue, false) || bChanged);
}

void WorkRecord::OnStored(RobotWorkChanged work)
{
    _stored = std::move(work);
}

const RobotWorkChanged& WorkRecord::GetStored() const noexcept
{
    return _stored;
}

const std::vector<std::string>& WorkRecord::GetEarlierIDs() const noexcept
{
    return _earlierIDs;
}

bool WorkRecord::IsUnresolved() const noexcept
{
    return _bUnresolved;
}

bool WorkRecord::IsChecked() const noexcept
{
    return !_evidence.has_value();
}

} // namespace ACS::Planning
