#include "config/DriverConfig.hpp"

#include "config/DriverContext.hpp"
#include "drivers/OptionTableImpl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

constexpr std::size_t MOST_DRIVER_NAME_BYTES = 32;

bool IsDriverName(std::string_view name)
{
    const auto isLetter = [](char letter) {
        return letter >= 'a' && letter <= 'z';
    };
    return !name.empty() && name.size() <= MOST_DRIVER_NAME_BYTES && isLetter(name.front())
        && std::ranges::all_of(name, [&isLetter](char letter) {
               return isLetter(letter) || (letter >= '0' && letter <= '9') || letter == '_';
           });
}

const IRobotDriver* FindDriverOrNull(const RobotDrivers& drivers, std::string_view name)
{
    const auto found = std::ranges::find_if(drivers, [name](const auto& driver) { return driver->GetName() == name; });
    return found == drivers.end() ? nullptr : found->get();
}

std::string_view GetTypeName(Planning::ERobotType type)
{
    return type == Planning::ERobotType::CR ? "CR" : "LR";
}

DrivenRobotConfig MakeDrivenConfig(
    const Apps::ConfigReader& reader,
    const DriverContext& context,
    const std::shared_ptr<std::vector<std::string>>& warnings)
{
    const ConfigSection actions = reader.GetRoot().GetSection("actions");
    const Planning::RobotOptions& robot = context.options;
    DrivenRobotConfig config{
        std::string(robot.robotID.GetText()),
        robot.type,
        robot.ports,
        MakeOptionTable(reader, context.robot, "options", warnings),
        {},
        &context};
    for (const auto& [name, rule] : context.config.engine.actions)
    {
        if (rule.robotType == robot.type)
        {
            config.actions.emplace(name, MakeOptionTable(reader, actions.GetSection(name), "options", warnings));
        }
    }
    return config;
}

/// What the driver states of the robot.
void ApplyCapabilitiesOf(
    const ConfigSection& robot,
    const Planning::ActionTable& rules,
    RobotLinkConfig& link,
    Planning::RobotOptions& options)
{
    RobotCapabilities capabilities = link.setupOrNull->GetCapabilities();
    if (std::ranges::count(capabilities.types, options.type) == 0)
    {
        std::vector<std::string_view> types;
        std::ranges::transform(capabilities.types, std::back_inserter(types), GetTypeName);
        robot.AddError(
            "type",
            fmt::format(
                "the driver {} has robots of type {} only, found {}",
                link.driver,
                fmt::join(types, " or "),
                GetTypeName(options.type)));
    }
    options.rejectedActions = std::move(capabilities.rejectedActions);
    std::erase_if(options.rejectedActions, [&rules, &options](const auto& rejected) {
        const auto rule = rules.find(rejected.first);
        return rule == rules.end() || rule->second.robotType != options.type;
    });
    options.connectionHint = std::move(capabilities.connectionHint);
    link.topicPrefix = std::move(capabilities.topicPrefix);
    link.ports.clear();
    std::ranges::transform(options.ports, std::back_inserter(link.ports), [](const Core::Location& port) {
        return port.GetText();
    });
    if (link.topicPrefix.find_first_of("+#") != std::string::npos || link.topicPrefix.ends_with('/'))
    {
        robot.AddError(
            "options",
            fmt::format(
                "the driver {} declares the topics {}, with a wildcard or with '/' at the end",
                link.driver,
                link.topicPrefix));
    }
}

/// Messages on a topic are passed to one robot.
void RefuseSharedTopics(const ConfigSection& root, const std::vector<RobotLinkConfig>& links)
{
    std::map<std::string_view, std::string_view> robots; ///< By topic prefix.
    for (const RobotLinkConfig& link : links)
    {
        if (link.topicPrefix.empty())
        {
            continue;
        }
        const auto [other, bNew] = robots.emplace(link.topicPrefix, link.robotID);
        if (!bNew)
        {
            root.GetSection("robots")
                .GetSection(link.robotID)
                .AddError(
                    "",
                    fmt::format(
                        "{} has the same topics on the broker ({}): give each robot its own",
                        other->second,
                        link.topicPrefix));
        }
    }
}

