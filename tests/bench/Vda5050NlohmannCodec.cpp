#include "Vda5050NlohmannCodec.hpp"

#include <acs/core/Timestamp.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

namespace ACS::Bench
{

namespace
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)
using Json = nlohmann::ordered_json;

constexpr std::array BLOCKING_TYPES{"NONE", "SOFT", "HARD"};
constexpr std::array ORIENTATION_TYPES{"GLOBAL", "TANGENTIAL"};
constexpr std::array ACTION_STATUSES{"WAITING", "INITIALIZING", "RUNNING", "PAUSED", "FINISHED", "FAILED"};
constexpr std::array OPERATING_MODES{"AUTOMATIC", "SEMIAUTOMATIC", "MANUAL", "SERVICE", "TEACHIN"};
constexpr std::array ERROR_LEVELS{"WARNING", "FATAL"};
constexpr std::array INFORMATION_LEVELS{"INFO", "DEBUG"};
constexpr std::array EMERGENCY_STOPS{"AUTOACK", "MANUAL", "REMOTE", "NONE"};

template <typename TEnum, std::size_t COUNT>
void ReadWord(const Json& value, const std::array<const char*, COUNT>& words, TEnum& out)
{
    const auto& text = value.get_ref<const std::string&>();
    const auto found = std::ranges::find(words, text);
    if (found == words.end())
    {
        throw std::runtime_error("unknown word " + text);
    }
    out = static_cast<TEnum>(found - words.begin());
}

template <typename TEnum, std::size_t COUNT>
std::string_view GetWord(TEnum value, const std::array<const char*, COUNT>& words)
{
    return words.at(static_cast<std::size_t>(value));
}

template <typename T>
void ReadOptional(const Json& object, const char* name, T& out)
{
    const auto found = object.find(name);
    if (found != object.end())
    {
        out = found->get<T>();
    }
}

template <typename T>
void ReadOptional(const Json& object, const char* name, std::optional<T>& out)
{
    const auto found = object.find(name);
    if (found != object.end())
    {
        out = found->get<T>();
    }
}

template <typename T>
void ReadArray(const Json& array, std::vector<T>& out, void (*read)(const Json&, T&))
{
    out.reserve(array.size());
    for (const Json& element : array)
    {
        read(element, out.emplace_back());
    }
}

template <typename T>
void ReadOptionalObject(const Json& object, const char* name, std::optional<T>& out, void (*read)(const Json&, T&))
{
    const auto found = object.find(name);
    if (found != object.end())
    {
        read(*found, out.emplace());
    }
}

template <typename T>
void WriteOptional(Json& object, const char* name, const std::optional<T>& valueOrNull)
{
    if (valueOrNull.has_value())
    {
        object[name] = *valueOrNull;
    }
}

void WriteOptional(Json& object, const char* name, const std::string& value)
{
    if (!value.empty())
    {
        object[name] = value;
    }
}

template <typename T>
Json WriteArray(const std::vector<T>& values, Json (*write)(const T&))
{
    Json array = Json::array();
    for (const T& value : values)
    {
        array.push_back(write(value));
    }
    return array;
}

template <typename T>
void WriteOptionalObject(Json& object, const char* name, const std::optional<T>& valueOrNull, Json (*write)(const T&))
{
    if (valueOrNull.has_value())
    {
        object[name] = write(*valueOrNull);
    }
}

void ReadHeader(const Json& object, Header& header)
{
    object.at("headerId").get_to(header.headerID);
    header.timestamp = Core::ParseTimestamp(object.at("timestamp").get_ref<const std::string&>()).value().time;
    object.at("version").get_to(header.version);
    object.at("manufacturer").get_to(header.manufacturer);
    object.at("serialNumber").get_to(header.serialNumber);
}

Json WriteHeader(const Header& header)
{
    return Json{
        {"headerId", header.headerID},
        {"timestamp", Core::FormatUTC(header.timestamp)},
        {"version", header.version},
        {"manufacturer", header.manufacturer},
        {"serialNumber", header.serialNumber}};
}

