#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/Header.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Whether the vehicle uses the map (section 6.10.6). At most one version of a map is enabled.
enum class EMapStatus : std::uint8_t
{
    Enabled,
    Disabled,
};

/// A map that is stored on the vehicle (section 6.10.6).
struct MapState
{
    std::string mapID; ///< As in positions on this map.
    std::string mapVersion;
    EMapStatus mapStatus = EMapStatus::Disabled;
    std::string mapDescription;

    bool operator==(const MapState&) const = default;
};

/// The position of a node in a state (section 6.10.6). Members that exist only in the schema of 2.0.0 are written in 2.0 only.
struct NodeStatePosition
{
    double x = 0.0;
    double y = 0.0;
    std::optional<double> theta;
    std::string mapID;
    std::optional<double> allowedDeviationXY = std::nullopt;    ///< Written in 2.0 only.
    std::optional<double> allowedDeviationTheta = std::nullopt; ///< Written in 2.0 only.
    std::string mapDescription = {};                            ///< Written in 2.0 only.

    bool operator==(const NodeStatePosition&) const = default;
};

/// A node of the order that is not reached yet (section 6.10.6).
struct NodeState
{
    std::string nodeID;
    std::uint32_t sequenceID = 0;
    std::string nodeDescription;
    bool bReleased = false;
    std::optional<NodeStatePosition> nodePosition;

    bool operator==(const NodeState&) const = default;
};

/// An edge of the order that is not traversed yet (section 6.10.6).
struct EdgeState
{
    std::string edgeID;
    std::uint32_t sequenceID = 0;
    std::string edgeDescription;
    bool bReleased = false;
    std::optional<Trajectory> trajectory;

    bool operator==(const EdgeState&) const = default;
};

/// The pose of a vehicle on its map (section 6.10.6), in metres and radians.
struct AgvPosition
{
    bool bPositionInitialized = false;
    std::optional<double> localizationScore; ///< [0, 1]
    std::optional<double> deviationRange;    ///< m
    double x = 0.0;
    double y = 0.0;
    double theta = 0.0; ///< [-pi, pi]
    std::string mapID;
    std::string mapDescription;

    bool operator==(const AgvPosition&) const = default;
};

/// The velocity of a vehicle in its own frame (section 6.10.6).
struct Velocity
{
    std::optional<double> vx;    ///< m/s
    std::optional<double> vy;    ///< m/s
    std::optional<double> omega; ///< rad/s

    bool operator==(const Velocity&) const = default;
};

/// The reference point of a load's bounding box in the frame of the vehicle (section 6.10.6), in metres and radians.
struct BoundingBoxReference
{
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    std::optional<double> theta;

    bool operator==(const BoundingBoxReference&) const = default;
};

/// The size of a load's bounding box (section 6.10.6), in metres.
struct LoadDimensions
{
    double length = 0.0;
    double width = 0.0;
    std::optional<double> height;

    bool operator==(const LoadDimensions&) const = default;
};

/// A load on the vehicle (section 6.10.6).
struct Load
{
    std::optional<std::string> loadID; ///< "": can be identified, but is not yet.
    std::string loadType;
    std::string loadPosition;
    std::optional<BoundingBoxReference> boundingBoxReference;
    std::optional<LoadDimensions> loadDimensions;
    std::optional<double> weight; ///< kg

    bool operator==(const Load&) const = default;
};

/// Section 6.11: Finished and Failed are final. ActionMachine has the transitions.
enum class EActionStatus : std::uint8_t
{
    Waiting,
    Initializing,
    Running,
    Paused,
    Finished,
    Failed,
};

/// The state of an order action or an instant action (section 6.10.6).
struct ActionState
{
    std::string actionID;
    std::string actionType;
    std::string actionDescription;
    EActionStatus actionStatus = EActionStatus::Waiting;
    std::string resultDescription;

    bool operator==(const ActionState&) const = default;
};

/// The battery of a vehicle (section 6.10.6).
struct BatteryState
{
    double batteryCharge = 0.0;           ///< %
    std::optional<double> batteryVoltage; ///< V
    std::optional<double> batteryHealth;  ///< %; written as an integer in 2.0.
    bool bCharging = false;               ///< The vehicle is charging.
    std::optional<double> reach;          ///< m

    bool operator==(const BatteryState&) const = default;
};

/// Who controls the vehicle (section 6.10.6).
enum class EOperatingMode : std::uint8_t
{
    Automatic,
    SemiAutomatic,
    Manual,
    Service,
    TeachIn,
};

