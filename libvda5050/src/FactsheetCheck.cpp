#include "OrderCapability.hpp"
#include <acs/vda5050/FactsheetCheck.hpp>

#include <fmt/format.h>

#include <array>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <unordered_set>

namespace ACS::VDA5050
{

namespace
{

/// Members that every order has, or every nodePosition.
constexpr std::array<std::string_view, 22> MANDATORY{
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
    "order.manufacturer",
    "order.serialNumber"};

/// Seconds. The longest interval of states in the standard, unless a factsheet has another.
constexpr double STATE_INTERVAL = 30.0;

using TextSet = std::unordered_set<std::string_view>;

TextSet MakeKnownMembers(const std::vector<OptionalParameter>& optional)
{
    TextSet known(MANDATORY.begin(), MANDATORY.end());
    for (const OptionalParameter& member : optional)
    {
        known.insert(member.parameter);
    }
    return known;
}

void FindContradictoryActions(const std::vector<AgvAction>& actions, std::vector<std::string>& found)
{
    TextSet seen;
    for (const AgvAction& action : actions)
    {
        if (!seen.insert(action.actionType).second)
        {
            found.push_back("the action " + action.actionType + " is listed twice");
        }
    }
}

void FindContradictoryMembers(const std::vector<OptionalParameter>& members, std::vector<std::string>& found)
{
    const std::vector<OptionalParameter> optional = ListOptionalParameters();
    const TextSet known = MakeKnownMembers(optional);
    TextSet seen;
    for (const OptionalParameter& member : members)
    {
        if (!seen.insert(member.parameter).second)
        {
            found.push_back("the member " + member.parameter + " is listed twice");
        }
        else if (
            member.support == EParameterSupport::Required && member.parameter.starts_with("order.")
            && !known.contains(member.parameter))
        {
            found.push_back("the member " + member.parameter + " is required and unknown");
        }
    }
}

struct Range
{
    std::string_view low; ///< Names of the two members.
    std::string_view high;
    std::optional<double> lowest;
    std::optional<double> highest;
};

void FindReversed(std::initializer_list<Range> ranges, std::vector<std::string>& found)
{
    for (const Range& range : ranges)
    {
        if (range.lowest.has_value() && range.highest.has_value() && *range.lowest > *range.highest)
        {
            found.push_back(fmt::format("{} {} is above {} {}", range.low, *range.lowest, range.high, *range.highest));
        }
    }
}

void FindReversedRanges(const FactsheetMessage& factsheet, std::vector<std::string>& found)
{
    const PhysicalParameters& physical = factsheet.physicalParameters;
    const ProtocolTiming& timing = factsheet.protocolLimits.timing;
    FindReversed(
        {{"speedMin", "speedMax", physical.speedMin, physical.speedMax},
         {"angularSpeedMin", "angularSpeedMax", physical.angularSpeedMin, physical.angularSpeedMax},
         {"heightMin", "heightMax", physical.heightMin, physical.heightMax},
         {"minStateInterval",
          "defaultStateInterval",
          timing.minStateInterval,
          timing.defaultStateInterval.value_or(STATE_INTERVAL)}},
        found);
    for (const LoadSet& set : factsheet.loadSpecification.loadSets)
    {
        FindReversed(
            {{"minLoadhandlingHeight", "maxLoadhandlingHeight", set.minLoadhandlingHeight, set.maxLoadhandlingHeight}},
            found);
    }
}

void FindLongIntervals(const ProtocolTiming& timing, std::vector<std::string>& found)
{
    const auto check = [&found](std::string_view name, double seconds, std::string_view effect) {
        if (seconds > LONGEST_PLAUSIBLE_INTERVAL)
        {
            found.push_back(
                fmt::format("{} is {} s, above {} s: {}", name, seconds, LONGEST_PLAUSIBLE_INTERVAL, effect));
        }
    };
    check("minOrderInterval", timing.minOrderInterval, "each order message waits this long after the one before");
    check("minStateInterval", timing.minStateInterval, "the vehicle shows what it does this late");
    check(
        "defaultStateInterval",
        timing.defaultStateInterval.value_or(0.0),
        "a vehicle that has failed counts as connected this long");
}

} // namespace

std::vector<std::string> FindContradictions(const FactsheetMessage& factsheet)
{
    std::vector<std::string> found;
    FindContradictoryActions(factsheet.protocolFeatures.agvActions, found);
    if (factsheet.protocolFeatures.optionalParameters.has_value())
    {
        FindContradictoryMembers(*factsheet.protocolFeatures.optionalParameters, found);
    }
    FindReversedRanges(factsheet, found);
    FindLongIntervals(factsheet.protocolLimits.timing, found);
    return found;
}

} // namespace ACS::VDA5050
