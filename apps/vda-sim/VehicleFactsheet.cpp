#include "vda-sim/VehicleFactsheet.hpp"

#include <acs/vda5050/PredefinedActions.hpp>

#include <string>
#include <utility>
#include <vector>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::AgvAction;
using VDA5050::AgvActionParameter;
using VDA5050::EBlockingType;

/// Whether a vehicle could not do without it; loads and stations may stay unnamed, logs and triggers too.
bool IsNeeded(const AgvAction& action, const AgvActionParameter& parameter)
{
    const bool bOfMap = action.actionType == VDA5050::ActionTypes::ENABLE_MAP
        || action.actionType == VDA5050::ActionTypes::DOWNLOAD_MAP
        || action.actionType == VDA5050::ActionTypes::DELETE_MAP;
    const bool bOfPose = action.actionType == ACTION_INIT_POSITION && parameter.key != "lastNodeId";
    return !parameter.bOptional.value_or(false) && (bOfMap || bOfPose);
}

/// All that the standard names, as it names them.
std::vector<AgvAction> MakeActions()
{
    std::vector<AgvAction> actions = VDA5050::GetPredefinedActions();
    for (AgvAction& action : actions)
    {
        for (AgvActionParameter& parameter : action.actionParameters)
        {
            parameter.bOptional = !IsNeeded(action, parameter);
        }
        action.blockingTypes = {EBlockingType::None, EBlockingType::Soft, EBlockingType::Hard};
    }
    return actions;
}

std::vector<VDA5050::OptionalParameter> MakeOptionalParameters()
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
          "order.edges.trajectory",
          "order.edges.corridor"})
    {
        parameters.push_back({std::string(name), VDA5050::EParameterSupport::Supported, {}});
    }
    return parameters;
}

} // namespace

VDA5050::FactsheetMessage MakeFactsheet(EVehicleType type, const MotionLimits& limits)
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
    factsheet.physicalParameters.speedMax = limits.maxSpeed;
    // No angularSpeedMax: the text of 2.1 has it, and its schema does not.
    factsheet.physicalParameters.accelerationMax = limits.acceleration;
    factsheet.physicalParameters.decelerationMax = limits.deceleration;
    factsheet.physicalParameters.heightMin = 1.2;
    factsheet.physicalParameters.heightMax = 1.2;
    factsheet.physicalParameters.width = 0.8;
    factsheet.physicalParameters.length = 0.8;
    factsheet.protocolLimits.timing.visualizationInterval = 0.2;
    factsheet.protocolFeatures.agvActions = MakeActions();
    factsheet.protocolFeatures.optionalParameters = MakeOptionalParameters();
    return factsheet;
}

} // namespace ACS::VdaSim
