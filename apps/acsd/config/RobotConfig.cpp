#include "config/RobotConfig.hpp"

#include "config/DriverConfig.hpp"
#include "config/PlaceConfig.hpp"
#include <acs/core/Location.hpp>
#include <acs/core/RobotID.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

/// Ports that are listed twice, and places inside carriers on ports that the robot does not have.
void CheckPorts(const ConfigSection& section, const Planning::RobotOptions& robot)
{
    std::set<std::string_view> seen;
    for (const auto& [key, places] : {std::pair("ports", &robot.ports), std::pair("child_ports", &robot.childPorts)})
    {
        for (const Core::Location& place : *places)
        {
            if (!seen.insert(place.GetText()).second)
            {
                section.AddError(key, fmt::format("{} is listed twice", place.GetText()));
            }
        }
    }
    for (const Core::Location& child : robot.childPorts)
    {
        const std::string_view text = child.GetText();
        const std::string_view carrier = text.substr(0, text.rfind('.'));
        if (std::ranges::find(robot.ports, carrier, &Core::Location::GetText) == robot.ports.end())
        {
            section.AddError("child_ports", fmt::format("{} is in {}, which is not in ports", text, carrier));
        }
    }
}

/// Whether the table has one of the keys that each robot needs. One with overrides under a misspelled name has none.
bool HasRobotKey(const ConfigSection& section)
{
    static constexpr std::array KEYS{"type", "manufacturer", "serial", "vehicle_type", "start_node"};
    const std::vector<std::string> names = section.GetNames();
    return std::ranges::any_of(KEYS, [&names](const char* key) { return std::ranges::count(names, key) > 0; });
}

std::string ReadStartNode(const ConfigSection& section)
{
    if (!section.HasKey("start_node"))
    {
        section.AddError("start_node", "missing; give the nodeId of the site map where the robot is at the start");
        return {};
    }
    return section.GetString("start_node");
}

void ReadRobot(const ConfigSection& section, const std::string& name, const RobotDrivers& drivers, AcsdConfig& config)
{
    const Core::Result<Core::RobotID> robotID = Core::RobotID::Parse(name);
    if (!robotID)
    {
        section.Refuse(Core::Describe(robotID.error()));
        return;
    }
    if (robotID->IsAlias())
    {
        section.Refuse(
            fmt::format("{} stands for the robot that executes a plan (MCS-ACS section 3.1); give another name", name));
        return;
    }
    if (!HasRobotKey(section))
    {
        section.Refuse(
            "describes no robot; correct the name, or give type, manufacturer, serial, vehicle_type and start_node");
        return;
    }
    RobotLinkConfig link;
    link.robotID = name;
    link.driver = ReadDriver(section, drivers);
    Planning::RobotOptions options{*robotID, {}, {}, {}, {}, {}, {}, {}};
    options.type = section.GetWord("type", {"LR", "CR"}) == "CR" ? Planning::ERobotType::CR : Planning::ERobotType::LR;
    options.vehicleTypeID = section.GetString("vehicle_type");
    options.startNodeID = ReadStartNode(section);
    options.homeStationID = section.GetStringOrNull("home");
    options.chargingStationID = section.GetStringOrNull("charge");
    options.ports = ReadPlaces(section, "ports", name + ".");
    options.childPorts = ReadPlaces(section, "child_ports", name + ".");
    CheckPorts(section, options);
    config.engine.robots.push_back(std::move(options));
    config.robots.push_back(std::move(link));
}

} // namespace

void ReadRobots(const ConfigSection& root, const RobotDrivers& drivers, AcsdConfig& config)
{
    const ConfigSection robots = root.GetSection("robots");
    for (const std::string& name : robots.GetNames())
    {
        ReadRobot(robots.GetSection(name), name, drivers, config);
    }
    if (config.robots.empty())
    {
        root.AddError("robots", "needs at least one table, such as [robots.LR01]");
    }
}

} // namespace ACS::Acsd
