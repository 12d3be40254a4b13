#include "CodecBody.hpp"
#include "CommonFields.hpp"
#include <acs/vda5050/FactsheetMessage.hpp>

namespace ACS::Json
{

template <>
struct EnumNames<VDA5050::EAgvKinematic>
{
    using Type = VDA5050::EAgvKinematic;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Diff, "DIFF"},
        EnumWord<Type>{Type::Omni, "OMNI"},
        EnumWord<Type>{Type::ThreeWheel, "THREEWHEEL"}};
};

template <>
struct EnumNames<VDA5050::EAgvClass>
{
    using Type = VDA5050::EAgvClass;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Forklift, "FORKLIFT"},
        EnumWord<Type>{Type::Conveyor, "CONVEYOR"},
        EnumWord<Type>{Type::Tugger, "TUGGER"},
        EnumWord<Type>{Type::Carrier, "CARRIER"}};
};

template <>
struct JsonFields<VDA5050::TypeSpecification>
{
    using Type = VDA5050::TypeSpecification;
    static constexpr auto FIELDS = std::make_tuple(
        Required("seriesName", &Type::seriesName),
        Optional("seriesDescription", &Type::seriesDescription),
        Required("agvKinematic", &Type::agvKinematic),
        Required("agvClass", &Type::agvClass),
        Required("maxLoadMass", &Type::maxLoadMass).Between(0, VDA5050::NO_MAXIMUM),
        Required("localizationTypes", &Type::localizationTypes),
        Required("navigationTypes", &Type::navigationTypes));
};

template <>
struct JsonFields<VDA5050::PhysicalParameters>
{
    using Type = VDA5050::PhysicalParameters;
    static constexpr auto FIELDS = std::make_tuple(
        Required("speedMin", &Type::speedMin),
        Required("speedMax", &Type::speedMax),
        Optional("angularSpeedMin", &Type::angularSpeedMin).WrittenIn(VDA5050::Dialects::VERSION_210),
        Optional("angularSpeedMax", &Type::angularSpeedMax).WrittenIn(VDA5050::Dialects::VERSION_210),
        Required("accelerationMax", &Type::accelerationMax),
        Required("decelerationMax", &Type::decelerationMax),
        Defaulted("heightMin", &Type::heightMin),
        Required("heightMax", &Type::heightMax),
        Required("width", &Type::width),
        Required("length", &Type::length));
};

template <>
struct JsonFields<VDA5050::MaximumStringLengths>
{
    using Type = VDA5050::MaximumStringLengths;
    static constexpr auto FIELDS = std::make_tuple(
        Optional("msgLen", &Type::message),
        Optional("topicSerialLen", &Type::topicSerial),
        Optional("topicElemLen", &Type::topicElement),
        Optional("idLen", &Type::identifier),
        Optional("idNumericalOnly", &Type::bIdentifierNumericalOnly),
        Optional("enumLen", &Type::enumeration),
        Optional("loadIdLen", &Type::loadID));
};

template <>
struct JsonFields<VDA5050::MaximumArrayLengths>
{
    using Type = VDA5050::MaximumArrayLengths;
    static constexpr auto FIELDS = std::make_tuple(
        Optional("order.nodes", &Type::orderNodes),
        Optional("order.edges", &Type::orderEdges),
        Optional("node.actions", &Type::nodeActions),
        Optional("edge.actions", &Type::edgeActions),
        Optional("actions.actionsParameters", &Type::actionParameters),
        Optional("instantActions", &Type::instantActions),
        Optional("trajectory.knotVector", &Type::trajectoryKnotVector),
        Optional("trajectory.controlPoints", &Type::trajectoryControlPoints),
        Optional("state.nodeStates", &Type::stateNodeStates),
        Optional("state.edgeStates", &Type::stateEdgeStates),
        Optional("state.loads", &Type::stateLoads),
        Optional("state.actionStates", &Type::stateActionStates),
        Optional("state.errors", &Type::stateErrors),
        Optional("state.information", &Type::stateInformation),
        Optional("error.errorReferences", &Type::errorReferences),
        Optional("information.infoReferences", &Type::informationReferences),
        Alias("informations.infoReferences", &Type::informationReferences));
};

template <>
struct JsonFields<VDA5050::ProtocolTiming>
{
    using Type = VDA5050::ProtocolTiming;
    static constexpr auto FIELDS = std::make_tuple(
        Required("minOrderInterval", &Type::minOrderInterval).Between(0, VDA5050::LONGEST_INTERVAL),
        Required("minStateInterval", &Type::minStateInterval).Between(0, VDA5050::LONGEST_INTERVAL),
        Optional("defaultStateInterval", &Type::defaultStateInterval).Between(0, VDA5050::LONGEST_INTERVAL),
        Optional("visualizationInterval", &Type::visualizationInterval).Between(0, VDA5050::LONGEST_INTERVAL));
};

