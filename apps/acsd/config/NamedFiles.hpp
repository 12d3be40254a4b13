#pragma once

#include <map>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The text of each file that acsd reads only with the configuration, by the key that names it ("site.map"); without text if it cannot
/// be read. The values are those of the keys as TOML.
[[nodiscard]] std::map<std::string, std::string> ReadNamedFiles(
    const std::string& configFile,
    const std::map<std::string, std::string>& values);

/// The keys, sorted, of paths in the folder where systemd puts the credentials of the service. systemd writes it only when the service
/// starts. The values are those of the keys as TOML.
[[nodiscard]] std::vector<std::string> FindCredentialKeys(const std::map<std::string, std::string>& values);

} // namespace ACS::Acsd
