#include "ActionFault.hpp"
#include "MessageSizes.hpp"
#include "OrderErrors.hpp"
#include "VehicleSession.Impl.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

bool IsPerformedBySession(std::string_view actionType)
{
    return actionType == ActionTypes::STATE_REQUEST || actionType == ActionTypes::FACTSHEET_REQUEST
        || actionType == ActionTypes::CANCEL_ORDER || actionType == ActionTypes::START_PAUSE
        || actionType == ActionTypes::STOP_PAUSE;
}

} // namespace

void VehicleSession::Impl::OnInstantActions(std::string_view payload, Core::Now now, VehicleActions& out)
{
    const Core::Result<InstantActionsMessage> message = _topics.Decode<InstantActionsMessage>(payload);
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
    const std::uint64_t mark = _errors.GetMark();
    bool bTaken = false;
    for (std::size_t index = 0; index < message->actions.size(); ++index)
    {
        const bool bTooMany = allowed != 0 && index >= allowed;
        bTaken = TryHandleInstantAction(message->actions[index], message->header, bTooMany, now, out) || bTaken;
    }
    if (bTaken)
    {
        _errors.End(SessionErrors::ELifetime::UntilInstantAction, mark);
    }
    FinishIfStationary(out);
    Advance(out);
}

bool VehicleSession::Impl::TryHandleInstantAction(
    const Action& action,
    const Header& header,
    bool bTooMany,
    Core::Now now,
    VehicleActions& out)
{
    _schedule.Request();
    if (action.actionID.empty())
    {
        _errors.AddNamelessAction(header);
        return false;
    }
    if (_actions.IsRepeated(action))
    {
        return false;
    }
    std::string clash = _actions.FindClash(action);
    if (clash.empty() && !_actions.TryMakeRoomFor(action))
    {
        clash = "the state has no room for another action: maxArrayLens.state.actionStates";
    }
    if (!clash.empty())
    {
        _errors.AddInstantActionError(action, header.headerID, ErrorTypes::INSTANT_ACTION_ERROR, {clash, {}});
        return false;
    }
    const std::optional<ActionFault> refusal = FindRefusalOrNull(action, bTooMany);
    if (!refusal.has_value())
    {
        PerformInstantAction(action, header, now, out);
    }
    else
    {
        FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, *refusal);
    }
    const ReportedAction* trackedOrNull = _actions.FindOrNull(action.actionID);
    return trackedOrNull != nullptr && trackedOrNull->machine.GetStatus() != EActionStatus::Failed;
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
    if (!_reports.IsLed() && !bRequest)
    {
        return ActionFault{"the operating mode takes no instant actions", {}};
    }
    const std::vector<ActionFault> faults = FindSizeFaults(Measure(action), _options.factsheet.protocolLimits);
    return faults.empty() ? std::nullopt : std::optional(faults[0]);
}

void VehicleSession::Impl::PerformInstantAction(
    const Action& action,
    const Header& header,
    Core::Now now,
    VehicleActions& out)
{
    if (IsPerformedBySession(action.actionType))
    {
        const std::optional<ActionFault> fault =
            FindSessionActionFaultOrNull(_options.factsheet, action, _options.parameterCheck);
        if (fault.has_value())
        {
            FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, *fault);
            return;
        }
        ReportUnlistedParameters(action, ETopic::InstantActions);
    }
    if (action.actionType == ActionTypes::STATE_REQUEST)
    {
        _actions.AddInstant(action, EActionStatus::Finished);
    }
    else if (action.actionType == ActionTypes::FACTSHEET_REQUEST)
    {
        PublishFactsheet(now, out);
        _actions.AddInstant(action, EActionStatus::Finished);
    }
    else if (action.actionType == ActionTypes::CANCEL_ORDER)
    {
        StartCancel(action, header, out);
    }
    else if (action.actionType == ActionTypes::START_PAUSE || action.actionType == ActionTypes::STOP_PAUSE)
    {
        ChangePause(action, header, out);
    }
    else
    {
        const ActionFault fault =
            FindActionFaultOrNull(_options.factsheet, action, EActionScope::Instant, _options.parameterCheck)
                .value_or(ActionFault{_reports.FindFault(action, IsExecuting()), {}});
        if (!fault.rule.empty())
        {
            FailInstantAction(action, header, ErrorTypes::INSTANT_ACTION_ERROR, fault);
            return;
        }
        ReportUnlistedParameters(action, ETopic::InstantActions);
        Start(_actions.AddInstant(action, EActionStatus::Waiting), out);
    }
}

void VehicleSession::Impl::FailInstantAction(
    const Action& action,
    const Header& header,
    std::string_view errorType,
    const ActionFault& fault)
{
    _actions.AddInstant(action, EActionStatus::Failed, CutForeignText(fault.rule));
    _errors.AddInstantActionError(action, header.headerID, errorType, fault);
}

} // namespace ACS::VDA5050
