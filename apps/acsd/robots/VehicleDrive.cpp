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
    VDA5050::NodePosition& position = node.nodePosition.emplace();
    position.x = from.x;
    position.y = from.y;
    position.theta = from.theta;
    position.mapID = from.mapID;
    position.allowedDeviationXY = from.allowedDeviation;
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

Core::Result<VDA5050::OrderMessage> VehicleDrive::MakeOrder()
{
    return _route.MakeOrder(_wantedReleased);
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

Core::Result<VDA5050::OrderMessage> VehicleDrive::MakeUpdate()
{
    return _route.MakeUpdate(_bShortUpdate ? _route.GetReleasedNodes() + 1 : _wantedReleased);
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
