#include "JobConfig.hpp"

#include "ActionConfig.hpp"
#include "RobotHost.hpp"
#include "TemplateCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

constexpr std::size_t WORD_BYTES = 4;

/// One table and what it says.
struct MethodTable
{
    ConfigSection section;
    MethodKeys keys;
};

/// By action, and of stations by station too.
using MethodTables = std::map<std::string, MethodTable, std::less<>>;
using StationTables = std::map<std::string, MethodTables, std::less<>>;

/// The tables `actions` of a robot or a station. A type is given for robots.
MethodTables ReadOverrides(
    const ConfigSection& owner,
    const Planning::ActionTable& actions,
    const Planning::ERobotType* typeOrNull,
    const TemplateCheck& check)
{
    MethodTables tables;
    const ConfigSection section = owner.GetSection("actions");
    for (const std::string& name : section.GetNames())
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
        else
        {
            tables.emplace(name, MethodTable{table, ReadMethodKeys(table, rule->second, check)});
        }
    }
    return tables;
}

MethodTables ReadActions(const ConfigSection& root, const TemplateCheck& check, Planning::ActionTable& rules)
{
    MethodTables tables;
    const ConfigSection actions = root.GetSection("actions");
    rules.clear();
    for (const std::string& name : actions.GetNames())
    {
        const ConfigSection section = actions.GetSection(name);
        const Planning::ActionRule rule = ReadActionRule(section, name);
        MethodKeys keys = ReadMethodKeys(section, rule, check);
        if (keys.vehicleAction.has_value() == keys.armProgram.has_value())
        {
            section.AddMistake("", "needs exactly one of vehicle_action and arm_program");
        }
        rules.insert_or_assign(name, rule);
        tables.emplace(name, MethodTable{section, std::move(keys)});
    }
    if (rules.empty())
    {
        root.AddMistake("actions", "needs at least one table, such as [actions.CassetteLoad]: no plan could be done");
    }
    return tables;
}

bool IsCounter(const ArmRelay& relay, const ArmOptions& options)
{
    std::vector<std::size_t> words{options.startedIndex, options.finishedIndex, options.failedIndex};
    if (options.echoIndex.has_value())
    {
        words.push_back(*options.echoIndex);
    }
    return relay.url == options.monitorUrl && std::ranges::any_of(words, [&relay, &options](std::size_t word) {
               const std::size_t counter = options.firstByte + word * WORD_BYTES;
               const std::size_t input = relay.firstByte - relay.firstByte % WORD_BYTES;
               return input < counter + WORD_BYTES && counter < input + WORD_BYTES;
           });
}

/// The program would lose what it shows there, or acsd would take the input for it.
void RefuseCounters(const MethodTable& table, const RobotLinkConfig& robot)
{
    if (!table.keys.armInputs.has_value())
    {
        return;
    }
    for (const ArmInputTemplate& input : *table.keys.armInputs)
    {
        if (IsCounter(input.relay, robot.armOptions))
        {
            table.section.GetSection("arm_inputs")
                .AddMistake(
                    input.relay.name,
                    fmt::format("is a counter of the arm of {}; give a relay that is free", robot.robotID));
        }
    }
}

/// Its program cannot echo a number that it does not get.
void WarnWithoutNumber(const MethodTable& table, const RobotLinkConfig& robot, std::vector<std::string>& warnings)
{
    if (!table.keys.armInputs.has_value() || table.keys.armInputs->empty() || !robot.armOptions.echoIndex.has_value())
    {
        return;
    }
    const bool bNumbered = std::ranges::any_of(*table.keys.armInputs, [](const ArmInputTemplate& input) {
        const JobName* const nameOrNull = input.value.GetNameOrNull();
        return nameOrNull != nullptr && nameOrNull->subject == JobName::ESubject::JobNumber;
    });
    std::string warning = fmt::format(
        "{}.arm_inputs: has no {{job_number}}, so its program cannot echo it: every change of the counters counts for the job. "
        "Add it, or set arm.counter_echo = -1 where no program of the arm can echo",
        table.section.GetPath());
    if (!bNumbered && std::ranges::find(warnings, warning) == warnings.end())
    {
        warnings.push_back(std::move(warning));
    }
}

