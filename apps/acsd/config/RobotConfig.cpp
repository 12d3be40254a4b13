#include "config/RobotConfig.hpp"

#include "common/config/TextFile.hpp"
#include "config/ArmConfig.hpp"
#include "config/DriverConfig.hpp"
#include "config/McsConfig.hpp"
#include "config/PlaceConfig.hpp"
#include "mcs/MessageValue.hpp"
#include <acs/core/Location.hpp>
#include <acs/core/RobotID.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
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
using Apps::EUrlScheme;

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

std::optional<Apps::Url> ReadArmOrNull(
    const ConfigSection& robot,
    bool bNeeded,
    const std::vector<RobotLinkConfig>& others)
{
    if (!robot.HasKey("arm"))
    {
        if (bNeeded)
        {
            robot.AddError("arm", "a CR needs arm.url (tcp://) of its arm's controller");
        }
        return std::nullopt;
    }
    const ConfigSection section = robot.GetSection("arm");
    Apps::Url url = section.GetURL("url", {EUrlScheme::Tcp});
    const auto twin = std::ranges::find_if(others, [&url](const RobotLinkConfig& other) {
        return other.armOrNull.has_value() && *other.armOrNull == url && !url.peer.host.empty();
    });
    if (twin != others.end())
    {
        section.AddError("url", fmt::format("{} has the same: one arm cannot be of two robots", twin->robotID));
    }
    return url;
}

/// The vehicle's names of its ports: a table by port without the robot ("CP01").
LoadPositions ReadLoadPositions(const ConfigSection& robot, const std::vector<Core::Location>& ports)
{
    std::map<std::string, std::string, std::less<>> names;
    const ConfigSection section = robot.GetSection("load_positions");
    for (const std::string& name : section.GetNames())
    {
        const std::string position = section.GetString(name);
        const bool bPort = std::ranges::count(ports, name, LoadPositions::GetPortName) > 0;
        if (!bPort || position.empty())
        {
            section.AddError(name, "expected a port of this robot, such as CP01, and the vehicle's name of it");
        }
        else if (const std::optional<std::string> fault = FindNameFaultOrNull(position))
        {
            section.AddError(name, *fault);
        }
        names.emplace(name, position);
    }
    std::map<std::string, std::string, std::less<>> portsByPosition;
    for (const Core::Location& port : ports)
    {
        const std::string portName = LoadPositions::GetPortName(port);
        const auto given = names.find(portName);
        const std::string& position = given == names.end() ? portName : given->second;
        const auto [other, bNew] = portsByPosition.emplace(position, portName);
        if (!bNew && other->second != portName)
        {
            section.AddError(
                given == names.end() ? other->second : portName,
                fmt::format("is {}, which another port uses already: give each port a different position", position));
        }
    }
    return {ports, names};
}

/// SCHEME://REST without blanks: the vehicle knows which schemes it supports.
bool IsDownloadLink(std::string_view text)
{
    constexpr std::string_view SEPARATOR = "://";
    const std::size_t end = text.find(SEPARATOR);
    const auto isSchemeLetter = [](char letter) {
        return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9')
            || letter == '+' || letter == '-' || letter == '.';
    };
    const auto isVisible = [](char letter) {
        return letter > ' ' && letter <= '~';
    };
    return end != std::string_view::npos && end > 0 && text.size() > end + SEPARATOR.size()
        && std::ranges::all_of(text.substr(0, end), isSchemeLetter) && std::ranges::all_of(text, isVisible);
}

NeededMap ReadMap(const ConfigSection& section, const std::string& mapID, const AcsdConfig& config)
{
    const ConfigSection table = section.GetSection(mapID);
    NeededMap map{
        mapID,
        table.GetString("version"),
        table.GetStringOrNull("download").value_or(std::string()),
        table.GetStringOrNull("hash").value_or(std::string())};
    if (map.version.empty())
    {
        table.AddError("version", "expected the mapVersion that the vehicle is to enable");
    }
    if (table.HasKey("download") && !IsDownloadLink(map.downloadLink))
    {
        table.AddError(
            "download",
            fmt::format("expected a URL such as http://HOST/FILE, found {}", Core::QuoteForError(map.downloadLink)));
    }
    if (table.HasKey("hash") && !table.HasKey("download"))
    {
        table.AddError("hash", "is of the download, which is not given; add download, or remove hash");
    }
    const bool bKnown =
        !config.site.has_value() || std::ranges::count(config.site->GetNodes(), mapID, &Planning::SiteNode::mapID) > 0;
    if (!bKnown)
    {
        section.AddError(mapID, "no node of site.map has this mapId; correct the name, or remove the table");
    }
    return map;
}

/// How the vehicle gets the maps of its nodes: a table by mapId.
std::vector<NeededMap> ReadMaps(const ConfigSection& robot, const RobotLinkConfig& link, AcsdConfig& config)
{
    std::vector<NeededMap> maps;
    const ConfigSection section = robot.GetSection("maps");
    for (const std::string& mapID : section.GetNames())
    {
        maps.push_back(ReadMap(section, mapID, config));
    }
    if (!maps.empty() && link.protocolVersion == "2.0.0")
    {
        config.warnings.push_back(fmt::format(
            "robots.{}.maps: has no effect, because VDA5050 has maps since 2.1; remove it, or set protocol",
            link.robotID));
    }
    return maps;
}