void ReadParameter(const Json& object, ActionParameter& parameter)
{
    object.at("key").get_to(parameter.key);
    parameter.value = Core::JsonText::FromTrusted(object.at("value").dump());
}

Json WriteParameter(const ActionParameter& parameter)
{
    return Json{{"key", parameter.key}, {"value", Json::parse(parameter.value.GetText())}};
}

void ReadAction(const Json& object, Action& action)
{
    object.at("actionType").get_to(action.actionType);
    object.at("actionId").get_to(action.actionID);
    ReadOptional(object, "actionDescription", action.actionDescription);
    ReadWord(object.at("blockingType"), BLOCKING_TYPES, action.blockingType);
    if (object.contains("actionParameters"))
    {
        ReadArray(object.at("actionParameters"), action.actionParameters, &ReadParameter);
    }
}

Json WriteAction(const Action& action)
{
    Json object{{"actionType", action.actionType}, {"actionId", action.actionID}};
    WriteOptional(object, "actionDescription", action.actionDescription);
    object["blockingType"] = GetWord(action.blockingType, BLOCKING_TYPES);
    if (!action.actionParameters.empty())
    {
        object["actionParameters"] = WriteArray(action.actionParameters, &WriteParameter);
    }
    return object;
}

void ReadControlPoint(const Json& object, ControlPoint& point)
{
    object.at("x").get_to(point.x);
    object.at("y").get_to(point.y);
    ReadOptional(object, "weight", point.weight);
}

Json WriteControlPoint(const ControlPoint& point)
{
    Json object{{"x", point.x}, {"y", point.y}};
    WriteOptional(object, "weight", point.weight);
    return object;
}

void ReadTrajectory(const Json& object, Trajectory& trajectory)
{
    ReadOptional(object, "degree", trajectory.degree);
    object.at("knotVector").get_to(trajectory.knotVector);
    ReadArray(object.at("controlPoints"), trajectory.controlPoints, &ReadControlPoint);
}

Json WriteTrajectory(const Trajectory& trajectory)
{
    return Json{
        {"degree", trajectory.degree},
        {"knotVector", trajectory.knotVector},
        {"controlPoints", WriteArray(trajectory.controlPoints, &WriteControlPoint)}};
}

void ReadNodePosition(const Json& object, NodePosition& position)
{
    object.at("x").get_to(position.x);
    object.at("y").get_to(position.y);
    ReadOptional(object, "theta", position.theta);
    ReadOptional(object, "allowedDeviationXY", position.allowedDeviationXY);
    ReadOptional(object, "allowedDeviationTheta", position.allowedDeviationTheta);
    object.at("mapId").get_to(position.mapID);
    ReadOptional(object, "mapDescription", position.mapDescription);
}

Json WriteNodePosition(const NodePosition& position)
{
    Json object{{"x", position.x}, {"y", position.y}};
    WriteOptional(object, "theta", position.theta);
    WriteOptional(object, "allowedDeviationXY", position.allowedDeviationXY);
    WriteOptional(object, "allowedDeviationTheta", position.allowedDeviationTheta);
    object["mapId"] = position.mapID;
    WriteOptional(object, "mapDescription", position.mapDescription);
    return object;
}

void ReadNode(const Json& object, OrderNode& node)
{
    object.at("nodeId").get_to(node.nodeID);
    object.at("sequenceId").get_to(node.sequenceID);
    ReadOptional(object, "nodeDescription", node.nodeDescription);
    object.at("released").get_to(node.bReleased);
    ReadOptionalObject(object, "nodePosition", node.nodePosition, &ReadNodePosition);
    ReadArray(object.at("actions"), node.actions, &ReadAction);
}

Json WriteNode(const OrderNode& node)
{
    Json object{{"nodeId", node.nodeID}, {"sequenceId", node.sequenceID}};
    WriteOptional(object, "nodeDescription", node.nodeDescription);
    object["released"] = node.bReleased;
    WriteOptionalObject(object, "nodePosition", node.nodePosition, &WriteNodePosition);
    object["actions"] = WriteArray(node.actions, &WriteAction);
    return object;
}

