#include "RouteDrive.hpp"

#include "OrderErrors.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

bool IsBlockingDriving(const Action& action)
{
    return action.blockingType != EBlockingType::None;
}

bool HasBlocking(std::span<const Action> actions)
{
    return std::ranges::any_of(actions, IsBlockingDriving);
}

} // namespace

RouteDrive::RouteDrive(std::string lastNodeID)
    : _lastNodeID(std::move(lastNodeID))
{
}

void RouteDrive::Begin(const OrderNode& first)
{
    Discard();
    _lastNodeID = first.nodeID;
    _lastNodeSequenceID = first.sequenceID;
}

void RouteDrive::Append(OrderMessage order)
{
    _route.Append(std::move(order));
}

std::optional<std::uint32_t> RouteDrive::DropHorizonOrNull()
{
    const std::size_t kept = _route.CountReleased();
    if (kept == _route.GetSize())
    {
        return std::nullopt;
    }
    const std::uint32_t firstDropped = _route.GetEdgeSequenceID(kept);
    _route.Cut(kept);
    return firstDropped;
}

bool RouteDrive::TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory)
{
    return _route.TrySetTrajectory(edgeSequenceID, std::move(trajectory));
}

bool RouteDrive::TryEnterEdge()
{
    if (_place != EPlace::AtNode)
    {
        return false;
    }
    _place = EPlace::EdgeEntered;
    return true;
}

void RouteDrive::DriveToFront(VehicleActions& out)
{
    const bool bStopAtNode = NeedsStopAtFront();
    if (_motion != (bStopAtNode ? EMotion::DrivingToStop : EMotion::DrivingThrough))
    {
        SendDriveTo(bStopAtNode, out);
    }
}

void RouteDrive::DriveLastLeg(VehicleActions& out)
{
    const bool bSent = _motion == EMotion::DrivingToStop;
    if (_bLastLeg && !IsEndReached() && !bSent && !_corridorError.has_value())
    {
        SendDriveTo(true, out);
    }
}

void RouteDrive::SendDriveTo(bool bStopAtNode, VehicleActions& out)
{
    _place = EPlace::BetweenNodes;
    _motion = bStopAtNode ? EMotion::DrivingToStop : EMotion::DrivingThrough;
    std::optional<NextLeg> next;
    if (!bStopAtNode)
    {
        next = NextLeg{_route.GetEdge(1), _route.GetNode(1)};
    }
    out.emplace_back(DriveTo{_route.GetEdge(0), _route.GetNode(0), bStopAtNode, std::move(next)});
}

void RouteDrive::Stop(VehicleActions& out)
{
    if (IsLegActive())
    {
        _motion = EMotion::Halting;
        out.emplace_back(StopDriving{});
    }
}

void RouteDrive::OnStationary()
{
    _bDriving = false;
    _motion = EMotion::None; // an action that fails at the node has no drive to stop
}

bool RouteDrive::TryChangeDriving(bool bDriving)
{
    // A stop may end without a change of driving, if the vehicle had not started to move.
    const bool bHalted = _motion == EMotion::Halting && !bDriving;
    if (bHalted)
    {
        _motion = EMotion::None;
    }
    return std::exchange(_bDriving, bDriving) != bDriving || bHalted;
}

void RouteDrive::LeaveEdge(bool bCancelling)
{
    _place = bCancelling && _route.GetSize() == 1 ? EPlace::EndReached : EPlace::AtNode;
    if (IsLegActive())
    {
        _motion = EMotion::None;
    }
    _corridorError.reset();
}

void RouteDrive::PassFrontNode()
{
    _lastNodeID = _route.GetNodeID(0);
    _lastNodeSequenceID = _route.GetNodeSequenceID(0);
    _route.DropFront();
}

/// lastNodeSequenceId stays: it counts within the order that is held, and an update may still follow.
void RouteDrive::SetLastNode(std::string nodeID)
{
    _lastNodeID = std::move(nodeID);
}

bool RouteDrive::TryChangeCorridor(bool bOutside, VehicleActions& out)
{
    if (bOutside == _corridorError.has_value())
    {
        return false;
    }
    _corridorError.reset();
    if (bOutside)
    {
        const std::string& edgeID = _route.GetEdgeID(0);
        VehicleError& error = _corridorError.emplace();
        error.errorType = ErrorTypes::OUTSIDE_OF_CORRIDOR;
        error.errorLevel = EErrorLevel::Fatal;
        error.errorDescription = "outside of the corridor of " + edgeID;
        AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::Order));
        AddReference(error, ReferenceKeys::EDGE_ID, edgeID);
        Stop(out);
    }
    return true;
}

