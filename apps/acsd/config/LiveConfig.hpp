#pragma once

#include "config/AcsdConfig.hpp"
#include <acs/core/Logger.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// What a second reading of the configuration has changed, each list sorted by key.
struct ConfigChange
{
    std::vector<std::string> taken;   ///< Holds from now on.
    std::vector<std::string> waiting; ///< Holds from the next start on.

    bool operator==(const ConfigChange&) const = default;
};

/// Whether acsd takes this key ("log.level") while it runs; docs/reference/configuration.md marks them.
[[nodiscard]] bool IsLiveKey(std::string_view key);

/// Both as AcsdConfig::values. A key that is given now and was not before, or the other way round, has changed.
[[nodiscard]] ConfigChange CompareConfigs(
    const std::map<std::string, std::string>& before,
    const std::map<std::string, std::string>& after);

/// A line per key that differs.
void LogChange(const AcsdConfig& present, const AcsdConfig& fresh, const Core::Logger& logger);

/// What IsLiveKey names; everything else stays.
void TakeLiveKeys(const AcsdConfig& fresh, AcsdConfig& present);

} // namespace ACS::Acsd
