#include "robot/JobTracker.hpp"

#include <cassert>
#include <utility>

namespace ACS::Planning
{

void JobTracker::Begin(StartJob job)
{
    _job = std::move(job);
    _state = EState::Commanded;
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

void JobTracker::Release()
{
    *this = {};
}

const StartJob* JobTracker::GetOrNull() const noexcept
{
    return _job.has_value() ? &*_job : nullptr;
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
