#pragma once

#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/Header.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// Metres and radians in the project's map frame (section 6.6.6), counter-clockwise, theta in [-pi, pi].
struct NodePosition
{
    double x = 0.0;
    double y = 0.0;
    std::optional<double> theta;
    std::optional<double> allowedDeviationXY;    ///< Radius in metres; 0: the tolerance of the vehicle.
    std::optional<double> allowedDeviationTheta; ///< [0, pi]
    std::string mapID;
    std::string mapDescription;

    bool operator==(const NodePosition&) const = default;
};

/// A node of an order (section 6.6.6).
struct OrderNode
{
    std::string nodeID;
    std::uint32_t sequenceID = 0; ///< Even; nodes and edges share one sequence.
    std::string nodeDescription;
    bool bReleased = false; ///< Base; otherwise horizon.
    std::optional<NodePosition> nodePosition;
    std::vector<Action> actions;

    bool operator==(const OrderNode&) const = default;
};

/// A control point of a trajectory (section 6.6.6), in metres.
struct ControlPoint
{
    double x = 0.0;
    double y = 0.0;
    std::optional<double> weight; ///< Absent: 1.

    bool operator==(const ControlPoint&) const = default;
};

/// A NURBS (section 6.6.6): as many knots as control points + degree + 1, each in [0, 1].
struct Trajectory
{
    std::uint32_t degree = 1;
    std::vector<double> knotVector;
    std::vector<ControlPoint> controlPoints;

    bool operator==(const Trajectory&) const = default;
};

/// What must stay inside a corridor: the vehicle's kinematic center, or its contour with the load.
enum class ECorridorReferencePoint : std::uint8_t
{
    KinematicCenter,
    Contour,
};

/// How far a vehicle may leave its trajectory, left and right of the driving direction, in metres (2.1, section 6.6.6).
struct Corridor
{
    double leftWidth = 0.0;
    double rightWidth = 0.0;
    std::optional<ECorridorReferencePoint> corridorReferencePoint;

    bool operator==(const Corridor&) const = default;
};

/// What the orientation of an edge refers to: the map, or the tangent of the edge.
enum class EOrientationType : std::uint8_t
{
    Global,
    Tangential,
};

/// An edge of an order, from one node to the next (section 6.6.6).
struct OrderEdge
{
    std::string edgeID;
    std::uint32_t sequenceID = 0; ///< Odd.
    std::string edgeDescription;
    bool bReleased = false; ///< Base; otherwise horizon.
    std::string startNodeID;
    std::string endNodeID;
    std::optional<double> maxSpeed;                  ///< m/s
    std::optional<double> maxHeight;                 ///< m
    std::optional<double> minHeight;                 ///< m
    std::optional<double> orientation;               ///< Radians; see orientationType.
    std::optional<EOrientationType> orientationType; ///< Absent: Tangential.
    std::string direction;
    std::optional<bool> bRotationAllowed;
    std::optional<double> maxRotationSpeed; ///< rad/s
    std::optional<double> length;           ///< m
    std::optional<Trajectory> trajectory;   ///< Absent: a straight line.
    std::optional<Corridor> corridor;       ///< Written from 2.1 on.
    std::vector<Action> actions;

    bool operator==(const OrderEdge&) const = default;
};

/// Topic order (section 6.6).
struct OrderMessage
{
    Header header;
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    std::string zoneSetID;
    std::vector<OrderNode> nodes;
    std::vector<OrderEdge> edges;

    bool operator==(const OrderMessage&) const = default;
};

} // namespace ACS::VDA5050
