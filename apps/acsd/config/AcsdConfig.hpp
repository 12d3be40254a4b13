#pragma once

#include "common/config/ConfigReader.hpp"
#include "common/config/LocalOffset.hpp"
#include "config/ArmOptions.hpp"
#include "config/HttpConfig.hpp"
#include "config/McsConfig.hpp"
#include "config/MqttConfig.hpp"
#include "config/OperationsConfig.hpp"
#include "config/StoreConfig.hpp"
#include "config/VehicleConfig.hpp"
#include "drivers/BuiltInDrivers.hpp"
#include "robots/ArmRelay.hpp"
#include "robots/JobData.hpp"
#include <acs/acsd/IRobotDriver.hpp>
#include <acs/acsd/IRobotSetup.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The drivers of MakeBuiltInDrivers: a vehicle, and a vehicle with an arm.
inline constexpr std::string_view VDA5050_DRIVER = "vda5050";
inline constexpr std::string_view OPEN_STREAM_DRIVER = "vda5050_openstream";

/// The driver of one robot. The engine's settings of the robot are in EngineOptions::robots.
struct RobotLinkConfig
{
    std::string robotID;
    std::string driver = std::string(VDA5050_DRIVER);
    std::vector<std::string> ports;                 ///< RobotOptions::ports
    std::string topicPrefix;                        ///< RobotCapabilities::topicPrefix
    std::shared_ptr<const IRobotSetup> setupOrNull; ///< Set if there are no errors.
};

/// acsd's complete and checked configuration.
struct AcsdConfig
{
    std::string fileName; ///< Relative paths begin at its folder.
    McsConfig mcs;
    std::optional<MqttConfig> mqtt; ///< Set if a robot uses the broker.
    ArmOptions arm;                 ///< Defaults of all arms.
    EArmRelayIndex relayIndex = EArmRelayIndex::Value;
    std::string siteFile;
    std::string zoneSetID; ///< Of all orders; may be empty.
    StoreConfig store;
    HttpConfig http;
    Apps::LocalOffset localOffset;
    std::vector<RobotLinkConfig> robots; ///< In the order of EngineOptions::robots.
    /// Those of the robots whose drivers are built in, and which their setups share.
    std::vector<std::shared_ptr<VehicleConfig>> vehicles;
    std::shared_ptr<const StationTable> stations = std::make_shared<const StationTable>();
    OperationsConfig operations;
    Planning::EngineOptions engine;
    std::optional<Planning::SiteMap> site; ///< Always set if there are no errors.
    /// Each key that is given ("mcs.url") with its value as TOML, for comparison after a reload.
    std::map<std::string, std::string> values;
    std::map<std::string, std::string> files; ///< Of ReadNamedFiles. Some are secrets.
    std::vector<std::string> warnings; ///< Valid settings that are not advisable; what the map demands without effect.
    std::vector<std::string> notes;    ///< Members of the map that acsd ignores and that demand nothing.
    std::vector<std::string> errors;   ///< Errors, each with file, line and key; empty: the configuration is valid.
};

/// Reads the file and its map. The overrides of the command line ("table.key=value") take precedence.
[[nodiscard]] AcsdConfig ReadAcsdConfig(
    const std::string& fileName,
    const std::vector<std::string>& overrides,
    const RobotDrivers& drivers = MakeBuiltInDrivers());

/// Likewise, and checks whether a start could open the store. Does not create, change or lock it.
[[nodiscard]] AcsdConfig CheckAcsdConfig(
    const std::string& fileName,
    const std::vector<std::string>& overrides,
    const RobotDrivers& drivers = MakeBuiltInDrivers());

/// First level of the topics of the vehicles.
[[nodiscard]] std::string GetInterfaceName(const AcsdConfig& config);

} // namespace ACS::Acsd
