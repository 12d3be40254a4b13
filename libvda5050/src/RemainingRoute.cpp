#include "RemainingRoute.hpp"

#include "StateRoom.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::VDA5050
{
namespace
{

/// Null if all members are empty.
template <typename TExtras>
std::unique_ptr<TExtras> KeepOrNull(TExtras extras)
{
    return extras == TExtras() ? nullptr : std::make_unique<TExtras>(std::move(extras));
}

} // namespace

RemainingRoute::Step RemainingRoute::MakeStep(OrderEdge edge, OrderNode node)
{
    Step step;
    step.edgeID = std::move(edge.edgeID);
    step.edgeSequenceID = edge.sequenceID;
    step.bEdgeReleased = edge.bReleased;
    step.maxSpeed = edge.maxSpeed;
    step.orientation = edge.orientation;
    step.maxRotationSpeed = edge.maxRotationSpeed;
    step.length = edge.length;
    step.orientationType = edge.orientationType;
    step.bRotationAllowed = edge.bRotationAllowed;
    step.edgeExtrasOrNull = KeepOrNull(EdgeExtras{
        std::move(edge.edgeDescription),
        std::move(edge.direction),
        edge.maxHeight,
        edge.minHeight,
        std::move(edge.trajectory),
        edge.corridor,
        std::move(edge.actions)});
    step.nodeID = std::move(node.nodeID);
    step.nodeSequenceID = node.sequenceID;
    step.bNodeReleased = node.bReleased;
    NodeExtras extras{std::move(node.nodeDescription), {}, std::move(node.actions)};
    if (node.nodePosition.has_value())
    {
        NodePosition& position = *node.nodePosition;
        extras.mapDescription = std::move(position.mapDescription);
        step.position = Position{
            position.x,
            position.y,
            position.theta,
            position.allowedDeviationXY,
            position.allowedDeviationTheta,
            std::move(position.mapID)};
    }
    step.nodeExtrasOrNull = KeepOrNull(std::move(extras));
    return step;
}

void RemainingRoute::Append(OrderMessage order)
{
    assert(order.nodes.size() == order.edges.size() + 1);
    if (_steps.empty())
    {
        _startNodeID = order.nodes.front().nodeID;
    }
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        const bool bReleased = order.nodes[index + 1].bReleased && _released == _steps.size();
        _steps.push_back(MakeStep(std::move(order.edges[index]), std::move(order.nodes[index + 1])));
        _released += bReleased ? 1U : 0U;
        _bytes += Measure(_steps.size() - 1);
    }
}

void RemainingRoute::DropFront()
{
    assert(!_steps.empty());
    _bytes -= Measure(0);
    _startNodeID = std::move(_steps.front().nodeID);
    _steps.pop_front();
    _released -= std::min<std::size_t>(_released, 1);
}

void RemainingRoute::Cut(std::size_t size)
{
    while (_steps.size() > size)
    {
        _bytes -= Measure(_steps.size() - 1);
        _steps.pop_back();
    }
    _released = std::min(_released, size);
}

void RemainingRoute::DropFrontActions()
{
    if (_steps.front().nodeExtrasOrNull != nullptr)
    {
        _steps.front().nodeExtrasOrNull->actions.clear();
    }
}

bool RemainingRoute::TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory)
{
    const auto step = std::ranges::find(_steps, edgeSequenceID, &Step::edgeSequenceID);
    if (step == _steps.end() || (step->edgeExtrasOrNull != nullptr && step->edgeExtrasOrNull->trajectory.has_value()))
    {
        return false;
    }
    const std::size_t added = MeasureTrajectory(trajectory);
    if (_bytes + added > StateRoom::ORDER_BYTES)
    {
        return false;
    }
    _bytes += added;
    if (step->edgeExtrasOrNull == nullptr)
    {
        step->edgeExtrasOrNull = std::make_unique<EdgeExtras>();
    }
    step->edgeExtrasOrNull->trajectory = std::move(trajectory);
    return true;
}

void RemainingRoute::Clear()
{
    _steps.clear();
    _released = 0;
    _bytes = 0;
}

bool RemainingRoute::IsEmpty() const noexcept
{
    return _steps.empty();
}

std::size_t RemainingRoute::GetSize() const noexcept
{
    return _steps.size();
}

std::size_t RemainingRoute::CountReleased() const
{
    return _released;
}

std::size_t RemainingRoute::Measure(std::size_t index) const
{
    return MeasureEdgeState(GetEdgeState(index)) + MeasureNodeState(GetNodeState(index));
}

std::size_t RemainingRoute::GetReleasedBytes() const
{
    std::size_t bytes = _bytes;
    for (std::size_t index = _released; index < _steps.size(); ++index)
    {
        bytes -= Measure(index);
    }
    return bytes;
}

