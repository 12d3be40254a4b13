#include "config/NamedFiles.hpp"

#include "common/config/ConfigReader.hpp"
#include "common/config/TextFile.hpp"
#include "config/McsConfig.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

/// Those of TLS and the tokens are not among them: they are read again while acsd runs.
constexpr std::array<std::string_view, 5>
    FILE_KEYS{"errors.map", "mcs.headers_file", "mqtt.password_file", "site.map", "store.password_file"};

bool IsFileKey(std::string_view key)
{
    return std::ranges::find(FILE_KEYS, key) != FILE_KEYS.end()
        || (key.starts_with("robots.") && key.ends_with(".factsheet_file"));
}

/// The value of a string that is given as TOML.
std::string ReadString(const std::string& value)
{
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadText("value = " + value, {}, {});
    return reader.GetRoot().GetString("value", "");
}

} // namespace

std::map<std::string, std::string> ReadNamedFiles(
    const std::string& configFile,
    const std::map<std::string, std::string>& values)
{
    std::map<std::string, std::string> files;
    for (const auto& [key, value] : values)
    {
        if (IsFileKey(key))
        {
            files.emplace(key, Apps::ReadTextFile(ResolvePath(configFile, ReadString(value))).value_or(std::string()));
        }
    }
    return files;
}

std::vector<std::string> FindCredentialKeys(const std::map<std::string, std::string>& values)
{
    // NOLINTNEXTLINE(concurrency-mt-unsafe): the environment is never changed
    const char* const directoryOrNull = std::getenv("CREDENTIALS_DIRECTORY");
    const std::string directory = directoryOrNull == nullptr ? std::string() : std::string(directoryOrNull) + '/';
    std::vector<std::string> keys;
    for (const auto& [key, value] : values)
    {
        const std::string path = ReadString(value);
        if (path.starts_with("${CREDENTIALS_DIRECTORY}/") || (directory.size() > 1 && path.starts_with(directory)))
        {
            keys.push_back(key);
        }
    }
    return keys;
}

} // namespace ACS::Acsd
