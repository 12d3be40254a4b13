#include "robots/Vda5050RobotAdapter.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

} // namespace

void Vda5050RobotAdapter::ExtendDrive(const Planning::ExtendDrive& extension, Core::Now now, AdapterActions& out)
{
    if (_nextDrive.has_value() && _nextDrive->driveID == extension.driveID)
    {
        _nextDrive->releasedCount = extension.releasedCount;
    }
    else if (IsDrive(extension.driveID))
    {
        _drive->Extend(extension.releasedCount);
        SendPendingUpdate(now, out);
    }
}

VehicleDrive Vda5050RobotAdapter::TakeDrive()
{
    VehicleDrive drive = *std::exchange(_drive, std::nullopt);
    _repetition.OnDriveEnded(drive);
    return drive;
}

std::optional<Planning::Drive> Vda5050RobotAdapter::MakeRepetitionOrNull(const Planning::StartJob& job)
{
    return _repetition.MakeDriveOrNull(job.commandID, FindNodeID(job));
}

bool Vda5050RobotAdapter::IsRepeating() const
{
    return _drive.has_value() && _job.HasDeferred();
}

void Vda5050RobotAdapter::ReportDriveRejected(
    const std::string& orderID,
    const std::string& reason,
    AdapterActions& out)
{
    if (const auto deferredOrNull = _job.TakeDeferredOrNull(); deferredOrNull.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobRejected{deferredOrNull->job.jobID, reason}});
        return;
    }
    out.emplace_back(RaiseEvent{Planning::DriveRejected{orderID, reason}});
}

void Vda5050RobotAdapter::OnDriveFinished(const std::string& orderID, Core::Now now, AdapterActions& out)
{
    const VehicleDrive drive = TakeDrive();
    if (const std::optional<std::string>& reason = drive.GetFailureOrNull(); reason.has_value())
    {
        ReportDriveRejected(orderID, *reason, out);
    }
    else if (const std::string* const openOrNull = drive.GetOpenActionOrNull(); openOrNull != nullptr)
    {
        ReportDriveRejected(orderID, "the vehicle did not report the end of the action " + *openOrNull, out);
    }
    else if (const auto deferredOrNull = _job.TakeDeferredOrNull(); deferredOrNull.has_value())
    {
        ContinueJob(*deferredOrNull, now, out);
    }
    else
    {
        out.emplace_back(RaiseEvent{Planning::Arrived{orderID}});
    }
}

/// Outside automatic mode, and in an order that is being cancelled, the vehicle ends actions as the standard demands.
void Vda5050RobotAdapter::OnDriveAction(const VDA5050::ActionChanged& action, Core::Now now, AdapterActions& out)
{
    const std::string* const openOrNull = _drive.has_value() ? _drive->FindOpenActionOrNull(action.actionID) : nullptr;
    if (openOrNull == nullptr)
    {
        return;
    }
    if (action.status == VDA5050::EActionStatus::Finished)
    {
        _drive->OnActionFinished(action.actionID);
    }
    const bool bCancelling = _session.GetOrderPhase() == VDA5050::EOrderPhase::Cancelling;
    if (action.status == VDA5050::EActionStatus::Failed && !bCancelling && _report.GetState().bAutomatic)
    {
        const std::string reason = fmt::format(
            "the action {} failed: {}",
            *openOrNull,
            action.resultDescription.empty() ? "no reason given" : action.resultDescription);
        if (_session.GetOrderID() != _drive->GetOrderID())
        {
            _drive->OnActionFailed(reason); // the same state ends the order, which is reported after its last nodes
            return;
        }
        AbandonDrive(reason, now, out);
    }
}

} // namespace ACS::Acsd
