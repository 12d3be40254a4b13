#include "robot/JobTracker.hpp"

#include <cassert>
#include <utility>

namespace ACS::Planning
{

void JobTracker::Begin(StartJob job)
{
    _job = std::move(job);
    _state = EState::Commanded;
    _end = EEnd::Awaited;
    _bBegun = false;
    _abandonedID.clear();
}

void JobTracker::MarkBegun(std::string_view jobID)
{
    if (!IsOpen(jobID))
    {
        return;
    }
    _bBegun = true;
    if (_end == EEnd::Awaited)
    {
        _resolved.reset();
    }
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

bool JobTracker::TryEndResolved(std::string_view jobID)
{
    if (IsOpen(jobID))
    {
        _end = _end == EEnd::Awaited ? EEnd::Reported : _end;
        return false;
    }
    if (!_resolved.has_value() || _resolved->job.jobID != jobID)
    {
        return false;
    }
    _resolved.reset();
    return true;
}

void JobTracker::Resolve()
{
    _state = IsUnresolved() ? EState::Commanded : _state;
    _end = _end == EEnd::Awaited ? EEnd::Decided : _end;
}

void JobTracker::Abandon()
{
    assert(_job.has_value());
    _abandonedID = _job->jobID;
    _end = _end == EEnd::Awaited ? EEnd::Decided : _end;
}

void JobTracker::Release()
{
    std::optional<Resolved> resolved = std::move(_resolved);
    // The arm has never begun a job that was commanded while it ran the program of an earlier one: that one counts.
    if (!resolved.has_value() && _end == EEnd::Decided && _job.has_value() && !_job->progressToken.empty())
    {
        resolved = Resolved{std::move(*_job)};
    }
    std::string abandonedID = std::move(_abandonedID);
    *this = {};
    _abandonedID = std::move(abandonedID);
    _resolved = std::move(resolved);
}

void JobTracker::RestoreAbandoned(std::string jobID)
{
    _abandonedID = std::move(jobID);
}

void JobTracker::RestoreResolved(StartJob job)
{
    _resolved = Resolved{std::move(job), EInquiry::Due};
}

void JobTracker::BeginResolvedRecovery()
{
    assert(_resolved.has_value());
    _resolved->inquiry = EInquiry::Asked;
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

const StartJob* JobTracker::GetResolvedOrNull() const noexcept
{
    return _resolved.has_value() ? &_resolved->job : nullptr;
}

const std::string& JobTracker::GetAbandonedID() const noexcept
{
    return _abandonedID;
}

bool JobTracker::HasBegun() const noexcept
{
    return _bBegun;
}

bool JobTracker::IsRecovering() const noexcept
{
    return _state == EState::Recovering;
}

bool JobTracker::IsResolvedRecovering(std::string_view jobID) const noexcept
{
    return _resolved.has_value() && _resolved->inquiry == EInquiry::Asked && _resolved->job.jobID == jobID
        && !IsOpen(jobID);
}

bool JobTracker::IsResolvedRecoveryDue() const noexcept
{
    return _resolved.has_value() && _resolved->inquiry == EInquiry::Due
        && (!_job.has_value() || _end == EEnd::Reported);
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

bool JobTracker::IsOpen(std::string_view jobID) const noexcept
{
    return _job.has_value() && _job->jobID == jobID;
}

} // namespace ACS::Planning
