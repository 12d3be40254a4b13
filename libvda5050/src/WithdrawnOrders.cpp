#include "WithdrawnOrders.hpp"

#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

void WithdrawnOrders::Add(std::string orderID, const OrderMessage* messageOrNull, bool bRejected)
{
    WithdrawnOrder order{std::move(orderID), 0, {}, bRejected};
    const auto add = [&order](const auto& elements) {
        for (const auto& element : elements)
        {
            std::ranges::transform(element.actions, std::back_inserter(order.actionIDs), &Action::actionID);
        }
    };
    if (messageOrNull != nullptr)
    {
        order.orderUpdateID = messageOrNull->orderUpdateID;
        add(messageOrNull->nodes);
        add(messageOrNull->edges);
    }
    constexpr std::size_t MOST_WITHDRAWN = 16;
    if (_orders.size() == MOST_WITHDRAWN)
    {
        _orders.erase(_orders.begin());
    }
    std::ranges::sort(order.actionIDs);
    _orders.push_back(std::move(order));
}

void WithdrawnOrders::Remove(std::string_view orderID)
{
    std::erase_if(_orders, [orderID](const WithdrawnOrder& order) { return order.orderID == orderID; });
}

std::optional<WithdrawnOrders::EReappearance> WithdrawnOrders::TakeReappearedOrNull(const StateMessage& state)
{
    const auto found = std::ranges::find(_orders, state.orderID, &WithdrawnOrder::orderID);
    if (found == _orders.end() || state.orderUpdateID < found->orderUpdateID)
    {
        return std::nullopt;
    }
    const bool bRunning = IsRunning(*found, state);
    if (!bRunning && !found->bRejected)
    {
        return std::nullopt;
    }
    _orders.erase(found);
    return bRunning ? EReappearance::Running : EReappearance::Ended;
}

bool WithdrawnOrders::IsRunning(const WithdrawnOrder& order, const StateMessage& state)
{
    const auto isRunningAction = [&order](const ActionState& action) {
        return !IsTerminal(action.actionStatus) && std::ranges::binary_search(order.actionIDs, action.actionID);
    };
    return !state.nodeStates.empty() || !state.edgeStates.empty()
        || std::ranges::any_of(state.actionStates, isRunningAction);
}

} // namespace ACS::VDA5050