/// Which keys a robot of an unknown driver has is unknown too.
void AcceptKeys(
    const ConfigSection& root,
    const std::string& robotID,
    Planning::ERobotType type,
    const Planning::ActionTable& rules)
{
    const ConfigSection robot = root.GetSection("robots").GetSection(robotID);
    for (const std::string& key : robot.GetNames())
    {
        static_cast<void>(robot.FindValueOrNull(key));
    }
    for (const auto& [name, rule] : rules)
    {
        if (rule.robotType == type)
        {
            static_cast<void>(root.GetSection("actions").GetSection(name).FindValueOrNull("options"));
        }
    }
}

} // namespace

std::optional<std::string> FindDriverFaultOrNull(const RobotDrivers& drivers)
{
    std::set<std::string_view> names;
    for (const auto& driver : drivers)
    {
        if (driver == nullptr)
        {
            return "a robot driver is null";
        }
        const std::string_view name = driver->GetName();
        if (!IsDriverName(name))
        {
            return fmt::format(
                "the robot driver {} needs a name of 1 to {} of a-z, 0-9 and _, the first one a letter",
                Core::QuoteForError(name),
                MOST_DRIVER_NAME_BYTES);
        }
        if (!names.insert(name).second)
        {
            return fmt::format("two robot drivers have the name {}; rename one", name);
        }
    }
    return std::nullopt;
}

std::string ReadDriver(const ConfigSection& robot, const RobotDrivers& drivers)
{
    if (!robot.HasKey("driver"))
    {
        return std::string(robot.HasKey("arm") ? OPEN_STREAM_DRIVER : VDA5050_DRIVER);
    }
    std::string name = robot.GetString("driver");
    if (FindDriverOrNull(drivers, name) == nullptr)
    {
        std::vector<std::string_view> known;
        std::ranges::transform(drivers, std::back_inserter(known), [](const auto& driver) {
            return driver->GetName();
        });
        robot.AddError(
            "driver",
            fmt::format("this acsd has no driver {}; it has {}", Core::QuoteForError(name), fmt::join(known, ", ")));
    }
    return name;
}

void MakeSetups(
    const Apps::ConfigReader& reader,
    const std::string& fileName,
    const RobotDrivers& drivers,
    AcsdConfig& config)
{
    const ConfigSection robots = reader.GetRoot().GetSection("robots");
    for (std::size_t i = 0; i < config.robots.size(); ++i)
    {
        RobotLinkConfig& link = config.robots[i];
        const Planning::RobotOptions& options = config.engine.robots[i];
        const IRobotDriver* const driverOrNull = FindDriverOrNull(drivers, link.driver);
        if (driverOrNull == nullptr)
        {
            AcceptKeys(reader.GetRoot(), link.robotID, options.type, config.engine.actions);
            continue;
        }
        const ConfigSection robot = robots.GetSection(link.robotID);
        const DriverContext context{robot, fileName, options, config};
        const auto warnings = std::make_shared<std::vector<std::string>>();
        link.setupOrNull = driverOrNull->MakeSetupOrNull(MakeDrivenConfig(reader, context, warnings));
        std::ranges::move(*warnings, std::back_inserter(config.warnings));
        if (link.setupOrNull == nullptr && reader.GetErrors().empty())
        {
            robot.AddError("options", fmt::format("the driver {} refuses the robot without a reason", link.driver));
        }
    }
}

void ApplyCapabilities(const Apps::ConfigReader& reader, AcsdConfig& config)
{
    const ConfigSection robots = reader.GetRoot().GetSection("robots");
    for (std::size_t i = 0; i < config.robots.size(); ++i)
    {
        RobotLinkConfig& link = config.robots[i];
        if (link.setupOrNull != nullptr)
        {
            ApplyCapabilitiesOf(robots.GetSection(link.robotID), config.engine.actions, link, config.engine.robots[i]);
        }
    }
    if (reader.GetErrors().empty())
    {
        RefuseSharedTopics(reader.GetRoot(), config.robots);
    }
}

} // namespace ACS::Acsd
