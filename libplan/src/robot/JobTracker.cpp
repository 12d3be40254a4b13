#include "robot/JobTracker.hpp"

#include <cassert>
#include <utility>

namespace ACS::Planning
{

void JobTracker::Begin(StartJob job)
{
    _job = std::move(job);
    _state = EState::Commanded;
    _abandonedID.clear();
}

void JobTracker::MarkOverdue()
{
    assert(_job.has_value());
    _bOverdue = true;
}

void JobTracker::BeginRecovery()
{
    assert(_job.has_value());
    _state = EState::Recovering;
}

bool JobTracker::TryEndRecovery()
{
    if (!IsRecovering())
    {
        return false;
    }
    _state = EState::Commanded;
    return true;
}

void JobTracker::MarkUnresolved()
{
    assert(_job.has_value());
    _state = EState::Unresolved;
}

void JobTracker::Resolve()
{
    _state = IsUnresolved() ? EState::Commanded : _state;
}

void JobTracker::Abandon()
{
    assert(_job.has_value());
    _abandonedID = _job->jobID;
}

void JobTracker::Release()
{
    std::string abandonedID = std::move(_abandonedID);
    *this = {};
    _abandonedID = std::move(abandonedID);
}

void JobTracker::RestoreAbandoned(std::string jobID)
{
    _abandonedID = std::move(jobID);
}

std::optional<std::string> JobTracker::TakeCancelOrNull()
{
    if (_bOverdue)
    {
        return _job->jobID;
    }
    std::string abandonedID = std::exchange(_abandonedID, {});
    return abandonedID.empty() ? std::nullopt : std::optional(std::move(abandonedID));
}

const StartJob* JobTracker::GetOrNull() const noexcept
{
    return _job.has_value() ? &*_job : nullptr;
}

const std::string& JobTracker::GetAbandonedID() const noexcept
{
    return _abandonedID;
}

bool JobTracker::IsRecovering() const noexcept
{
    return _state == EState::Recovering;
}

bool JobTracker::IsUnresolved() const noexcept
{
    return _state == EState::Unresolved;
}

bool JobTracker::IsOverdue() const noexcept
{
    return _bOverdue;
}

bool JobTracker::IsOverdue(std::string_view jobID) const noexcept
{
    return _bOverdue && _job->jobID == jobID;
}

} // namespace ACS::Planning
