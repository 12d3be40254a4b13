#include "robots/DefaultParameters.hpp"

#include <acs/vda5050/Action.hpp>

#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

bool IsTray(Planning::EPlaceRule rule)
{
    return rule == Planning::EPlaceRule::FixedTray || rule == Planning::EPlaceRule::RobotTray;
}

VehicleParameter MakeParameter(std::string key, std::string_view text)
{
    return {std::move(key), *ParameterTemplate::Make(text), true};
}

} // namespace

std::vector<VehicleParameter> MakeDefaultParameters(
    std::string_view actionType,
    const Planning::ActionRule& rule,
    std::size_t portCount)
{
    std::vector<VehicleParameter> parameters;
    parameters.push_back(MakeParameter("stationName", "{place}"));
    parameters.push_back(MakeParameter("loadId", "{carrier}"));
    if (actionType != VDA5050::ActionTypes::PICK && actionType != VDA5050::ActionTypes::DROP)
    {
        return parameters;
    }
    parameters.push_back(MakeParameter("stationType", "{station.type}"));
    parameters.push_back(MakeParameter("loadType", IsTray(rule.from) || IsTray(rule.to) ? "tray" : "cassette"));
    parameters.push_back(MakeParameter("lhd", "{robot_port}"));
    parameters.back().bDefault = portCount <= 1;
    parameters.push_back(MakeParameter("height", "{station.height}"));
    parameters.push_back(MakeParameter("side", "{station.side}"));
    return parameters;
}

} // namespace ACS::Acsd