void ReadEdge(const Json& object, OrderEdge& edge)
{
    object.at("edgeId").get_to(edge.edgeID);
    object.at("sequenceId").get_to(edge.sequenceID);
    ReadOptional(object, "edgeDescription", edge.edgeDescription);
    object.at("released").get_to(edge.bReleased);
    object.at("startNodeId").get_to(edge.startNodeID);
    object.at("endNodeId").get_to(edge.endNodeID);
    ReadOptional(object, "maxSpeed", edge.maxSpeed);
    ReadOptional(object, "maxHeight", edge.maxHeight);
    ReadOptional(object, "minHeight", edge.minHeight);
    ReadOptional(object, "orientation", edge.orientation);
    if (object.contains("orientationType"))
    {
        ReadWord(object.at("orientationType"), ORIENTATION_TYPES, edge.orientationType.emplace());
    }
    ReadOptional(object, "direction", edge.direction);
    ReadOptional(object, "rotationAllowed", edge.bRotationAllowed);
    ReadOptional(object, "maxRotationSpeed", edge.maxRotationSpeed);
    ReadOptional(object, "length", edge.length);
    ReadOptionalObject(object, "trajectory", edge.trajectory, &ReadTrajectory);
    ReadArray(object.at("actions"), edge.actions, &ReadAction);
}

Json WriteEdge(const OrderEdge& edge)
{
    Json object{{"edgeId", edge.edgeID}, {"sequenceId", edge.sequenceID}};
    WriteOptional(object, "edgeDescription", edge.edgeDescription);
    object["released"] = edge.bReleased;
    object["startNodeId"] = edge.startNodeID;
    object["endNodeId"] = edge.endNodeID;
    WriteOptional(object, "maxSpeed", edge.maxSpeed);
    WriteOptional(object, "maxHeight", edge.maxHeight);
    WriteOptional(object, "minHeight", edge.minHeight);
    WriteOptional(object, "orientation", edge.orientation);
    if (edge.orientationType.has_value())
    {
        object["orientationType"] = GetWord(*edge.orientationType, ORIENTATION_TYPES);
    }
    WriteOptional(object, "direction", edge.direction);
    WriteOptional(object, "rotationAllowed", edge.bRotationAllowed);
    WriteOptional(object, "maxRotationSpeed", edge.maxRotationSpeed);
    WriteOptional(object, "length", edge.length);
    WriteOptionalObject(object, "trajectory", edge.trajectory, &WriteTrajectory);
    object["actions"] = WriteArray(edge.actions, &WriteAction);
    return object;
}

void ReadNodeStatePosition(const Json& object, NodeStatePosition& position)
{
    object.at("x").get_to(position.x);
    object.at("y").get_to(position.y);
    ReadOptional(object, "theta", position.theta);
    object.at("mapId").get_to(position.mapID);
}

Json WriteNodeStatePosition(const NodeStatePosition& position)
{
    Json object{{"x", position.x}, {"y", position.y}};
    WriteOptional(object, "theta", position.theta);
    object["mapId"] = position.mapID;
    return object;
}

void ReadNodeState(const Json& object, NodeState& node)
{
    object.at("nodeId").get_to(node.nodeID);
    object.at("sequenceId").get_to(node.sequenceID);
    ReadOptional(object, "nodeDescription", node.nodeDescription);
    object.at("released").get_to(node.bReleased);
    ReadOptionalObject(object, "nodePosition", node.nodePosition, &ReadNodeStatePosition);
}

Json WriteNodeState(const NodeState& node)
{
    Json object{{"nodeId", node.nodeID}, {"sequenceId", node.sequenceID}};
    WriteOptional(object, "nodeDescription", node.nodeDescription);
    object["released"] = node.bReleased;
    WriteOptionalObject(object, "nodePosition", node.nodePosition, &WriteNodeStatePosition);
    return object;
}

void ReadEdgeState(const Json& object, EdgeState& edge)
{
    object.at("edgeId").get_to(edge.edgeID);
    object.at("sequenceId").get_to(edge.sequenceID);
    ReadOptional(object, "edgeDescription", edge.edgeDescription);
    object.at("released").get_to(edge.bReleased);
    ReadOptionalObject(object, "trajectory", edge.trajectory, &ReadTrajectory);
}

