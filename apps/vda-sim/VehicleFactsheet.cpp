#include "vda-sim/VehicleFactsheet.hpp"

#include "vda-sim/OrderLimits.hpp"
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <string>
#include <utility>
#include <vector>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::AgvAction;
using VDA5050::EBlockingType;

bool IsOfLoads(const AgvAction& action)
{
    return action.actionType == VDA5050::ActionTypes::PICK || action.actionType == VDA5050::ActionTypes::DROP;
}

bool IsOfMaps(const AgvAction& action)
{
    return action.actionType == VDA5050::ActionTypes::ENABLE_MAP
        || action.actionType == VDA5050::ActionTypes::DOWNLOAD_MAP
        || action.actionType == VDA5050::ActionTypes::DELETE_MAP;
}

/// The actions of this version; pick and drop in the vehicle's form, and only if it has load positions.
std::vector<AgvAction> MakeActions(VDA5050::EVda5050Version version, bool bHandlesLoads, const LoadHandling& handling)
{
    std::vector<AgvAction> actions = VDA5050::GetPredefinedActions();
    if (version == VDA5050::EVda5050Version::Version200)
    {
        std::erase_if(actions, IsOfMaps); // new in 2.1
    }
    if (!bHandlesLoads)
    {
        std::erase_if(actions, IsOfLoads);
    }
    for (AgvAction& action : actions)
    {
        if (IsOfLoads(action))
        {
            action = AdaptAction(std::move(action), handling);
        }
        action.blockingTypes = {EBlockingType::None, EBlockingType::Soft, EBlockingType::Hard};
    }
    return actions;
}

/// The limits that the session checks messages against and keeps itself.
VDA5050::ProtocolLimits MakeLimits(std::size_t loads)
{
    constexpr std::uint32_t MAX_NODES = 1000;
    constexpr std::uint32_t MAX_OF_ONE = 100; ///< Actions of a node, an edge or a message, parameters of an action.
    constexpr std::uint32_t MAX_ACTION_STATES = 2000;
    constexpr std::uint32_t MAX_ERRORS = 64;
    VDA5050::ProtocolLimits limits;
    limits.maxStringLengths.message = static_cast<std::uint32_t>(VDA5050::CodecLimits{}.payloadBytes);
    limits.maxStringLengths.identifier = MAX_ID_LENGTH;
    limits.maxStringLengths.loadID = MAX_ID_LENGTH;
    VDA5050::MaximumArrayLengths& arrays = limits.maxArrayLengths;
    arrays.orderNodes = MAX_NODES;
    arrays.orderEdges = MAX_NODES;
    arrays.nodeActions = MAX_OF_ONE;
    arrays.edgeActions = MAX_OF_ONE;
    arrays.actionParameters = MAX_OF_ONE;
    arrays.instantActions = MAX_OF_ONE;
    arrays.trajectoryKnotVector = MAX_CONTROL_POINTS + MAX_DEGREE + 1;
    arrays.trajectoryControlPoints = MAX_CONTROL_POINTS;
    arrays.stateNodeStates = MAX_NODES;
    arrays.stateEdgeStates = MAX_NODES;
    arrays.stateActionStates = MAX_ACTION_STATES;
    arrays.stateErrors = MAX_ERRORS;
    if (loads > 0) // 0 would mean no limit
    {
        arrays.stateLoads = static_cast<std::uint32_t>(loads);
    }
    return limits;
}

std::vector<VDA5050::OptionalParameter> MakeOptionalParameters(VDA5050::EVda5050Version version)
{
    std::vector<VDA5050::OptionalParameter> parameters;
    for (const std::string_view name :
         {"order.nodes.nodePosition",
          "order.nodes.nodePosition.theta",
          "order.nodes.nodePosition.allowedDeviationXY",
          "order.nodes.nodePosition.allowedDeviationTheta",
          "order.edges.maxSpeed",
          "order.edges.maxRotationSpeed",
          "order.edges.orientation",
          "order.edges.orientationType",
          "order.edges.rotationAllowed",
          "order.edges.length",
          "order.edges.trajectory"})
    {
        parameters.push_back({std::string(name), VDA5050::EParameterSupport::Supported, {}});
    }
    if (version != VDA5050::EVda5050Version::Version200)
    {
        parameters.push_back({"order.edges.corridor", VDA5050::EParameterSupport::Supported, {}}); // new in 2.1
    }
    return parameters;
}

} // namespace

VDA5050::FactsheetMessage MakeFactsheet(
    EVehicleType type,
    const MotionLimits& limits,
    VDA5050::EVda5050Version version,
    const LoadHandling& handling)
{
    const bool bCarriesCassettes = type == EVehicleType::Logistics;
    VDA5050::FactsheetMessage factsheet;
    factsheet.typeSpecification.seriesName = bCarriesCassettes ? "vda-sim LR" : "vda-sim CR";
    factsheet.typeSpecification.seriesDescription = "virtual vehicle";
    factsheet.typeSpecification.agvKinematic = VDA5050::EAgvKinematic::Omni;
    factsheet.typeSpecification.agvClass = VDA5050::EAgvClass::Carrier;
    factsheet.typeSpecification.maxLoadMass = 50.0;
    factsheet.typeSpecification.localizationTypes = {"NATURAL"};
    factsheet.typeSpecification.navigationTypes = {"VIRTUAL_LINE_GUIDED"};
    factsheet.physicalParameters.speedMin = MIN_SPEED;
    factsheet.physicalParameters.speedMax = limits.maxSpeed;
    // No angularSpeedMax: the text of 2.1 has it, and its schema does not.
    factsheet.physicalParameters.accelerationMax = limits.acceleration;
    factsheet.physicalParameters.decelerationMax = limits.deceleration;
    factsheet.physicalParameters.heightMin = 1.2;
    factsheet.physicalParameters.heightMax = 1.2;
    factsheet.physicalParameters.width = 0.8;
    factsheet.physicalParameters.length = 0.8;
    const std::vector<LoadPosition> positions = GetLoadPositions(type, handling);
    factsheet.protocolLimits = MakeLimits(positions.size());
    factsheet.protocolLimits.timing.visualizationInterval = 0.2;
    for (const LoadPosition& position : positions)
    {
        factsheet.loadSpecification.loadPositions.push_back(position.name);
    }
    factsheet.protocolFeatures.agvActions = MakeActions(version, !positions.empty(), handling);
    factsheet.protocolFeatures.optionalParameters = MakeOptionalParameters(version);
    return factsheet;
}

} // namespace ACS::VdaSim
