#include "vda-sim/VirtualVehicle.hpp"

#include "vda-sim/OrderLimits.hpp"
#include "world/EWorldError.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/ShortText.hpp>
#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr std::string_view CHARGER_PREFIX = "CHG";

} // namespace

void VirtualVehicle::OnWorldChanged(Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    _actionRunner.GetDevice().UpdateLoads();
    ReportLoads(now);
    Settle(now, out);
}

void VirtualVehicle::Start(const VDA5050::StartAction& start, Core::Now now)
{
    LogUnlisted(start.action.actionID, now);
    std::string refusal;
    if (std::optional<VDA5050::VehicleError> error = UseActionFaultOrNull(start.action, true); error.has_value())
    {
        refusal = error->errorDescription;
        AddOrderError(std::move(*error), now);
    }
    if (refusal.empty() && start.action.actionType == VDA5050::ActionTypes::INIT_POSITION)
    {
        refusal = InitialisePosition(start.action, now);
    }
    if (refusal.empty())
    {
        refusal = _actionRunner.FindRefusal(start.action, IsAtCharger());
    }
    const bool bRuns = refusal.empty();
    if (bRuns)
    {
        _actionRunner.Start(start.action, UseActionFaultOrNull(start.action, false));
    }
    SetStatus(start.action.actionID, VDA5050::EActionStatus::Running, {}, now);
    if (!bRuns)
    {
        SetStatus(start.action.actionID, VDA5050::EActionStatus::Failed, std::move(refusal), now);
    }
}

/// Sets the position of the action. Returns an empty text, or why it cannot.
std::string VirtualVehicle::InitialisePosition(const VDA5050::Action& action, Core::Now now)
{
    const auto getNumber = [&action](std::string_view key) {
        const VDA5050::ActionParameter* const parameter = VDA5050::FindParameterOrNull(action, key);
        if (parameter == nullptr)
        {
            return std::optional<double>();
        }
        // A text was refused before, unless the option --lenient-parameters allows it.
        const std::optional<std::string> text = parameter->value.GetStringOrNull();
        const std::optional<double> number =
            text.has_value() ? Core::ParseNumberOrNull<double>(*text) : parameter->value.GetNumberOrNull();
        return number.has_value() && std::isfinite(*number) ? number : std::nullopt;
    };
    const std::optional<double> x = getNumber("x");
    const std::optional<double> y = getNumber("y");
    const std::optional<double> theta = getNumber("theta");
    const auto getText = [&action](std::string_view key) {
        const VDA5050::ActionParameter* const parameter = VDA5050::FindParameterOrNull(action, key);
        return parameter != nullptr ? parameter->value.GetStringOrNull() : std::nullopt;
    };
    const std::optional<std::string> mapID = getText("mapId");
    if (!x.has_value() || !y.has_value() || !theta.has_value() || !mapID.has_value())
    {
        return "x, y and theta have to be numbers, mapId a string";
    }
    if (!IsInReach(*_site, *x, *y))
    {
        return "the position is too far from the site";
    }
    // The node may be far from the position: between two nodes it is the one that the vehicle has passed.
    const std::string lastNodeID = getText("lastNodeId").value_or("");
    if (!lastNodeID.empty() && _site->FindNodeOrNull(lastNodeID) == nullptr)
    {
        return "the site has no node " + Core::ShortenText(lastNodeID);
    }
    if (!_drive.TryPlace({*x, *y, NormaliseAngle(*theta)}, *mapID))
    {
        return "the vehicle is driving";
    }
    _faults.End(EFaultKind::Lost, "initPosition");
    ReportCondition(now);
    return {};
}

void VirtualVehicle::SetStatus(
    std::string_view actionID,
    VDA5050::EActionStatus status,
    std::string result,
    Core::Now now)
{
    _logger.Debug("action", {{"actionId", Core::ShortenText(actionID)}, {"status", VDA5050::GetStatusText(status)}});
    if (!_session.TrySetActionStatus(actionID, status, std::move(result), now, _sessionActions))
    {
        LogWarning(now, "the session rejected an action status", {{"actionId", Core::ShortenText(actionID)}});
    }
}

bool VirtualVehicle::IsAtCharger() const
{
    return !_drive.GetMotion().HasLeg()
        && std::ranges::any_of(_site->GetStations(), [this](const Planning::SiteStation& station) {
               return station.stationID.starts_with(CHARGER_PREFIX)
                   && std::ranges::find(station.nodeIDs, _drive.GetPlaceNodeID()) != station.nodeIDs.end();
           });
}

void VirtualVehicle::LogUnlisted(const std::string& actionID, Core::Now now)
{
    if (_options.parameterCheck != VDA5050::EParameterCheck::Lenient)
    {
        return;
    }
    for (const VDA5050::VehicleError& error : _session.GetState().errors)
    {
        const std::string* const reported = VDA5050::FindReferenceOrNull(error, "actionId");
        if (error.errorType != VDA5050::ErrorTypes::UNLISTED_PARAMETER || reported == nullptr || *reported != actionID)
        {
            continue;
        }
        std::string keys;
        for (const VDA5050::ErrorReference& reference : error.errorReferences)
        {
            if (reference.referenceKey == "parameter")
            {
                keys += (keys.empty() ? "" : ", ") + reference.referenceValue;
            }
        }
        LogWarning(
            now,
            error.errorDescription,
            {{"actionId", Core::ShortenText(actionID)}, {"parameters", Core::ShortenText(keys)}});
    }
}

void VirtualVehicle::EndActions(std::vector<ActionOutcome> outcomes, Core::Now now, VirtualActions& out)
{
    ReportLoads(now);
    ReportBattery(now);
    for (ActionOutcome& outcome : outcomes)
    {
        if (outcome.error.has_value())
        {
            AddOrderError(std::move(*outcome.error), now);
        }
        else if (outcome.status == VDA5050::EActionStatus::Failed)
        {
            LogFailure(outcome, now);
        }
        SetStatus(outcome.actionID, outcome.status, std::move(outcome.result), now);
    }
    Pump(now, out);
}

void VirtualVehicle::LogFailure(const ActionOutcome& outcome, Core::Now now)
{
    LogWarning(now, "action failed", {{"actionId", Core::ShortenText(outcome.actionID)}, {"reason", outcome.result}});
}

void VirtualVehicle::ReportLoads(Core::Now now)
{
    _session.OnLoads(_actionRunner.GetDevice().GetLoads(), now, _sessionActions);
}

void VirtualVehicle::UpdateDock(Core::Now now)
{
    const VehicleMotion& motion = _drive.GetMotion();
    const std::string nodeID = motion.HasLeg() || !motion.IsStanding() ? std::string() : _drive.GetPlaceNodeID();
    if (_dockNodeID == nodeID)
    {
        return;
    }
    std::vector<std::string> stationIDs;
    for (const Planning::SiteStation& station : _site->GetStations())
    {
        if (std::ranges::find(station.nodeIDs, nodeID) != station.nodeIDs.end())
        {
            stationIDs.push_back(station.stationID);
        }
    }
    const Core::Result<void> docked = _actionRunner.GetDevice().Dock(std::move(stationIDs));
    const bool bRecorded = docked.has_value() || docked.error().code != Sim::EWorldError::JournalFailed;
    _dockNodeID = bRecorded ? std::optional(nodeID) : std::nullopt;
    if (!docked.has_value())
    {
        LogWarning(
            now,
            "cannot record in the world where the vehicle is docked",
            {{"reason", Core::Describe(docked.error())}});
    }
}

} // namespace ACS::VdaSim
