#include "CodecBody.hpp"
#include "CommonFields.hpp"

namespace ACS::Json
{

template <>
struct EnumNames<VDA5050::EMapStatus>
{
    using Type = VDA5050::EMapStatus;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Enabled, "ENABLED"},
        EnumWord<Type>{Type::Disabled, "DISABLED"}};
};

template <>
struct JsonFields<VDA5050::MapState>
{
    using Type = VDA5050::MapState;
    static constexpr auto FIELDS = std::make_tuple(
        Required("mapId", &Type::mapID),
        Required("mapVersion", &Type::mapVersion),
        Required("mapStatus", &Type::mapStatus),
        Optional("mapDescription", &Type::mapDescription));
};

template <>
struct JsonFields<VDA5050::NodeStatePosition>
{
    using Type = VDA5050::NodeStatePosition;
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &Type::x),
        Required("y", &Type::y),
        Optional("theta", &Type::theta),
        Optional("allowedDeviationXY", &Type::allowedDeviationXY).WrittenIn(VDA5050::Dialects::VERSION_200),
        Optional("allowedDeviationTheta", &Type::allowedDeviationTheta).WrittenIn(VDA5050::Dialects::VERSION_200),
        Required("mapId", &Type::mapID),
        Optional("mapDescription", &Type::mapDescription).WrittenIn(VDA5050::Dialects::VERSION_200));
};

template <>
struct JsonFields<VDA5050::NodeState>
{
    using Type = VDA5050::NodeState;
    static constexpr auto FIELDS = std::make_tuple(
        Required("nodeId", &Type::nodeID),
        Required("sequenceId", &Type::sequenceID),
        Optional("nodeDescription", &Type::nodeDescription),
        Required("released", &Type::bReleased),
        Optional("nodePosition", &Type::nodePosition));
};

template <>
struct JsonFields<VDA5050::EdgeState>
{
    using Type = VDA5050::EdgeState;
    static constexpr auto FIELDS = std::make_tuple(
        Required("edgeId", &Type::edgeID),
        Required("sequenceId", &Type::sequenceID),
        Optional("edgeDescription", &Type::edgeDescription),
        Required("released", &Type::bReleased),
        Optional("trajectory", &Type::trajectory));
};

template <>
struct JsonFields<VDA5050::AgvPosition>
{
    using Type = VDA5050::AgvPosition;
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &Type::x),
        Required("y", &Type::y),
        Required("theta", &Type::theta)
            .Between(-VDA5050::PI_BOUND, VDA5050::PI_BOUND)
            .WrittenBetween(-VDA5050::PI, VDA5050::PI),
        Required("mapId", &Type::mapID),
        Optional("mapDescription", &Type::mapDescription).WrittenIn(VDA5050::Dialects::OUTSIDE_VISUALIZATION),
        Required("positionInitialized", &Type::bPositionInitialized),
        Optional("localizationScore", &Type::localizationScore).Between(0, 1).WrittenBetween(0, 1),
        Optional("deviationRange", &Type::deviationRange));
};

template <>
struct JsonFields<VDA5050::Velocity>
{
    using Type = VDA5050::Velocity;
    static constexpr auto FIELDS =
        std::make_tuple(Optional("vx", &Type::vx), Optional("vy", &Type::vy), Optional("omega", &Type::omega));
};

template <>
struct JsonFields<VDA5050::Load>
{
    using Type = VDA5050::Load;
    static constexpr auto FIELDS = std::make_tuple(
        Optional("loadId", &Type::loadID),
        Optional("loadType", &Type::loadType),
        Optional("loadPosition", &Type::loadPosition),
        Optional("boundingBoxReference", &Type::boundingBoxReference),
        Optional("loadDimensions", &Type::loadDimensions),
        Optional("weight", &Type::weight).Between(0, VDA5050::NO_MAXIMUM).WrittenBetween(0, VDA5050::NO_MAXIMUM));
};

