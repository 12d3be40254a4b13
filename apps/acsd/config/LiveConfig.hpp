#pragma once

#include "config/AcsdConfig.hpp"
#include <acs/core/Logger.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The keys that differ after a reload of the configuration, each list sorted.
struct ConfigChange
{
    std::vector<std::string> applied; ///< Applied at once.
    std::vector<std::string> pending; ///< In effect after the next start.

    bool operator==(const ConfigChange&) const = default;
};

/// Whether acsd applies a change of this key ("log.level") while it runs; docs/reference/configuration.md marks these keys.
[[nodiscard]] bool IsLiveKey(std::string_view key);

/// Compares two AcsdConfig::values. A key that only one of them has differs, too.
[[nodiscard]] ConfigChange CompareConfigs(
    const std::map<std::string, std::string>& before,
    const std::map<std::string, std::string>& after);

/// Logs one line for each key that differs, or whose file does, and a warning if keys name credentials of systemd.
void LogChange(const AcsdConfig& present, const AcsdConfig& fresh, const Core::Logger& logger);

/// Copies the values of the live keys (see IsLiveKey).
void ApplyLiveKeys(const AcsdConfig& fresh, AcsdConfig& present);

} // namespace ACS::Acsd