Json WriteEdgeState(const EdgeState& edge)
{
    Json object{{"edgeId", edge.edgeID}, {"sequenceId", edge.sequenceID}};
    WriteOptional(object, "edgeDescription", edge.edgeDescription);
    object["released"] = edge.bReleased;
    WriteOptionalObject(object, "trajectory", edge.trajectory, &WriteTrajectory);
    return object;
}

void ReadPosition(const Json& object, AgvPosition& position)
{
    object.at("x").get_to(position.x);
    object.at("y").get_to(position.y);
    object.at("theta").get_to(position.theta);
    object.at("mapId").get_to(position.mapID);
    ReadOptional(object, "mapDescription", position.mapDescription);
    object.at("positionInitialized").get_to(position.bPositionInitialized);
    ReadOptional(object, "localizationScore", position.localizationScore);
    ReadOptional(object, "deviationRange", position.deviationRange);
}

Json WritePosition(const AgvPosition& position)
{
    Json object{{"x", position.x}, {"y", position.y}, {"theta", position.theta}, {"mapId", position.mapID}};
    WriteOptional(object, "mapDescription", position.mapDescription);
    object["positionInitialized"] = position.bPositionInitialized;
    WriteOptional(object, "localizationScore", position.localizationScore);
    WriteOptional(object, "deviationRange", position.deviationRange);
    return object;
}

void ReadVelocity(const Json& object, Velocity& velocity)
{
    ReadOptional(object, "vx", velocity.vx);
    ReadOptional(object, "vy", velocity.vy);
    ReadOptional(object, "omega", velocity.omega);
}

Json WriteVelocity(const Velocity& velocity)
{
    Json object = Json::object();
    WriteOptional(object, "vx", velocity.vx);
    WriteOptional(object, "vy", velocity.vy);
    WriteOptional(object, "omega", velocity.omega);
    return object;
}

void ReadBox(const Json& object, BoundingBoxReference& box)
{
    object.at("x").get_to(box.x);
    object.at("y").get_to(box.y);
    object.at("z").get_to(box.z);
    ReadOptional(object, "theta", box.theta);
}

Json WriteBox(const BoundingBoxReference& box)
{
    Json object{{"x", box.x}, {"y", box.y}, {"z", box.z}};
    WriteOptional(object, "theta", box.theta);
    return object;
}

void ReadDimensions(const Json& object, LoadDimensions& dimensions)
{
    object.at("length").get_to(dimensions.length);
    object.at("width").get_to(dimensions.width);
    ReadOptional(object, "height", dimensions.height);
}

Json WriteDimensions(const LoadDimensions& dimensions)
{
    Json object{{"length", dimensions.length}, {"width", dimensions.width}};
    WriteOptional(object, "height", dimensions.height);
    return object;
}

void ReadLoad(const Json& object, Load& load)
{
    ReadOptional(object, "loadId", load.loadID);
    ReadOptional(object, "loadType", load.loadType);
    ReadOptional(object, "loadPosition", load.loadPosition);
    ReadOptionalObject(object, "boundingBoxReference", load.boundingBoxReference, &ReadBox);
    ReadOptionalObject(object, "loadDimensions", load.loadDimensions, &ReadDimensions);
    ReadOptional(object, "weight", load.weight);
}

Json WriteLoad(const Load& load)
{
    Json object = Json::object();
    WriteOptional(object, "loadId", load.loadID);
    WriteOptional(object, "loadType", load.loadType);
    WriteOptional(object, "loadPosition", load.loadPosition);
    WriteOptionalObject(object, "boundingBoxReference", load.boundingBoxReference, &WriteBox);
    WriteOptionalObject(object, "loadDimensions", load.loadDimensions, &WriteDimensions);
    WriteOptional(object, "weight", load.weight);
    return object;
}

void ReadActionState(const Json& object, ActionState& action)
{
    object.at("actionId").get_to(action.actionID);
    ReadOptional(object, "actionType", action.actionType);
    ReadOptional(object, "actionDescription", action.actionDescription);
    ReadWord(object.at("actionStatus"), ACTION_STATUSES, action.actionStatus);
    ReadOptional(object, "resultDescription", action.resultDescription);
}

