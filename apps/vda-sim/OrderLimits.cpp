#include "vda-sim/OrderLimits.hpp"

#include <acs/vda5050/PredefinedActions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::ErrorReference;
using VDA5050::OrderEdge;
using VDA5050::OrderNode;
using VDA5050::OrderViolation;

/// The first rules that an order breaks; further ones do not help to correct it.
class Findings
{
    static constexpr std::size_t MOST = 16;

    const VDA5050::OrderMessage* _order;
    std::vector<OrderViolation> _violations;

public:
    explicit Findings(const VDA5050::OrderMessage& order)
        : _order(&order)
    {
    }

    void Add(std::string_view errorType, std::string rule, std::vector<ErrorReference> references)
    {
        if (_violations.size() >= MOST)
        {
            return;
        }
        OrderViolation& violation =
            _violations.emplace_back(VDA5050::MakeOrderViolation(*_order, errorType, std::move(rule)));
        std::ranges::move(references, std::back_inserter(violation.error.errorReferences));
    }

    void AddOfEdge(const OrderEdge& edge, std::string_view parameter, std::string rule)
    {
        Add(VDA5050::ErrorTypes::ORDER_ERROR,
            std::move(rule),
            {{"edgeId", edge.edgeID}, {"parameter", std::string(parameter)}});
    }

    [[nodiscard]] std::vector<OrderViolation> Take()
    {
        return std::move(_violations);
    }
};

std::string MakeTooFar()
{
    return fmt::format("farther than {} m from the site", MAX_REACH);
}

void CheckPlaces(const VDA5050::OrderMessage& order, const Planning::SiteMap& site, Findings& findings)
{
    for (std::size_t index = 0; index < order.nodes.size(); ++index)
    {
        const OrderNode& node = order.nodes[index];
        // The vehicle is on the first node, or drives to it: an order begins there and an update continues there.
        if (!node.nodePosition.has_value() && index > 0 && site.FindNodeOrNull(node.nodeID) == nullptr)
        {
            findings.Add(
                VDA5050::ErrorTypes::NO_ROUTE_ERROR,
                "this node is not on the site, and the order does not contain its position",
                {{"nodeId", node.nodeID}, {"parameter", "order.nodes.nodePosition"}});
        }
        if (node.nodePosition.has_value() && !IsInReach(site, node.nodePosition->x, node.nodePosition->y))
        {
            findings.Add(
                VDA5050::ErrorTypes::NO_ROUTE_ERROR,
                "a node is " + MakeTooFar(),
                {{"nodeId", node.nodeID}, {"parameter", "order.nodes.nodePosition"}});
        }
    }
}

void CheckCurve(
    const OrderEdge& edge,
    const VDA5050::Trajectory& curve,
    const Planning::SiteMap& site,
    Findings& findings)
{
    constexpr std::string_view PARAMETER = "order.edges.trajectory";
    if (curve.degree > MAX_DEGREE)
    {
        findings.AddOfEdge(
            edge,
            PARAMETER,
            fmt::format("the vehicle drives trajectories up to the degree {}, not {}", MAX_DEGREE, curve.degree));
    }
    const bool bNear = std::ranges::all_of(curve.controlPoints, [&site](const VDA5050::ControlPoint& point) {
        return IsInReach(site, point.x, point.y);
    });
    if (!bNear)
    {
        findings.AddOfEdge(edge, PARAMETER, "a control point of a trajectory is " + MakeTooFar());
    }
}

void CheckEdge(const OrderEdge& edge, const Planning::SiteMap& site, Findings& findings)
{
    if (edge.maxSpeed.has_value() && *edge.maxSpeed < MIN_SPEED)
    {
        findings.AddOfEdge(
            edge,
            "order.edges.maxSpeed",
            fmt::format("the vehicle drives no slower than {} m/s", MIN_SPEED));
    }
    if (edge.maxRotationSpeed.has_value() && *edge.maxRotationSpeed < MIN_TURN_SPEED)
    {
        findings.AddOfEdge(
            edge,
            "order.edges.maxRotationSpeed",
            fmt::format("the vehicle turns no slower than {} rad/s", MIN_TURN_SPEED));
    }
    if (edge.trajectory.has_value())
    {
        CheckCurve(edge, *edge.trajectory, site, findings);
    }
}

bool CanEnable(const VDA5050::Action& action, const std::string& mapID)
{
    const VDA5050::ActionParameter* const parameter = VDA5050::FindParameterOrNull(action, "mapId");
    return action.actionType == VDA5050::ActionTypes::ENABLE_MAP && parameter != nullptr
        && parameter->value.GetStringOrNull() == mapID;
}

} // namespace

bool IsInReach(const Planning::SiteMap& site, double x, double y)
{
    const std::vector<Planning::SiteNode>& nodes = site.GetNodes();
    const double fromX = nodes.empty() ? 0.0 : nodes.front().x;
    const double fromY = nodes.empty() ? 0.0 : nodes.front().y;
    return std::hypot(x - fromX, y - fromY) <= MAX_REACH;
}

std::vector<OrderViolation> FindUndrivable(const VDA5050::OrderMessage& order, const Planning::SiteMap& site)
{
    Findings findings(order);
    CheckPlaces(order, site, findings);
    for (const OrderEdge& edge : order.edges)
    {
        CheckEdge(edge, site, findings);
    }
    return findings.Take();
}

std::vector<OrderViolation> FindDisabledMaps(
    const VDA5050::OrderMessage& order,
    const std::set<std::string>& disabledMapIDs)
{
    Findings findings(order);
    for (const OrderNode& node : order.nodes)
    {
        if (!node.nodePosition.has_value() || !disabledMapIDs.contains(node.nodePosition->mapID))
        {
            continue;
        }
        const std::string& mapID = node.nodePosition->mapID;
        const bool bEnabled = std::ranges::any_of(order.nodes, [&mapID](const OrderNode& other) {
            return std::ranges::any_of(other.actions, [&mapID](const VDA5050::Action& action) {
                return CanEnable(action, mapID);
            });
        });
        if (!bEnabled)
        {
            findings.Add(
                VDA5050::ErrorTypes::ORDER_ERROR,
                fmt::format("the map {} is disabled", mapID),
                {{"mapId", mapID}, {"nodeId", node.nodeID}, {"parameter", "order.nodes.nodePosition.mapId"}});
        }
    }
    return findings.Take();
}

} // namespace ACS::VdaSim
