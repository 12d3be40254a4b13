#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/Header.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Kinematics of a vehicle type (section 6.15.1).
enum class EAgvKinematic : std::uint8_t
{
    Diff,       ///< Differential drive.
    Omni,       ///< Omnidirectional.
    ThreeWheel, ///< Like a car.
};

/// What a vehicle type is made for (section 6.15.1).
enum class EAgvClass : std::uint8_t
{
    Forklift,
    Conveyor,
    Tugger,
    Carrier,
};

/// The vehicle type (section 6.15.1).
struct TypeSpecification
{
    std::string seriesName;
    std::string seriesDescription;
    EAgvKinematic agvKinematic = EAgvKinematic::Diff;
    EAgvClass agvClass = EAgvClass::Carrier;
    double maxLoadMass = 0.0; ///< kg
    std::vector<std::string>
        localizationTypes; ///< NATURAL, REFLECTOR, RFID, DMC, SPOT, GRID: examples in the text, all there is in the schema of 2.1.
    std::vector<std::string> navigationTypes; ///< By priority: PHYSICAL_LINE_GUIDED, VIRTUAL_LINE_GUIDED, AUTONOMOUS.

    bool operator==(const TypeSpecification&) const = default;
};

/// Limits and size of the vehicle type (section 6.15.1) in m/s, m/s², m and rad/s.
struct PhysicalParameters
{
    double speedMin = 0.0;
    double speedMax = 0.0;
    std::optional<double> angularSpeedMin; ///< Written from 2.1 on, according to its text; missing in its schema.
    std::optional<double> angularSpeedMax;
    double accelerationMax = 0.0;
    double decelerationMax = 0.0;
    double heightMin = 0.0;
    double heightMax = 0.0;
    double width = 0.0;
    double length = 0.0;

    bool operator==(const PhysicalParameters&) const = default;
};

/// Maximum lengths of texts in characters (section 6.15.1). Absent or 0: no stated limit.
struct MaximumStringLengths
{
    std::optional<std::uint32_t> message;
    std::optional<std::uint32_t> topicSerial;
    std::optional<std::uint32_t> topicElement;
    std::optional<std::uint32_t> identifier;
    std::optional<bool> bIdentifierNumericalOnly;
    std::optional<std::uint32_t> enumeration;
    std::optional<std::uint32_t> loadID;

    bool operator==(const MaximumStringLengths&) const = default;
};

/// Maximum numbers of elements (section 6.15.1). Absent or 0: no stated limit.
struct MaximumArrayLengths
{
    std::optional<std::uint32_t> orderNodes;
    std::optional<std::uint32_t> orderEdges;
    std::optional<std::uint32_t> nodeActions;
    std::optional<std::uint32_t> edgeActions;
    std::optional<std::uint32_t> actionParameters;
    std::optional<std::uint32_t> instantActions;
    std::optional<std::uint32_t> trajectoryKnotVector;
    std::optional<std::uint32_t> trajectoryControlPoints;
    std::optional<std::uint32_t> stateNodeStates;
    std::optional<std::uint32_t> stateEdgeStates;
    std::optional<std::uint32_t> stateLoads;
    std::optional<std::uint32_t> stateActionStates;
    std::optional<std::uint32_t> stateErrors;
    std::optional<std::uint32_t> stateInformation;
    std::optional<std::uint32_t> errorReferences;
    std::optional<std::uint32_t> informationReferences;

    bool operator==(const MaximumArrayLengths&) const = default;
};

/// Maximum interval of ProtocolTiming that is accepted, in seconds: one day.
inline constexpr double LONGEST_INTERVAL = 86'400.0;

/// Times of the protocol in seconds, 0 to LONGEST_INTERVAL (section 6.15.1).
struct ProtocolTiming
{
    double minOrderInterval = 0.0;
    double minStateInterval = 0.0;
    std::optional<double> defaultStateInterval;
    std::optional<double> visualizationInterval;