Json WriteActionState(const ActionState& action)
{
    Json object{{"actionId", action.actionID}};
    WriteOptional(object, "actionType", action.actionType);
    WriteOptional(object, "actionDescription", action.actionDescription);
    object["actionStatus"] = GetWord(action.actionStatus, ACTION_STATUSES);
    WriteOptional(object, "resultDescription", action.resultDescription);
    return object;
}

void ReadReference(const Json& object, ErrorReference& reference)
{
    object.at("referenceKey").get_to(reference.referenceKey);
    object.at("referenceValue").get_to(reference.referenceValue);
}

Json WriteReference(const ErrorReference& reference)
{
    return Json{{"referenceKey", reference.referenceKey}, {"referenceValue", reference.referenceValue}};
}

void ReadError(const Json& object, VehicleError& error)
{
    object.at("errorType").get_to(error.errorType);
    if (object.contains("errorReferences"))
    {
        ReadArray(object.at("errorReferences"), error.errorReferences, &ReadReference);
    }
    ReadOptional(object, "errorDescription", error.errorDescription);
    ReadWord(object.at("errorLevel"), ERROR_LEVELS, error.errorLevel);
}

Json WriteError(const VehicleError& error)
{
    Json object{{"errorType", error.errorType}};
    if (!error.errorReferences.empty())
    {
        object["errorReferences"] = WriteArray(error.errorReferences, &WriteReference);
    }
    WriteOptional(object, "errorDescription", error.errorDescription);
    object["errorLevel"] = GetWord(error.errorLevel, ERROR_LEVELS);
    return object;
}

void ReadInformation(const Json& object, Information& information)
{
    object.at("infoType").get_to(information.infoType);
    if (object.contains("infoReferences"))
    {
        ReadArray(object.at("infoReferences"), information.infoReferences, &ReadReference);
    }
    ReadOptional(object, "infoDescription", information.infoDescription);
    ReadWord(object.at("infoLevel"), INFORMATION_LEVELS, information.infoLevel);
}

Json WriteInformation(const Information& information)
{
    Json object{{"infoType", information.infoType}};
    if (!information.infoReferences.empty())
    {
        object["infoReferences"] = WriteArray(information.infoReferences, &WriteReference);
    }
    WriteOptional(object, "infoDescription", information.infoDescription);
    object["infoLevel"] = GetWord(information.infoLevel, INFORMATION_LEVELS);
    return object;
}

void ReadBattery(const Json& object, BatteryState& battery)
{
    object.at("batteryCharge").get_to(battery.batteryCharge);
    ReadOptional(object, "batteryVoltage", battery.batteryVoltage);
    ReadOptional(object, "batteryHealth", battery.batteryHealth);
    object.at("charging").get_to(battery.bCharging);
    ReadOptional(object, "reach", battery.reach);
}

Json WriteBattery(const BatteryState& battery)
{
    Json object{{"batteryCharge", battery.batteryCharge}};
    WriteOptional(object, "batteryVoltage", battery.batteryVoltage);
    WriteOptional(object, "batteryHealth", battery.batteryHealth);
    object["charging"] = battery.bCharging;
    WriteOptional(object, "reach", battery.reach);
    return object;
}

} // namespace

template <>
OrderMessage Vda5050NlohmannCodec::Decode(std::string_view text)
{
    const Json root = Json::parse(text);
    OrderMessage order;
    ReadHeader(root, order.header);
    root.at("orderId").get_to(order.orderID);
    root.at("orderUpdateId").get_to(order.orderUpdateID);
    ReadOptional(root, "zoneSetId", order.zoneSetID);
    ReadArray(root.at("nodes"), order.nodes, &ReadNode);
    ReadArray(root.at("edges"), order.edges, &ReadEdge);
    return order;
}

