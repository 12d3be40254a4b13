#include "vda-sim/VehicleFactsheet.hpp"

#include <string>
#include <utility>
#include <vector>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::AgvAction;
using VDA5050::AgvActionParameter;
using VDA5050::EActionScope;
using VDA5050::EBlockingType;
using VDA5050::EValueDataType;

AgvAction MakeAction(
    std::string_view type,
    std::vector<EActionScope> scopes,
    std::vector<std::string> textParameters = {})
{
    AgvAction action;
    action.actionType = std::string(type);
    action.actionScopes = std::move(scopes);
    for (std::string& key : textParameters)
    {
        action.actionParameters.push_back(AgvActionParameter{std::move(key), EValueDataType::String, {}, true});
    }
    action.blockingTypes = {EBlockingType::None, EBlockingType::Soft, EBlockingType::Hard};
    return action;
}

AgvAction MakeInitPosition()
{
    AgvAction action = MakeAction(ACTION_INIT_POSITION, {EActionScope::Instant}, {"mapId", "lastNodeId"});
    for (const std::string_view key : {"x", "y", "theta"})
    {
        action.actionParameters.push_back(AgvActionParameter{std::string(key), EValueDataType::Float, {}, false});
    }
    return action;
}

std::vector<AgvAction> MakeActions()
{
    const std::vector<EActionScope> onNode{EActionScope::Node};
    const std::vector<EActionScope> instant{EActionScope::Instant};
    const std::vector<EActionScope> both{EActionScope::Instant, EActionScope::Node};
    const std::vector<std::string> handling{"lhd", "stationType", "stationName", "loadType", "loadId"};
    return {
        MakeAction(ACTION_PICK, onNode, handling),
        MakeAction(ACTION_DROP, onNode, handling),
        MakeAction(ACTION_FINE_POSITIONING, onNode, {"stationType", "stationName"}),
        MakeAction(ACTION_DETECT_OBJECT, onNode, {"objectType"}),
        MakeAction(ACTION_WAIT_FOR_TRIGGER, onNode, {"triggerType"}),
        MakeAction(ACTION_LOG_REPORT, instant, {"reason"}),
        MakeInitPosition(),
        MakeAction(ACTION_START_CHARGING, both),
        MakeAction(ACTION_STOP_CHARGING, both),
        MakeAction(VDA5050::ActionTypes::CANCEL_ORDER, instant),
        MakeAction(VDA5050::ActionTypes::START_PAUSE, instant),
        MakeAction(VDA5050::ActionTypes::STOP_PAUSE, instant),
        MakeAction(VDA5050::ActionTypes::STATE_REQUEST, instant),
        MakeAction(VDA5050::ActionTypes::FACTSHEET_REQUEST, instant)};
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
