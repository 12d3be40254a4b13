#pragma once

#include "common/config/ConfigReader.hpp"
#include "common/config/LocalOffset.hpp"
#include "common/config/Url.hpp"
#include "config/ArmOptions.hpp"
#include "config/McsConfig.hpp"
#include "config/MqttConfig.hpp"
#include "config/OperationsConfig.hpp"
#include "robots/ArmRelay.hpp"
#include "robots/JobData.hpp"
#include "robots/JobMethods.hpp"
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

/// The vehicle and the arm of one robot; what the engine must know of it is in EngineOptions::robots.
struct RobotLinkConfig
{
    std::string robotID;
    std::string manufacturer;
    std::string serialNumber;
    std::string protocolVersion;        ///< "2.0.0" or "2.1.0"
    std::optional<Apps::Url> armOrNull; ///< tcp://, Open Stream of its controller
    ArmOptions armOptions = {};
    JobMethods methods = {}; ///< Of the actions of its type.
};

/// acsd's configuration, checked as a whole.
struct AcsdConfig
{
    McsConfig mcs;
    MqttConfig mqtt;
    ArmOptions arm; ///< Of arms whose robot does not give its own.
    EArmRelayIndex relayIndex = EArmRelayIndex::Value;
    std::string siteFile;
    std::string storePath;
    Apps::Endpoint httpListen{"127.0.0.1", 8080};
    std::vector<std::string> httpHosts; ///< Names by which it may be called, without port.
    Apps::LocalOffset localOffset;
    std::vector<RobotLinkConfig> robots;
    std::shared_ptr<const StationTable> stations = std::make_shared<const StationTable>();
    OperationsConfig operations;
    Planning::EngineOptions engine;
    std::optional<Planning::SiteMap> site; ///< Always there when there are no mistakes.
    /// Each key that is given, "mcs.url", with its value as TOML: what a later reading differs in.
    std::map<std::string, std::string> values;
    std::vector<std::string> warnings; ///< What is not wrong, but should not be so.
    std::vector<std::string> mistakes; ///< Each with file, line and key; empty: the rest is good.
};

/// Reads the file, with the overrides of the command line ("table.key=value") on top, and the map that it names.
[[nodiscard]] AcsdConfig ReadAcsdConfig(const std::string& fileName, const std::vector<std::string>& overrides);

/// The same, and looks at the store that it names too, without making, changing or taking it: what a start would find.
[[nodiscard]] AcsdConfig CheckAcsdConfig(const std::string& fileName, const std::vector<std::string>& overrides);

} // namespace ACS::Acsd
