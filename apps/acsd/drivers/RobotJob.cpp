#include <acs/acsd/RobotJob.hpp>

#include <variant>

namespace ACS::Acsd
{

void RobotJob::Handle(const Planning::RobotCommand& command)
{
    if (const auto* start = std::get_if<Planning::StartJob>(&command))
    {
        _job = *start;
        _bStarted = false;
    }
    else if (const auto* recover = std::get_if<Planning::RecoverJob>(&command))
    {
        _job = recover->job;
        _bStarted = false;
    }
}

const Planning::StartJob* RobotJob::GetJobOrNull() const noexcept
{
    return _job.has_value() ? &*_job : nullptr;
}

void RobotJob::OnRunning(std::string_view commandID, Planning::AdapterActions& out)
{
    if (IsCurrent(commandID))
    {
        _bStarted = true;
        out.emplace_back(Planning::RaiseEvent{Planning::JobStarted{_job->jobID}});
    }
}

void RobotJob::OnDone(std::string_view commandID, Planning::AdapterActions& out)
{
    if (IsCurrent(commandID))
    {
        End(Planning::JobFinished{_job->jobID}, out);
    }
}

void RobotJob::OnNotExecuted(std::string_view commandID, const std::string& reason, Planning::AdapterActions& out)
{
    if (!IsCurrent(commandID))
    {
        return;
    }
    if (_bStarted)
    {
        End(Planning::JobInterrupted{_job->jobID, reason}, out);
    }
    else
    {
        End(Planning::JobUnknown{_job->jobID}, out);
    }
}

void RobotJob::OnRejected(std::string_view commandID, const std::string& reason, Planning::AdapterActions& out)
{
    if (IsCurrent(commandID))
    {
        End(Planning::JobRejected{_job->jobID, reason}, out);
    }
}

void RobotJob::OnFailed(std::string_view commandID, const std::string& reason, Planning::AdapterActions& out)
{
    if (IsCurrent(commandID))
    {
        End(Planning::JobFailed{_job->jobID, reason}, out);
    }
}

bool RobotJob::IsCurrent(std::string_view commandID) const noexcept
{
    return _job.has_value() && _job->commandID == commandID;
}

void RobotJob::End(const Planning::RobotEvent& event, Planning::AdapterActions& out)
{
    out.emplace_back(Planning::RaiseEvent{event});
    _job.reset();
}

} // namespace ACS::Acsd
