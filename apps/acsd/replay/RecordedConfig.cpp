#include "replay/RecordedConfig.hpp"

#include "common/Version.hpp"
#include "config/LiveConfig.hpp"
#include "operator/OperatorToken.hpp"
#include "replay/RecordKind.hpp"
#include <acs/json/TextCodec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::RecordedFile>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("name", &Acsd::RecordedFile::name), Required("text", &Acsd::RecordedFile::text));
};

template <>
struct JsonFields<Acsd::RecordedRun>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("version", &Acsd::RecordedRun::version),
        Required("config", &Acsd::RecordedRun::config),
        Optional("files", &Acsd::RecordedRun::files));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

/// Of links, paths and secrets. The keys that are required are added again, with a value that connects to nothing.
constexpr std::array<std::string_view, 12> OMITTED{
    "http.",
    "operator.",
    "mqtt.",
    "mcs.tls",
    "mcs.headers",
    "mcs.host",
    "mcs.url",
    "store.directory",
    "store.url",
    "store.password_file",
    "store.lease",
    "store.instance"};

constexpr std::array<std::string_view, 4> SECRETS{"password", "secret", "token", "api_key"};

constexpr std::string_view INTERFACE_KEY = "mqtt.interface_name";
constexpr std::string_view TIMEZONE_KEY = "site.timezone";

bool IsOmitted(std::string_view key)
{
    return key != INTERFACE_KEY
        && std::ranges::any_of(OMITTED, [key](std::string_view prefix) { return key.starts_with(prefix); });
}

bool IsSecret(std::string_view key)
{
    const std::string_view name = key.substr(key.rfind('.') + 1);
    return std::ranges::any_of(SECRETS, [name](std::string_view word) {
        return name.find(word) != std::string_view::npos;
    });
}

bool IsFile(std::string_view key)
{
    return key == "site.map" || key == "errors.map" || (key.starts_with("robots.") && key.ends_with(".factsheet_file"));
}

/// The name of the recorded file of the key: unique, and one for each key.
std::string MakeFileName(std::string_view key)
{
    std::string name(key);
    std::ranges::replace_if(
        name,
        [](char letter) { return letter == '/' || letter == '"' || letter == '\''; },
        '_');
    return name;
}

std::string QuoteName(std::string_view name)
{
    return fmt::format("\"{}\"", name);
}

std::string MakeOffsetText(std::chrono::minutes offset)
{
    constexpr int HOUR = 60;
    const auto minutes = static_cast<int>(std::abs(offset.count()));
    return fmt::format("\"{}{:02}:{:02}\"", offset.count() < 0 ? '-' : '+', minutes / HOUR, minutes % HOUR);
}

std::string MakeTOML(const std::map<std::string, std::string>& values)
{
    std::string text;
    for (const auto& [key, value] : values)
    {
        fmt::format_to(std::back_inserter(text), "{} = {}\n", key, value);
    }
    return text;
}

std::map<std::string, std::string> MakeRecordedValues(const AcsdConfig& config)
{
    std::map<std::string, std::string> values;
    for (const auto& [key, value] : config.values)
    {
        if (!IsOmitted(key))
        {
            values.emplace(
                key,
                IsFile(key)         ? QuoteName(MakeFileName(key))
                    : IsSecret(key) ? QuoteName("omitted")
                                    : value);
        }
    }
    values.insert_or_assign("mcs.url", QuoteName("ws://127.0.0.1:9/"));
    values.insert_or_assign("store.directory", QuoteName("store"));
    if (config.mqtt.has_value())
    {
        values.insert_or_assign("mqtt.url", QuoteName("mqtt://127.0.0.1:9"));
    }
    return values;
}

/// As acsd runs with them: those on the disk may have changed since.
std::vector<RecordedFile> MakeRecordedFiles(const AcsdConfig& config)
{
    std::vector<RecordedFile> files;
    for (const auto& [key, text] : config.files)
    {
        if (IsFile(key))
        {
            files.push_back({MakeFileName(key), text});
        }
    }
    return files;
}

bool TryWrite(const std::string& path, std::string_view text)
{
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    return file.good();
}

} // namespace

std::string MakeRecordedConfig(const AcsdConfig& config)
{
    return MakeTOML(MakeRecordedValues(config));
}

std::string MakeConfigFingerprint(const AcsdConfig& config)
{
    std::map<std::string, std::string> values = MakeRecordedValues(config);
    std::erase_if(values, [](const auto& entry) {
        return IsLiveKey(entry.first) || entry.first.starts_with("log.") || entry.first.starts_with("trace.");
    });
    std::string text = MakeTOML(values);
    for (const RecordedFile& file : MakeRecordedFiles(config))
    {
        text += fmt::format("{} {}\n{}\n", file.name, file.text.size(), file.text);
    }
    std::string fingerprint;
    for (const std::uint8_t byte : HashToken(text))
    {
        fmt::format_to(std::back_inserter(fingerprint), "{:02x}", byte);
    }
    return fingerprint;
}

CoreRecord MakeBeginRecord(const AcsdConfig& config, Core::Now now)
{
    std::map<std::string, std::string> values = MakeRecordedValues(config);
    values.insert_or_assign(std::string(TIMEZONE_KEY), MakeOffsetText(config.localOffset.GetAt(now.wall)));
    const RecordedRun run{std::string(Apps::VERSION), MakeTOML(values), MakeRecordedFiles(config)};
    CoreRecord record;
    record.now = now;
    record.kind = BEGIN_KIND;
    record.text = Json::EncodeText(run);
    return record;
}

Core::Result<RecordedRun> DecodeBegin(std::string_view text)
{
    return Json::DecodeText<RecordedRun>(text);
}

AcsdConfig ReadRecordedConfig(const RecordedRun& run, const std::string& folder, const RobotDrivers& drivers)
{
    AcsdConfig unwritten;
    for (const RecordedFile& file : run.files)
    {
        // The name comes from the recording: it must not leave the folder.
        if (file.name.find('/') == std::string::npos && !TryWrite(folder + "/" + file.name, file.text))
        {
            unwritten.errors.push_back(fmt::format("{}/{} cannot be written", folder, file.name));
        }
    }
    const std::string path = folder + "/acsd.toml";
    if (!TryWrite(path, run.config))
    {
        unwritten.errors.push_back(fmt::format("{} cannot be written", path));
    }
    return unwritten.errors.empty() ? ReadAcsdConfig(path, {}, drivers) : unwritten;
}

} // namespace ACS::Acsd
