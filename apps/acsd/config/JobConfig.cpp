#include "config/JobConfig.hpp"

#include "config/ActionConfig.hpp"
#include "config/TemplateCheck.hpp"
#include "robots/MethodResolver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

/// The tables `actions` of a robot or a station. The type is given only for robots.
MethodTables ReadOverrides(
    const ConfigSection& owner,
    const Planning::ActionTable& actions,
    const Planning::ERobotType* typeOrNull,
    const TemplateCheck& check)
{
    MethodTables tables;
    const ConfigSection section = owner.GetSection("actions");
    const std::vector<std::string> names = section.GetNames();
    if (names.empty() && owner.HasKey("actions"))
    {
        section.AddError("", "is empty; give a table per action, or leave it out");
    }
    for (const std::string& name : names)
    {
        const ConfigSection table = section.GetSection(name);
        const auto rule = actions.find(name);
        if (rule == actions.end())
        {
            table.Refuse(fmt::format("expected an action of the table actions, found {}", Core::QuoteForError(name)));
        }
        else if (typeOrNull != nullptr && rule->second.robotType != *typeOrNull)
        {
            table.Refuse(fmt::format("actions.{}.robot gives the action to the other type of robot", name));
        }
        else if (table.GetNames().empty())
        {
            table.AddError("", "is empty; give vehicle_action, parameters, arm_program or arm_inputs, or leave it out");
        }
        else
        {
            tables.emplace(name, MethodTable{table, ReadMethodKeys(table, rule->second, check)});
        }
    }
    return tables;
}

bool HasVehicle(const AcsdConfig& config, Planning::ERobotType type)
{
    return std::ranges::any_of(config.vehicles, [type](const auto& vehicle) { return vehicle->type == type; });
}

/// Reported with the robot. Whether it can do an action is known when it has its arm.
bool IsArmMissing(const VehicleConfig& vehicle)
{
    return vehicle.type == Planning::ERobotType::CR && !vehicle.armOrNull.has_value();
}

/// Whether a robot of the type has a driver that is not built in.
bool HasOtherRobot(const AcsdConfig& config, Planning::ERobotType type)
{
    const auto vehicles =
        std::ranges::count_if(config.vehicles, [type](const auto& vehicle) { return vehicle->type == type; });
    return std::ranges::count(config.engine.robots, type, &Planning::RobotOptions::type) > vehicles;
}

/// Robots of other drivers do an action by its `options`.
void CheckKeys(const ConfigSection& section, const MethodKeys& keys, bool bVehicles, bool bOthers)
{
    const bool bGiven = keys.IsOfVehicle() || keys.IsOfArm();
    if (bGiven && bOthers && !bVehicles)
    {
        section.AddError(
            keys.FindFirstKey(),
            "has no effect: no robot of this type has the driver vda5050 or vda5050_openstream; give options instead");
    }
    else if ((bGiven || !bOthers) && keys.vehicleAction.has_value() == keys.armProgram.has_value())
    {
        section.AddError("", "needs exactly one of vehicle_action and arm_program");
    }
}

StationTables ReadStationTables(const ConfigSection& root, const AcsdConfig& config, const TemplateCheck& check)
{
    StationTables tables;
    const ConfigSection stations = root.GetSection("stations");
    for (const auto& [stationID, values] : *config.stations)
    {
        const ConfigSection station = stations.GetSection(stationID);
        if (station.HasKey("actions"))
        {
            tables.emplace(stationID, ReadOverrides(station, config.engine.actions, nullptr, check));
        }
    }
    return tables;
}

TemplateCheck MakeTemplateCheck(const AcsdConfig& config)
{
    return {*config.stations, config.engine, config.relayIndex};
}

/// The tables `actions` of the vehicles, in their order.
std::vector<MethodTables> ReadVehicleTables(
    const ConfigSection& root,
    const AcsdConfig& config,
    const TemplateCheck& check)
{
    std::vector<MethodTables> tables;
    const ConfigSection robots = root.GetSection("robots");
    for (const std::shared_ptr<VehicleConfig>& vehicle : config.vehicles)
    {
        const ConfigSection section = robots.GetSection(vehicle->robotID);
        tables.push_back(ReadOverrides(section, config.engine.actions, &vehicle->type, check));
    }
    return tables;
}

} // namespace

MethodTables ReadActions(const ConfigSection& root, AcsdConfig& config)
{
    const TemplateCheck check = MakeTemplateCheck(config);
    Planning::ActionTable& rules = config.engine.actions;
    MethodTables tables;
    const ConfigSection actions = root.GetSection("actions");
    rules.clear();
    for (const std::string& name : actions.GetNames())
    {
        const ConfigSection section = actions.GetSection(name);
        const Planning::ActionRule rule = ReadActionRule(section, name);
        MethodKeys keys = ReadMethodKeys(section, rule, check);
        rules.insert_or_assign(name, rule);
        tables.emplace(name, MethodTable{section, std::move(keys)});
    }
    if (rules.empty())
    {
        root.AddError("actions", "needs at least one table, such as [actions.CassetteLoad]: no plan could be done");
    }
    return tables;
}

void ReadMethods(const ConfigSection& root, const MethodTables& actions, AcsdConfig& config)
{
    const TemplateCheck check = MakeTemplateCheck(config);
    for (const auto& [name, table] : actions)
    {
        const Planning::ERobotType type = config.engine.actions.at(name).robotType;
        CheckKeys(table.section, table.keys, HasVehicle(config, type), HasOtherRobot(config, type));
    }
    const StationTables stations = ReadStationTables(root, config, check);
    const std::vector<MethodTables> overrides = ReadVehicleTables(root, config, check);
    for (const auto& [name, table] : actions)
    {
        const Planning::ActionRule& rule = config.engine.actions.at(name);
        MethodResolver resolver(name, rule, table, stations, config.warnings);
        for (std::size_t i = 0; i < config.vehicles.size(); ++i)
        {
            if (rule.robotType == config.vehicles[i]->type && !IsArmMissing(*config.vehicles[i]))
            {
                const auto own = overrides[i].find(name);
                resolver.SetMethods(own == overrides[i].end() ? nullptr : &own->second, *config.vehicles[i]);
            }
        }
        resolver.Check(check.GetPlaces());
    }
}

void CheckActions(const ConfigSection& root, const AcsdConfig& config)
{
    std::map<std::string, std::string> reasons; ///< By action: why the first robot cannot do it.
    std::set<std::string> possible;
    for (const Planning::RobotOptions& robot : config.engine.robots)
    {
        for (const auto& [name, rule] : config.engine.actions)
        {
            const auto rejected = robot.rejectedActions.find(name);
            if (rejected != robot.rejectedActions.end())
            {
                reasons.try_emplace(name, fmt::format("{}: {}", robot.robotID.GetText(), rejected->second));
            }
            else if (rule.robotType == robot.type)
            {
                possible.insert(name);
            }
        }
    }
    const bool bOthers = config.vehicles.size() < config.robots.size();
    for (const auto& [name, reason] : reasons)
    {
        if (!possible.contains(name))
        {
            root.GetSection("actions").GetSection(name).AddError(
                "",
                fmt::format(
                    "no robot can do it, {}; give arm_program for robots with an arm, vehicle_action for those without{}",
                    reason,
                    bOthers ? ", options for those of other drivers" : ""));
        }
    }
}

} // namespace ACS::Acsd