    bool operator==(const ProtocolTiming&) const = default;
};

/// Limits of the protocol that the vehicle states (section 6.15.1).
struct ProtocolLimits
{
    MaximumStringLengths maxStringLengths;
    MaximumArrayLengths maxArrayLengths;
    ProtocolTiming timing;

    bool operator==(const ProtocolLimits&) const = default;
};

/// Whether an optional member may be sent to the vehicle, or must be.
enum class EParameterSupport : std::uint8_t
{
    Supported,
    Required,
};

/// An optional member of the protocol that the vehicle supports or requires (section 6.15.1).
struct OptionalParameter
{
    std::string parameter; ///< Full path: order.nodes.nodePosition.allowedDeviationTheta
    EParameterSupport support = EParameterSupport::Supported;
    std::string description;

    bool operator==(const OptionalParameter&) const = default;
};

/// Where an action may be performed (section 6.15.1).
enum class EActionScope : std::uint8_t
{
    Instant,
    Node,
    Edge,
};

/// JSON type of a parameter's value (section 6.15.1).
enum class EValueDataType : std::uint8_t
{
    Bool,
    Number,
    Integer,
    Float,
    String,
    Object,
    Array,
};

/// A parameter of an action of the vehicle (section 6.15.1).
struct AgvActionParameter
{
    std::string key;
    EValueDataType valueDataType = EValueDataType::String;
    std::string description;
    std::optional<bool> bOptional;

    bool operator==(const AgvActionParameter&) const = default;
};

/// An action that the vehicle can perform, and where (section 6.15.1).
struct AgvAction
{
    std::string actionType;
    std::string actionDescription;
    std::vector<EActionScope> actionScopes;
    std::vector<AgvActionParameter> actionParameters;
    std::string resultDescription;            ///< What results of this action mean, in words.
    std::vector<EBlockingType> blockingTypes; ///< Written from 2.1 on.

    bool operator==(const AgvAction&) const = default;
};

/// Optional members and actions that the vehicle supports (section 6.15.1).
struct ProtocolFeatures
{
    /// Unlisted parameters are not supported; an empty list supports none. Absent, against the schema: all are allowed.
    std::optional<std::vector<OptionalParameter>> optionalParameters;
    std::vector<AgvAction> agvActions;

    bool operator==(const ProtocolFeatures&) const = default;
};

/// Kind of a wheel (section 6.15.1).
enum class EWheelType : std::uint8_t
{
    Drive,
    Caster,
    Fixed,
    Mecanum,
};

/// Position of a wheel in the frame of the vehicle (section 6.15.1), in metres and radians.
struct WheelPosition
{
    double x = 0.0;
    double y = 0.0;
    std::optional<double> theta;

    bool operator==(const WheelPosition&) const = default;
};

/// A wheel of the vehicle (section 6.15.1); lengths in metres.
struct WheelDefinition
{
    EWheelType type = EWheelType::Drive;
    bool bActiveDriven = false;
    bool bActiveSteered = false;
    WheelPosition position;
    double diameter = 0.0;
    double width = 0.0;
    std::optional<double> centerDisplacement;
    std::string constraints;

    bool operator==(const WheelDefinition&) const = default;
};

/// A point in the frame of the vehicle (section 6.15.1), in metres.
struct PolygonPoint
{
    double x = 0.0;
    double y = 0.0;

    bool operator==(const PolygonPoint&) const = default;
};

/// A contour of the vehicle in two dimensions, named by its set (section 6.15.1).
struct Envelope2D
{
    std::string set;
    std::vector<PolygonPoint> polygonPoints;
    std::string description;

    bool operator==(const Envelope2D&) const = default;
};

/// A contour of the vehicle in three dimensions, named by its set (section 6.15.1).
struct Envelope3D
{
    std::string set;
    std::string format;
    std::optional<Core::JsonText> data; ///< An object, defined by the format.
    std::string url;
    /// A string, but an integer in the schema of 2.1: written in 2.0 only.
    std::optional<Core::JsonText> description;

