#include "config/AcsdConfig.hpp"

#include "common/config/TextFile.hpp"
#include "config/ArmConfig.hpp"
#include "config/CorridorConfig.hpp"
#include "config/DriverConfig.hpp"
#include "config/EngineConfig.hpp"
#include "config/FactsheetFile.hpp"
#include "config/JobConfig.hpp"
#include "config/MapRestriction.hpp"
#include "config/NamedFiles.hpp"
#include "config/ParkingCheck.hpp"
#include "config/PlaceConfig.hpp"
#include "config/ReachCheck.hpp"
#include "config/RemovedKeys.hpp"
#include "config/RobotConfig.hpp"
#include "config/StationConfig.hpp"
#include "robots/RobotAdapterFactory.hpp"
#include "robots/VehicleCompatibility.hpp"
#include "robots/VehicleMap.hpp"
#include "robots/VehicleParameters.hpp"
#include <acs/plan/LifReader.hpp>
#include <acs/plan/UnusedLifMember.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
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

/// Part of each order. VDA5050 and factsheets have no limit of it.
constexpr std::size_t MOST_ZONE_SET_BYTES = 128;

void ReportUnusedMembers(const std::string& map, AcsdConfig& config)
{
    using EKind = Planning::UnusedLifMember::EKind;
    std::string ignored;
    for (const Planning::UnusedLifMember& member : Planning::FindUnusedMembers(map))
    {
        const std::string_view times = member.count == 1 ? "time" : "times";
        if (member.kind == EKind::Informative)
        {
            ignored += fmt::format("{}{} ({} {})", ignored.empty() ? "" : ", ", member.path, member.count, times);
            continue;
        }
        config.warnings.push_back(fmt::format(
            "site.map: {} {} ({} {}, first {})",
            member.path,
            member.kind == EKind::Unknown ? "is not a member of LIF 1.0 and has no effect"
                                          : "is not supported: " + member.effect,
            member.count,
            times,
            member.first));
    }
    if (!ignored.empty())
    {
        config.notes.push_back("site.map: members without effect on driving: " + ignored);
    }
}

/// Of what the factsheets of factsheet_file do not allow.
void CloseEdges(AcsdConfig& config)
{
    std::vector<KnownVehicle> vehicles;
    for (const std::shared_ptr<VehicleConfig>& vehicle : config.vehicles)
    {
        if (vehicle->factsheet.has_value())
        {
            vehicles.push_back({vehicle->robotID, vehicle->vehicleTypeID, MakeMasterOptions(*vehicle)});
        }
    }
    std::ranges::move(RestrictMap(vehicles, *config.site), std::back_inserter(config.warnings));
}

/// Corridors are optional for the vehicle: without one it stops at an obstacle.
void WarnOfCorridors(AcsdConfig& config)
{
    const bool bCorridors = std::ranges::any_of(config.site->GetEdges(), [](const Planning::SiteEdge& edge) {
        return edge.corridor.has_value();
    });
    for (const std::shared_ptr<VehicleConfig>& vehicle : config.vehicles)
    {
        if (bCorridors && vehicle->protocolVersion == "2.0.0")
        {
            config.warnings.push_back(fmt::format(
                "site.corridors: robots.{} gets none, because VDA5050 has corridors since 2.1",
                vehicle->robotID));
        }
    }
}

void ReadMap(const ConfigSection& section, const std::string& map, AcsdConfig& config)
{
    if (map.empty())
    {
        section.AddError(
            "map",
            fmt::format("{}; give the path of a LIF file", section.HasKey("map") ? "is empty" : "missing"));
        return;
    }
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(config.siteFile);
    if (!text.has_value())
    {
        section.AddError(
            "map",
            fmt::format("{} cannot be read ({}); give the path of a LIF file", config.siteFile, text.error()));
        return;
    }
    std::vector<std::string> warnings;
    Core::Result<Planning::SiteMap> site = Planning::DecodeLIF(*text, warnings);
    if (site)
    {
        config.site = std::move(*site);
        for (const std::string& warning : warnings)
        {
            config.warnings.push_back("site.map: " + warning);
        }
        ReportUnusedMembers(*text, config);
    }
    else
    {
        const std::string_view hint = site.error().path.ends_with(".theta") ? "; theta is in radians" : "";
        section.AddError(
            "map",
            fmt::format("{} is no LIF layout: {}{}", config.siteFile, Core::Describe(site.error()), hint));
    }
}

