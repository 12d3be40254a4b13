#include "FactsheetRules.hpp"

#include "ActionFault.hpp"
#include "OrderCapability.hpp"
#include "OrderErrors.hpp"
#include "StateRoom.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

namespace
{

Core::Duration ToDuration(double seconds)
{
    return std::chrono::duration_cast<Core::Duration>(std::chrono::duration<double>(seconds));
}

/// Master control needs these actions: they are sent regardless of the factsheet.
bool IsAlwaysSent(std::string_view actionType)
{
    return actionType == ActionTypes::CANCEL_ORDER || actionType == ActionTypes::START_PAUSE
        || actionType == ActionTypes::STOP_PAUSE || actionType == ActionTypes::STATE_REQUEST
        || actionType == ActionTypes::FACTSHEET_REQUEST;
}

/// The actions of the update that a state may show already, with the horizon that the update replaces.
std::set<std::string_view> ListReplaced(const OrderMessage& update)
{
    std::set<std::string_view> ids;
    for (std::size_t index = 0; index < update.edges.size(); ++index)
    {
        for (const std::vector<Action>* actions : {&update.edges[index].actions, &update.nodes[index + 1].actions})
        {
            for (const Action& action : *actions)
            {
                ids.insert(action.actionID);
            }
        }
    }
    return ids;
}

/// What the vehicle's state keeps when it accepts the update. Ended actions do not count: a vehicle may remove them.
void AddKept(const OrderMessage& update, const StateMessage& state, OrderContext& context)
{
    context.heldOrderID = update.orderID;
    const std::uint32_t stitch = update.nodes.front().sequenceID;
    for (const NodeState& node : state.nodeStates)
    {
        const bool bKept = node.sequenceID <= stitch;
        context.keptNodes += bKept ? 1U : 0U;
        context.keptBytes += bKept ? MeasureNodeState(node) : 0;
    }
    for (const EdgeState& edge : state.edgeStates)
    {
        context.keptBytes += edge.sequenceID <= stitch ? MeasureEdgeState(edge) : 0;
    }
    const std::set<std::string_view> replaced = ListReplaced(update);
    for (const ActionState& action : state.actionStates)
    {
        const bool bKept = !IsTerminal(action.actionStatus) && !replaced.contains(action.actionID);
        context.keptActions += bKept ? 1U : 0U;
        context.keptBytes += bKept ? MeasureActionState(action) : 0;
    }
}

/// The order with its first nodes only.
OrderMessage Shorten(const OrderMessage& whole, std::size_t nodeCount)
{
    OrderMessage order = whole;
    order.nodes.resize(nodeCount);
    order.edges.resize(nodeCount - 1);
    return order;
}

constexpr std::string_view LIMITS = "max"; ///< Prefix of the names of size limits (FindSizeFaults).

struct SizeLimit
{
    std::string_view name;
    std::size_t found = 0;
    std::optional<std::uint32_t> most; ///< Absent or 0: none.
};

} // namespace

FactsheetRules::FactsheetRules(const MasterOptions& options)
    : _options(options),
      _factsheet(options.factsheet)
{
}

void FactsheetRules::OnFactsheet(FactsheetMessage factsheet, MasterActions& out)
{
    _factsheet = std::move(factsheet);
    out.emplace_back(FactsheetReceived{});
}

const FactsheetMessage* FactsheetRules::GetFactsheetOrNull() const noexcept
{
    return _factsheet.has_value() ? &*_factsheet : nullptr;
}

const FactsheetMessage* FactsheetRules::GetRulesOrNull() const
{
    return _options.bFactsheetObeyed ? GetFactsheetOrNull() : nullptr;
}

Core::Result<void> FactsheetRules::FitOrder(
    OrderMessage& order,
    const StateMessage* stateOrNull,
    const MasterTopics& topics,
    Core::Now now) const
{
    const FactsheetMessage* const rules = GetRulesOrNull();
    if (rules == nullptr)
    {
        return {};
    }
    AdaptToFactsheet(order, *rules);
    OrderContext context;
    context.factsheet = rules;
    if (stateOrNull != nullptr)
    {
        AddKept(order, *stateOrNull, context);
    }
    const auto check = [now, rules, &topics, &context](OrderMessage& candidate) -> Core::Result<void> {
        if (rules->protocolLimits.maxStringLengths.message.value_or(0) != 0)
        {
            context.payloadBytes = topics.Measure(ETopic::Order, candidate, now);
        }
        const std::vector<OrderViolation> violations = FindUnusable(candidate, context);
        if (violations.empty())
        {
            return {};
        }
        const std::string* const path = FindReferenceOrNull(violations.front().error, ReferenceKeys::PARAMETER);
        return Core::Fail(
            EVda5050Error::NotSupported,
            path == nullptr ? std::string() : *path,
            violations.front().rule,
            "order " + candidate.orderID);
    };
    Core::Result<void> checked = check(order);
    const auto base = static_cast<std::size_t>(std::ranges::count(order.nodes, true, &OrderNode::bReleased));
    if (checked || !checked.error().path.starts_with(LIMITS) || base == order.nodes.size())
    {
        return checked;
    }
    // The horizon is optional: as much of it is sent as fits.
    const OrderMessage whole = order;
    std::size_t tooMany = whole.nodes.size();
    std::size_t fitting = base;
    order = Shorten(whole, base);
    checked = check(order);
    while (checked && tooMany - fitting > 1)
    {
        const std::size_t middle = fitting + (tooMany - fitting) / 2;
        OrderMessage candidate = Shorten(whole, middle);
        if (check(candidate))
        {
            fitting = middle;
            order = std::move(candidate);
        }
        else
        {
            tooMany = middle;
        }
    }
    return checked;
}

