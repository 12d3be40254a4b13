#include "VehicleView.hpp"

#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

void CancelMasterTimers(MasterActions& out)
{
    for (const EMasterTimer timer :
         {EMasterTimer::ResendOrder, EMasterTimer::ResendInstantActions, EMasterTimer::Silence})
    {
        out.emplace_back(CancelMasterTimer{timer});
    }
}

} // namespace

void VehicleView::OnLinkUp() noexcept
{
    _bLinkUp = true;
}

void VehicleView::OnLinkDown(MasterActions& out)
{
    _bLinkUp = false;
    _bStateSinceOnline = false;
    _freshness = EFreshness::NoState;
    _link = EVehicleLink::Unknown;
    CancelMasterTimers(out);
}

void VehicleView::OnRestartedNumbers() noexcept
{
    _bNumbersKnown = false;
}

void VehicleView::SetConnectionHeader(Header header)
{
    _connectionHeader = std::move(header);
}

void VehicleView::OnOnline(Core::Duration allowedSilence, Core::Now now, MasterActions& out)
{
    _link = EVehicleLink::Online;
    _bStateSinceOnline = false;
    _freshness = EFreshness::NoState;
    _lastStateTime = now.steady;
    out.emplace_back(VehicleOnline{});
    out.emplace_back(StartMasterTimer{EMasterTimer::Silence, allowedSilence});
}

void VehicleView::OnGone(EVehicleLink link, MasterActions& out)
{
    if (_link == link)
    {
        return; // a repeated retained message, or a will after it was read once
    }
    _link = link;
    _bStateSinceOnline = false;
    _freshness = EFreshness::NoState;
    CancelMasterTimers(out);
    if (link == EVehicleLink::Broken)
    {
        out.emplace_back(VehicleBroken{});
    }
    else
    {
        out.emplace_back(VehicleOffline{});
    }
}

std::optional<StateMessage> VehicleView::ReplaceStateOrNull(
    StateMessage state,
    Core::Duration allowedSilence,
    Core::Now now,
    MasterActions& out)
{
    _lastStateTime = now.steady;
    _bNumbersKnown = true;
    _bStateSinceOnline = true;
    if (std::exchange(_freshness, EFreshness::Fresh) == EFreshness::Silent)
    {
        out.emplace_back(StartMasterTimer{EMasterTimer::Silence, allowedSilence});
    }
    std::optional<StateMessage> previous = std::exchange(_state, std::move(state));
    out.emplace_back(StateReceived{});
    if (_state->agvPosition.has_value())
    {
        out.emplace_back(PositionReceived{*_state->agvPosition, _state->velocity});
    }
    return previous;
}

void VehicleView::CheckSilence(Core::Duration allowed, Core::Now now, MasterActions& out)
{
    if (!IsOnline() || _freshness == EFreshness::Silent)
    {
        return;
    }
    const Core::Duration age = now.steady - _lastStateTime;
    if (age < allowed)
    {
        out.emplace_back(StartMasterTimer{EMasterTimer::Silence, allowed - age});
        return;
    }
    _freshness = EFreshness::Silent;
    out.emplace_back(VehicleSilent{age});
}

/// Of a repeated action or error, only the first is reported: otherwise each state would report a change again.
void VehicleView::ReportDifferences(
    const std::optional<StateMessage>& previousOrNull,
    const ActionIndex& shown,
    MasterActions& out) const
{
    const StateMessage none;
    const StateMessage& before = previousOrNull.has_value() ? *previousOrNull : none;
    const ActionIndex actionsBefore(before.actionStates);
    for (const ActionState& action : _state->actionStates)
    {
        const ActionState* const known = actionsBefore.FindOrNull(action.actionID);
        const bool bSame = known != nullptr && known->actionStatus == action.actionStatus
            && known->resultDescription == action.resultDescription;
        if (!bSame && shown.FindOrNull(action.actionID) == &action)
        {
            out.emplace_back(
                ActionChanged{action.actionID, action.actionType, action.actionStatus, action.resultDescription});
        }
    }
    const SortedIndex<VehicleError> errorsBefore(before.errors);
    const SortedIndex<VehicleError> errorsNow(_state->errors);
    const auto report = [&out](const auto& errors, const auto& own, const auto& other, bool bActive) {
        for (const VehicleError& error : errors)
        {
            if (other.FindOrNull(error) == nullptr && own.FindOrNull(error) == &error)
            {
                out.emplace_back(VehicleErrorChanged{error, bActive});
            }
        }
    };
    report(_state->errors, errorsNow, errorsBefore, true);
    report(before.errors, errorsBefore, errorsNow, false);
}

bool VehicleView::IsLinkUp() const noexcept
{
    return _bLinkUp;
}

EVehicleLink VehicleView::GetLink() const noexcept
{
    return _link;
}

bool VehicleView::IsOnline() const noexcept
{
    return _link == EVehicleLink::Online;
}

bool VehicleView::WasRestarted(const Header& connection) const
{
    if (!_connectionHeader.has_value() || connection.headerID > _connectionHeader->headerID)
    {
        return false;
    }
    return connection.headerID < _connectionHeader->headerID || connection.timestamp != _connectionHeader->timestamp;
}

bool VehicleView::IsReady() const noexcept
{
    return IsOnline() && _freshness == EFreshness::Fresh;
}

bool VehicleView::HasStateSinceOnline() const noexcept
{
    return _bStateSinceOnline;
}

bool VehicleView::IsUnderMasterControl() const
{
    return !_state.has_value() || IsLedByMaster(_state->operatingMode);
}

bool VehicleView::CanReceive() const
{
    return IsOnline() && IsUnderMasterControl();
}

bool VehicleView::IsBusy() const
{
    return _state.has_value() && !(_state->nodeStates.empty() && _state->edgeStates.empty());
}

/// Both must be older: clocks are set. After a restart both may be, and its ONLINE comes first.
bool VehicleView::IsStale(const StateMessage& state) const
{
    return _bNumbersKnown && _state.has_value() && state.header.headerID < _state->header.headerID
        && state.header.timestamp < _state->header.timestamp;
}

bool VehicleView::IsShowingOrder(std::string_view orderID) const
{
    return _state.has_value() && _state->orderID == orderID;
}

const ActionState* VehicleView::FindActionOrNull(std::string_view actionID) const
{
    if (!_state.has_value())
    {
        return nullptr;
    }
    const auto found = std::ranges::find(_state->actionStates, actionID, &ActionState::actionID);
    return found == _state->actionStates.end() ? nullptr : &*found;
}

const StateMessage* VehicleView::GetStateOrNull() const noexcept
{
    return _state.has_value() ? &*_state : nullptr;
}

} // namespace ACS::VDA5050