/// Vehicles of one type share its part of the map.
void SetMaps(AcsdConfig& config)
{
    if (config.vehicles.empty())
    {
        return;
    }
    const auto site = std::make_shared<const Planning::SiteMap>(*config.site);
    std::map<std::string, std::shared_ptr<DriveCheck>> checks;
    for (const std::shared_ptr<VehicleConfig>& vehicle : config.vehicles)
    {
        std::shared_ptr<DriveCheck>& drives = checks[vehicle->vehicleTypeID];
        if (drives == nullptr)
        {
            drives = std::make_shared<DriveCheck>(VehicleMap(*site, vehicle->vehicleTypeID));
        }
        vehicle->drives = drives;
        vehicle->site = site;
    }
}

/// Why jobs of some actions would wait for another robot.
std::set<std::string> FindMethodFaults(const JobMethods& methods, const VDA5050::FactsheetMessage& factsheet)
{
    std::set<std::string> faults;
    for (const JobMethod* const method : methods.ListMethods())
    {
        std::optional<std::string> fault =
            method->vehicleAction.empty() ? std::nullopt : FindMethodFaultOrNull(*method, factsheet);
        if (fault.has_value())
        {
            faults.insert(*std::move(fault));
        }
    }
    return faults;
}

/// What a received factsheet would be reported for, by the log, by an alarm or as the reason of a plan that waits.
void WarnOfFactsheets(AcsdConfig& config)
{
    for (const std::shared_ptr<VehicleConfig>& vehicle : config.vehicles)
    {
        std::ranges::move(CheckFactsheetFile(*vehicle), std::back_inserter(config.warnings));
        const VDA5050::MasterSession session(MakeMasterOptions(*vehicle));
        const std::string incompatibility = FindIncompatibility(session, *vehicle->drives, vehicle->methods, {});
        std::set<std::string> faults;
        if (!incompatibility.empty())
        {
            faults.insert(incompatibility);
        }
        else if (vehicle->factsheet.has_value())
        {
            faults = FindMethodFaults(vehicle->methods, *vehicle->factsheet);
        }
        for (const std::string& fault : faults)
        {
            config.warnings.push_back(fmt::format("robots.{}: {}", vehicle->robotID, fault));
        }
    }
}

void ReadSite(const ConfigSection& root, const std::string& fileName, AcsdConfig& config)
{
    const ConfigSection section = root.GetSection("site");
    const std::string map = section.HasKey("map") ? section.GetString("map") : std::string();
    config.zoneSetID = section.GetString("zone_set", "");
    if (config.zoneSetID.size() > MOST_ZONE_SET_BYTES)
    {
        section.AddError(
            "zone_set",
            fmt::format("expected at most {} bytes, found {}", MOST_ZONE_SET_BYTES, config.zoneSetID.size()));
    }
    config.siteFile = ResolvePath(fileName, map);
    config.engine.places = ReadPlaces(section, "ports", "");
    const std::string zone = section.GetString("timezone", "system");
    const Core::Result<Apps::LocalOffset> offset = Apps::LocalOffset::Parse(zone);
    if (offset)
    {
        config.localOffset = *offset;
    }
    else
    {
        section.AddError("timezone", Core::Describe(offset.error()));
    }
    ReadMap(section, map, config);
    ReadCorridors(section, config.site);
}

/// Of a broker that is given. The interface is a part of the topics of vehicles, which are read later.
void ReadBroker(const ConfigSection& root, const std::string& fileName, AcsdConfig& config)
{
    if (root.HasKey("mqtt"))
    {
        ReadMqttConfig(root, fileName, config.mqtt.emplace(), config.warnings);
    }
}

