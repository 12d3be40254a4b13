#include "config/VehicleReader.hpp"

#include "common/config/TextFile.hpp"
#include "config/ArmConfig.hpp"
#include "config/DriverContext.hpp"
#include "config/McsConfig.hpp"
#include "config/VehicleConfig.hpp"
#include "mcs/MessageValue.hpp"
#include "robots/VehicleSetup.hpp"
#include <acs/core/Location.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <memory>
#include <optional>
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
using Vehicles = std::vector<std::shared_ptr<VehicleConfig>>;

std::optional<Apps::Url> ReadArmOrNull(const ConfigSection& robot, bool bNeeded, const Vehicles& others)
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
    const auto twin = std::ranges::find_if(others, [&url](const auto& other) {
        return other->armOrNull.has_value() && *other->armOrNull == url && !url.peer.host.empty();
    });
    if (twin != others.end())
    {
        section.AddError("url", fmt::format("{} has the same: one arm cannot be of two robots", (*twin)->robotID));
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
std::vector<NeededMap> ReadMaps(const ConfigSection& robot, const VehicleConfig& vehicle, AcsdConfig& config)
{
    std::vector<NeededMap> maps;
    const ConfigSection section = robot.GetSection("maps");
    for (const std::string& mapID : section.GetNames())
    {
        maps.push_back(ReadMap(section, mapID, config));
    }
    if (!maps.empty() && vehicle.protocolVersion == "2.0.0")
    {
        config.warnings.push_back(fmt::format(
            "robots.{}.maps: has no effect, because VDA5050 has maps since 2.1; remove it, or set protocol",
            vehicle.robotID));
    }
    return maps;
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

/// A topic has both names.
void CheckAddress(const ConfigSection& section, const VDA5050::VehicleAddress& address, const Vehicles& others)
{
    for (const auto& [key, level] :
         {std::pair("manufacturer", address.manufacturer), std::pair("serial", address.serialNumber)})
    {
        if (!VDA5050::IsValidAddress({"uagv", level, level}))
        {
            section.AddError(key, "is a level of a topic: not empty, without / + #");
        }
    }
    const auto twin = std::ranges::find_if(others, [&address](const auto& other) {
        return other->address.manufacturer == address.manufacturer
            && other->address.serialNumber == address.serialNumber;
    });
    if (twin != others.end() && !address.serialNumber.empty())
    {
        section.AddError(
            "serial",
            fmt::format("{} has the same manufacturer and serial: one vehicle cannot be two robots", (*twin)->robotID));
    }
}

std::shared_ptr<VehicleConfig> ReadVehicle(const DriverContext& context, std::string_view driver)
{
    const ConfigSection& section = context.robot;
    const Planning::RobotOptions& options = context.options;
    AcsdConfig& config = context.config;
    auto vehicle = std::make_shared<VehicleConfig>();
    vehicle->robotID = options.robotID.GetText();
    vehicle->type = options.type;
    vehicle->vehicleTypeID = options.vehicleTypeID;
    vehicle->portCount = options.ports.size();
    vehicle->zoneSetID = config.zoneSetID;
    vehicle->offlineAfter = config.operations.offlineAfter;
    vehicle->loadTimeout = config.operations.loadTimeout;
    vehicle->address = {GetInterfaceName(config), section.GetString("manufacturer"), section.GetString("serial")};
    vehicle->protocolVersion = section.GetWord("protocol", {"2.0.0", "2.1.0"}, "2.0.0");
    vehicle->factsheet = ReadFactsheetOrNull(section, context.fileName);
    vehicle->maps = ReadMaps(section, *vehicle, config);
    const bool bArmDriver = driver == OPEN_STREAM_DRIVER;
    vehicle->armOrNull =
        ReadArmOrNull(section, bArmDriver || options.type == Planning::ERobotType::CR, config.vehicles);
    if (vehicle->armOrNull.has_value())
    {
        vehicle->armOptions = ReadArmOptions(section.GetSection("arm"), config.arm);
        if (!bArmDriver)
        {
            section.AddError("driver", fmt::format("a robot with an arm has the driver {}", OPEN_STREAM_DRIVER));
        }
    }
    // The vehicle of a robot with an arm does not see what the arm carries, unless its positions are named.
    const bool bLoadsShown = !vehicle->armOrNull.has_value() || section.HasKey("load_positions");
    vehicle->methods =
        JobMethods(bLoadsShown ? ReadLoadPositions(section, options.ports) : LoadPositions(), config.stations);
    CheckAddress(section, vehicle->address, config.vehicles);
    config.vehicles.push_back(vehicle);
    return vehicle;
}

} // namespace

std::unique_ptr<IRobotSetup> MakeVehicleSetup(const DrivenRobotConfig& config, std::string_view driver)
{
    assert(config.contextOrNull != nullptr);
    std::vector<std::string> actions;
    for (const auto& [action, options] : config.actions)
    {
        actions.push_back(action);
    }
    return std::make_unique<VehicleSetup>(ReadVehicle(*config.contextOrNull, driver), std::move(actions));
}

} // namespace ACS::Acsd