template <>
struct JsonFields<VDA5050::ProtocolLimits>
{
    using Type = VDA5050::ProtocolLimits;
    static constexpr auto FIELDS = std::make_tuple(
        Required("maxStringLens", &Type::maxStringLengths),
        Required("maxArrayLens", &Type::maxArrayLengths),
        Required("timing", &Type::timing));
};

template <>
struct EnumNames<VDA5050::EParameterSupport>
{
    using Type = VDA5050::EParameterSupport;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Supported, "SUPPORTED"},
        EnumWord<Type>{Type::Required, "REQUIRED"}};
};

template <>
struct JsonFields<VDA5050::OptionalParameter>
{
    using Type = VDA5050::OptionalParameter;
    static constexpr auto FIELDS = std::make_tuple(
        Required("parameter", &Type::parameter),
        Required("support", &Type::support),
        Optional("description", &Type::description));
};

template <>
struct EnumNames<VDA5050::EActionScope>
{
    using Type = VDA5050::EActionScope;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Instant, "INSTANT"},
        EnumWord<Type>{Type::Node, "NODE"},
        EnumWord<Type>{Type::Edge, "EDGE"}};
};

template <>
struct EnumNames<VDA5050::EValueDataType>
{
    using Type = VDA5050::EValueDataType;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Bool, "BOOL"},
        EnumWord<Type>{Type::Number, "NUMBER"},
        EnumWord<Type>{Type::Integer, "INTEGER"},
        EnumWord<Type>{Type::Float, "FLOAT"},
        EnumWord<Type>{Type::String, "STRING"},
        EnumWord<Type>{Type::Object, "OBJECT"},
        EnumWord<Type>{Type::Array, "ARRAY"}};
};

template <>
struct JsonFields<VDA5050::AgvActionParameter>
{
    using Type = VDA5050::AgvActionParameter;
    static constexpr auto FIELDS = std::make_tuple(
        Required("key", &Type::key),
        Required("valueDataType", &Type::valueDataType),
        Optional("description", &Type::description),
        Optional("isOptional", &Type::bOptional));
};

template <>
struct JsonFields<VDA5050::AgvAction>
{
    using Type = VDA5050::AgvAction;
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionType", &Type::actionType),
        Optional("actionDescription", &Type::actionDescription),
        Required("actionScopes", &Type::actionScopes),
        Optional("actionParameters", &Type::actionParameters),
        Optional("resultDescription", &Type::resultDescription),
        Optional("blockingTypes", &Type::blockingTypes).WrittenIn(VDA5050::Dialects::VERSION_210));
};

template <>
struct JsonFields<VDA5050::ProtocolFeatures>
{
    using Type = VDA5050::ProtocolFeatures;
    static constexpr auto FIELDS = std::make_tuple(
        Optional("optionalParameters", &Type::optionalParameters),
        Required("agvActions", &Type::agvActions));
};

template <>
struct EnumNames<VDA5050::EWheelType>
{
    using Type = VDA5050::EWheelType;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Drive, "DRIVE"},
        EnumWord<Type>{Type::Caster, "CASTER"},
        EnumWord<Type>{Type::Fixed, "FIXED"},
        EnumWord<Type>{Type::Mecanum, "MECANUM"}};
};

template <>
struct JsonFields<VDA5050::WheelPosition>
{
    using Type = VDA5050::WheelPosition;
    static constexpr auto FIELDS =
        std::make_tuple(Required("x", &Type::x), Required("y", &Type::y), Optional("theta", &Type::theta));
};

template <>
struct JsonFields<VDA5050::WheelDefinition>
{
    using Type = VDA5050::WheelDefinition;
    static constexpr auto FIELDS = std::make_tuple(
        Required("type", &Type::type),
        Required("isActiveDriven", &Type::bActiveDriven),
        Required("isActiveSteered", &Type::bActiveSteered),
        Required("position", &Type::position),
        Required("diameter", &Type::diameter),
        Required("width", &Type::width),
        Optional("centerDisplacement", &Type::centerDisplacement),
        Optional("constraints", &Type::constraints));
};

template <>
struct JsonFields<VDA5050::PolygonPoint>
{
    using Type = VDA5050::PolygonPoint;
    static constexpr auto FIELDS = std::make_tuple(Required("x", &Type::x), Required("y", &Type::y));
};

template <>
struct JsonFields<VDA5050::Envelope2D>
{
    using Type = VDA5050::Envelope2D;
    static constexpr auto FIELDS = std::make_tuple(
        Required("set", &Type::set),
        Required("polygonPoints", &Type::polygonPoints),
        Optional("description", &Type::description));
};

template <>
struct JsonFields<VDA5050::Envelope3D>
{
    using Type = VDA5050::Envelope3D;
    static constexpr auto FIELDS = std::make_tuple(
        Required("set", &Type::set),
        Required("format", &Type::format),
        Optional("data", &Type::data).WrittenIfObject(),
        Optional("url", &Type::url),
        Optional("description", &Type::description).WrittenIn(VDA5050::Dialects::VERSION_200).WrittenIfString());
};

