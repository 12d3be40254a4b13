#include "ActionFault.hpp"
#include "OrderErrors.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Ended instant actions live until a new order; a peer that only asks for states must not fill the state.
constexpr std::size_t MAXIMUM_INSTANT_ACTIONS = 128;

} // namespace

void VehicleSession::OnInstantActions(std::string_view payload, Core::Now now, VehicleActions& out)
{
    const Core::Result<InstantActionsMessage> message = _codec.Decode<InstantActionsMessage>(payload);
    if (!message)
    {
        RefusePayload(ETopic::InstantActions, payload, message.error(), out);
        return;
    }
    if (IsForeign(ETopic::InstantActions, message->header, out))
    {
        return;
    }
    if (!ReadVersionOrNull(message->header.version).has_value())
    {
        RefuseVersion(ETopic::InstantActions, message->header, out);
        return;
    }
    for (const Action& action : message->actions)
    {
        OnInstantAction(action, message->header, now, out);
    }
    FinishPauseIfStanding();
    FinishCancelIfStanding(out);
    Advance(out);
}

void VehicleSession::OnInstantAction(const Action& action, const Header& header, Core::Now now, VehicleActions& out)
{
    _bStateDue = true;
    if (action.actionID.empty())
    {
        VehicleError error;
        error.errorType = ErrorTypes::VALIDATION_ERROR;
        error.errorDescription = "an instant action has no actionId";
        AddReference(error, ReferenceKeys::TOPIC, std::string(GetTopicName(ETopic::InstantActions)));
        AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
        AddSessionError(std::move(error));
        return;
    }
    // A repeated id is the same action, sent again by a master that has not seen it in a state.
    if (FindActionOrNull(action.actionID) != nullptr)
    {
        return;
    }
    const bool bRequest =
        action.actionType == ActionTypes::STATE_REQUEST || action.actionType == ActionTypes::FACTSHEET_REQUEST;
    if (_operatingMode == EOperatingMode::Manual && !bRequest)
    {
        FailInstantAction(
            action,
            header,
            ErrorTypes::INSTANT_ACTION_ERROR,
            "in manual mode the vehicle takes no instant actions");
        return;
    }
    PerformOwnInstantAction(action, header, now, out);
}

void VehicleSession::PerformOwnInstantAction(
    const Action& action,
    const Header& header,
    Core::Now now,
    VehicleActions& out)
{
    if (action.actionType == ActionTypes::STATE_REQUEST)
    {
        AddInstantAction(action, EActionStatus::Finished);
    }
    else if (action.actionType == ActionTypes::FACTSHEET_REQUEST)
    {
        PublishFactsheet(now, out);
        AddInstantAction(action, EActionStatus::Finished);
    }
    else if (action.actionType == ActionTypes::CANCEL_ORDER)
    {
        StartCancel(action, header, out);
    }
    else if (action.actionType == ActionTypes::START_PAUSE)
    {
        StartPause(action, header, out);
    }
    else if (action.actionType == ActionTypes::STOP_PAUSE)
    {
        StopPause(action, header, out);
    }
    else
    {
        const std::optional<ActionFault> fault =
            FindActionFaultOrNull(_options.factsheet, action, EActionScope::Instant);
        if (fault.has_value())
        {
            FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, fault->rule);
            return;
        }
        AddInstantAction(action, EActionStatus::Waiting);
        Start(_actions.back(), out);
    }
}

void VehicleSession::AddInstantAction(const Action& action, EActionStatus status, const std::string& result)
{
    const auto isEnded = [](const TrackedAction& tracked) {
        return tracked.scope == EActionScope::Instant && IsTerminal(tracked.machine.GetStatus());
    };
    if (static_cast<std::size_t>(std::ranges::count_if(_actions, isEnded)) >= MAXIMUM_INSTANT_ACTIONS)
    {
        _actions.erase(std::ranges::find_if(_actions, isEnded));
    }
    ActionState state{action.actionID, action.actionType, action.actionDescription, status, result};
    _actions.push_back(TrackedAction{action, ActionMachine(std::move(state)), EActionScope::Instant, {}, 0, false});
}

void VehicleSession::FailInstantAction(
    const Action& action,
    const Header& header,
    std::string_view errorType,
    const std::string& reason)
{
    AddInstantAction(action, EActionStatus::Failed, reason);
    VehicleError error;
    error.errorType = errorType;
    error.errorDescription = reason;
    AddReference(error, ReferenceKeys::TOPIC, std::string(GetTopicName(ETopic::InstantActions)));
    AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
    AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
    AddSessionError(std::move(error));
}

} // namespace ACS::VDA5050