/// A table of a station is for robots that do the action in the same way: with the vehicle, or with the arm.
bool IsSameKind(const MethodKeys& keys, const MethodKeys& by)
{
    return (by.IsOfVehicle() && keys.IsOfVehicle()) || (by.IsOfArm() && keys.IsOfArm());
}

/// All methods of one robot for one action.
void SetMethods(
    const std::string& action,
    const Planning::ActionRule& rule,
    const MethodKeys& keys,
    const StationTables& stations,
    std::size_t portCount,
    RobotLinkConfig& robot,
    std::vector<std::string>& warnings)
{
    robot.methods.SetMethod(action, {}, MakeMethod(keys, rule, portCount));
    for (const auto& [stationID, tables] : stations)
    {
        const auto table = tables.find(action);
        if (table == tables.end() || !IsSameKind(keys, table->second.keys))
        {
            continue;
        }
        MethodKeys atStation = keys;
        ReplaceKeys(atStation, table->second.keys);
        RefuseCounters(table->second, robot);
        WarnWithoutNumber(table->second, robot, warnings);
        robot.methods.SetMethod(action, stationID, MakeMethod(atStation, rule, portCount));
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

} // namespace

void ReadJobs(const ConfigSection& root, AcsdConfig& config)
{
    const TemplateCheck check(*config.stations, config.engine, config.relayIndex);
    const MethodTables actions = ReadActions(root, check, config.engine.actions);
    const StationTables stations = ReadStationTables(root, config, check);
    for (const auto& [stationID, tables] : stations)
    {
        for (const auto& [name, table] : tables)
        {
            if (!IsSameKind(actions.at(name).keys, table.keys))
            {
                table.section.AddMistake(
                    "",
                    fmt::format("expected keys of the same kind as in actions.{}: of a vehicle or of an arm", name));
            }
        }
    }
    for (std::size_t i = 0; i < config.robots.size(); ++i)
    {
        RobotLinkConfig& robot = config.robots[i];
        const Planning::RobotOptions& options = config.engine.robots[i];
        const ConfigSection section = root.GetSection("robots").GetSection(robot.robotID);
        const MethodTables overrides = ReadOverrides(section, config.engine.actions, &options.type, check);
        for (const auto& [name, table] : actions)
        {
            const Planning::ActionRule& rule = config.engine.actions.at(name);
            if (rule.robotType != options.type)
            {
                continue;
            }
            RefuseCounters(table, robot);
            MethodKeys keys = table.keys;
            const auto own = overrides.find(name);
            const bool bOwn = own != overrides.end();
            if (bOwn)
            {
                RefuseCounters(own->second, robot);
                ReplaceKeys(keys, own->second.keys);
            }
            if (keys.IsOfArm())
            {
                const bool bOwnInputs = bOwn && own->second.keys.armInputs.has_value();
                WarnWithoutNumber(bOwnInputs ? own->second : table, robot, config.warnings);
            }
            SetMethods(name, rule, keys, stations, options.ports.size(), robot, config.warnings);
        }
    }
}

void RejectActions(const ConfigSection& root, AcsdConfig& config)
{
    std::map<std::string, std::string> reasons; ///< Of the first robot.
    std::set<std::string> possible;
    for (std::size_t i = 0; i < config.robots.size(); ++i)
    {
        Planning::RobotOptions& robot = config.engine.robots[i];
        robot.rejectedActions = RobotHost::FindRejectedActions(config, config.robots[i], robot.type);
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
    for (const auto& [name, reason] : reasons)
    {
        if (!possible.contains(name))
        {
            root.GetSection("actions").GetSection(name).AddMistake(
                "",
                fmt::format(
                    "no robot can do it, {}; give arm_program for robots with an arm, vehicle_action for those without",
                    reason));
        }
    }
}

} // namespace ACS::Acsd
