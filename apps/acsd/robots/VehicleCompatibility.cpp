#include "robots/VehicleCompatibility.hpp"

#include "robots/VehicleDrive.hpp"
#include "robots/VehicleParameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

constexpr const char* ANY_UUID = "01234567-89ab-4cde-8f01-23456789abcd"; // of the length of all orderIds

std::optional<std::string> FindDriveFaultOrNull(
    const VDA5050::MasterSession& session,
    const Planning::Route& route,
    Core::Now now)
{
    Planning::Drive drive;
    drive.driveID = ANY_UUID;
    drive.route = route;
    drive.releasedCount = route.nodes.size();
    Core::Result<VehicleDrive> made = VehicleDrive::Create(drive);
    const Core::Result<VDA5050::OrderMessage> order = made
        ? made->MakeOrder([&session, now](const auto& message) { return session.CheckOrder(message, now); })
        : tl::unexpected(std::move(made.error()));
    if (order)
    {
        return std::nullopt;
    }
    const Core::Error& error = order.error();
    const bool bNamed = error.expected.find(error.path) != std::string::npos;
    return fmt::format(
        "the drive from {} to {} cannot be ordered: {}{}.",
        route.nodes.front().nodeID,
        route.nodes.back().nodeID,
        error.expected,
        bNamed ? "" : " (" + error.path + ")");
}

std::optional<std::string> FindJobFaultOrNull(const VDA5050::FactsheetMessage& factsheet, const JobMethods& methods)
{
    std::optional<std::string> first;
    for (const JobMethod* const method : methods.ListMethods())
    {
        std::optional<std::string> fault =
            method->vehicleAction.empty() ? std::nullopt : FindMethodFaultOrNull(*method, factsheet);
        if (!fault.has_value())
        {
            return std::nullopt;
        }
        if (!first.has_value())
        {
            first = std::move(fault);
        }
    }
    return first;
}

} // namespace

std::string FindIncompatibility(
    const VDA5050::MasterSession& session,
    const VehicleMap& map,
    const JobMethods& methods,
    Core::Now now)
{
    const VDA5050::FactsheetMessage* const factsheetOrNull = session.GetFactsheetOrNull();
    if (factsheetOrNull == nullptr)
    {
        return {};
    }
    std::optional<std::string> fault;
    for (const Planning::Route& route : map.GetRoutes())
    {
        fault = FindDriveFaultOrNull(session, route, now);
        if (fault.has_value())
        {
            return *fault + " Correct the factsheet (of the vehicle, or robots.NAME.factsheet_file) or the map.";
        }
    }
    fault = FindJobFaultOrNull(*factsheetOrNull, methods);
    if (fault.has_value())
    {
        return fmt::format(
            "it can do none of its jobs: {}. Correct the factsheet (of the vehicle, or robots.NAME.factsheet_file) or the "
            "actions of the robot.",
            *fault);
    }
    return {};
}

} // namespace ACS::Acsd
