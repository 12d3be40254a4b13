#include "ActionFault.hpp"
#include "MasterSession.Impl.hpp"
#include "OrderCapability.hpp"
#include "OrderErrors.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

namespace
{

/// Members that a vehicle can do without: it keeps its own tolerance, and measures the edge itself. True: left out.
bool TryLeaveOut(OrderMessage& order, std::string_view path)
{
    const auto forPositions = [&order](const auto& change) {
        for (OrderNode& node : order.nodes)
        {
            if (node.nodePosition.has_value())
            {
                change(*node.nodePosition);
            }
        }
        return true;
    };
    if (path == "order.nodes.nodePosition.allowedDeviationXY")
    {
        return forPositions([](NodePosition& position) { position.allowedDeviationXY.reset(); });
    }
    if (path == "order.nodes.nodePosition.allowedDeviationTheta")
    {
        return forPositions([](NodePosition& position) { position.allowedDeviationTheta.reset(); });
    }
    if (path == "order.edges.length")
    {
        std::ranges::for_each(order.edges, [](OrderEdge& edge) { edge.length.reset(); });
        return true;
    }
    return false;
}

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

struct SizeLimit
{
    std::string_view name;
    std::size_t found = 0;
    std::optional<std::uint32_t> most; ///< Absent or 0: none.
};

} // namespace

const FactsheetMessage* MasterSession::Impl::GetRulesOrNull() const
{
    return _options.bFactsheetObeyed && _factsheet.has_value() ? &*_factsheet : nullptr;
}

Core::Result<void> MasterSession::Impl::FitOrder(OrderMessage& order, Core::Now now) const
{
    OrderContext context;
    context.factsheet = GetRulesOrNull();
    if (context.factsheet == nullptr)
    {
        return {};
    }
    for (const OrderViolation& violation : FindUnusable(order, context))
    {
        const std::string* const path = FindReferenceOrNull(violation.error, ReferenceKeys::PARAMETER);
        if (path != nullptr)
        {
            static_cast<void>(TryLeaveOut(order, *path)); // what remains is found again below
        }
    }
    if (context.factsheet->protocolLimits.maxStringLengths.message.value_or(0) != 0)
    {
        order.header = PeekHeader(ETopic::Order, now);
        context.payloadBytes = _codec.Encode(order, _options.version).size();
    }
    const std::vector<OrderViolation> violations = FindUnusable(order, context);
    if (violations.empty())
    {
        return {};
    }
    const std::string* const path = FindReferenceOrNull(violations.front().error, ReferenceKeys::PARAMETER);
    return Core::Fail(
        EVda5050Error::NotSupported,
        path == nullptr ? std::string() : *path,
        violations.front().rule,
        "order " + order.orderID);
}

std::string MasterSession::Impl::MakeActionID(std::string_view actionType, Core::Now now)
{
    constexpr int MOST_TRIES = 100; // an id that has to be short may be in use
    std::string id = MakeNextActionID(actionType, now);
    for (int i = 1; i < MOST_TRIES && (IsTracked(id) || FindShownOrNull(id) != nullptr); ++i)
    {
        id = MakeNextActionID(actionType, now);
    }
    return id;
}

std::string MasterSession::Impl::MakeNextActionID(std::string_view actionType, Core::Now now)
{
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(now.wall.time_since_epoch());
    const std::string moment = std::to_string(milliseconds.count());
    const std::string count = std::to_string(++_ownActionCount);
    const FactsheetMessage* const rules = GetRulesOrNull();
    const MaximumStringLengths limits =
        rules == nullptr ? MaximumStringLengths{} : rules->protocolLimits.maxStringLengths;
    std::string id = limits.bIdentifierNumericalOnly.value_or(false)
        ? moment + count
        : _options.actionIDPrefix + "-" + std::string(actionType) + "-" + moment + "-" + count;
    const std::size_t most = limits.identifier.value_or(0);
    if (most != 0 && id.size() > most)
    {
        id.erase(0, id.size() - most); // its end is what differs
    }
    return id;
}

Core::Result<void> MasterSession::Impl::FitInstantAction(Action& action, Core::Now now) const
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
    message.header = PeekHeader(ETopic::InstantActions, now);
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
            _codec.Encode(message, _options.version).size(),
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

Core::Duration MasterSession::Impl::GetOrderInterval() const
{
    const FactsheetMessage* const rules = GetRulesOrNull();
    return rules == nullptr ? Core::Duration::zero() : ToDuration(rules->protocolLimits.timing.minOrderInterval);
}

Core::Duration MasterSession::Impl::GetAllowedSilence() const
{
    Core::Duration interval = _options.stateInterval;
    if (_factsheet.has_value())
    {
        const double announced = _factsheet->protocolLimits.timing.defaultStateInterval.value_or(0.0);
        interval = std::max(interval, ToDuration(announced));
    }
    return interval + _options.stateMargin;
}

std::size_t MasterSession::Impl::GetMaximumInstantActions() const
{
    const FactsheetMessage* const rules = GetRulesOrNull();
    if (rules != nullptr && rules->protocolLimits.maxStringLengths.message.value_or(0) != 0)
    {
        return 1; // each was measured alone
    }
    const std::uint32_t limit = rules == nullptr ? 0 : rules->protocolLimits.maxArrayLengths.instantActions.value_or(0);
    return limit == 0 ? std::string::npos : limit;
}

} // namespace ACS::VDA5050
