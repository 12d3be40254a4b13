#include "OrderCapability.hpp"
#include <acs/vda5050/FactsheetCheck.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace ACS::VDA5050
{

namespace
{

/// Members that every order has, or every nodePosition.
constexpr std::array<std::string_view, 21> MANDATORY{
    "order.orderId",
    "order.orderUpdateId",
    "order.nodes",
    "order.nodes.nodeId",
    "order.nodes.sequenceId",
    "order.nodes.released",
    "order.nodes.actions",
    "order.nodes.nodePosition.x",
    "order.nodes.nodePosition.y",
    "order.nodes.nodePosition.mapId",
    "order.edges",
    "order.edges.edgeId",
    "order.edges.sequenceId",
    "order.edges.released",
    "order.edges.startNodeId",
    "order.edges.endNodeId",
    "order.edges.actions",
    "order.headerId",
    "order.timestamp",
    "order.version",
    "order.manufacturer"};

bool IsKnown(std::string_view path)
{
    const std::vector<OptionalParameter> optional = ListOptionalParameters();
    return std::ranges::count(MANDATORY, path) > 0
        || std::ranges::count(optional, path, &OptionalParameter::parameter) > 0;
}

} // namespace

std::vector<std::string> FindContradictions(const FactsheetMessage& factsheet)
{
    std::vector<std::string> found;
    const std::vector<AgvAction>& actions = factsheet.protocolFeatures.agvActions;
    for (auto action = actions.begin(); action != actions.end(); ++action)
    {
        if (std::find_if(
                actions.begin(),
                action,
                [&action](const AgvAction& other) { return other.actionType == action->actionType; })
            != action)
        {
            found.push_back("the action " + action->actionType + " is listed twice");
        }
    }
    const std::vector<OptionalParameter> none;
    const std::optional<std::vector<OptionalParameter>>& list = factsheet.protocolFeatures.optionalParameters;
    const std::vector<OptionalParameter>& members = list.has_value() ? *list : none;
    for (auto member = members.begin(); member != members.end(); ++member)
    {
        if (std::find_if(
                members.begin(),
                member,
                [&member](const OptionalParameter& other) { return other.parameter == member->parameter; })
            != member)
        {
            found.push_back("the member " + member->parameter + " is listed twice");
        }
        else if (
            member->support == EParameterSupport::Required && member->parameter.starts_with("order.")
            && !IsKnown(member->parameter))
        {
            found.push_back("the member " + member->parameter + " is required and unknown");
        }
    }
    return found;
}

} // namespace ACS::VDA5050