template <>
struct EnumNames<VDA5050::EActionStatus>
{
    using Type = VDA5050::EActionStatus;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Waiting, "WAITING"},
        EnumWord<Type>{Type::Initializing, "INITIALIZING"},
        EnumWord<Type>{Type::Running, "RUNNING"},
        EnumWord<Type>{Type::Paused, "PAUSED"},
        EnumWord<Type>{Type::Finished, "FINISHED"},
        EnumWord<Type>{Type::Failed, "FAILED"}};
};

template <>
struct JsonFields<VDA5050::ActionState>
{
    using Type = VDA5050::ActionState;
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionId", &Type::actionID),
        Optional("actionType", &Type::actionType),
        Optional("actionDescription", &Type::actionDescription),
        Required("actionStatus", &Type::actionStatus),
        Optional("resultDescription", &Type::resultDescription));
};

template <>
struct JsonFields<VDA5050::BatteryState>
{
    using Type = VDA5050::BatteryState;
    static constexpr auto FIELDS = std::make_tuple(
        Required("batteryCharge", &Type::batteryCharge),
        Optional("batteryVoltage", &Type::batteryVoltage),
        Optional("batteryHealth", &Type::batteryHealth)
            .Between(0, 100)
            .WrittenBetween(0, 100)
            .WholeIn(VDA5050::Dialects::VERSION_200),
        Required("charging", &Type::bCharging),
        Optional("reach", &Type::reach).Between(0, VDA5050::NO_MAXIMUM).WrittenBetween(0, VDA5050::NO_MAXIMUM));
};

template <>
struct EnumNames<VDA5050::EOperatingMode>
{
    using Type = VDA5050::EOperatingMode;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Automatic, "AUTOMATIC"},
        EnumWord<Type>{Type::SemiAutomatic, "SEMIAUTOMATIC"},
        EnumWord<Type>{Type::Manual, "MANUAL"},
        EnumWord<Type>{Type::Service, "SERVICE"},
        EnumWord<Type>{Type::TeachIn, "TEACHIN"}};
};

template <>
struct EnumNames<VDA5050::EErrorLevel>
{
    using Type = VDA5050::EErrorLevel;
    static constexpr std::array WORDS{EnumWord<Type>{Type::Warning, "WARNING"}, EnumWord<Type>{Type::Fatal, "FATAL"}};
};

template <>
struct JsonFields<VDA5050::ErrorReference>
{
    using Type = VDA5050::ErrorReference;
    static constexpr auto FIELDS = std::make_tuple(
        Required("referenceKey", &Type::referenceKey),
        Required("referenceValue", &Type::referenceValue));
};

template <>
struct JsonFields<VDA5050::VehicleError>
{
    using Type = VDA5050::VehicleError;
    static constexpr auto FIELDS = std::make_tuple(
        Required("errorType", &Type::errorType),
        Optional("errorReferences", &Type::errorReferences),
        Optional("errorDescription", &Type::errorDescription),
        Optional("errorHint", &Type::errorHint).WrittenIn(VDA5050::Dialects::VERSION_210),
        Required("errorLevel", &Type::errorLevel));
};

template <>
struct EnumNames<VDA5050::EInformationLevel>
{
    using Type = VDA5050::EInformationLevel;
    static constexpr std::array WORDS{EnumWord<Type>{Type::Info, "INFO"}, EnumWord<Type>{Type::Debug, "DEBUG"}};
};

template <>
struct JsonFields<VDA5050::Information>
{
    using Type = VDA5050::Information;
    static constexpr auto FIELDS = std::make_tuple(
        Required("infoType", &Type::infoType),
        Optional("infoReferences", &Type::infoReferences),
        Optional("infoDescription", &Type::infoDescription),
        Required("infoLevel", &Type::infoLevel));
};

