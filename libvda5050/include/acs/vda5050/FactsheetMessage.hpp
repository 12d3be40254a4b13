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

enum class EAgvKinematic : std::uint8_t
{
    Diff,
    Omni,
    ThreeWheel,
};

enum class EAgvClass : std::uint8_t
{
    Forklift,
    Conveyor,
    Tugger,
    Carrier,
};

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

/// m/s, m/s², m, rad/s.
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

/// Absent or 0: no stated limit.
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

/// Absent or 0: no stated limit.
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

/// Seconds, 0 to LONGEST_INTERVAL.
struct ProtocolTiming
{
    double minOrderInterval = 0.0;
    double minStateInterval = 0.0;
    std::optional<double> defaultStateInterval;
    std::optional<double> visualizationInterval;

    bool operator==(const ProtocolTiming&) const = default;
};

struct ProtocolLimits
{
    MaximumStringLengths maxStringLengths;
    MaximumArrayLengths maxArrayLengths;
    ProtocolTiming timing;

    bool operator==(const ProtocolLimits&) const = default;
};

enum class EParameterSupport : std::uint8_t
{
    Supported,
    Required,
};

struct OptionalParameter
{
    std::string parameter; ///< Full path: order.nodes.nodePosition.allowedDeviationTheta
    EParameterSupport support = EParameterSupport::Supported;
    std::string description;

    bool operator==(const OptionalParameter&) const = default;
};

enum class EActionScope : std::uint8_t
{
    Instant,
    Node,
    Edge,
};

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

struct AgvActionParameter
{
    std::string key;
    EValueDataType valueDataType = EValueDataType::String;
    std::string description;
    std::optional<bool> bOptional;

    bool operator==(const AgvActionParameter&) const = default;
};

/// An action that the vehicle can perform, and where.
struct AgvAction
{
    std::string actionType;
    std::string actionDescription;
    std::vector<EActionScope> actionScopes;
    std::vector<AgvActionParameter> actionParameters;
    std::string resultDescription;
    std::vector<EBlockingType> blockingTypes; ///< Written from 2.1 on.

    bool operator==(const AgvAction&) const = default;
};

struct ProtocolFeatures
{
    /// Unlisted parameters are not supported; an empty list supports none. Absent, against the schema: all are allowed.
    std::optional<std::vector<OptionalParameter>> optionalParameters;
    std::vector<AgvAction> agvActions;

    bool operator==(const ProtocolFeatures&) const = default;
};

enum class EWheelType : std::uint8_t
{
    Drive,
    Caster,
    Fixed,
    Mecanum,
};

struct WheelPosition
{
    double x = 0.0;
    double y = 0.0;
    std::optional<double> theta;

    bool operator==(const WheelPosition&) const = default;
};

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

struct PolygonPoint
{
    double x = 0.0;
    double y = 0.0;

    bool operator==(const PolygonPoint&) const = default;
};

struct Envelope2D
{
    std::string set;
    std::vector<PolygonPoint> polygonPoints;
    std::string description;

    bool operator==(const Envelope2D&) const = default;
};

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

struct AgvGeometry
{
    std::vector<WheelDefinition> wheelDefinitions;
    std::vector<Envelope2D> envelopes2D;
    std::vector<Envelope3D> envelopes3D;

    bool operator==(const AgvGeometry&) const = default;
};

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

struct LoadSpecification
{
    std::vector<std::string> loadPositions; ///< Empty: no load handling device.
    std::vector<LoadSet> loadSets;

    bool operator==(const LoadSpecification&) const = default;
};

struct VersionEntry
{
    std::string key;
    std::string value;

    bool operator==(const VersionEntry&) const = default;
};

struct NetworkConfig
{
    std::vector<std::string> dnsServers;
    std::vector<std::string> ntpServers;
    std::string localIpAddress;
    std::string netmask;
    std::string defaultGateway;

    bool operator==(const NetworkConfig&) const = default;
};

struct VehicleConfig
{
    std::vector<VersionEntry> versions;
    std::optional<NetworkConfig> network;

    bool operator==(const VehicleConfig&) const = default;
};

/// Topic factsheet (section 7), retained.
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
