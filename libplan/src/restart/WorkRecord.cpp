#include "restart/WorkRecord.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ACS::Planning
{

void WorkRecord::Restore(const RobotWorkChanged& work)
{
    _commandID = work.commandID;
    _earlierIDs = work.earlierIDs;
    _jobNumber = work.jobNumber;
    _bCommandTaken = work.bCommandTaken;
    _bDoubtful = work.bDoubtful;
    _evidence = work;
    _stored = work;
}

void WorkRecord::BeginPlan(const std::optional<std::string>& shownCommandIDOrNull)
{
    if (_commandID.empty())
    {
        _commandID = shownCommandIDOrNull.value_or(std::string()); // of the previous master
    }
    _bMarkDue = true;
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

void WorkRecord::MarkDoubtful() noexcept
{
    _bDoubtful = true;
}

bool WorkRecord::TryClearDoubt() noexcept
{
    return std::exchange(_bDoubtful, false);
}

bool WorkRecord::TryCheckEvidence(const StateChanged& state, bool bHasPlan)
{
    const std::optional<RobotWorkChanged> evidence = std::exchange(_evidence, std::nullopt);
    if (!evidence.has_value() || !bHasPlan)
    {
        return false;
    }
    bool bMore = false;
    if (!state.mark.empty() && !evidence->mark.empty())
    {
        bMore = !evidence->job.has_value() && state.mark != evidence->mark; // the adapter reports a commanded one
    }
    else if (state.shownCommandID.has_value())
    {
        // The robot shows no command: it never had one, or it was switched off.
        const bool bNeverHadAny =
            state.shownCommandID->empty() && evidence->earlierIDs.empty() && !evidence->bCommandTaken;
        bMore = !bNeverHadAny && *state.shownCommandID != evidence->commandID
            && std::ranges::count(evidence->earlierIDs, *state.shownCommandID) == 0;
    }
    _bDoubtful = _bDoubtful || bMore;
    return true;
}

RobotWorkChanged WorkRecord::Make(const std::string& robotID) const
{
    RobotWorkChanged work;
    work.robotID = robotID;
    work.commandID = _commandID;
    work.earlierIDs = _earlierIDs;
    work.mark = _stored.mark;
    work.bDoubtful = _bDoubtful;
    work.nodeIDs = _stored.nodeIDs;
    work.bCommandTaken = _bCommandTaken;
    work.jobNumber = _jobNumber;
    return work;
}

bool WorkRecord::TryBeginStore(const RobotWorkChanged& work)
{
    const bool bNothing =
        _stored.robotID.empty() && work.commandID.empty() && !work.bPauseAsked && work.nodeIDs.empty();
    RobotWorkChanged unmarked = work;
    unmarked.mark = _stored.mark;
    return !bNothing && (std::exchange(_bMarkDue, false) || unmarked != _stored);
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

bool WorkRecord::IsDoubtful() const noexcept
{
    return _bDoubtful;
}

} // namespace ACS::Planning
