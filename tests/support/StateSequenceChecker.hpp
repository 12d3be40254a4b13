#pragma once

#include <acs/core/Now.hpp>
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// Checks the published states of one vehicle: what belongs to one event is in one state, states keep their minimum
/// interval, and no instant action is lost. Orders and instant actions are added before the states that follow them.
class StateSequenceChecker
{
    Core::Duration _minimumInterval;
    std::string _orderID;
    std::map<std::uint32_t, std::set<std::string>> _blocking; ///< SOFT and HARD actions by sequenceId of node or edge.
    std::map<std::string, std::uint32_t> _edges;              ///< sequenceId of the edge by actionId.
    std::map<std::string, std::string> _cancels;              ///< orderId by actionId; not shown as ended yet.
    std::set<std::string> _instantActions;                    ///< Not shown as ended yet.
    std::optional<VDA5050::StateMessage> _last;
    Core::SteadyTime _lastTime;
    std::size_t _count = 0;
    std::size_t _stopCount = 0;
    std::size_t _cancelCount = 0;
    std::vector<std::string> _faults;

public:
    explicit StateSequenceChecker(Core::Duration minimumInterval)
        : _minimumInterval(minimumInterval)
    {
    }

    /// An order or an update that the vehicle has accepted.
    void AddOrder(const VDA5050::OrderMessage& order)
    {
        if (order.orderUpdateID == 0)
        {
            _orderID = order.orderID;
            _blocking.clear();
            _edges.clear();
        }
        for (const VDA5050::OrderNode& node : order.nodes)
        {
            AddBlocking(node.sequenceID, node.actions);
        }
        for (const VDA5050::OrderEdge& edge : order.edges)
        {
            AddBlocking(edge.sequenceID, edge.actions);
            for (const VDA5050::Action& action : edge.actions)
            {
                _edges[action.actionID] = edge.sequenceID;
            }
        }
    }

    void AddInstantAction(const std::string& actionID)
    {
        _instantActions.insert(actionID);
    }

    /// A cancelOrder that the vehicle has accepted while it still had nodes to reach.
    void AddCancel(const std::string& actionID)
    {
        _cancels[actionID] = _orderID;
    }

    void Check(const VDA5050::StateMessage& state, Core::SteadyTime time)
    {
        Require(!_last.has_value() || time - _lastTime >= _minimumInterval, "the minimum interval is kept", state);
        if (!state.orderID.empty())
        {
            Require(state.orderID == _orderID, "the order is the accepted one", state);
            Require(
                !state.bDriving || !IsStoppingAtLastNode(state),
                "a vehicle that stops at its node is stationary",
                state);
            CheckEdges(state);
            const bool bFurther = _last.has_value() && state.lastNodeSequenceID > _last->lastNodeSequenceID;
            _stopCount += bFurther && IsStoppingAtLastNode(state) ? 1U : 0U;
        }
        CheckCancels(state);
        std::erase_if(_instantActions, [&state](const std::string& actionID) { return IsShownEnded(state, actionID); });
        _last = state;
        _lastTime = time;
        ++_count;
    }

    /// Nothing is due: the last state shows all of the present one except for what sends no state.
    void CheckComplete(VDA5050::StateMessage present)
    {
        if (!_last.has_value())
        {
            _faults.emplace_back("no state");
            return;
        }
        present.header = _last->header;
        present.maps = _last->maps; // not in a state of 2.0
        present.agvPosition = _last->agvPosition;
        present.velocity = _last->velocity;
        present.distanceSinceLastNode = _last->distanceSinceLastNode;
        present.batteryState = _last->batteryState;
        Require(present == *_last, "the last state shows every change", *_last);
        const bool bAllShown = std::ranges::all_of(_instantActions, [this](const std::string& actionID) {
            return std::ranges::find(_last->actionStates, actionID, &VDA5050::ActionState::actionID)
                != _last->actionStates.end();
        });
        Require(bAllShown, "every instant action is shown until its end", *_last);
    }

