#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

using Scopes = std::vector<EActionScope>;

constexpr EActionScope INSTANT = EActionScope::Instant;
constexpr EActionScope NODE = EActionScope::Node;
constexpr EActionScope EDGE = EActionScope::Edge;

AgvActionParameter Needed(std::string_view key, EValueDataType type = EValueDataType::String)
{
    return AgvActionParameter{std::string(key), type, {}, false};
}

AgvActionParameter Possible(std::string_view key, EValueDataType type = EValueDataType::String)
{
    return AgvActionParameter{std::string(key), type, {}, true};
}

AgvAction Row(std::string_view actionType, Scopes scopes, std::initializer_list<AgvActionParameter> parameters = {})
{
    AgvAction row;
    row.actionType = actionType;
    row.actionScopes = std::move(scopes);
    row.actionParameters = parameters;
    return row;
}

std::vector<AgvAction> MakeTable()
{
    constexpr EValueDataType NUMBER = EValueDataType::Number;
    return {
        Row(ActionTypes::START_PAUSE, {INSTANT}),
        Row(ActionTypes::STOP_PAUSE, {INSTANT}),
        Row(ActionTypes::START_CHARGING, {INSTANT, NODE}),
        Row(ActionTypes::STOP_CHARGING, {INSTANT, NODE}),
        Row(ActionTypes::INIT_POSITION,
            {INSTANT, NODE},
            {Needed("x", NUMBER), Needed("y", NUMBER), Needed("theta", NUMBER), Needed("mapId"), Needed("lastNodeId")}),
        Row(ActionTypes::ENABLE_MAP, {INSTANT, NODE}, {Needed("mapId"), Needed("mapVersion")}),
        Row(ActionTypes::DOWNLOAD_MAP,
            {INSTANT},
            {Needed("mapId"), Needed("mapVersion"), Needed("mapDownloadLink"), Possible("mapHash")}),
        Row(ActionTypes::DELETE_MAP, {INSTANT}, {Needed("mapId"), Needed("mapVersion")}),
        Row(ActionTypes::STATE_REQUEST, {INSTANT}),
        Row(ActionTypes::LOG_REPORT, {INSTANT}, {Needed("reason")}),
        Row(ActionTypes::PICK,
            {NODE, EDGE},
            {Possible("lhd"),
             Needed("stationType"),
             Possible("stationName"),
             Needed("loadType"),
             Possible("loadId"),
             Possible("height", NUMBER),
             Possible("depth", NUMBER),
             Possible("side")}),
        Row(ActionTypes::DROP,
            {NODE, EDGE},
            {Possible("lhd"),
             Possible("stationType"),
             Possible("stationName"),
             Possible("loadType"),
             Possible("loadId"),
             Possible("height", NUMBER),
             Possible("depth", NUMBER),
             Possible("side")}),
        Row(ActionTypes::DETECT_OBJECT, {NODE, EDGE}, {Possible("objectType")}),
        Row(ActionTypes::FINE_POSITIONING, {NODE, EDGE}, {Possible("stationType"), Possible("stationName")}),
        Row(ActionTypes::WAIT_FOR_TRIGGER, {NODE}, {Needed("triggerType")}),
        Row(ActionTypes::CANCEL_ORDER, {INSTANT}),
        Row(ActionTypes::FACTSHEET_REQUEST, {INSTANT})};
}

} // namespace

const std::vector<AgvAction>& GetPredefinedActions()
{
    static const std::vector<AgvAction> TABLE = MakeTable();
    return TABLE;
}

const AgvAction* FindPredefinedActionOrNull(std::string_view actionType)
{
    const std::vector<AgvAction>& table = GetPredefinedActions();
    const auto found = std::ranges::find(table, actionType, &AgvAction::actionType);
    return found == table.end() ? nullptr : &*found;
}

} // namespace ACS::VDA5050