    bool operator==(const Envelope3D&) const = default;
};

/// Wheels and contours of the vehicle (section 6.15.1).
struct AgvGeometry
{
    std::vector<WheelDefinition> wheelDefinitions;
    std::vector<Envelope2D> envelopes2D;
    std::vector<Envelope3D> envelopes3D;

    bool operator==(const AgvGeometry&) const = default;
};

/// What the vehicle can do with one kind of load (section 6.15.1). Lengths in metres, masses in kilograms, tilts in radians, speeds
/// in m/s, accelerations in m/s².
struct LoadSet
{
    std::string setName;
    std::string loadType;
    std::vector<std::string> loadPositions;
    std::optional<BoundingBoxReference> boundingBoxReference;
    std::optional<LoadDimensions> loadDimensions;
    std::optional<double> maxWeight;
    std::optional<double> minLoadhandlingHeight;
    std::optional<double> maxLoadhandlingHeight;
    std::optional<double> minLoadhandlingDepth;
    std::optional<double> maxLoadhandlingDepth;
    std::optional<double> minLoadhandlingTilt;
    std::optional<double> maxLoadhandlingTilt;
    std::optional<double> agvSpeedLimit;
    std::optional<double> agvAccelerationLimit;
    std::optional<double> agvDecelerationLimit;
    std::optional<double> pickTime; ///< s
    std::optional<double> dropTime; ///< s
    std::string description;

    bool operator==(const LoadSet&) const = default;
};

/// Loads that the vehicle can carry (section 6.15.1).
struct LoadSpecification
{
    std::vector<std::string> loadPositions; ///< Empty: no load handling device.
    std::vector<LoadSet> loadSets;

    bool operator==(const LoadSpecification&) const = default;
};

/// The version of a piece of software or hardware of the vehicle (2.1, section 6.15.1).
struct VersionEntry
{
    std::string key;
    std::string value;

    bool operator==(const VersionEntry&) const = default;
};

/// The vehicle's network configuration (2.1, section 6.15.1).
struct NetworkConfig
{
    std::vector<std::string> dnsServers;
    std::vector<std::string> ntpServers;
    std::string localIpAddress;
    std::string netmask;
    std::string defaultGateway;

    bool operator==(const NetworkConfig&) const = default;
};

/// Software, hardware and network of the vehicle (2.1, section 6.15.1).
struct VehicleConfig
{
    std::vector<VersionEntry> versions;
    std::optional<NetworkConfig> network;

    bool operator==(const VehicleConfig&) const = default;
};

/// Topic factsheet (section 6.15), retained.
struct FactsheetMessage
{
    Header header;
    TypeSpecification typeSpecification;
    PhysicalParameters physicalParameters;
    ProtocolLimits protocolLimits;
    ProtocolFeatures protocolFeatures;
    AgvGeometry agvGeometry;
    LoadSpecification loadSpecification;
    std::optional<Core::JsonText> localizationParameters; ///< 2.0 only; an object, its contents are not defined.
    std::optional<VehicleConfig> vehicleConfig;           ///< Written from 2.1 on.

    bool operator==(const FactsheetMessage&) const = default;
};

/// Whether the factsheet lists the action type with this scope.
[[nodiscard]] ACS_API bool CanPerform(
    const FactsheetMessage& factsheet,
    std::string_view actionType,
    EActionScope scope);

/// Whether an optional member may be sent to the vehicle. The parameter is its full path, such as "order.edges.trajectory".
/// True where optionalParameters is absent, or lists the parameter or one inside it. A listed parameter does not imply those
/// inside it.
[[nodiscard]] ACS_API bool IsSupported(const FactsheetMessage& factsheet, std::string_view parameter);

} // namespace ACS::VDA5050