/// Whether orders and instant actions are accepted in this mode (section 6.10.6).
[[nodiscard]] ACS_API bool IsLedByMaster(EOperatingMode mode);

/// Warning: the vehicle continues without help. Fatal: it needs help.
enum class EErrorLevel : std::uint8_t
{
    Warning,
    Fatal,
};

/// What an error or an information refers to (section 6.10.6): the name of a member, such as "orderId", and its value.
struct ErrorReference
{
    std::string referenceKey;
    std::string referenceValue;

    bool operator==(const ErrorReference&) const = default;
    std::strong_ordering operator<=>(const ErrorReference&) const = default; // NOLINT(modernize-use-nullptr)
};

/// An active error of a vehicle (section 6.10.6).
struct VehicleError
{
    std::string errorType; ///< One of ErrorTypes, or specific to the vehicle.
    std::vector<ErrorReference> errorReferences;
    std::string errorDescription;
    std::string errorHint; ///< Written from 2.1 on.
    EErrorLevel errorLevel = EErrorLevel::Warning;

    bool operator==(const VehicleError&) const = default;
    std::strong_ordering operator<=>(const VehicleError&) const = default; // NOLINT(modernize-use-nullptr)
};

/// The error types of 2.x; instantActionError, actionError and outsideOfCorridor are specific to this library.
namespace ErrorTypes
{
inline constexpr std::string_view VALIDATION_ERROR = "validationError";
inline constexpr std::string_view ORDER_ERROR = "orderError";
inline constexpr std::string_view ORDER_UPDATE_ERROR = "orderUpdateError";
inline constexpr std::string_view NO_ROUTE_ERROR = "noRouteError";
inline constexpr std::string_view NO_ORDER_TO_CANCEL = "noOrderToCancel";
inline constexpr std::string_view INSTANT_ACTION_ERROR = "instantActionError";
inline constexpr std::string_view ACTION_ERROR = "actionError"; ///< An action failed after its start.
inline constexpr std::string_view OUTSIDE_OF_CORRIDOR = "outsideOfCorridor";
inline constexpr std::string_view UNLISTED_PARAMETER = "unlistedParameter"; ///< Accepted, without effect.
} // namespace ErrorTypes

/// The value of the reference with this key; null if there is none.
[[nodiscard]] ACS_API const std::string* FindReferenceOrNull(const VehicleError& error, std::string_view key);

/// What an information is for: display or debugging (section 6.10.6).
enum class EInformationLevel : std::uint8_t
{
    Info,
    Debug,
};

/// For the operator only; must not be evaluated by programs (section 6.10.6).
struct Information
{
    std::string infoType;
    std::vector<ErrorReference> infoReferences;
    std::string infoDescription;
    EInformationLevel infoLevel = EInformationLevel::Info;

    bool operator==(const Information&) const = default;
};

/// How an active emergency stop is acknowledged (section 6.10.6): by itself, at the vehicle, or remotely. None: no emergency stop
/// is active.
enum class EEmergencyStop : std::uint8_t
{
    AutoAcknowledge,
    Manual,
    Remote,
    None,
};

/// The state of the vehicle's safety functions (section 6.10.6).
struct SafetyState
{
    EEmergencyStop emergencyStop = EEmergencyStop::None;
    bool bFieldViolation = false; ///< A protective field is violated.

    bool operator==(const SafetyState&) const = default;
};

/// Topic state (section 6.10).
struct StateMessage
{
    Header header;
    std::optional<std::vector<MapState>> maps; ///< Written from 2.1 on; empty: no map on the vehicle.
    std::string orderID;                       ///< The current or last order; empty before the first one.
    std::uint32_t orderUpdateID = 0;
    std::string zoneSetID;
    std::string lastNodeID;
    std::uint32_t lastNodeSequenceID = 0;
    std::vector<NodeState> nodeStates; ///< Remaining nodes, including the horizon.
    std::vector<EdgeState> edgeStates;
    std::optional<AgvPosition> agvPosition;
    std::optional<Velocity> velocity;
    std::optional<std::vector<Load>> loads; ///< Absent: unknown to the vehicle.
    bool bDriving = false;
    std::optional<bool> bPaused;
    std::optional<bool> bNewBaseRequest;
    std::optional<double> distanceSinceLastNode; ///< m
    std::vector<ActionState> actionStates;       ///< Order and instant actions.
    BatteryState batteryState;
    EOperatingMode operatingMode = EOperatingMode::Automatic;
    std::vector<VehicleError> errors;
    std::vector<Information> information;
    SafetyState safetyState;

    bool operator==(const StateMessage&) const = default;
};

} // namespace ACS::VDA5050