const std::string& RemainingRoute::GetStartNodeID(std::size_t index) const
{
    return index == 0 ? _startNodeID : _steps[index - 1].nodeID;
}

OrderEdge RemainingRoute::GetEdge(std::size_t index) const
{
    const Step& step = _steps[index];
    OrderEdge edge;
    edge.edgeID = step.edgeID;
    edge.sequenceID = step.edgeSequenceID;
    edge.bReleased = step.bEdgeReleased;
    edge.startNodeID = GetStartNodeID(index);
    edge.endNodeID = step.nodeID;
    edge.maxSpeed = step.maxSpeed;
    edge.orientation = step.orientation;
    edge.maxRotationSpeed = step.maxRotationSpeed;
    edge.length = step.length;
    edge.orientationType = step.orientationType;
    edge.bRotationAllowed = step.bRotationAllowed;
    if (step.edgeExtrasOrNull != nullptr)
    {
        const EdgeExtras& extras = *step.edgeExtrasOrNull;
        edge.edgeDescription = extras.edgeDescription;
        edge.direction = extras.direction;
        edge.maxHeight = extras.maxHeight;
        edge.minHeight = extras.minHeight;
        edge.trajectory = extras.trajectory;
        edge.corridor = extras.corridor;
        edge.actions = extras.actions;
    }
    return edge;
}

OrderNode RemainingRoute::GetNode(std::size_t index) const
{
    const Step& step = _steps[index];
    OrderNode node;
    node.nodeID = step.nodeID;
    node.sequenceID = step.nodeSequenceID;
    node.bReleased = step.bNodeReleased;
    if (step.position.has_value())
    {
        const Position& held = *step.position;
        node.nodePosition = NodePosition{
            held.x,
            held.y,
            held.theta,
            held.allowedDeviationXY,
            held.allowedDeviationTheta,
            held.mapID,
            {}};
    }
    if (step.nodeExtrasOrNull != nullptr)
    {
        const NodeExtras& extras = *step.nodeExtrasOrNull;
        node.nodeDescription = extras.nodeDescription;
        node.actions = extras.actions;
        if (node.nodePosition.has_value())
        {
            node.nodePosition->mapDescription = extras.mapDescription;
        }
    }
    return node;
}

const std::string& RemainingRoute::GetEdgeID(std::size_t index) const
{
    return _steps[index].edgeID;
}

bool RemainingRoute::HasCorridor(std::size_t index) const
{
    const std::unique_ptr<EdgeExtras>& extrasOrNull = _steps[index].edgeExtrasOrNull;
    return extrasOrNull != nullptr && extrasOrNull->corridor.has_value();
}

const std::string& RemainingRoute::GetNodeID(std::size_t index) const
{
    return _steps[index].nodeID;
}

std::uint32_t RemainingRoute::GetNodeSequenceID(std::size_t index) const
{
    return _steps[index].nodeSequenceID;
}

std::uint32_t RemainingRoute::GetEdgeSequenceID(std::size_t index) const
{
    return _steps[index].edgeSequenceID;
}

std::span<const Action> RemainingRoute::GetNodeActions(std::size_t index) const
{
    const std::unique_ptr<NodeExtras>& extrasOrNull = _steps[index].nodeExtrasOrNull;
    return extrasOrNull != nullptr ? std::span<const Action>(extrasOrNull->actions) : std::span<const Action>();
}

std::span<const Action> RemainingRoute::GetEdgeActions(std::size_t index) const
{
    const std::unique_ptr<EdgeExtras>& extrasOrNull = _steps[index].edgeExtrasOrNull;
    return extrasOrNull != nullptr ? std::span<const Action>(extrasOrNull->actions) : std::span<const Action>();
}

NodeState RemainingRoute::GetNodeState(std::size_t index) const
{
    const Step& step = _steps[index];
    NodeState state;
    state.nodeID = step.nodeID;
    state.sequenceID = step.nodeSequenceID;
    state.bReleased = step.bNodeReleased;
    if (step.nodeExtrasOrNull != nullptr)
    {
        state.nodeDescription = step.nodeExtrasOrNull->nodeDescription;
    }
    if (step.position.has_value())
    {
        const Position& held = *step.position;
        state.nodePosition = NodeStatePosition{held.x, held.y, held.theta, held.mapID};
    }
    return state;
}

EdgeState RemainingRoute::GetEdgeState(std::size_t index) const
{
    const Step& step = _steps[index];
    EdgeState state;
    state.edgeID = step.edgeID;
    state.sequenceID = step.edgeSequenceID;
    state.bReleased = step.bEdgeReleased;
    if (step.edgeExtrasOrNull != nullptr)
    {
        state.edgeDescription = step.edgeExtrasOrNull->edgeDescription;
        state.trajectory = step.edgeExtrasOrNull->trajectory;
    }
    return state;
}

} // namespace ACS::VDA5050
