#include "VehicleModel.hpp"

#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace ACS::Fuzz
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

VehicleModel::VehicleModel()
{
    _state.header.version = "2.0.0";
    _state.header.manufacturer = "ACS";
    _state.header.serialNumber = "LR01";
    _state.lastNodeID = "n0";
}

bool VehicleModel::IsBusy() const
{
    const bool bActs = std::ranges::any_of(_state.actionStates, [this](const ActionState& action) {
        return _orderActions.contains(action.actionID) && !IsTerminal(action.actionStatus);
    });
    return bActs || !_state.nodeStates.empty() || !_state.edgeStates.empty();
}

void VehicleModel::AddError(VehicleError error)
{
    constexpr std::size_t MOST_ERRORS = 4;
    if (_state.errors.size() == MOST_ERRORS)
    {
        _state.errors.erase(_state.errors.begin());
    }
    _state.errors.push_back(std::move(error));
}

void VehicleModel::Refuse(std::string_view errorType, const OrderMessage& order)
{
    VehicleError error;
    error.errorType = errorType;
    error.errorReferences = {
        {"topic", "order"},
        {"orderId", order.orderID},
        {"orderUpdateId", std::to_string(order.orderUpdateID)}};
    AddError(std::move(error));
}

void VehicleModel::Receive(const OrderMessage& order)
{
    if (order.nodes.empty() || order.edges.size() + 1 != order.nodes.size() || !IsLedByMaster(_state.operatingMode))
    {
        Refuse("validationError", order);
    }
    else if (order.orderID != _state.orderID)
    {
        if (IsBusy())
        {
            Refuse("orderError", order);
            return;
        }
        Begin(order);
    }
    else if (order.orderUpdateID > _state.orderUpdateID)
    {
        Extend(order);
    }
}

void VehicleModel::Begin(const OrderMessage& order)
{
    std::erase_if(_state.actionStates, [this](const ActionState& action) {
        return _orderActions.contains(action.actionID);
    });
    _orderActions.clear();
    _state.orderID = order.orderID;
    _state.lastNodeID = order.nodes.front().nodeID;
    _state.lastNodeSequenceID = order.nodes.front().sequenceID;
    Append(order, 0);
    std::erase_if(_state.nodeStates, [this](const NodeState& node) {
        return node.sequenceID == _state.lastNodeSequenceID;
    });
}

void VehicleModel::Extend(const OrderMessage& order)
{
    std::uint32_t decisionPoint = _state.lastNodeSequenceID;
    for (const NodeState& node : _state.nodeStates)
    {
        decisionPoint = node.bReleased ? node.sequenceID : decisionPoint;
    }
    if (order.nodes.front().sequenceID != decisionPoint)
    {
        Refuse("orderUpdateError", order);
        return;
    }
    std::erase_if(_state.nodeStates, [](const NodeState& node) { return !node.bReleased; });
    std::erase_if(_state.edgeStates, [](const EdgeState& edge) { return !edge.bReleased; });
    std::erase_if(_state.actionStates, [this, decisionPoint](const ActionState& action) {
        const auto found = _orderActions.find(action.actionID);
        return found != _orderActions.end() && found->second > decisionPoint;
    });
    Append(order, 1);
}

void VehicleModel::Append(const OrderMessage& order, std::size_t firstNode)
{
    const auto add = [this](const std::vector<Action>& actions, std::uint32_t sequenceID) {
        for (const Action& action : actions)
        {
            _orderActions[action.actionID] = sequenceID;
            _state.actionStates.push_back(
                ActionState{action.actionID, action.actionType, {}, EActionStatus::Waiting, {}});
        }
    };
    _state.orderUpdateID = order.orderUpdateID;
    for (std::size_t index = firstNode; index < order.nodes.size(); ++index)
    {
        const OrderNode& node = order.nodes[index];
        _state.nodeStates.push_back(NodeState{node.nodeID, node.sequenceID, {}, node.bReleased, {}});
        add(node.actions, node.sequenceID);
    }
    for (const OrderEdge& edge : order.edges)
    {
        _state.edgeStates.push_back(EdgeState{edge.edgeID, edge.sequenceID, {}, edge.bReleased, {}});
        add(edge.actions, edge.sequenceID);
    }
}