template <>
struct EnumNames<VDA5050::EEmergencyStop>
{
    using Type = VDA5050::EEmergencyStop;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::AutoAcknowledge, "AUTOACK"},
        EnumWord<Type>{Type::Manual, "MANUAL"},
        EnumWord<Type>{Type::Remote, "REMOTE"},
        EnumWord<Type>{Type::None, "NONE"}};
};

template <>
struct JsonFields<VDA5050::SafetyState>
{
    using Type = VDA5050::SafetyState;
    static constexpr auto FIELDS =
        std::make_tuple(Required("eStop", &Type::emergencyStop), Required("fieldViolation", &Type::bFieldViolation));
};

template <>
struct JsonFields<VDA5050::StateMessage>
{
    using Type = VDA5050::StateMessage;
    static constexpr auto FIELDS = std::make_tuple(
        Flat(&Type::header),
        Optional("maps", &Type::maps).WrittenIn(VDA5050::Dialects::VERSION_210),
        Required("orderId", &Type::orderID),
        Required("orderUpdateId", &Type::orderUpdateID),
        Optional("zoneSetId", &Type::zoneSetID),
        Required("lastNodeId", &Type::lastNodeID),
        Required("lastNodeSequenceId", &Type::lastNodeSequenceID),
        Required("nodeStates", &Type::nodeStates),
        Required("edgeStates", &Type::edgeStates),
        Optional("agvPosition", &Type::agvPosition),
        Optional("velocity", &Type::velocity),
        Optional("loads", &Type::loads),
        Required("driving", &Type::bDriving),
        Optional("paused", &Type::bPaused),
        Optional("newBaseRequest", &Type::bNewBaseRequest),
        Optional("distanceSinceLastNode", &Type::distanceSinceLastNode),
        Required("actionStates", &Type::actionStates),
        Required("batteryState", &Type::batteryState),
        Required("operatingMode", &Type::operatingMode),
        Required("errors", &Type::errors),
        Optional("information", &Type::information),
        Required("safetyState", &Type::safetyState));
};

template <>
struct JsonFields<VDA5050::VisualizationMessage>
{
    using Type = VDA5050::VisualizationMessage;
    // The schemas of 2.x require nothing here.
    static constexpr auto FIELDS = std::make_tuple(
        DefaultedInHeader<Type>("headerId", &VDA5050::Header::headerID),
        DefaultedInHeader<Type>("timestamp", &VDA5050::Header::timestamp),
        DefaultedInHeader<Type>("version", &VDA5050::Header::version),
        DefaultedInHeader<Type>("manufacturer", &VDA5050::Header::manufacturer),
        DefaultedInHeader<Type>("serialNumber", &VDA5050::Header::serialNumber),
        Optional("agvPosition", &Type::agvPosition),
        Optional("velocity", &Type::velocity));
};

template <>
struct EnumNames<VDA5050::EConnectionState>
{
    using Type = VDA5050::EConnectionState;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Online, "ONLINE"},
        EnumWord<Type>{Type::Offline, "OFFLINE"},
        EnumWord<Type>{Type::ConnectionBroken, "CONNECTIONBROKEN"}};
};

template <>
struct JsonFields<VDA5050::ConnectionMessage>
{
    using Type = VDA5050::ConnectionMessage;
    static constexpr auto FIELDS =
        std::make_tuple(Flat(&Type::header), Required("connectionState", &Type::connectionState));
};

} // namespace ACS::Json

namespace ACS::VDA5050
{

template Core::Result<StateMessage> Vda5050Codec::Decode(std::string_view payload);
template Core::Result<VisualizationMessage> Vda5050Codec::Decode(std::string_view payload);
template Core::Result<ConnectionMessage> Vda5050Codec::Decode(std::string_view payload);
template void Vda5050Codec::Encode(const StateMessage& message, EVda5050Version version, std::string& out) const;
template void Vda5050Codec::Encode(const VisualizationMessage& message, EVda5050Version version, std::string& out)
    const;
template void Vda5050Codec::Encode(const ConnectionMessage& message, EVda5050Version version, std::string& out) const;

} // namespace ACS::VDA5050
