#include "robots/VehicleRepetition.hpp"

#include <fmt/format.h>

namespace ACS::Acsd
{

namespace
{

/// The length of a commandID, which vehicles accept as an orderId. Its end differs by action (VehicleDrive), its begin by number.
std::string MakeRepetitionID(const std::string& commandID, std::size_t number)
{
    const std::string prefix = fmt::format("{}-", number);
    constexpr std::size_t SHORTEST = 32;
    return prefix + commandID.substr(commandID.size() < SHORTEST ? 0 : prefix.size());
}

} // namespace

void VehicleRepetition::OnDriveEnded(const VehicleDrive& drive)
{
    if (!drive.GetLastPassedNodeID().empty()) // otherwise the vehicle has not accepted it
    {
        _openNode = drive.GetOpenNodeOrNull();
    }
}

std::vector<Planning::SiteAction> VehicleRepetition::ListStartActions(const Planning::Route& route) const
{
    const bool bOpen = _openNode.has_value() && !route.nodes.empty() && route.nodes.front().nodeID == _openNode->nodeID;
    return bOpen ? _openNode->actions : std::vector<Planning::SiteAction>();
}

std::optional<Planning::Drive> VehicleRepetition::MakeDriveOrNull(
    const std::string& commandID,
    const std::string& nodeID)
{
    if (!_openNode.has_value() || nodeID != _openNode->nodeID)
    {
        return std::nullopt;
    }
    Planning::Drive repetition;
    repetition.driveID = MakeRepetitionID(commandID, ++_count);
    repetition.route.nodes.push_back(*_openNode);
    repetition.releasedCount = 1;
    return repetition;
}

} // namespace ACS::Acsd