void VehicleModel::Receive(const InstantActionsMessage& message)
{
    constexpr std::size_t MOST_ENDED = 16;
    for (const Action& action : message.actions)
    {
        const bool bNew = _instantActions.insert(action.actionID).second;
        const bool bShown = std::ranges::count(_state.actionStates, action.actionID, &ActionState::actionID) > 0;
        if (!bNew && bShown)
        {
            continue;
        }
        if (_state.actionStates.size() > MOST_ENDED)
        {
            const auto ended = std::ranges::find_if(_state.actionStates, [this](const ActionState& known) {
                return !_orderActions.contains(known.actionID) && IsTerminal(known.actionStatus);
            });
            if (ended != _state.actionStates.end())
            {
                _state.actionStates.erase(ended);
            }
        }
        // One that is sent again after it was removed as an old one is shown again, and not executed again.
        const bool bEnded = !bNew || action.actionType.ends_with("Request");
        const EActionStatus status = bEnded ? EActionStatus::Finished : EActionStatus::Waiting;
        _state.actionStates.push_back(ActionState{action.actionID, action.actionType, {}, status, {}});
        if (bNew && action.actionType == ActionTypes::CANCEL_ORDER)
        {
            Cancel(action.actionID);
        }
    }
}

void VehicleModel::Cancel(const std::string& actionID)
{
    const bool bBusy = IsBusy();
    for (ActionState& action : _state.actionStates)
    {
        if (_orderActions.contains(action.actionID) && !IsTerminal(action.actionStatus))
        {
            action.actionStatus = EActionStatus::Failed;
        }
    }
    _state.nodeStates.clear();
    _state.edgeStates.clear();
    _state.actionStates.back().actionStatus = bBusy ? EActionStatus::Finished : EActionStatus::Failed;
    if (!bBusy)
    {
        VehicleError error;
        error.errorType = ErrorTypes::NO_ORDER_TO_CANCEL;
        error.errorReferences = {{"actionId", actionID}};
        AddError(std::move(error));
    }
}

void VehicleModel::Drive()
{
    if (!_state.nodeStates.empty() && _state.nodeStates.front().bReleased)
    {
        _state.lastNodeID = _state.nodeStates.front().nodeID;
        _state.lastNodeSequenceID = _state.nodeStates.front().sequenceID;
        _state.nodeStates.erase(_state.nodeStates.begin());
        std::erase_if(_state.edgeStates, [this](const EdgeState& edge) {
            return edge.sequenceID < _state.lastNodeSequenceID;
        });
    }
}

void VehicleModel::AdvanceAction(std::size_t choice, bool bFails)
{
    std::vector<ActionState*> open;
    for (ActionState& action : _state.actionStates)
    {
        const auto ofOrder = _orderActions.find(action.actionID);
        const bool bReached = ofOrder == _orderActions.end() || ofOrder->second <= _state.lastNodeSequenceID;
        if (bReached && !IsTerminal(action.actionStatus))
        {
            open.push_back(&action);
        }
    }
    if (!open.empty())
    {
        ActionState& action = *open[choice % open.size()];
        const EActionStatus ended = bFails ? EActionStatus::Failed : EActionStatus::Finished;
        action.actionStatus = action.actionStatus == EActionStatus::Running ? ended : EActionStatus::Running;
    }
}

void VehicleModel::Restart()
{
    const EOperatingMode mode = _state.operatingMode;
    const std::string lastNodeID = _state.lastNodeID;
    *this = VehicleModel();
    _state.operatingMode = mode;
    _state.lastNodeID = lastNodeID;
}

void VehicleModel::SetMode(EOperatingMode mode)
{
    _state.operatingMode = mode;
}

void VehicleModel::ClearErrors()
{
    _state.errors.clear();
}

StateMessage VehicleModel::MakeState(Core::Now now)
{
    StateMessage state = _state;
    state.header.headerID = _state.header.headerID++;
    state.header.timestamp = now.wall;
    return state;
}

} // namespace ACS::Fuzz
