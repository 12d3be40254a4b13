#include "robots/VehicleJobCheck.hpp"

#include "robots/VehicleParameters.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace ACS::Acsd
{

VehicleJobCheck::VehicleJobCheck(
    JobMethods methods,
    const VDA5050::FactsheetMessage* factsheetOrNull,
    bool bFactsheetAwaited)
    : _methods(std::move(methods)),
      _factsheet(factsheetOrNull == nullptr ? std::nullopt : std::optional(*factsheetOrNull)),
      _bFactsheetAwaited(bFactsheetAwaited)
{
}

bool VehicleJobCheck::IsFor(const VDA5050::FactsheetMessage* factsheetOrNull) const
{
    if (factsheetOrNull == nullptr || !_factsheet.has_value())
    {
        return factsheetOrNull == nullptr && !_factsheet.has_value();
    }
    VDA5050::FactsheetMessage other = *factsheetOrNull;
    other.header = _factsheet->header;
    return other == *_factsheet;
}

tl::expected<VDA5050::Action, std::string> VehicleJobCheck::MakeAction(const Planning::StartJob& job) const
{
    const JobData data = _methods.MakeData(job);
    const JobMethod* const methodOrNull = _methods.FindMethodOrNull(job.action, data);
    if (methodOrNull == nullptr || methodOrNull->vehicleAction.empty())
    {
        return tl::unexpected(fmt::format("the vehicle has no action for {}", job.action));
    }
    tl::expected<std::vector<VDA5050::ActionParameter>, std::string> parameters =
        MakeActionParameters(*methodOrNull, data, _factsheet.has_value() ? &*_factsheet : nullptr);
    if (!parameters.has_value())
    {
        return tl::unexpected(std::move(parameters.error()));
    }
    VDA5050::Action action;
    action.actionType = methodOrNull->vehicleAction;
    action.actionID = job.commandID;
    action.blockingType = JOB_BLOCKING;
    action.actionParameters = std::move(*parameters);
    return action;
}

std::optional<std::string> VehicleJobCheck::GetRejectionReasonOrNull(const Planning::StartJob& job) const
{
    if (_bFactsheetAwaited)
    {
        return "the vehicle has not sent its factsheet yet";
    }
    tl::expected<VDA5050::Action, std::string> action = MakeAction(job);
    return action.has_value() ? std::nullopt : std::optional(std::move(action.error()));
}

} // namespace ACS::Acsd
