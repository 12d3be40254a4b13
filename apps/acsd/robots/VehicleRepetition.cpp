#include "robots/VehicleRepetition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

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

/// The number in the orderId if the order repeats actions before the job of the commandID.
std::optional<std::size_t> FindRepetitionNumberOrNull(const std::string& commandID, const std::string& orderID)
{
    std::size_t number = 0;
    const std::errc error = std::from_chars(orderID.data(), orderID.data() + orderID.size(), number).ec;
    // A commandID may begin with a number too: then the same id is the job's own order.
    if (error != std::errc() || orderID == commandID || orderID != MakeRepetitionID(commandID, number))
    {
        return std::nullopt;
    }
    return number;
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

bool VehicleRepetition::TryRecognize(const Planning::RecoverJob& recovery, const std::string& orderID)
{
    std::vector<std::string> commandIDs = recovery.earlierIDs;
    commandIDs.push_back(recovery.job.commandID);
    _shown.reset();
    for (const std::string& commandID : commandIDs)
    {
        const std::optional<std::size_t> numberOrNull = FindRepetitionNumberOrNull(commandID, orderID);
        if (numberOrNull.has_value())
        {
            _count = std::max(_count, *numberOrNull); // the next order needs another orderId
            _shown = Shown{orderID, commandID};
        }
    }
    return _shown.has_value();
}

const std::string* VehicleRepetition::FindCommandOrNull(std::string_view orderID) const noexcept
{
    return _shown.has_value() && _shown->orderID == orderID ? &_shown->commandID : nullptr;
}

} // namespace ACS::Acsd
