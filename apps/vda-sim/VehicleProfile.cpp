#include "vda-sim/VehicleProfile.hpp"

#include <acs/vda5050/PredefinedActions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

namespace ACS::VdaSim
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::AgvAction;
using VDA5050::EActionScope;
using VDA5050::EParameterSupport;
using VDA5050::FactsheetMessage;
using VDA5050::OptionalParameter;
namespace ActionTypes = VDA5050::ActionTypes;

constexpr std::size_t PROFILE_COUNT = 9;
constexpr std::string_view NODE_POSITION = "order.nodes.nodePosition";
/// Longer than MasterOptions::resendInterval: a master sends the order again before it sees the acceptance.
constexpr std::chrono::milliseconds ACCEPTANCE_TIME = 3s;

bool IsOneOf(std::string_view text, std::initializer_list<std::string_view> words)
{
    return std::ranges::find(words, text) != words.end();
}

std::vector<OptionalParameter> MakeParameters(std::initializer_list<std::string_view> names)
{
    std::vector<OptionalParameter> parameters;
    for (const std::string_view name : names)
    {
        parameters.push_back({std::string(name), EParameterSupport::Supported, {}});
    }
    return parameters;
}

bool HasScope(const AgvAction& action, EActionScope scope)
{
    return std::ranges::find(action.actionScopes, scope) != action.actionScopes.end();
}

void LimitLengths(FactsheetMessage& factsheet)
{
    VDA5050::MaximumStringLengths& strings = factsheet.protocolLimits.maxStringLengths;
    strings.message = 4096;
    strings.identifier = 36; // a UUID
    VDA5050::MaximumArrayLengths& arrays = factsheet.protocolLimits.maxArrayLengths;
    arrays.orderNodes = 3;
    arrays.orderEdges = 2;
    arrays.nodeActions = 1;
    arrays.edgeActions = 1;
    arrays.actionParameters = 6;
    arrays.instantActions = 1;
    arrays.trajectoryControlPoints = 4;
    arrays.trajectoryKnotVector = 8;
}

/// What a vehicle needs that only carries loads from node to node. Actions with a make's own names stay.
void KeepTransport(FactsheetMessage& factsheet)
{
    factsheet.protocolFeatures.optionalParameters = MakeParameters(
        {NODE_POSITION, "order.edges.maxSpeed", "order.edges.orientation", "order.edges.rotationAllowed"});
    std::vector<AgvAction>& actions = factsheet.protocolFeatures.agvActions;
    std::erase_if(actions, [](const AgvAction& action) {
        return VDA5050::FindPredefinedActionOrNull(action.actionType) != nullptr
            && !IsOneOf(
                   action.actionType,
                   {ActionTypes::PICK,
                    ActionTypes::DROP,
                    ActionTypes::CANCEL_ORDER,
                    ActionTypes::START_PAUSE,
                    ActionTypes::STOP_PAUSE});
    });
    for (AgvAction& action : actions)
    {
        std::erase_if(action.actionParameters, [](const VDA5050::AgvActionParameter& parameter) {
            return IsOneOf(parameter.key, {"height", "depth", "side"});
        });
    }
}

/// The factsheet of a vehicle without a profile lists optional members.
void RequirePositions(FactsheetMessage& factsheet)
{
    for (OptionalParameter& parameter : *factsheet.protocolFeatures.optionalParameters)
    {
        if (parameter.parameter == NODE_POSITION)
        {
            parameter.support = EParameterSupport::Required;
        }
    }
    for (AgvAction& action : factsheet.protocolFeatures.agvActions)
    {
        std::erase(action.actionScopes, EActionScope::Edge);
    }
}

void BlockHard(FactsheetMessage& factsheet)
{
    for (AgvAction& action : factsheet.protocolFeatures.agvActions)
    {
        if (HasScope(action, EActionScope::Node))
        {
            action.blockingTypes = {VDA5050::EBlockingType::Hard};
        }
    }
}

void FollowLine(FactsheetMessage& factsheet)
{
    factsheet.typeSpecification.localizationTypes = {"RFID"};
    factsheet.typeSpecification.navigationTypes = {"PHYSICAL_LINE_GUIDED"};
    factsheet.protocolFeatures.optionalParameters = MakeParameters(
        {"order.edges.maxSpeed",
         "order.edges.maxRotationSpeed",
         "order.edges.orientation",
         "order.edges.orientationType",
         "order.edges.rotationAllowed",
         "order.edges.length"});
    std::erase_if(factsheet.protocolFeatures.agvActions, [](const AgvAction& action) {
        return IsOneOf(
            action.actionType,
            {ActionTypes::INIT_POSITION, ActionTypes::DOWNLOAD_MAP, ActionTypes::ENABLE_MAP, ActionTypes::DELETE_MAP});
    });
}

std::array<VehicleProfile, PROFILE_COUNT> MakeProfiles()
{
    VehicleTraits rejectsHorizon;
    rejectsHorizon.bRejectsHorizon = true;
    VehicleTraits forgets;
    forgets.bForgetsInManual = true;
    VehicleTraits isSlow;
    isSlow.acceptanceTime = ACCEPTANCE_TIME;
    VehicleTraits inPlace;
    inPlace.bHandlesLoadsInPlaceOnly = true;
    VehicleTraits onLine;
    onLine.bReportsPosition = false;
    return {
        VehicleProfile{EVehicleProfile::Standard, "standard", "accepts what the standard allows", {}, nullptr},
        {EVehicleProfile::StrictLengths,
         "strict-lengths",
         "orders of at most 3 nodes, 1 action per node, ids of at most 36 bytes",
         {},
         LimitLengths},
        {EVehicleProfile::NoHorizon,
         "no-horizon",
         "rejects orders with a horizon; the factsheet does not state it",
         rejectsHorizon,
         nullptr},
        {EVehicleProfile::ManualClears,
         "manual-clears",
         "forgets the orderId, the actions and, between two nodes, the node in MANUAL",
         forgets,
         nullptr},
        {EVehicleProfile::SlowAccept, "slow-accept", "accepts or rejects an order only after 3 s", isSlow, nullptr},
        {EVehicleProfile::PartialFactsheet,
         "partial-factsheet",
         "lists few optional members, only pick and drop, and few of their parameters",
         {},
         KeepTransport},
        {EVehicleProfile::NodeActions,
         "node-actions",
         "requires nodePosition in every order, also in that of a job; no edge actions",
         inPlace,
         RequirePositions},
        {EVehicleProfile::Blocking,
         "blocking",
         "performs actions of orders only with blockingType HARD",
         {},
         BlockHard},
        {EVehicleProfile::LineGuided,
         "line-guided",
         "follows a physical line: reports no position, accepts neither nodePosition nor trajectory",
         onLine,
         FollowLine}};
}

} // namespace

std::span<const VehicleProfile> GetProfiles()
{
    static const std::array<VehicleProfile, PROFILE_COUNT> PROFILES = MakeProfiles();
    return PROFILES;
}

const VehicleProfile& GetProfile(EVehicleProfile profile)
{
    const auto found = std::ranges::find(GetProfiles(), profile, &VehicleProfile::profile);
    assert(found != GetProfiles().end());
    return *found;
}

Core::Result<EVehicleProfile> ParseProfile(std::string_view text)
{
    std::string names;
    for (const VehicleProfile& row : GetProfiles())
    {
        if (row.name == text)
        {
            return row.profile;
        }
        names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "profile", "one of " + names, Core::QuoteForError(text));
}

} // namespace ACS::VdaSim