template <>
struct JsonFields<VDA5050::AgvGeometry>
{
    using Type = VDA5050::AgvGeometry;
    static constexpr auto FIELDS = std::make_tuple(
        Optional("wheelDefinitions", &Type::wheelDefinitions),
        Optional("envelopes2d", &Type::envelopes2D),
        Optional("envelopes3d", &Type::envelopes3D));
};

template <>
struct JsonFields<VDA5050::LoadSet>
{
    using Type = VDA5050::LoadSet;
    static constexpr auto FIELDS = std::make_tuple(
        Required("setName", &Type::setName),
        Required("loadType", &Type::loadType),
        Optional("loadPositions", &Type::loadPositions),
        Optional("boundingBoxReference", &Type::boundingBoxReference),
        Optional("loadDimensions", &Type::loadDimensions),
        Optional("maxWeight", &Type::maxWeight),
        Alias("maxWeigth", &Type::maxWeight),
        Optional("minLoadhandlingHeight", &Type::minLoadhandlingHeight),
        Optional("maxLoadhandlingHeight", &Type::maxLoadhandlingHeight),
        Optional("minLoadhandlingDepth", &Type::minLoadhandlingDepth),
        Optional("maxLoadhandlingDepth", &Type::maxLoadhandlingDepth),
        Optional("minLoadhandlingTilt", &Type::minLoadhandlingTilt),
        Optional("maxLoadhandlingTilt", &Type::maxLoadhandlingTilt),
        Optional("agvSpeedLimit", &Type::agvSpeedLimit),
        Optional("agvAccelerationLimit", &Type::agvAccelerationLimit),
        Optional("agvDecelerationLimit", &Type::agvDecelerationLimit),
        Optional("pickTime", &Type::pickTime),
        Optional("dropTime", &Type::dropTime),
        Optional("description", &Type::description));
};

template <>
struct JsonFields<VDA5050::LoadSpecification>
{
    using Type = VDA5050::LoadSpecification;
    static constexpr auto FIELDS =
        std::make_tuple(Optional("loadPositions", &Type::loadPositions), Optional("loadSets", &Type::loadSets));
};

template <>
struct JsonFields<VDA5050::VersionEntry>
{
    using Type = VDA5050::VersionEntry;
    static constexpr auto FIELDS = std::make_tuple(Required("key", &Type::key), Required("value", &Type::value));
};

template <>
struct JsonFields<VDA5050::NetworkConfig>
{
    using Type = VDA5050::NetworkConfig;
    static constexpr auto FIELDS = std::make_tuple(
        Optional("dnsServers", &Type::dnsServers),
        Optional("ntpServers", &Type::ntpServers),
        Optional("localIpAddress", &Type::localIpAddress),
        Optional("netmask", &Type::netmask),
        Optional("defaultGateway", &Type::defaultGateway));
};

template <>
struct JsonFields<VDA5050::VehicleConfig>
{
    using Type = VDA5050::VehicleConfig;
    static constexpr auto FIELDS =
        std::make_tuple(Optional("versions", &Type::versions), Optional("network", &Type::network));
};

template <>
struct JsonFields<VDA5050::FactsheetMessage>
{
    using Type = VDA5050::FactsheetMessage;
    static constexpr auto FIELDS = std::make_tuple(
        DefaultedInHeader<Type>("headerId", &VDA5050::Header::headerID),
        DefaultedInHeader<Type>("timestamp", &VDA5050::Header::timestamp),
        DefaultedInHeader<Type>("version", &VDA5050::Header::version),
        DefaultedInHeader<Type>("manufacturer", &VDA5050::Header::manufacturer),
        DefaultedInHeader<Type>("serialNumber", &VDA5050::Header::serialNumber),
        Required("typeSpecification", &Type::typeSpecification),
        Required("physicalParameters", &Type::physicalParameters),
        Required("protocolLimits", &Type::protocolLimits),
        Required("protocolFeatures", &Type::protocolFeatures),
        Required("agvGeometry", &Type::agvGeometry),
        Required("loadSpecification", &Type::loadSpecification),
        Optional("localizationParameters", &Type::localizationParameters)
            .WrittenIn(VDA5050::Dialects::VERSION_200)
            .WrittenIfObject(),
        Optional("vehicleConfig", &Type::vehicleConfig).WrittenIn(VDA5050::Dialects::VERSION_210));
};

} // namespace ACS::Json

namespace ACS::VDA5050
{

template Core::Result<FactsheetMessage> Vda5050Codec::Decode(std::string_view payload);
template void Vda5050Codec::Encode(const FactsheetMessage& message, EVda5050Version version, std::string& out) const;

} // namespace ACS::VDA5050