/// Whether the table has one of the keys that each robot needs. One with overrides under a misspelled name has none.
bool HasRobotKey(const ConfigSection& section)
{
    static constexpr std::array KEYS{"type", "manufacturer", "serial", "vehicle_type", "start_node"};
    const std::vector<std::string> names = section.GetNames();
    return std::ranges::any_of(KEYS, [&names](const char* key) { return std::ranges::count(names, key) > 0; });
}

std::optional<VDA5050::FactsheetMessage> ReadFactsheetOrNull(const ConfigSection& robot, const std::string& fileName)
{
    const std::optional<std::string> name = robot.GetStringOrNull("factsheet_file");
    if (!name.has_value())
    {
        return std::nullopt;
    }
    const std::string path = ResolvePath(fileName, *name);
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        robot.AddError(
            "factsheet_file",
            fmt::format("{} cannot be read ({}); give the path of a JSON file", path, text.error()));
        return std::nullopt;
    }
    Core::Result<VDA5050::FactsheetMessage> factsheet =
        VDA5050::Vda5050Codec().Decode<VDA5050::FactsheetMessage>(*text);
    if (!factsheet)
    {
        robot.AddError(
            "factsheet_file",
            fmt::format("{} is not a VDA5050 factsheet: {}", path, Core::Describe(factsheet.error())));
        return std::nullopt;
    }
    return std::move(*factsheet);
}

void ReadVehicle(
    const ConfigSection& section,
    const std::string& fileName,
    Planning::RobotOptions& options,
    RobotLinkConfig& link,
    AcsdConfig& config)
{
    link.manufacturer = section.GetString("manufacturer");
    link.serialNumber = section.GetString("serial");
    link.protocolVersion = section.GetWord("protocol", {"2.0.0", "2.1.0"}, "2.0.0");
    link.factsheet = ReadFactsheetOrNull(section, fileName);
    link.maps = ReadMaps(section, link, config);
    link.armOrNull = ReadArmOrNull(
        section,
        options.type == Planning::ERobotType::CR || link.driver == OPEN_STREAM_DRIVER,
        config.robots);
    if (link.armOrNull.has_value())
    {
        link.armOptions = ReadArmOptions(section.GetSection("arm"), config.arm);
        if (section.HasKey("driver") && link.driver != OPEN_STREAM_DRIVER)
        {
            section.AddError("driver", fmt::format("a robot with an arm has the driver {}", OPEN_STREAM_DRIVER));
        }
        link.driver = OPEN_STREAM_DRIVER;
    }
    // The vehicle of a robot with an arm does not see what the arm carries, unless its positions are named.
    const bool bLoadsShown = !link.armOrNull.has_value() || section.HasKey("load_positions");
    link.methods =
        JobMethods(bLoadsShown ? ReadLoadPositions(section, options.ports) : LoadPositions(), config.stations);
    for (const auto& [key, level] :
         {std::pair("manufacturer", link.manufacturer), std::pair("serial", link.serialNumber)})
    {
        if (!VDA5050::IsValidAddress({"uagv", level, level}))
        {
            section.AddError(key, "is a level of a topic: not empty, without / + #");
        }
    }
    const VDA5050::VehicleAddress address{GetInterfaceName(config), link.manufacturer, link.serialNumber};
    if (VDA5050::IsValidAddress(address))
    {
        link.topicPrefix = VDA5050::BuildTopicPrefix(address);
        options.connectionHint = fmt::format(
            "The connection message of its vehicle is expected on {}.",
            VDA5050::BuildTopic(address, VDA5050::ETopic::Connection));
    }
    const auto twin = std::ranges::find_if(config.robots, [&link](const RobotLinkConfig& other) {
        return other.manufacturer == link.manufacturer && other.serialNumber == link.serialNumber;
    });
    if (twin != config.robots.end() && !link.serialNumber.empty())
    {
        section.AddError(
            "serial",
            fmt::format("{} has the same manufacturer and serial: one vehicle cannot be two robots", twin->robotID));
    }
}

void ReadRobot(
    const ConfigSection& section,
    const std::string& name,
    const std::string& fileName,
    const RobotDrivers& drivers,
    AcsdConfig& config)
{
    const Core::Result<Core::RobotID> robotID = Core::RobotID::Parse(name);
    if (!robotID)
    {
        section.Refuse(Core::Describe(robotID.error()));
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
    options.startNodeID = section.GetString("start_node");
    options.homeStationID = section.GetStringOrNull("home");
    options.chargingStationID = section.GetStringOrNull("charge");
    options.ports = ReadPlaces(section, "ports", name + ".");
    options.childPorts = ReadPlaces(section, "child_ports", name + ".");
    CheckPorts(section, options);
    link.bDriven = !IsBuiltInDriver(link.driver);
    if (!link.bDriven)
    {
        ReadVehicle(section, fileName, options, link, config);
    }
    config.engine.robots.push_back(std::move(options));
    config.robots.push_back(std::move(link));
}

} // namespace

void ReadRobots(const ConfigSection& root, const std::string& fileName, const RobotDrivers& drivers, AcsdConfig& config)
{
    const ConfigSection robots = root.GetSection("robots");
    for (const std::string& name : robots.GetNames())
    {
        ReadRobot(robots.GetSection(name), name, fileName, drivers, config);
    }
    if (config.robots.empty())
    {
        root.AddError("robots", "needs at least one table, such as [robots.LR01]");
    }
}

} // namespace ACS::Acsd
