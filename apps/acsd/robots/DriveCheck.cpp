#include "robots/DriveCheck.hpp"

#include "robots/VehicleDrive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// Of the length of all orderIds.
constexpr std::string_view ORDER_ID = "01234567-89ab-4cde-8f01-23456789abcd";

bool HasLongIDs(const Planning::Route& route, std::size_t most)
{
    const auto isLong = [most](const std::string& id) {
        return id.size() > most;
    };
    return std::ranges::any_of(route.nodes, isLong, &Planning::RouteNode::nodeID)
        || std::ranges::any_of(route.edges, isLong, &Planning::RouteEdge::edgeID);
}

/// What can be corrected instead of the factsheet, or why nothing else can.
std::string AdviseOnFault(
    const Planning::Route& route,
    std::string_view member,
    const VDA5050::FactsheetMessage& factsheet)
{
    constexpr std::string_view OWN_IDS = ": the ids of orders are those of acsd.";
    if (member == "order.zoneSetId")
    {
        return " or site.zone_set.";
    }
    if (member == "maxStringLens.idNumericalOnly")
    {
        return std::string(OWN_IDS);
    }
    if (member == "maxStringLens.idLen")
    {
        const std::size_t most = factsheet.protocolLimits.maxStringLengths.identifier.value_or(0);
        return most >= ORDER_ID.size() && HasLongIDs(route, most) ? " or the map, which has longer ids."
                                                                  : std::string(OWN_IDS);
    }
    return " or the map.";
}

std::string DescribeFault(
    const Planning::Route& route,
    const Core::Error& error,
    const VDA5050::FactsheetMessage& factsheet)
{
    const bool bNamed = error.expected.find(error.path) != std::string::npos;
    return fmt::format(
        "the drive from {} to {} cannot be ordered: {}{}. Correct the factsheet (of the vehicle, or "
        "robots.NAME.factsheet_file){}",
        route.nodes.front().nodeID,
        route.nodes.back().nodeID,
        error.expected,
        bNamed ? "" : " (" + error.path + ")",
        AdviseOnFault(route, error.path, factsheet));
}

} // namespace

Core::Result<void> CheckDrive(const VDA5050::MasterSession& session, const Planning::Route& route, Core::Now now)
{
    Core::Result<VehicleDrive> drive =
        VehicleDrive::Create(Planning::Drive{std::string(ORDER_ID), route, route.nodes.size()});
    if (!drive)
    {
        return tl::unexpected(std::move(drive.error()));
    }
    Core::Result<VDA5050::OrderMessage> order =
        drive->MakeOrder([&session, now](const auto& message) { return session.CheckOrder(message, now); });
    return order ? Core::Result<void>() : tl::unexpected(std::move(order.error()));
}

DriveCheck::DriveCheck(VehicleMap map)
    : _map(std::move(map))
{
}

const VehicleMap& DriveCheck::GetMap() const noexcept
{
    return _map;
}

std::string DriveCheck::FindFault(const VDA5050::MasterSession& session, Core::Now now)
{
    const VDA5050::FactsheetMessage* const factsheetOrNull = session.GetFactsheetOrNull();
    if (factsheetOrNull == nullptr)
    {
        return {};
    }
    const VDA5050::MasterOptions& options = session.GetOptions();
    const std::size_t addressLength = options.address.manufacturer.size() + options.address.serialNumber.size();
    Subject subject{*factsheetOrNull, options.zoneSetID, addressLength, options.version};
    subject.factsheet.header = {};
    subject.factsheet.vehicleConfig.reset(); // network addresses
    const auto known = std::ranges::find(_checked, subject, &Checked::subject);
    if (known != _checked.end())
    {
        return known->fault;
    }
    std::string fault;
    for (const Planning::Route& route : _map.GetRoutes())
    {
        const Core::Result<void> checked = CheckDrive(session, route, now);
        if (!checked)
        {
            fault = DescribeFault(route, checked.error(), *factsheetOrNull);
            break;
        }
    }
    if (_checked.size() == MOST_FACTSHEETS)
    {
        _checked.erase(_checked.begin());
    }
    _checked.push_back({std::move(subject), fault});
    return fault;
}

std::size_t DriveCheck::CountFactsheets() const noexcept
{
    return _checked.size();
}

} // namespace ACS::Acsd
