#include "robots/VehicleDrive.hpp"

#include <acs/vda5050/TrajectoryCurve.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// Unique in the order and the same each time that the drive is sent. Not longer than the driveID, because vehicles limit the
/// length of ids; what remains of the driveID makes it different from those of other drives.
std::string MakeActionID(const std::string& driveID, std::size_t sequenceID, std::size_t index)
{
    const std::string suffix = fmt::format("-{}-{}", sequenceID, index);
    constexpr std::size_t SHORTEST_PREFIX = 16;
    const std::size_t room = driveID.size() - std::min(driveID.size(), suffix.size());
    return driveID.substr(0, room < SHORTEST_PREFIX ? std::string::npos : room) + suffix;
}

VDA5050::EBlockingType ToBlockingType(Planning::EActionBlocking blocking)
{
    constexpr std::array TYPES{
        VDA5050::EBlockingType::None,
        VDA5050::EBlockingType::Soft,
        VDA5050::EBlockingType::Hard};
    return TYPES.at(static_cast<std::size_t>(blocking));
}

std::vector<VDA5050::Action> MakeActions(
    const std::vector<Planning::SiteAction>& from,
    const std::string& driveID,
    std::size_t sequenceID)
{
    std::vector<VDA5050::Action> actions;
    for (const Planning::SiteAction& required : from)
    {
        VDA5050::Action& action = actions.emplace_back();
        action.actionType = required.actionType;
        action.actionID = MakeActionID(driveID, sequenceID, actions.size() - 1);
        action.actionDescription = required.description;
        action.blockingType = ToBlockingType(required.blocking);
        for (const Planning::SiteActionParameter& parameter : required.parameters)
        {
            action.actionParameters.push_back({parameter.key, parameter.value});
        }
    }
    return actions;
}

VDA5050::OrderNode MakeNode(const Planning::RouteNode& from)
{
    VDA5050::OrderNode node;
    node.nodeID = from.nodeID;
    node.nodePosition = MakeNodePosition(from);
    return node;
}

VDA5050::OrderEdge MakeEdge(const Planning::RouteEdge& from, bool bCorridor)
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
    edge.minHeight = from.minHeight;
    edge.maxHeight = from.maxHeight;
    if (from.trajectory.has_value())
    {
        edge.trajectory = VDA5050::MakeTrajectory(*from.trajectory);
    }
    if (bCorridor && from.corridor.has_value())
    {
        using EPoint = VDA5050::ECorridorReferencePoint;
        edge.corridor = VDA5050::Corridor{
            from.corridor->leftWidth,
            from.corridor->rightWidth,
            from.corridor->bContour ? EPoint::Contour : EPoint::KinematicCenter};
    }
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

Core::Result<VehicleDrive> VehicleDrive::Create(const Planning::Drive& drive, const DriveContents& contents)
{
    std::vector<OpenAction> open;
    std::vector<VDA5050::OrderNode> nodes;
    std::vector<VDA5050::OrderEdge> edges;
    for (std::size_t i = 0; i < drive.route.nodes.size(); ++i)
    {
        const Planning::RouteNode& from = drive.route.nodes[i];
        const std::vector<Planning::SiteAction>& actions = i == 0 ? contents.startActions : from.actions;
        VDA5050::OrderNode& node = nodes.emplace_back(MakeNode(from));
        node.actions = MakeActions(actions, drive.driveID, 2 * i);
        for (std::size_t action = 0; action < actions.size(); ++action)
        {
            OpenAction& added = open.emplace_back();
            added.actionID = node.actions[action].actionID;
            added.text = fmt::format("{} of the node {}", actions[action].actionType, from.nodeID);
            added.node = from;
            added.node->actions = {actions[action]};
        }
    }
    for (std::size_t i = 0; i < drive.route.edges.size(); ++i)
    {
        const Planning::RouteEdge& from = drive.route.edges[i];
        VDA5050::OrderEdge& edge = edges.emplace_back(MakeEdge(from, contents.bCorridors));
        edge.actions = MakeActions(from.actions, drive.driveID, 2 * i + 1);
        for (const VDA5050::Action& action : edge.actions)
        {
            const std::string text = fmt::format("{} of the edge {}", action.actionType, from.edgeID);
            open.push_back({action.actionID, text, std::nullopt});
        }
    }
    Core::Result<VDA5050::OrderBuilder> route =
        VDA5050::OrderBuilder::Create(drive.driveID, std::move(nodes), std::move(edges));
    if (!route)
    {
        return tl::unexpected(std::move(route.error()));
    }
    VehicleDrive made(std::move(*route), drive.releasedCount);
    made._openActions = std::move(open);
    return made;
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
    return _bConfirmed && !_abandonReason.has_value() && _wantedReleased > _route.GetReleasedNodes();
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

void VehicleDrive::OnUpdateSent()
{
    _bConfirmed = false;
}

void VehicleDrive::OnConfirmed()
{
    _bConfirmed = true;
    _bShortUpdate = false;
}

bool VehicleDrive::TryShortenUpdate()
{
    if (std::exchange(_bShortUpdate, true))
    {
        return false;
    }
    _route.WithdrawUpdate();
    _bConfirmed = true;
    return true;
}

void VehicleDrive::OnNodePassed(std::string nodeID)
{
    _lastPassedNodeID = std::move(nodeID);
    ++_passedCount;
    _cancelRefusedAt.reset();
}

void VehicleDrive::OnActionFinished(std::string_view actionID)
{
    std::erase_if(_openActions, [actionID](const OpenAction& open) { return open.actionID == actionID; });
}

const std::string* VehicleDrive::FindOpenActionOrNull(std::string_view actionID) const
{
    const auto found = std::ranges::find(_openActions, actionID, &OpenAction::actionID);
    return found == _openActions.end() ? nullptr : &found->text;
}

const std::string* VehicleDrive::GetOpenActionOrNull() const noexcept
{
    return _openActions.empty() ? nullptr : &_openActions.front().text;
}

std::optional<Planning::RouteNode> VehicleDrive::GetOpenNodeOrNull() const
{
    std::optional<Planning::RouteNode> node;
    for (const OpenAction& open : _openActions)
    {
        if (!open.node.has_value() || open.node->nodeID != _lastPassedNodeID)
        {
            continue;
        }
        if (!node.has_value())
        {
            node = open.node;
            continue;
        }
        node->actions.push_back(open.node->actions.front());
    }
    return node;
}

void VehicleDrive::OnActionFailed(std::string reason)
{
    _failure = std::move(reason);
}

void VehicleDrive::Abandon(std::string reason)
{
    _abandonReason = std::move(reason);
}

const std::optional<std::string>& VehicleDrive::GetAbandonReasonOrNull() const noexcept
{
    return _abandonReason;
}

void VehicleDrive::OnCancelRefused(Core::Now now)
{
    _cancelRefusedAt = now.steady;
}

bool VehicleDrive::IsCancelDue(Core::Now now) const
{
    return _abandonReason.has_value()
        && (!_cancelRefusedAt.has_value() || now.steady - *_cancelRefusedAt >= CANCEL_PAUSE);
}

const std::optional<std::string>& VehicleDrive::GetFailureOrNull() const noexcept
{
    return _abandonReason.has_value() ? _abandonReason : _failure;
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

} // namespace ACS::Acsd