std::string Vda5050NlohmannCodec::Encode(const OrderMessage& order)
{
    Json root = WriteHeader(order.header);
    root["orderId"] = order.orderID;
    root["orderUpdateId"] = order.orderUpdateID;
    WriteOptional(root, "zoneSetId", order.zoneSetID);
    root["nodes"] = WriteArray(order.nodes, &WriteNode);
    root["edges"] = WriteArray(order.edges, &WriteEdge);
    return root.dump();
}

template <>
StateMessage Vda5050NlohmannCodec::Decode(std::string_view text)
{
    const Json root = Json::parse(text);
    StateMessage state;
    ReadHeader(root, state.header);
    root.at("orderId").get_to(state.orderID);
    root.at("orderUpdateId").get_to(state.orderUpdateID);
    ReadOptional(root, "zoneSetId", state.zoneSetID);
    root.at("lastNodeId").get_to(state.lastNodeID);
    root.at("lastNodeSequenceId").get_to(state.lastNodeSequenceID);
    ReadArray(root.at("nodeStates"), state.nodeStates, &ReadNodeState);
    ReadArray(root.at("edgeStates"), state.edgeStates, &ReadEdgeState);
    ReadOptionalObject(root, "agvPosition", state.agvPosition, &ReadPosition);
    ReadOptionalObject(root, "velocity", state.velocity, &ReadVelocity);
    if (root.contains("loads"))
    {
        ReadArray(root.at("loads"), state.loads.emplace(), &ReadLoad);
    }
    root.at("driving").get_to(state.bDriving);
    ReadOptional(root, "paused", state.bPaused);
    ReadOptional(root, "newBaseRequest", state.bNewBaseRequest);
    ReadOptional(root, "distanceSinceLastNode", state.distanceSinceLastNode);
    ReadArray(root.at("actionStates"), state.actionStates, &ReadActionState);
    ReadBattery(root.at("batteryState"), state.batteryState);
    ReadWord(root.at("operatingMode"), OPERATING_MODES, state.operatingMode);
    ReadArray(root.at("errors"), state.errors, &ReadError);
    if (root.contains("information"))
    {
        ReadArray(root.at("information"), state.information, &ReadInformation);
    }
    ReadWord(root.at("safetyState").at("eStop"), EMERGENCY_STOPS, state.safetyState.emergencyStop);
    root.at("safetyState").at("fieldViolation").get_to(state.safetyState.bFieldViolation);
    return state;
}

std::string Vda5050NlohmannCodec::Encode(const StateMessage& state)
{
    Json root = WriteHeader(state.header);
    root["orderId"] = state.orderID;
    root["orderUpdateId"] = state.orderUpdateID;
    WriteOptional(root, "zoneSetId", state.zoneSetID);
    root["lastNodeId"] = state.lastNodeID;
    root["lastNodeSequenceId"] = state.lastNodeSequenceID;
    root["nodeStates"] = WriteArray(state.nodeStates, &WriteNodeState);
    root["edgeStates"] = WriteArray(state.edgeStates, &WriteEdgeState);
    WriteOptionalObject(root, "agvPosition", state.agvPosition, &WritePosition);
    WriteOptionalObject(root, "velocity", state.velocity, &WriteVelocity);
    if (state.loads.has_value())
    {
        root["loads"] = WriteArray(*state.loads, &WriteLoad);
    }
    root["driving"] = state.bDriving;
    WriteOptional(root, "paused", state.bPaused);
    WriteOptional(root, "newBaseRequest", state.bNewBaseRequest);
    WriteOptional(root, "distanceSinceLastNode", state.distanceSinceLastNode);
    root["actionStates"] = WriteArray(state.actionStates, &WriteActionState);
    root["batteryState"] = WriteBattery(state.batteryState);
    root["operatingMode"] = GetWord(state.operatingMode, OPERATING_MODES);
    root["errors"] = WriteArray(state.errors, &WriteError);
    if (!state.information.empty())
    {
        root["information"] = WriteArray(state.information, &WriteInformation);
    }
    root["safetyState"] = Json{
        {"eStop", GetWord(state.safetyState.emergencyStop, EMERGENCY_STOPS)},
        {"fieldViolation", state.safetyState.bFieldViolation}};
    return root.dump();
}

} // namespace ACS::Bench