    /// The vehicle has been left alone for a while.
    void CheckEnded()
    {
        if (!_instantActions.empty() || !_cancels.empty())
        {
            _faults.emplace_back("the end of every instant action is shown");
        }
    }

    /// States in which a vehicle has stopped at a further node, and ends of a cancel with nodes left.
    [[nodiscard]] std::size_t CountStops() const noexcept
    {
        return _stopCount;
    }

    [[nodiscard]] std::size_t CountCancels() const noexcept
    {
        return _cancelCount;
    }

    [[nodiscard]] std::size_t GetCount() const noexcept
    {
        return _count;
    }

    [[nodiscard]] const std::vector<std::string>& GetFaults() const noexcept
    {
        return _faults;
    }

private:
    void AddBlocking(std::uint32_t sequenceID, const std::vector<VDA5050::Action>& actions)
    {
        for (const VDA5050::Action& action : actions)
        {
            if (action.blockingType != VDA5050::EBlockingType::None)
            {
                _blocking[sequenceID].insert(action.actionID);
            }
        }
    }

    void Require(bool bHolds, std::string_view rule, const VDA5050::StateMessage& state)
    {
        if (!bHolds)
        {
            _faults.push_back("state " + std::to_string(state.header.headerID) + ": " + std::string(rule));
        }
    }

    [[nodiscard]] static bool IsShownEnded(const VDA5050::StateMessage& state, const std::string& actionID)
    {
        const auto found = std::ranges::find(state.actionStates, actionID, &VDA5050::ActionState::actionID);
        return found != state.actionStates.end() && VDA5050::IsTerminal(found->actionStatus);
    }

    [[nodiscard]] bool HasOpenBlocking(const VDA5050::StateMessage& state, std::uint32_t sequenceID) const
    {
        const auto blocking = _blocking.find(sequenceID);
        return blocking != _blocking.end()
            && std::ranges::any_of(state.actionStates, [&blocking](const VDA5050::ActionState& action) {
                   return blocking->second.contains(action.actionID) && !VDA5050::IsTerminal(action.actionStatus);
               });
    }

    /// At the end of the base, or for SOFT and HARD actions of the node or of the next edge.
    [[nodiscard]] bool IsStoppingAtLastNode(const VDA5050::StateMessage& state) const
    {
        return std::ranges::none_of(state.nodeStates, &VDA5050::NodeState::bReleased)
            || HasOpenBlocking(state, state.lastNodeSequenceID) || HasOpenBlocking(state, state.lastNodeSequenceID + 1);
    }

    void CheckEdges(const VDA5050::StateMessage& state)
    {
        for (const VDA5050::ActionState& action : state.actionStates)
        {
            const auto edge = _edges.find(action.actionID);
            if (edge == _edges.end() || VDA5050::IsTerminal(action.actionStatus))
            {
                continue;
            }
            const bool bEdgeShown = std::ranges::find(state.edgeStates, edge->second, &VDA5050::EdgeState::sequenceID)
                != state.edgeStates.end();
            Require(bEdgeShown, "an edge action ends with its edge", state);
        }
    }

    void CheckCancels(const VDA5050::StateMessage& state)
    {
        for (const auto& [actionID, orderID] : std::exchange(_cancels, {}))
        {
            const bool bEnded = IsShownEnded(state, actionID);
            _cancelCount += bEnded ? 1U : 0U;
            if (!bEnded)
            {
                _cancels[actionID] = orderID;
            }
            if (state.orderID != orderID)
            {
                Require(bEnded, "a cancel ends before the next order", state);
                continue;
            }
            Require(bEnded == state.nodeStates.empty(), "a cancel ends when no nodes are left", state);
            Require(
                !bEnded || (state.edgeStates.empty() && !state.bDriving),
                "a cancelled vehicle is stationary",
                state);
        }
    }
};

} // namespace ACS::Testing
