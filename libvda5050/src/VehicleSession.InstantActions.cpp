#include "ActionFault.hpp"
#include "OrderErrors.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <algorithm>
#include <cstddef>
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
    if (!ShouldTake(ETopic::InstantActions, message->header, out))
    {
        return;
    }
    for (SessionError& known : _sessionErrors)
    {
        known.bShown = true;
    }
    const std::size_t allowed = _options.factsheet.protocolLimits.maxArrayLengths.instantActions.value_or(0);
    bool bTaken = false;
    for (std::size_t index = 0; index < message->actions.size(); ++index)
    {
        const bool bTooMany = allowed != 0 && index >= allowed;
        bTaken = TryTakeInstantAction(message->actions[index], message->header, bTooMany, now, out) || bTaken;
    }
    if (bTaken)
    {
        // Those of this message have yet to be seen.
        std::erase_if(_sessionErrors, [](const SessionError& known) {
            return known.lifetime == EErrorLifetime::UntilInstantAction && known.bShown;
        });
    }
    FinishPauseIfStanding();
    FinishCancelIfStanding(out);
    Advance(out);
}

bool VehicleSession::TryTakeInstantAction(
    const Action& action,
    const Header& header,
    bool bTooMany,
    Core::Now now,
    VehicleActions& out)
{
    _bStateDue = true;
    if (action.actionID.empty())
    {
        VehicleError error;
        error.errorType = ErrorTypes::VALIDATION_ERROR;
        error.errorDescription = "an instant action has no actionId";
        AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::InstantActions));
        AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
        AddSessionError(std::move(error), EErrorLifetime::UntilInstantAction);
        return false;
    }
    // A repeated id is the same action, sent again by a master that has not seen it in a state.
    if (FindActionOrNull(action.actionID) != nullptr)
    {
        return false;
    }
    const bool bRequest =
        action.actionType == ActionTypes::STATE_REQUEST || action.actionType == ActionTypes::FACTSHEET_REQUEST;
    if (bTooMany)
    {
        FailInstantAction(
            action,
            header,
            ErrorTypes::INSTANT_ACTION_ERROR,
            "the message has more instant actions than the vehicle takes");
    }
    else if (!CanMoveByItself() && !bRequest)
    {
        FailInstantAction(
            action,
            header,
            ErrorTypes::INSTANT_ACTION_ERROR,
            "the operating mode takes no instant actions");
    }
    else
    {
        PerformOwnInstantAction(action, header, now, out);
    }
    const TrackedAction* trackedOrNull = FindActionOrNull(action.actionID);
    return trackedOrNull != nullptr && trackedOrNull->machine.GetStatus() != EActionStatus::Failed;
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
        const std::string reason = fault.has_value() ? fault->rule : FindOwnFault(action, EActionScope::Instant);
        if (!reason.empty())
        {
            FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, reason);
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
    _actions.push_back(
        TrackedAction{action, ActionMachine(std::move(state)), EActionScope::Instant, {}, 0, false, false});
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
    AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::InstantActions));
    AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
    AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
    AddSessionError(
        std::move(error),
        errorType == ErrorTypes::NO_ORDER_TO_CANCEL ? EErrorLifetime::UntilOrder : EErrorLifetime::UntilInstantAction);
}

} // namespace ACS::VDA5050
