#include "robots/OperatorActions.hpp"

#include "robots/VehicleDetails.hpp"
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace ACS::Acsd
{

namespace
{

ERobotActionStatus MapStatus(VDA5050::EActionStatus status)
{
    switch (status)
    {
        case VDA5050::EActionStatus::Initializing:
            return ERobotActionStatus::Initializing;
        case VDA5050::EActionStatus::Running:
            return ERobotActionStatus::Running;
        case VDA5050::EActionStatus::Paused:
            return ERobotActionStatus::Paused;
        case VDA5050::EActionStatus::Finished:
            return ERobotActionStatus::Finished;
        case VDA5050::EActionStatus::Failed:
            return ERobotActionStatus::Failed;
        case VDA5050::EActionStatus::Waiting:
        default:
            return ERobotActionStatus::Waiting;
    }
}

bool IsAcceptedInAnyMode(std::string_view actionType)
{
    return actionType == VDA5050::ActionTypes::STATE_REQUEST || actionType == VDA5050::ActionTypes::FACTSHEET_REQUEST;
}

/// Why the vehicle cannot be sent a valid request now; nullopt if it can.
std::optional<std::string> FindConflictOrNull(std::string_view actionType, const VDA5050::MasterSession& session)
{
    if (session.GetLink() != VDA5050::EVehicleLink::Online)
    {
        return "The robot is not connected.";
    }
    const VDA5050::StateMessage* const stateOrNull = session.GetStateOrNull();
    if (stateOrNull != nullptr && !VDA5050::IsLedByMaster(stateOrNull->operatingMode)
        && !IsAcceptedInAnyMode(actionType))
    {
        return fmt::format(
            "The robot is in the mode {}, in which VDA5050 permits stateRequest and factsheetRequest only.",
            GetModeText(stateOrNull->operatingMode));
    }
    if (actionType == VDA5050::ActionTypes::INIT_POSITION && session.GetOrderPhase() != VDA5050::EOrderPhase::None)
    {
        return "The robot executes an order, which is planned from its present position. Request initPosition after the order, or abort "
               "its plan first.";
    }
    return std::nullopt;
}

/// The error by which the vehicle refuses an action that it does not show.
const VDA5050::VehicleError* FindRefusalOrNull(const VDA5050::StateMessage& state, const std::string& actionID)
{
    const auto isOfAction = [&actionID](const VDA5050::VehicleError& error) {
        return std::ranges::any_of(error.errorReferences, [&actionID](const VDA5050::ErrorReference& reference) {
            return reference.referenceKey == "actionId" && reference.referenceValue == actionID;
        });
    };
    const auto found = std::ranges::find_if(state.errors, isOfAction);
    return found == state.errors.end() ? nullptr : &*found;
}

} // namespace

OperatorActions::OperatorActions(InstantActionCheck check, RobotOutputs& outputs)
    : _check(std::move(check)),
      _outputs(outputs)
{
}

tl::expected<std::string, RobotActionRefusal> OperatorActions::Send(
    const RobotActionRequest& request,
    VDA5050::MasterSession& session,
    Core::Now now,
    VDA5050::MasterActions& sessionOut,
    Planning::AdapterActions& out)
{
    if (std::optional<std::string> error = _check.FindErrorOrNull(request, session.GetFactsheetOrNull()))
    {
        return tl::make_unexpected(RobotActionRefusal{true, std::move(*error)});
    }
    if (std::optional<std::string> conflict = FindConflictOrNull(request.actionType, session))
    {
        return tl::make_unexpected(RobotActionRefusal{false, std::move(*conflict)});
    }
    VDA5050::Action action;
    action.actionType = request.actionType;
    for (const RobotActionParameter& parameter : request.parameters)
    {
        action.actionParameters.push_back({parameter.key, parameter.value});
    }
    Core::Result<std::string> sent = session.SendInstantAction(std::move(action), now, sessionOut);
    if (!sent)
    {
        return tl::make_unexpected(RobotActionRefusal{
            false,
            fmt::format("{} cannot be sent: {}.", request.actionType, Core::Describe(sent.error()))});
    }
    if (_sent.size() >= MOST_OBSERVED)
    {
        _sent.pop_front();
    }
    _sent.push_back({{*sent, ERobotActionStatus::Waiting, {}}, now.steady});
    StartTimer(now, out);
    return std::move(*sent);
}

void OperatorActions::OnState(const VDA5050::StateMessage& state)
{
    for (Sent& sent : _sent)
    {
        const std::string& actionID = sent.last.actionID;
        const auto shown = std::ranges::find(state.actionStates, actionID, &VDA5050::ActionState::actionID);
        if (shown != state.actionStates.end())
        {
            sent.bShown = true;
            Report(sent, MapStatus(shown->actionStatus), shown->resultDescription);
        }
        else if (const VDA5050::VehicleError* const refusalOrNull = FindRefusalOrNull(state, actionID))
        {
            Report(sent, ERobotActionStatus::Failed, refusalOrNull->errorType + ": " + refusalOrNull->errorDescription);
        }
        else if (sent.bShown)
        {
            Report(sent, ERobotActionStatus::Unknown, "The robot no longer reports the action.");
        }
    }
    std::erase_if(_sent, [](const Sent& sent) {
        return IsEnded(sent.last.status) && sent.last.status != ERobotActionStatus::Unknown;
    });
}

void OperatorActions::OnDisconnected(VDA5050::MasterSession& session)
{
    for (Sent& sent : _sent)
    {
        if (!sent.bShown)
        {
            Abandon(sent, session, "The robot was disconnected before it reported the action.");
        }
    }
}

void OperatorActions::OnTimer(VDA5050::MasterSession& session, Core::Now now, Planning::AdapterActions& out)
{
    for (Sent& sent : _sent)
    {
        if (!sent.bShown && now.steady - sent.sentAt >= SHOW_TIMEOUT)
        {
            Abandon(
                sent,
                session,
                fmt::format(
                    "The robot did not report the action within {} s. It may have performed it.",
                    std::chrono::duration_cast<std::chrono::seconds>(SHOW_TIMEOUT).count()));
        }
    }
    StartTimer(now, out);
}

bool OperatorActions::IsRequested(std::string_view actionID) const
{
    return std::ranges::any_of(_sent, [actionID](const Sent& sent) { return sent.last.actionID == actionID; });
}

void OperatorActions::Report(Sent& sent, ERobotActionStatus status, const std::string& resultDescription)
{
    RobotActionChange change{sent.last.actionID, status, resultDescription};
    if (sent.last != change)
    {
        sent.last = change;
        _outputs.actionChanges.push_back(std::move(change));
    }
}

void OperatorActions::Abandon(Sent& sent, VDA5050::MasterSession& session, const std::string& reason)
{
    static_cast<void>(session.TryWithdrawInstantAction(sent.last.actionID));
    if (!IsEnded(sent.last.status))
    {
        Report(sent, ERobotActionStatus::Unknown, reason);
    }
}

/// Until the first time limit of an action that the vehicle has not shown.
void OperatorActions::StartTimer(Core::Now now, Planning::AdapterActions& out) const
{
    const auto waits =
        std::ranges::find_if(_sent, [](const Sent& sent) { return !sent.bShown && !IsEnded(sent.last.status); });
    if (waits != _sent.end())
    {
        out.emplace_back(Planning::StartAdapterTimer{TIMER, waits->sentAt + SHOW_TIMEOUT - now.steady});
    }
}

} // namespace ACS::Acsd
