#include "ActionFault.hpp"
#include "MessageSizes.hpp"
#include "OrderErrors.hpp"
#include "StateRoom.hpp"
#include "VehicleSession.Impl.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Maximum number of evicted actions, whose ids must not be performed again.
constexpr std::size_t MAXIMUM_EVICTED = 256;

/// A vehicle can always be stopped, and set free again, even where its state has no room to show it.
bool IsControl(const Action& action)
{
    return action.actionType == ActionTypes::CANCEL_ORDER || action.actionType == ActionTypes::START_PAUSE
        || action.actionType == ActionTypes::STOP_PAUSE;
}

/// As it waits.
ActionState MakeInstantState(const Action& action)
{
    return ActionState{
        action.actionID,
        action.actionType,
        std::string(CutForeignText(action.actionDescription)),
        EActionStatus::Waiting,
        {}};
}

} // namespace

void VehicleSession::Impl::OnInstantActions(std::string_view payload, Core::Now now, VehicleActions& out)
{
    const Core::Result<InstantActionsMessage> message = _codec.Decode<InstantActionsMessage>(payload);
    if (!message)
    {
        RefusePayload(ETopic::InstantActions, payload, message.error(), out);
        return;
    }
    if (!ShouldAccept(ETopic::InstantActions, message->header, out))
    {
        return;
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
        bTaken = TryHandleInstantAction(message->actions[index], message->header, bTooMany, now, out) || bTaken;
    }
    if (bTaken)
    {
        std::erase_if(_sessionErrors, [](const SessionError& known) {
            return known.lifetime == EErrorLifetime::UntilInstantAction && known.bShown;
        });
    }
    FinishPauseIfStationary();
    FinishCancelIfStationary(out);
    Advance(out);
}

bool VehicleSession::Impl::TryHandleInstantAction(
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
    if (IsRepeated(action))
    {
        return false;
    }
    std::string clash = FindClash(action);
    if (clash.empty() && !TryMakeRoomFor(action))
    {
        clash = "the state has no room for another action: maxArrayLens.state.actionStates";
    }
    if (!clash.empty())
    {
        ReportInstantAction(action, header.headerID, ErrorTypes::INSTANT_ACTION_ERROR, {clash, {}});
        return false;
    }
    const std::optional<ActionFault> refusal = FindRefusalOrNull(action, bTooMany);
    if (!refusal.has_value())
    {
        PerformOwnInstantAction(action, header, now, out);
    }
    else
    {
        FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, *refusal);
    }
    const ReportedAction* trackedOrNull = _actions.FindOrNull(action.actionID);
    return trackedOrNull != nullptr && trackedOrNull->machine.GetStatus() != EActionStatus::Failed;
}

/// A repeated id is the same action, sent again by a master that has not seen it in a state.
bool VehicleSession::Impl::IsRepeated(const Action& action)
{
    const ReportedAction* const knownOrNull = _actions.FindOrNull(action.actionID);
    const bool bHeld =
        knownOrNull != nullptr && knownOrNull->IsInstant() && knownOrNull->action.actionType == action.actionType;
    return bHeld || std::ranges::any_of(_evicted, [&action](const EvictedAction& evicted) {
               return evicted.actionID == action.actionID && evicted.actionType == action.actionType;
           });
}

/// Why an action cannot even be shown; empty where it can. A cancel that is not done must not look as if it were.
std::string VehicleSession::Impl::FindClash(const Action& action)
{
    if (std::max(action.actionID.size(), action.actionType.size()) > LONGEST_FOREIGN_TEXT)
    {
        return "actionId or actionType is too long";
    }
    const bool bUsed = _actions.FindOrNull(action.actionID) != nullptr
        || std::ranges::find(_evicted, action.actionID, &EvictedAction::actionID) != _evicted.end();
    return bUsed ? "the actionId is in use already" : std::string();
}

