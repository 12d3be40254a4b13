#include "robots/OpenStreamRobotAdapter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// The number that the job's program echoes; 0 if it receives none and cannot echo it.
std::int32_t GetEchoedNumber(const Planning::StartJob& job, const ArmJob& made)
{
    const bool bGiven =
        std::ranges::any_of(made.inputs, [&job](const ArmInput& input) { return input.value == job.jobNumber; });
    return bGiven ? job.jobNumber : 0;
}

} // namespace

void OpenStreamRobotAdapter::StartJob(const Planning::StartJob& job, Core::Now now, AdapterActions& out)
{
    if (_recovery.has_value() || _program.HasJob())
    {
        ReleaseJob(out);
        out.emplace_back(RaiseEvent{Planning::JobUnknown{job.jobID}}); // commanded again when the robot is not occupied
        return;
    }
    _repetition.reset();
    tl::expected<ArmJob, std::string> made = MakeJob(job);
    if (!made.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{job.jobID, made.error()}});
        return;
    }
    if (!_monitor.IsReady())
    {
        // The connection was lost while the job waited to be stored. The engine commands the job again when the robot is
        // online.
        out.emplace_back(RaiseEvent{Planning::JobUnknown{job.jobID}});
        return;
    }
    if (!job.progressToken.empty() && job.progressToken != _evidence.MakeProgressToken())
    {
        // Another program has run since. After a restart it could not be distinguished from the program of this job.
        ReportState(out);
        out.emplace_back(RaiseEvent{Planning::JobUnknown{job.jobID}});
        return;
    }
    if (const std::optional<Planning::Drive> repetition = _base.MakeRepetitionOrNull(job); repetition.has_value())
    {
        _repetition = Repetition{repetition->driveID, job, false};
        _base.Handle(*repetition, now, _baseActions);
        DrainBase(now, out);
        return;
    }
    _bJobReleased = false;
    _evidence.Begin(GetEchoedNumber(job, *made));
    _program.Start(std::move(*made), out);
}

bool OpenStreamRobotAdapter::TryEndRepetition(const Planning::RobotEvent& event, Core::Now now, AdapterActions& out)
{
    if (!_repetition.has_value())
    {
        return false;
    }
    const Planning::Arrived* const arrivedOrNull = std::get_if<Planning::Arrived>(&event);
    const Planning::DriveRejected* const rejectedOrNull = std::get_if<Planning::DriveRejected>(&event);
    if (arrivedOrNull != nullptr && arrivedOrNull->driveID == _repetition->driveID)
    {
        const Repetition repetition = *std::exchange(_repetition, std::nullopt);
        if (repetition.bOutdated)
        {
            out.emplace_back(
                RaiseEvent{Planning::JobUnknown{repetition.job.jobID}}); // commanded again if it was not resolved
            return true;
        }
        StartJob(repetition.job, now, out);
        return true;
    }
    if (rejectedOrNull != nullptr && rejectedOrNull->driveID == _repetition->driveID)
    {
        const Planning::StartJob job = std::exchange(_repetition, std::nullopt)->job;
        out.emplace_back(RaiseEvent{Planning::JobRejected{job.jobID, rejectedOrNull->reason}});
        return true;
    }
    return false;
}

void OpenStreamRobotAdapter::CancelJob(const std::string& jobID, Core::Now now, AdapterActions& out)
{
    if (_recovery.has_value() && _recovery->job.jobID == jobID)
    {
        _recovery->bCancelled = _recovery->bCancelled || _program.IsPauseWanted();
        ReleaseJob(out);
        return;
    }
    if (!_repetition.has_value() || _repetition->job.jobID != jobID)
    {
        _bJobReleased = _program.TryCancel(jobID, out) || _bJobReleased;
        Update(out);
        return;
    }
    const Planning::CancelDrive cancel{std::exchange(_repetition, std::nullopt)->driveID};
    out.emplace_back(RaiseEvent{Planning::JobFailed{jobID, "cancelled before it was started"}});
    _base.Handle(cancel, now, _baseActions);
    DrainBase(now, out);
}

tl::expected<ArmJob, std::string> OpenStreamRobotAdapter::MakeJob(const Planning::StartJob& job) const
{
    if (std::optional<std::string> rejection = GetRejectionReasonOrNull(job.action); rejection.has_value())
    {
        return tl::unexpected(std::move(*rejection));
    }
    ArmJob made{job.jobID, _methods.FindMethodOrNull(job.action, _methods.MakeData(job))->armProgram, {}};
    if (_resolveInputs)
    {
        tl::expected<std::vector<ArmInput>, std::string> inputs = _resolveInputs(job);
        if (!inputs.has_value())
        {
            return tl::unexpected(fmt::format("no inputs for the arm's program: {}", inputs.error()));
        }
        made.inputs = std::move(*inputs);
    }
    for (const ArmInput& input : made.inputs)
    {
        if (!CanHold(input.relay, input.value))
        {
            return tl::unexpected(
                fmt::format("relay {} of the arm is too narrow for the value {}", input.relay.name, input.value));
        }
    }
    return made;
}

/// A job that was commanded before a restart: the counters show whether its program has begun.
void OpenStreamRobotAdapter::RecoverJob(AdapterActions& out)
{
    const Recovery recovery = *std::exchange(_recovery, std::nullopt);
    const Planning::StartJob& job = recovery.job;
    const tl::expected<ArmJob, std::string> made = MakeJob(job);
    const std::int32_t number = made.has_value() ? GetEchoedNumber(job, *made) : job.jobNumber;
    const tl::expected<bool, std::string> begun = _evidence.Recover(job.progressToken, number);
    if (!begun.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobUnresolved{job.jobID, begun.error()}});
        return;
    }
    _bJobReleased = recovery.bReleased;
    _program.Recover({job.jobID, 0, {}}, *begun, recovery.bCancelled, out);
}

void OpenStreamRobotAdapter::ReleaseJob(AdapterActions& out)
{
    if (_recovery.has_value())
    {
        _recovery->bReleased = true;
    }
    else
    {
        _bJobReleased = true;
    }
    ReportActivity(out);
}

} // namespace ACS::Acsd
