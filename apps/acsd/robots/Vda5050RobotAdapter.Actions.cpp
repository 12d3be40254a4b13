#include "robots/Vda5050RobotAdapter.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// The length of a commandID, which vehicles accept as an orderId. Its end differs by action (VehicleDrive), its begin by number.
std::string MakeRepetitionID(const std::string& commandID, std::size_t number)
{
    const std::string prefix = fmt::format("{}-", number);
    constexpr std::size_t SHORTEST = 32;
    return prefix + commandID.substr(commandID.size() < SHORTEST ? 0 : prefix.size());
}

} // namespace

DriveContents Vda5050RobotAdapter::MakeContents(const Planning::Route& route) const
{
    DriveContents contents;
    contents.bCorridors = _session.GetOptions().version != VDA5050::EVda5050Version::Version200;
    if (_openNode.has_value() && !route.nodes.empty() && route.nodes.front().nodeID == _openNode->nodeID)
    {
        contents.startActions = _openNode->actions;
    }
    return contents;
}

VehicleDrive Vda5050RobotAdapter::TakeDrive()
{
    VehicleDrive drive = *std::exchange(_drive, std::nullopt);
    if (!drive.GetLastPassedNodeID().empty()) // otherwise the vehicle has not accepted it
    {
        _openNode = drive.GetOpenNodeOrNull();
    }
    return drive;
}

std::optional<Planning::Drive> Vda5050RobotAdapter::MakeRepetitionOrNull(const Planning::StartJob& job)
{
    if (!_openNode.has_value() || FindNodeID(job) != _openNode->nodeID)
    {
        return std::nullopt;
    }
    Planning::Drive repetition;
    repetition.driveID = MakeRepetitionID(job.commandID, ++_repetitionCount);
    repetition.route.nodes.push_back(*_openNode);
    repetition.releasedCount = 1;
    return repetition;
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
    if (const std::optional<Planning::StartJob> jobOrNull = _job.TakeDeferredOrNull(); jobOrNull.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobRejected{jobOrNull->jobID, reason}});
        return;
    }
    out.emplace_back(RaiseEvent{Planning::DriveRejected{orderID, reason}});
}

void Vda5050RobotAdapter::OnDriveFinished(const std::string& orderID, Core::Now now, AdapterActions& out)
{
    const VehicleDrive drive = TakeDrive();
    if (const std::optional<std::string>& reason = drive.GetAbandonReasonOrNull(); reason.has_value())
    {
        ReportDriveRejected(orderID, *reason, out);
    }
    else if (const std::string* const openOrNull = drive.GetOpenActionOrNull(); openOrNull != nullptr)
    {
        ReportDriveRejected(orderID, "the vehicle did not report the end of the action " + *openOrNull, out);
    }
    else if (const std::optional<Planning::StartJob> jobOrNull = _job.TakeDeferredOrNull(); jobOrNull.has_value())
    {
        StartJob(*jobOrNull, now, out);
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
            _drive->Abandon(reason); // the same state ends the order, which is reported after its last nodes
            return;
        }
        AbandonDrive(reason, now, out);
    }
}

} // namespace ACS::Acsd