void RouteDrive::Cancel(bool bStopsBetweenNodes, VehicleActions& out)
{
    if (bStopsBetweenNodes || !IsBetweenNodes())
    {
        _bLastLeg = false; // of an earlier cancel
        Stop(out);
        return;
    }
    _bLastLeg = true;
    _route.Cut(1);
    _route.DropFrontActions(); // they have failed
}

void RouteDrive::Clear()
{
    Discard();
    if (IsLegActive())
    {
        _motion = EMotion::None;
    }
    _bLastLeg = false;
}

void RouteDrive::Discard()
{
    _route.Clear();
    _place = EPlace::AtNode;
    _corridorError.reset();
}

void RouteDrive::Forget(bool bBetweenNodes)
{
    _lastNodeSequenceID = 0;
    if (bBetweenNodes)
    {
        _lastNodeID.clear();
    }
}

const RemainingRoute& RouteDrive::GetRoute() const noexcept
{
    return _route;
}

bool RouteDrive::IsOnEdgeTo(std::uint32_t sequenceID) const
{
    const bool bOnEdge = _place == EPlace::EdgeEntered || IsBetweenNodes();
    return bOnEdge && !_route.IsEmpty() && _route.GetNodeSequenceID(0) == sequenceID;
}

bool RouteDrive::IsBetweenNodes() const noexcept
{
    return _place == EPlace::BetweenNodes;
}

bool RouteDrive::IsEndReached() const noexcept
{
    return _place == EPlace::EndReached;
}

bool RouteDrive::IsOnLastLeg() const noexcept
{
    return _bLastLeg;
}

bool RouteDrive::IsLegActive() const noexcept
{
    return _motion == EMotion::DrivingThrough || _motion == EMotion::DrivingToStop;
}

bool RouteDrive::IsStationary() const noexcept
{
    return !_bDriving && _motion != EMotion::Halting;
}

bool RouteDrive::HasCorridor() const
{
    const bool bOnEdge = _place == EPlace::EdgeEntered || IsBetweenNodes();
    return bOnEdge && !_route.IsEmpty() && _route.HasCorridor(0);
}

bool RouteDrive::CanContinue() const
{
    return _route.CountReleased() > 0 && !_corridorError.has_value();
}

bool RouteDrive::CanFinishCancel() const
{
    const bool bNodeToReach = _bLastLeg && !IsEndReached() && !_corridorError.has_value();
    return IsStationary() && !IsLegActive() && !bNodeToReach;
}

bool RouteDrive::NeedsNewBase(std::size_t lowBaseNodes) const
{
    const std::size_t released = _route.CountReleased();
    return released < _route.GetSize() && released <= lowBaseNodes;
}

bool RouteDrive::NeedsStopAtFront() const
{
    return _route.CountReleased() < 2 || HasBlocking(_route.GetNodeActions(0)) || HasBlocking(_route.GetEdgeActions(1));
}

void RouteDrive::Fill(StateMessage& state, bool bEdgesShown) const
{
    state.lastNodeID = _lastNodeID;
    state.lastNodeSequenceID = _lastNodeSequenceID;
    state.bDriving = _bDriving;
    const std::size_t size = _route.GetSize();
    state.nodeStates.reserve(size);
    for (std::size_t index = 0; index < size; ++index)
    {
        state.nodeStates.push_back(_route.GetNodeState(index));
    }
    const std::size_t edges = bEdgesShown ? size : 0;
    state.edgeStates.reserve(edges);
    for (std::size_t index = 0; index < edges; ++index)
    {
        state.edgeStates.push_back(_route.GetEdgeState(index));
    }
    if (_corridorError.has_value())
    {
        state.errors.push_back(*_corridorError);
    }
}

void RouteDrive::Fill(OrderContext& context) const
{
    context.lastNodeID = _lastNodeID;
    context.decisionNodeID = _lastNodeID;
    context.decisionSequenceID = _lastNodeSequenceID;
    const std::size_t released = _route.CountReleased();
    if (released > 0)
    {
        context.decisionNodeID = _route.GetNodeID(released - 1);
        context.decisionSequenceID = _route.GetNodeSequenceID(released - 1);
    }
    context.keptNodes = released;
    context.keptBytes = _route.GetReleasedBytes();
}

} // namespace ACS::VDA5050
