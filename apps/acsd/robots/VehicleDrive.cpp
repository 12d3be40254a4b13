#include "robots/VehicleDrive.hpp"

#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

VDA5050::OrderNode MakeNode(const Planning::RouteNode& from)
{
    VDA5050::OrderNode node;
    node.nodeID = from.nodeID;
    node.nodePosition = MakeNodePosition(from);
    return node;
}

VDA5050::OrderEdge MakeEdge(const Planning::RouteEdge& from)
{
    VDA5050::OrderEdge edge;
    edge.edgeID = from.edgeID;
    edge.startNodeID = from.startNodeID;
    edge.endNodeID = from.endNodeID;
    edge.maxSpeed = from.maxSpeed;
    edge.maxRotationSpeed = from.maxRotationSpeed;
    edge.orientation = from.orientation;
    if (from.orientationType == "GLOBAL")
    {
        edge.orientationType = VDA5050::EOrientationType::Global;
    }
    edge.bRotationAllowed = from.bRotationAllowed;
    edge.length = from.length;
    return edge;
}

} // namespace

VDA5050::NodePosition MakeNodePosition(const Planning::RouteNode& node)
{
    VDA5050::NodePosition position;
    position.x = node.x;
    position.y = node.y;
    position.theta = node.theta;
    position.mapID = node.mapID;
    position.allowedDeviationXY = node.allowedDeviation;
    return position;
}

VehicleDrive::VehicleDrive(VDA5050::OrderBuilder route, std::size_t wantedReleased)
    : _route(std::move(route)),
      _wantedReleased(wantedReleased)
{
}

Core::Result<VehicleDrive> VehicleDrive::Create(const Planning::Drive& drive)
{
    std::vector<VDA5050::OrderNode> nodes;
    std::vector<VDA5050::OrderEdge> edges;
    for (const Planning::RouteNode& node : drive.route.nodes)
    {
        nodes.push_back(MakeNode(node));
    }
    for (const Planning::RouteEdge& edge : drive.route.edges)
    {
        edges.push_back(MakeEdge(edge));
    }
    Core::Result<VDA5050::OrderBuilder> route =
        VDA5050::OrderBuilder::Create(drive.driveID, std::move(nodes), std::move(edges));
    if (!route)
    {
        return tl::unexpected(std::move(route.error()));
    }
    return VehicleDrive(std::move(*route), drive.releasedCount);
}

Core::Result<VDA5050::OrderMessage> VehicleDrive::MakeOrder(const OrderCheck& check)
{
    constexpr std::size_t LEAST_RELEASED = 2; // a base of one node drives nowhere
    return MakeFitting(LEAST_RELEASED, check);
}

void VehicleDrive::Extend(std::size_t releasedCount)
{
    _wantedReleased = releasedCount;
}

bool VehicleDrive::IsUpdateDue() const
{
    return std::holds_alternative<Confirmed>(_message) && !_abandonReason.has_value()
        && _wantedReleased > _route.GetReleasedNodes();
}

Core::Result<VDA5050::OrderMessage> VehicleDrive::MakeUpdate(const OrderCheck& check)
{
    return MakeFitting(_route.GetReleasedNodes() + 1, check);
}

Core::Result<VDA5050::OrderMessage> VehicleDrive::MakeFitting(std::size_t leastReleased, const OrderCheck& check)
{
    for (std::size_t released = _bShortUpdate ? leastReleased : _wantedReleased;; --released)
    {
        VDA5050::OrderBuilder route = _route;
        Core::Result<VDA5050::OrderMessage> message =
            route.GetReleasedNodes() == 0 ? route.MakeOrder(released) : route.MakeUpdate(released);
        if (!message)
        {
            return message;
        }
        Core::Result<void> checked = check(*message);
        if (checked)
        {
            _route = std::move(route);
            return message;
        }
        if (released <= leastReleased || !checked.error().path.starts_with("max"))
        {
            return tl::unexpected(std::move(checked.error()));
        }
    }
}

bool VehicleDrive::HasNodesAhead() const
{
    return _passedCount < _route.GetReleasedNodes();
}

void VehicleDrive::OnUpdateSent(VDA5050::OrderMessage update)
{
    _message = UpdatePending{std::move(update)};
}

void VehicleDrive::OnConfirmed()
{
    _message = Confirmed{};
    _bShortUpdate = false;
}

bool VehicleDrive::TryShortenUpdate()
{
    if (std::exchange(_bShortUpdate, true))
    {
        return false;
    }
    _route.WithdrawUpdate();
    _message = Confirmed{};
    return true;
}

void VehicleDrive::OnNodePassed(std::string nodeID)
{
    _lastPassedNodeID = std::move(nodeID);
    ++_passedCount;
}

void VehicleDrive::Abandon(std::string reason)
{
    _abandonReason = std::move(reason);
}

const std::optional<std::string>& VehicleDrive::GetAbandonReasonOrNull() const noexcept
{
    return _abandonReason;
}

const std::string& VehicleDrive::GetOrderID() const noexcept
{
    return _route.GetOrderID();
}

const std::string& VehicleDrive::GetLastPassedNodeID() const noexcept
{
    return _lastPassedNodeID;
}

bool VehicleDrive::HasHorizon() const noexcept
{
    return !_route.IsWholeRouteReleased();
}

const VDA5050::OrderMessage* VehicleDrive::GetPendingUpdateOrNull() const noexcept
{
    const UpdatePending* const pendingOrNull = std::get_if<UpdatePending>(&_message);
    return pendingOrNull == nullptr ? nullptr : &pendingOrNull->update;
}

} // namespace ACS::Acsd
