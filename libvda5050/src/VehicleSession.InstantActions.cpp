#include "ActionFault.hpp"
#include "MessageSizes.hpp"
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

/// A vehicle can always be stopped, and set free again, even where its state has no room to show it.
bool IsControl(const Action& action)
{
    return action.actionType == ActionTypes::CANCEL_ORDER || action.actionType == ActionTypes::START_PAUSE
        || action.actionType == ActionTypes::STOP_PAUSE;
}

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
    const ProtocolLimits& limits = _options.factsheet.protocolLimits;
    MessageSizes sizes;
    sizes.payload = payload.size();
    const std::vector<ActionFault> faults = FindSizeFaults(sizes, limits);
    if (!faults.empty())
    {
        RefusePayload(
            ETopic::InstantActions,
            payload,
            Core::Error{make_error_code(EVda5050Error::NotSupported), {}, "what the vehicle can take", faults[0].rule},
            out);
        return;
    }
    const std::size_t allowed = limits.maxArrayLengths.instantActions.value_or(0);
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
    const TrackedAction* const knownOrNull = FindActionOrNull(action.actionID);
    if (knownOrNull != nullptr || std::max(action.actionID.size(), action.actionType.size()) > LONGEST_FOREIGN_TEXT)
    {
        // A repeated id is the same action, sent again by a master that has not seen it in a state. Another action with
        // that id cannot be shown; a cancel that is not done must not look as if it were.
        const bool bSame = knownOrNull != nullptr && knownOrNull->scope == EActionScope::Instant
            && knownOrNull->action.actionType == action.actionType;
        if (!bSame)
        {
            ReportInstantAction(
                action,
                header.headerID,
                ErrorTypes::INSTANT_ACTION_ERROR,
                knownOrNull != nullptr ? "the actionId is in use already" : "actionId or actionType is too long");
        }
        return false;
    }
    const std::string reason = FindRefusal(action, bTooMany);
    if (!TryMakeRoom(1) && !IsControl(action))
    {
        ReportInstantAction(
            action,
            header.headerID,
            ErrorTypes::INSTANT_ACTION_ERROR,
            "the state has no room for another action: maxArrayLens.state.actionStates");
        return false;
    }
    if (reason.empty())
    {
        PerformOwnInstantAction(action, header, now, out);
    }
    else
    {
        FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, reason);
    }
    const TrackedAction* trackedOrNull = FindActionOrNull(action.actionID);
    return trackedOrNull != nullptr && trackedOrNull->machine.GetStatus() != EActionStatus::Failed;
}

/// Why an instant action fails whatever it is; empty where it is looked at.
std::string VehicleSession::FindRefusal(const Action& action, bool bTooMany) const
{
    const bool bRequest =
        action.actionType == ActionTypes::STATE_REQUEST || action.actionType == ActionTypes::FACTSHEET_REQUEST;
    if (bTooMany)
    {
        return "the message has more instant actions than the vehicle takes";
    }
    if (!CanMoveByItself() && !bRequest)
    {
        return "the operating mode takes no instant actions";
    }
    const std::vector<ActionFault> faults = FindSizeFaults(Measure(action), _options.factsheet.protocolLimits);
    return faults.empty() ? std::string() : faults[0].rule;
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

bool VehicleSession::IsEndedInstantAction(const TrackedAction& tracked)
{
    return tracked.scope == EActionScope::Instant && IsTerminal(tracked.machine.GetStatus());
}

/// The oldest instant actions that have ended make way where the factsheet limits actionStates.
bool VehicleSession::TryMakeRoom(std::size_t count)
{
    const std::uint32_t allowed = _options.factsheet.protocolLimits.maxArrayLengths.stateActionStates.value_or(0);
    while (allowed != 0 && _actions.size() + count > allowed)
    {
        const auto oldest = std::ranges::find_if(_actions, IsEndedInstantAction);
        if (oldest == _actions.end())
        {
            return false;
        }
        _actions.erase(oldest);
    }
    return true;
}

void VehicleSession::AddInstantAction(const Action& action, EActionStatus status, const std::string& result)
{
    const auto ended = std::ranges::count_if(_actions, IsEndedInstantAction);
    if (static_cast<std::size_t>(ended) >= MAXIMUM_INSTANT_ACTIONS)
    {
        _actions.erase(std::ranges::find_if(_actions, IsEndedInstantAction));
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
    AddInstantAction(action, EActionStatus::Failed, std::string(CutForeignText(reason)));
    ReportInstantAction(action, header.headerID, errorType, reason);
}

void VehicleSession::ReportInstantAction(
    const Action& action,
    std::optional<std::uint32_t> headerIDOrNull,
    std::string_view errorType,
    const std::string& reason)
{
    VehicleError error;
    error.errorType = errorType;
    error.errorDescription = reason;
    AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::InstantActions));
    if (headerIDOrNull.has_value())
    {
        AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(*headerIDOrNull));
    }
    AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
    AddSessionError(
        std::move(error),
        errorType == ErrorTypes::NO_ORDER_TO_CANCEL ? EErrorLifetime::UntilOrder : EErrorLifetime::UntilInstantAction);
}

} // namespace ACS::VDA5050
