#include "robots/VehicleCompatibility.hpp"

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
    DriveCheck& drives,
    const JobMethods& methods,
    Core::Now now)
{
    const VDA5050::FactsheetMessage* const factsheetOrNull = session.GetFactsheetOrNull();
    if (factsheetOrNull == nullptr)
    {
        return {};
    }
    std::string driveFault = drives.FindFault(session, now);
    if (!driveFault.empty())
    {
        return driveFault;
    }
    const std::optional<std::string> jobFault = FindJobFaultOrNull(*factsheetOrNull, methods);
    if (jobFault.has_value())
    {
        return fmt::format(
            "it can do none of its jobs: {}. Correct the factsheet (of the vehicle, or robots.NAME.factsheet_file) or the "
            "actions of the robot.",
            *jobFault);
    }
    return {};
}

} // namespace ACS::Acsd
