#include "VehicleSession.Impl.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <limits>
#include <utility>

namespace ACS::VDA5050
{

void VehicleSession::Impl::RefusePayload(
    ETopic topic,
    std::string_view payload,
    const Core::Error& error,
    VehicleActions& out)
{
    const Core::Result<MessageIdentity> identity = _topics.DecodeIdentity(payload);
    if (identity && _topics.IsForeign(topic, identity->header, out))
    {
        return;
    }
    _errors.AddPayloadError(topic, Core::Describe(error), identity ? &*identity : nullptr);
    _schedule.Request();
    out.emplace_back(MessageIgnored{topic, error});
}

bool VehicleSession::Impl::ShouldAccept(ETopic topic, const Header& header, VehicleActions& out)
{
    if (_topics.IsForeign(topic, header, out))
    {
        return false;
    }
    if (ReadVersionOrNull(header.version).has_value())
    {
        return true;
    }
    const MessageIdentity identity{header, true, {}, std::nullopt};
    _errors.AddPayloadError(topic, "protocol version 2.x expected, found " + header.version, &identity);
    _schedule.Request();
    out.emplace_back(MessageIgnored{
        topic,
        Core::Error{make_error_code(EVda5050Error::UnsupportedVersion), "version", "2.x", header.version}});
    return false;
}

void VehicleSession::Impl::OnOrder(std::string_view payload, VehicleActions& out)
{
    Core::Result<OrderMessage> order = _topics.Decode<OrderMessage>(payload);
    if (!order)
    {
        RefusePayload(ETopic::Order, payload, order.error(), out);
        return;
    }
    if (!ShouldAccept(ETopic::Order, order->header, out))
    {
        return;
    }
    OrderContext context = MakeContext();
    context.payloadBytes = payload.size();
    OrderJudgement judgement = JudgeOrder(*order, context);
    _schedule.Request(); // also for a resent message: the master did not see the echo
    switch (judgement.verdict)
    {
        case EOrderVerdict::NewOrder:
            AcceptOrder(std::move(*order), out);
            break;
        case EOrderVerdict::Update:
            AcceptUpdate(std::move(*order), out);
            break;
        case EOrderVerdict::Reject:
        {
            const OrderViolation& first = judgement.violations.front();
            out.emplace_back(OrderRefused{order->orderID, order->orderUpdateID, first.error.errorType, first.rule});
            for (OrderViolation& violation : judgement.violations)
            {
                _errors.Add(
                    std::move(violation.error),
                    judgement.bUntilMode ? SessionErrors::ELifetime::UntilMode : SessionErrors::ELifetime::UntilOrder);
            }
            break;
        }
        case EOrderVerdict::Discard:
        default:
            break;
    }
}

OrderContext VehicleSession::Impl::MakeContext() const
{
    OrderContext context;
    context.bExecuting = IsExecuting();
    context.defaultDeviationXY = _options.defaultDeviationXY;
    context.zoneSetIDs = _options.zoneSetIDs;
    context.factsheet = &_options.factsheet;
    context.parameterCheck = _options.parameterCheck;
    context.orderCheck = _options.orderCheck;
    _order.Fill(context);
    _reports.Fill(context);
    _drive.Fill(context);
    const RemainingRoute& route = _drive.GetRoute();
    const std::size_t released = route.CountReleased();
    _actions.Fill(
        context,
        released == route.GetSize() ? std::numeric_limits<std::uint32_t>::max() : route.GetEdgeSequenceID(released));
    return context;
}

void VehicleSession::Impl::AcceptOrder(OrderMessage order, VehicleActions& out)
{
    _errors.EndAll();
    _order.Accept(order, out);
    _actions.BeginOrder();
    _actions.MarkOvertaken();
    const OrderNode first = order.nodes.front();
    _drive.Begin(first);
    _reports.ResetDistance();
    AddActions(first.actions, EActionScope::Node, first.nodeID, first.sequenceID);
    AppendElements(std::move(order));
    _actions.Enqueue(first.actions);
    Advance(out);
}

void VehicleSession::Impl::AcceptUpdate(OrderMessage order, VehicleActions& out)
{
    if (_order.IsHeldByFailure())
    {
        _errors.EndWarnings();
    }
    else
    {
        _errors.EndAll();
    }
    _order.AcceptUpdate(order, out);
    _actions.MarkOvertaken();
    if (const std::optional<std::uint32_t> firstDropped = _drive.DropHorizonOrNull())
    {
        _actions.DropFrom(*firstDropped);
    }
    // The stitching node keeps the contents that it came with first.
    AppendElements(std::move(order));
    _actions.EvictSurplus();
    Advance(out);
}

void VehicleSession::Impl::AppendElements(OrderMessage order)
{
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        const OrderEdge& edge = order.edges[index];
        const OrderNode& node = order.nodes[index + 1];
        AddActions(edge.actions, EActionScope::Edge, edge.edgeID, edge.sequenceID);
        AddActions(node.actions, EActionScope::Node, node.nodeID, node.sequenceID);
    }
    _drive.Append(std::move(order));
}

void VehicleSession::Impl::AddActions(
    const std::vector<Action>& actions,
    EActionScope scope,
    const std::string& elementID,
    std::uint32_t sequenceID)
{
    for (const Action& action : actions)
    {
        _actions.AddOrderAction(action, scope, elementID, sequenceID);
        ReportUnlistedParameters(action, ETopic::Order);
    }
}

} // namespace ACS::VDA5050