std::string FactsheetRules::MakeActionID(std::string_view actionType, std::uint32_t count, Core::Now now) const
{
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(now.wall.time_since_epoch());
    const std::string moment = std::to_string(milliseconds.count());
    const FactsheetMessage* const rules = GetRulesOrNull();
    const MaximumStringLengths limits =
        rules == nullptr ? MaximumStringLengths{} : rules->protocolLimits.maxStringLengths;
    std::string id = limits.bIdentifierNumericalOnly.value_or(false)
        ? moment + std::to_string(count)
        : _options.actionIDPrefix + "-" + std::string(actionType) + "-" + moment + "-" + std::to_string(count);
    const std::size_t most = limits.identifier.value_or(0);
    if (most != 0 && id.size() > most)
    {
        id.erase(0, id.size() - most); // its end is what differs
    }
    return id;
}

Core::Result<void> FactsheetRules::FitInstantAction(Action& action, const MasterTopics& topics, Core::Now now) const
{
    const FactsheetMessage* const rules = GetRulesOrNull();
    if (rules == nullptr)
    {
        return {};
    }
    const std::vector<AgvAction>& rows = rules->protocolFeatures.agvActions;
    const std::optional<ActionFault> fault = rows.empty()
        ? std::nullopt
        : FindActionFaultOrNull(*rules, action, EActionScope::Instant, EParameterCheck::Tolerant);
    if (fault.has_value() && !IsAlwaysSent(action.actionType))
    {
        return Core::Fail(EVda5050Error::NotSupported, fault->field, fault->rule, action.actionType);
    }
    const auto row = std::ranges::find(rows, action.actionType, &AgvAction::actionType);
    if (row != rows.end() && !row->blockingTypes.empty()
        && std::ranges::find(row->blockingTypes, action.blockingType) == row->blockingTypes.end())
    {
        action.blockingType = row->blockingTypes.front();
    }
    InstantActionsMessage message;
    message.actions.push_back(action);
    const ProtocolLimits& limits = rules->protocolLimits;
    const std::array sizes{
        SizeLimit{"maxStringLens.idLen", action.actionID.size(), limits.maxStringLengths.identifier},
        SizeLimit{
            "maxArrayLens.actions.actionsParameters",
            action.actionParameters.size(),
            limits.maxArrayLengths.actionParameters},
        SizeLimit{
            "maxStringLens.msgLen",
            topics.Measure(ETopic::InstantActions, message, now),
            limits.maxStringLengths.message}};
    for (const SizeLimit& size : sizes)
    {
        if (size.most.value_or(0) != 0 && size.found > *size.most)
        {
            return Core::Fail(
                EVda5050Error::NotSupported,
                std::string(size.name),
                "at most " + std::to_string(*size.most),
                std::to_string(size.found));
        }
    }
    const bool bDigits =
        std::ranges::all_of(action.actionID, [](char letter) { return letter >= '0' && letter <= '9'; });
    if (limits.maxStringLengths.bIdentifierNumericalOnly.value_or(false) && !bDigits)
    {
        return Core::Fail(EVda5050Error::NotSupported, "maxStringLens.idNumericalOnly", "digits", action.actionID);
    }
    return {};
}

Core::Duration FactsheetRules::GetOrderInterval() const
{
    const FactsheetMessage* const rules = GetRulesOrNull();
    return rules == nullptr ? Core::Duration::zero() : ToDuration(rules->protocolLimits.timing.minOrderInterval);
}

Core::Duration FactsheetRules::GetAllowedSilence() const
{
    Core::Duration interval = _options.stateInterval;
    if (_factsheet.has_value())
    {
        const double announced = _factsheet->protocolLimits.timing.defaultStateInterval.value_or(0.0);
        interval = std::max(interval, ToDuration(announced));
    }
    return interval + _options.stateMargin;
}

std::size_t FactsheetRules::GetMaximumInstantActions() const
{
    const FactsheetMessage* const rules = GetRulesOrNull();
    if (rules == nullptr || rules->protocolLimits.maxStringLengths.message.value_or(0) != 0)
    {
        return 1; // the limit is unknown, or each was measured alone
    }
    const std::uint32_t limit = rules->protocolLimits.maxArrayLengths.instantActions.value_or(0);
    return limit == 0 ? std::string::npos : limit;
}

} // namespace ACS::VDA5050
