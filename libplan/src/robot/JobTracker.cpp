#include "robot/JobTracker.hpp"

#include <cassert>
#include <utility>

namespace ACS::Planning
{

void JobTracker::Begin(StartJob job)
{
    _job = std::move(job);
    _state = EState::Commanded;
    _cancelID.reset();
}

void JobTracker::MarkOverdue()
{
    assert(_job.has_value());
    _bOverdue = true;
    _cancelID = _job->jobID;
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

void JobTracker::CancelLater(std::string jobID)
{
    if (!_job.has_value())
    {
        _cancelID = std::move(jobID);
    }
}

std::optional<std::string> JobTracker::TakeCancelOrNull()
{
    return _job.has_value() ? _cancelID : std::exchange(_cancelID, std::nullopt);
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
