#include "CodecBody.hpp"
#include "CommonFields.hpp"

namespace ACS::Json
{

template <>
struct JsonFields<VDA5050::NodePosition>
{
    using Type = VDA5050::NodePosition;
    // allowedDeviationXy: the spelling of the order schema of 2.0.0.
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &Type::x),
        Required("y", &Type::y),
        Optional("theta", &Type::theta)
            .Between(-VDA5050::PI_BOUND, VDA5050::PI_BOUND)
            .WrittenBetween(-VDA5050::PI, VDA5050::PI),
        Optional("allowedDeviationXY", &Type::allowedDeviationXY).Between(0, VDA5050::NO_MAXIMUM),
        Alias("allowedDeviationXy", &Type::allowedDeviationXY).Between(0, VDA5050::NO_MAXIMUM),
        Optional("allowedDeviationTheta", &Type::allowedDeviationTheta)
            .Between(0, VDA5050::PI_BOUND)
            .WrittenBetween(0, VDA5050::PI),
        Required("mapId", &Type::mapID),
        Optional("mapDescription", &Type::mapDescription));
};

template <>
struct JsonFields<VDA5050::OrderNode>
{
    using Type = VDA5050::OrderNode;
    static constexpr auto FIELDS = std::make_tuple(
        Required("nodeId", &Type::nodeID),
        Required("sequenceId", &Type::sequenceID),
        Optional("nodeDescription", &Type::nodeDescription),
        Required("released", &Type::bReleased),
        Optional("nodePosition", &Type::nodePosition),
        Required("actions", &Type::actions));
};

template <>
struct EnumNames<VDA5050::ECorridorReferencePoint>
{
    using Type = VDA5050::ECorridorReferencePoint;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::KinematicCenter, "KINEMATICCENTER"},
        EnumWord<Type>{Type::Contour, "CONTOUR"}};
};

template <>
struct JsonFields<VDA5050::Corridor>
{
    using Type = VDA5050::Corridor;
    static constexpr auto FIELDS = std::make_tuple(
        Required("leftWidth", &Type::leftWidth).Between(0, VDA5050::NO_MAXIMUM),
        Required("rightWidth", &Type::rightWidth).Between(0, VDA5050::NO_MAXIMUM),
        Optional("corridorRefPoint", &Type::corridorReferencePoint));
};

template <>
struct EnumNames<VDA5050::EOrientationType>
{
    using Type = VDA5050::EOrientationType;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Global, "GLOBAL"},
        EnumWord<Type>{Type::Tangential, "TANGENTIAL"}};
};

template <>
struct JsonFields<VDA5050::OrderEdge>
{
    using Type = VDA5050::OrderEdge;
    static constexpr auto FIELDS = std::make_tuple(
        Required("edgeId", &Type::edgeID),
        Required("sequenceId", &Type::sequenceID),
        Optional("edgeDescription", &Type::edgeDescription),
        Required("released", &Type::bReleased),
        Required("startNodeId", &Type::startNodeID),
        Required("endNodeId", &Type::endNodeID),
        Optional("maxSpeed", &Type::maxSpeed),
        Optional("maxHeight", &Type::maxHeight),
        Optional("minHeight", &Type::minHeight),
        Optional("orientation", &Type::orientation)
            .Between(-VDA5050::PI_BOUND, VDA5050::PI_BOUND)
            .WrittenBetween(-VDA5050::PI, VDA5050::PI),
        Optional("orientationType", &Type::orientationType),
        Optional("direction", &Type::direction),
        Optional("rotationAllowed", &Type::bRotationAllowed),
        Optional("maxRotationSpeed", &Type::maxRotationSpeed),
        Optional("length", &Type::length),
        Optional("trajectory", &Type::trajectory),
        Optional("corridor", &Type::corridor).WrittenIn(VDA5050::Dialects::VERSION_210),
        Required("actions", &Type::actions));
};

template <>
struct JsonFields<VDA5050::OrderMessage>
{
    using Type = VDA5050::OrderMessage;
    static constexpr auto FIELDS = std::make_tuple(
        Flat(&Type::header),
        Required("orderId", &Type::orderID),
        Required("orderUpdateId", &Type::orderUpdateID),
        Optional("zoneSetId", &Type::zoneSetID),
        Required("nodes", &Type::nodes),
        Required("edges", &Type::edges));
};

template <>
struct JsonFields<VDA5050::InstantActionsMessage>
{
    using Type = VDA5050::InstantActionsMessage;
    // instantActions: the array's name in 1.1, which some stacks of 2.0 still send.
    static constexpr auto FIELDS = std::make_tuple(
        Flat(&Type::header),
        Required("actions", &Type::actions),
        Alias("instantActions", &Type::actions));
};

} // namespace ACS::Json

namespace ACS::VDA5050
{

template Core::Result<OrderMessage> Vda5050Codec::Decode(std::string_view payload);
template Core::Result<InstantActionsMessage> Vda5050Codec::Decode(std::string_view payload);
template void Vda5050Codec::Encode(const OrderMessage& message, EVda5050Version version, std::string& out) const;
template void Vda5050Codec::Encode(const InstantActionsMessage& message, EVda5050Version version, std::string& out)
    const;

} // namespace ACS::VDA5050