/// Whether the broker is given and used, when it is known which robots use it.
void CheckBroker(const ConfigSection& root, const std::string& fileName, AcsdConfig& config)
{
    const bool bNeeded =
        std::ranges::any_of(config.robots, [](const RobotLinkConfig& robot) { return !robot.topicPrefix.empty(); });
    if (bNeeded && !config.mqtt.has_value())
    {
        ReadMqttConfig(root, fileName, config.mqtt.emplace(), config.warnings); // what is missing
    }
    else if (!bNeeded && config.mqtt.has_value())
    {
        config.mqtt.reset();
        config.warnings.emplace_back(
            "mqtt: has no effect, because no robot has a driver that uses the broker; remove it");
    }
    else if (bNeeded)
    {
        std::vector<std::string> prefixes;
        for (const RobotLinkConfig& robot : config.robots)
        {
            if (!robot.topicPrefix.empty())
            {
                prefixes.push_back(robot.topicPrefix);
            }
        }
        if (std::string warning = WarnOfTopics(*config.mqtt, prefixes); !warning.empty())
        {
            config.warnings.push_back(std::move(warning));
        }
    }
}

AcsdConfig Read(
    const std::string& fileName,
    const std::vector<std::string>& overrides,
    const RobotDrivers& drivers,
    bool bStoreInspected)
{
    AcsdConfig config;
    config.fileName = fileName;
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadFile(fileName, overrides);
    const ConfigSection root = reader.GetRoot();
    std::vector<std::string> otherErrors;
    ReadMcsConfig(root, fileName, config.mcs, otherErrors, config.warnings);
    ReadOperationsConfig(root, config.operations);
    ReadBroker(root, fileName, config);
    const ConfigSection arm = root.GetSection("arm");
    config.arm = ReadArmOptions(arm, config.arm);
    const bool bByte = arm.GetWord("relay_index", {"value", "byte"}, "value") == "byte";
    config.relayIndex = bByte ? EArmRelayIndex::Byte : EArmRelayIndex::Value;
    ReadSite(root, fileName, config);
    ReadStoreConfig(root, fileName, bStoreInspected, config.store, config.warnings);
    ReadHttpConfig(root, fileName, config.store.directory, config.http, config.warnings);
    if (bStoreInspected)
    {
        InspectAuditDirectory(root, config.http.control, config.store.directory);
    }
    ReadEngineConfig(root, config.engine);
    ReadStations(root, config);
    ReadRobots(root, drivers, config);
    const MethodTables actions = ReadActions(root, config);
    MakeSetups(reader, fileName, drivers, config);
    ReadMethods(root, actions, config);
    ApplyCapabilities(reader, config);
    CheckBroker(root, fileName, config);
    ReportRemovedKeys(root);
    if (reader.GetErrors().empty())
    {
        CheckActions(root, config);
    }
    std::optional<Planning::SiteMap> open; // before the factsheets close edges
    if (reader.GetErrors().empty() && config.site.has_value())
    {
        open = config.site;
        CloseEdges(config);
        for (Core::Error& error : Planning::FindErrors(config.engine, *config.site))
        {
            const std::string path = std::exchange(error.path, {});
            reader.AddError(path, Core::Describe(error));
        }
    }
    if (reader.GetErrors().empty() && config.site.has_value())
    {
        std::ranges::move(FindParkingFaults(config.engine, *config.site), std::back_inserter(config.warnings));
        std::ranges::move(
            FindUnreachableStations(config.engine, *open, *config.site),
            std::back_inserter(config.warnings));
        SetMaps(config);
        WarnOfFactsheets(config);
        WarnOfCorridors(config);
    }
    config.errors = reader.GetErrors();
    std::ranges::move(otherErrors, std::back_inserter(config.errors));
    config.values = reader.GetValues();
    config.files = ReadNamedFiles(fileName, config.values);
    return config;
}

} // namespace

AcsdConfig ReadAcsdConfig(
    const std::string& fileName,
    const std::vector<std::string>& overrides,
    const RobotDrivers& drivers)
{
    return Read(fileName, overrides, drivers, false);
}

AcsdConfig CheckAcsdConfig(
    const std::string& fileName,
    const std::vector<std::string>& overrides,
    const RobotDrivers& drivers)
{
    return Read(fileName, overrides, drivers, true);
}

std::string GetInterfaceName(const AcsdConfig& config)
{
    return config.mqtt.value_or(MqttConfig()).interfaceName;
}

} // namespace ACS::Acsd
