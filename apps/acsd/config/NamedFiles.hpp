#pragma once

#include <map>
#include <string>

namespace ACS::Acsd
{

/// The text of each file that acsd reads only with the configuration, by the key that names it ("site.map"); without text if it cannot
/// be read. The values are those of the keys as TOML.
[[nodiscard]] std::map<std::string, std::string> ReadNamedFiles(
    const std::string& configFile,
    const std::map<std::string, std::string>& values);

} // namespace ACS::Acsd