/// Why an instant action fails regardless of its type; nullopt if it is processed.
std::optional<ActionFault> VehicleSession::Impl::FindRefusalOrNull(const Action& action, bool bTooMany) const
{
    const bool bRequest =
        action.actionType == ActionTypes::STATE_REQUEST || action.actionType == ActionTypes::FACTSHEET_REQUEST;
    if (bTooMany)
    {
        return ActionFault{
            "the message has more instant actions than the vehicle takes",
            "maxArrayLens.instantActions"};
    }
    if (!CanMoveByItself() && !bRequest)
    {
        return ActionFault{"the operating mode takes no instant actions", {}};
    }
    const std::vector<ActionFault> faults = FindSizeFaults(Measure(action), _options.factsheet.protocolLimits);
    return faults.empty() ? std::nullopt : std::optional(faults[0]);
}

void VehicleSession::Impl::PerformOwnInstantAction(
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
        const ActionFault fault =
            FindActionFaultOrNull(_options.factsheet, action, EActionScope::Instant, _options.parameterCheck)
                .value_or(ActionFault{FindOwnFault(action, EActionScope::Instant), {}});
        if (!fault.rule.empty())
        {
            FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, fault);
            return;
        }
        ReportUnlistedParameters(action, ETopic::InstantActions);
        Start(AddInstantAction(action, EActionStatus::Waiting), out);
    }
}

/// The oldest instant action that has ended, and was seen to, makes way. False where there is none.
bool VehicleSession::Impl::TryEvict()
{
    const auto oldest = std::ranges::find_if(_actions, [](const ReportedAction& tracked) {
        return tracked.IsInstant() && tracked.IsEnded() && tracked.bShown;
    });
    if (oldest == _actions.end())
    {
        return false;
    }
    if (_evicted.size() >= MAXIMUM_EVICTED)
    {
        _evicted.erase(_evicted.begin());
    }
    _evicted.push_back(EvictedAction{oldest->action.actionID, oldest->action.actionType});
    _actions.Erase(oldest);
    return true;
}

/// False where the state cannot show another action. The factsheet's limit does not keep a vehicle from being stopped.
bool VehicleSession::Impl::TryMakeRoomFor(const Action& action)
{
    const bool bControl = IsControl(action);
    const std::size_t mostActions = bControl ? StateRoom::CONTROL_ACTIONS : StateRoom::INSTANT_ACTIONS;
    const std::size_t mostBytes = bControl ? StateRoom::CONTROL_BYTES : StateRoom::INSTANT_BYTES;
    const std::size_t bytes = MeasureActionState(MakeInstantState(action));
    const std::size_t stated = _options.factsheet.protocolLimits.maxArrayLengths.stateActionStates.value_or(0);
    while (true)
    {
        const bool bFull = _actions.CountInstant() >= mostActions || _actions.GetInstantBytes() + bytes > mostBytes;
        const bool bBeyond = stated != 0 && _actions.GetSize() >= stated;
        if (!bFull && !bBeyond)
        {
            return true;
        }
        if (!TryEvict())
        {
            return bControl && !bFull;
        }
    }
}

ReportedAction& VehicleSession::Impl::AddInstantAction(
    const Action& action,
    EActionStatus status,
    const std::string& result)
{
    ActionState state = MakeInstantState(action);
    state.actionStatus = status;
    state.resultDescription = result;
    return _actions.Add(ReportedAction{action, ActionMachine(std::move(state)), EActionScope::Instant});
}

void VehicleSession::Impl::FailInstantAction(
    const Action& action,
    const Header& header,
    std::string_view errorType,
    const ActionFault& fault)
{
    AddInstantAction(action, EActionStatus::Failed, std::string(CutForeignText(fault.rule)));
    ReportInstantAction(action, header.headerID, errorType, fault);
}

void VehicleSession::Impl::ReportInstantAction(
    const Action& action,
    std::optional<std::uint32_t> headerIDOrNull,
    std::string_view errorType,
    const ActionFault& fault)
{
    VehicleError error;
    error.errorType = errorType;
    error.errorDescription = fault.rule;
    AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::InstantActions));
    if (headerIDOrNull.has_value())
    {
        AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(*headerIDOrNull));
    }
    AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
    if (!fault.field.empty())
    {
        AddReference(error, ReferenceKeys::PARAMETER, fault.field);
    }
    AddSessionError(
        std::move(error),
        errorType == ErrorTypes::NO_ORDER_TO_CANCEL ? EErrorLifetime::UntilOrder : EErrorLifetime::UntilInstantAction);
}

} // namespace ACS::VDA5050
